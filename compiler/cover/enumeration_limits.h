#pragma once
#include <functional>
#include <vector>

#include "compiler/cover/enumerate.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"

namespace orbc::cover {

/// The cut-offs of a scene, in terms of the enumeration of its group. The letters of the automaton are the walls that reflect.
struct EnumerationLimits {
  int max_bounces = 0;                          ///< what `max_bounces` and `min_weight` allow together
  std::vector<scene::Color> weight_by_bounces;  ///< 0 … max_bounces; multiplied mirror by mirror, as in the tracer
  std::vector<int> wall_of_letter;              ///< `**`: 0 and 2; `*22∞`: 0, 1 and 3; else every wall
  std::vector<bool> has_mirror;                 ///< by letter; false: a plain wall
  std::vector<geometry::Isometry> reflections;  ///< by letter
  int bounces_per_half_turn = 0;                ///< S²: length of the longest word = bounces of any path of length π; 0 elsewhere
  int sheets = 1;                               ///< S²: number of sheets (copy.h) with copies in the limits; 1 elsewhere
  double min_pixels = 0;                        ///< smaller copies (projected_size.h) are left out
};

/// In:    a room whose copies the group enumerates: !needs_beams(room). Mirrors on floor and ceiling have no influence (storeys.h).
[[nodiscard]] EnumerationLimits enumeration_limits(const place::Interior& room, const scene::CoverSpec& spec);

/// Visits every copy on sheet 0 in the order of `enumerate`: visit(element, cover_from_room). Copies behind plain walls and copies below
/// `min_pixels` are left out.
/// Exact: a word with the letter of a plain wall is always hidden. Two reduced words of one element have the same letters (Tits, 1969), so
///        every straight path to such a copy crosses an image of the plain wall.
void visit_copies(const EnumerationLimits& limits, const place::Interior& room, const place::Camera& eye,
                  const std::function<Visit(const Element&, const geometry::Isometry& cover_from_room)>& visit);

/// Mirrors between the eye and a copy with a word of `length` letters, as seen on a sheet.
[[nodiscard]] int bounces_on_sheet(const EnumerationLimits& limits, int length, int sheet);

}  // namespace orbc::cover
