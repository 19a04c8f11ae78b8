#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "compiler/bake/bake_options.h"
#include "compiler/bake/patch_texels.h"
#include "compiler/bake/patches.h"
#include "compiler/bake/rect_packing.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/light/lighting.h"

namespace orbc::bake {

/// What was baked, for reports.
struct BakeCounts {
  std::uint64_t lit_points = 0;  ///< surface points at which shadow rays were traced
  std::uint64_t texels = 0;
};

/// The texels of a part before they have places in a picture.
struct PartTexels {
  std::vector<TexelRect> rects;                     ///< per patch: width and height
  std::vector<std::array<std::uint8_t, 4>> rgba;    ///< patch by patch, row by row
  std::vector<std::array<std::uint16_t, 3>> rgb16;  ///< parallel; empty unless BakeOptions::with_image16
  std::map<std::size_t, PatchTexels> above_white;   ///< by patch: those with colours above white, with PatchTexels::light
};

/// The light that the surfaces of a room send to every eye alike. Nothing in it depends on an eye.
struct DiffuseTexels {
  std::vector<PartTexels> parts;
  BakeCounts counts;
};

/// Bakes the light of a room.
/// In:    the patches of all parts, and the lighting that prepare_light made for this room. Parts beyond those of the lighting are levels
///        of detail: their points take over the light of the surface that they stand for; only points far from any are lit themselves.
/// Makes: for every patch a grid of texels from corner to corner, with texel centres on the corners, so that bilinear look-up never leaves
///        the patch, and neighbours that share an edge agree on it. Grids are adaptive: coarse where light is even, fine at the borders of
///        shadows. Same texels for any executor.
[[nodiscard]] DiffuseTexels bake_texels(const place::Interior& interior, const std::vector<std::vector<TexelPatch>>& patches,
                                        const light::LightingContext& lighting, const BakeOptions& options, const Executor& executor,
                                        const Progress& progress = {});

}  // namespace orbc::bake
