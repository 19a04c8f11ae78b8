#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "compiler/bend/bend.h"
#include "compiler/driver/open.h"

namespace orbc::driver {

/// Whether a copy is left out of the product for its size in the picture, though a path may lead there. None: no copy is.
using LeftOut = std::function<bool(const cover::Copy&)>;

/// Copies smaller than the scene's `min_pixels` (cover/projected_size.h), or than `budget_px` by bend::ScreenSize::smaller_side_px: what a
/// budget leaves out. Just large enough counts as too small, so that rounding opens no hole.
[[nodiscard]] LeftOut left_out_below(const Opened& opened, double budget_px);

struct BeyondOptions {
  bool color = false;          ///< of what lies beyond the cut-off by bounces and weight
  LeftOut left_out;            ///< copies whose colours are wanted as well
  std::vector<double> bands;   ///< borders between heights of the room that get a colour each
};

/// What lies beyond the mirrors at which the picture ends.
struct Beyond {
  double weight_lost = 0;      ///< of paths that are cut off by bounces or weight: largest channel, mean over the picture
  double weight_merged = 0;    ///< the same of paths that lead into copies left out for their size
  scene::Color color;          ///< radiance that is expected where paths are cut off; the scene's background where none is
  /// Radiance that copies left out bring, as they are seen through each band of a mirror, from the floor up
  std::vector<scene::Color> by_height;
};

/// Whether paths that are cut off show anything: then exports need panels at their ends.
[[nodiscard]] bool shows_beyond(const Opened& opened);

/// Looks beyond the mirrors at which an export ends: follows a fixed grid of rays of the picture through the real mirrors, those that are
/// cut off much deeper.
/// Makes: color = Σ (radiance the paths bring to the eye) / Σ (their weights at that mirror), channel by channel: with it in place of what
///        is cut off the grid's mean is right. The same for any executor. What only the weight is asked of may be a coarser stand-in of the
///        room.
/// Error: that of the grid; light that surfaces pass on to each other is left out.
[[nodiscard]] Beyond look_beyond(const Opened& opened, const place::Interior& room, const BeyondOptions& options,
                                 const Executor& executor);

/// A panel in each mirror (parallel to the room's): what is drawn where nothing lies behind it. Each band of heights between `bands` has a
/// look of its own: first_look, first_look + 1, … from the floor up. `flat`: of as few triangles as that takes, to be drawn without splits.
[[nodiscard]] std::vector<place::PlacedMesh> curtains(const place::Interior& room, std::uint16_t first_look,
                                                      const std::vector<double>& bands = {}, bool flat = false);

/// Whether panels that hide copies of so many pixels may be flat. Seen from the eye a flat panel fills the same bearings as the wall, whose
/// image bulges towards the eye, and nothing else lies there: only the edge of the floor before it does not end at it, which it hides by
/// reaching into the floor.
[[nodiscard]] bool may_be_flat(const place::Interior& room, double pixels);

/// Where panels get another colour: what one sees above the height of the eye goes up, what one sees below it goes down. None in a room of
/// storeys.
[[nodiscard]] std::vector<double> bands_of(const place::Interior& room, const place::Camera& eye);

/// How what is seen in a mirror of a copy ends there.
enum class CutOff : std::uint8_t {
  no,      ///< it goes on
  depth,   ///< by bounces or weight: the tracer reflects no more
  size     ///< the copy behind it is left out for its size
};

/// Tells of each mirror of the room how it ends in a copy. Walls that face the eye are never drawn, and may be among them.
class CutOffs {
 public:
  CutOffs(const place::Interior& room, const scene::CoverSpec& spec, LeftOut left_out = {});
  [[nodiscard]] std::vector<CutOff> of(const cover::Copy& copy) const;

 private:
  const place::Interior& room_;
  const scene::CoverSpec& spec_;
  LeftOut left_out_;
  std::vector<geometry::Isometry> behind_;   // by mirror: the reflection in its wall
};

/// The panels for each kind of end, parallel to the mirrors; empty: none are hung there.
struct Curtains {
  std::vector<bend::Model::Part> depth, size;
};

/// Adds panels to the models of the copies that need them. Makes: how many are hung; copies that need the same share a model.
std::uint64_t hang(const CutOffs& cut_offs, const std::vector<cover::Copy>& copies, const Curtains& curtains,
                   std::vector<bend::Model>& models, std::vector<std::uint32_t>& model_of_copy);

/// Gives the room panels for its mirrors, and a look for each of their colours. Makes: which parts they are.
[[nodiscard]] std::vector<std::size_t> add_curtains(place::Interior& room, const std::vector<scene::Color>& colors,
                                                    const std::vector<double>& bands, bool flat);

}  // namespace orbc::driver
