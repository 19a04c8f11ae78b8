#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"

namespace orbc::cutoff {

/// Whether a copy is culled: left out of the product for its size in the picture, though a path leads into it. Empty: no copy is culled.
using CullTest = std::function<bool(const cover::Copy&)>;

/// Culls copies smaller than the scene's `min_pixels` (cover/projected_size.h), and those smaller than `cull_px` (what a budget leaves out)
/// as bend::ScreenSize::smaller_side_px measures them. Copies within a relative 1e-6 of a limit are culled, so that rounding opens no hole.
/// In: `cull_px` 0: no budget culls.
[[nodiscard]] CullTest cull_below(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec, double cull_px);

/// How the path through a mirror of a copy ends there.
enum class Ending : std::uint8_t {
  none,   ///< it goes on into the next copy
  depth,  ///< by `max_bounces` or `min_weight`: the tracer follows it no further either
  size    ///< the copy behind the mirror is culled
};

/// Tells for each mirror of the room how paths through it end in a copy. Walls that face the eye are never drawn, and may be among them.
/// Invariant: the reflections are those of the room's mirrors. In: room and spec outlive this.
class Endings {
 public:
  Endings(const place::Interior& room, const scene::CoverSpec& spec, CullTest is_culled = {});
  /// Makes: parallel to Interior::mirrors.
  [[nodiscard]] std::vector<Ending> of(const cover::Copy& copy) const;

 private:
  const place::Interior& room_;
  const scene::CoverSpec& spec_;
  CullTest is_culled_;
  std::vector<geometry::Isometry> reflections_;  // per mirror; of floor and ceiling the identity
};

}  // namespace orbc::cutoff
