#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/rational.h"
#include "compiler/base/result.h"
#include "compiler/cover/copy.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"

namespace orbc::cover {

struct PlanOptions {
  /// Bound of the memory of all copies, each of kBytesPerCopy. Triangles do not count here (lod/estimate.h).
  std::uint64_t max_bytes = std::uint64_t{4} << 30;
};

/// Memory that a product takes, without its pictures.
constexpr double kBytesPerVertex = 20, kBytesPerTriangle = 12, kBytesPerCopy = 200;

/// Memory that one beam takes while copies are unfolded: the beam, its hit and the copy that results (measured: 480).
constexpr double kBytesPerBeam = 500;

/// How large a compiled scene will be. `plan` counts every copy with all triangles of the room, none of them split; lod/estimate.h
/// estimates how many triangles bending makes.
struct Plan {
  Integer copies;                                                          ///< exact
  std::vector<Integer> copies_per_bounces;                                 ///< 0 … the last number of bounces that has copies
  int sheets = 1;                                                          ///< number of sheets (copy.h) with copies
  std::uint64_t room_triangles = 0, room_vertices = 0;                     ///< of one copy
  std::uint64_t triangles = 0, vertices = 0, bytes = 0;                    ///< of all copies; bytes of memory
  std::vector<std::uint64_t> triangles_per_bounces, vertices_per_bounces;  ///< estimates; may be shorter than copies_per_bounces
};

/// Plans a scene before it is unfolded.
/// Makes:       the number of copies: from the growth series, or by enumeration where sizes or plain walls limit the group. Rooms that need
///              beams (beam.h) are unfolded.
/// Exact:       copies.
/// Diagnostics: those of `unfold`; cover.too-much when the copies exceed `max_bytes`; its hint names the largest max_bounces that fits.
[[nodiscard]] Result<Plan> plan(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec,
                                const PlanOptions& options = {});

/// The plan of copies that are unfolded already.
[[nodiscard]] Plan plan_of(const std::vector<Copy>& copies, const place::Interior& room);

/// The error cover.too-much of a cover with more than `max_copies` copies; its hint names the largest max_bounces that fits.
/// In: a room that does not need beams.
[[nodiscard]] Diagnostic too_many_copies(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec,
                                         std::uint64_t max_copies);

}  // namespace orbc::cover
