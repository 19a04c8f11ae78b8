#pragma once
#include <cstdint>
#include <vector>

#include "compiler/bake/patch_locator.h"
#include "compiler/bake/radiosity.h"

namespace orbc::bake {

/// A point at which light from other surfaces is gathered.
struct GatherPoint {
  surface::ShadingPoint at;
  PatchUv base;  ///< of a level of detail: the point of the part itself that has the same light, if it is known
};

/// The gather points of a patch: a grid from corner to corner, row by row.
struct PatchPoints {
  int width = 2, height = 2;
  std::vector<std::int32_t> point;  ///< index of the gather point; −1: beyond the long side of a single triangle
};

/// Gather points on all surfaces of a room: at the vertices of its parts, which patches share, and inside of the patches.
struct GatherNet {
  std::vector<GatherPoint> points;
  std::vector<PatchPoints> patches;  ///< of all patches, in the order of the parts
};

/// In: gather points per unit of length.
[[nodiscard]] GatherNet make_gather_net(const LitPatches& surfaces, const PatchLocator& locator, double density);

}  // namespace orbc::bake
