#pragma once
#include "compiler/bake/blocks.h"
#include "compiler/bake/light_grid.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/light/lighting.h"

namespace orbc::bake {

/// The surfaces of a room with what its lamps give them.
struct LitSurfaces {
  const place::PlacedRoom& room;
  const light::LightingContext& lighting;
  const std::vector<const surface::PartNormals*>& normals;  ///< per part
  const std::vector<std::vector<Block>>& blocks;            ///< per part
  const std::vector<LightGrid>& direct;                     ///< irradiance from lamps; of all blocks in the order of the parts
};

struct PassOptions {
  int samples = 256;    ///< directions asked at every point
  double density = 24;  ///< points per unit of length
};

/// Light that surfaces pass on to each other: for every block ∫ radiance·cosθ dω/π on a grid of points, as LightField::options.passes
/// allows.
/// How:   from every point of a net over all surfaces `samples` geodesics go out (light::Guide, the same lattice of directions everywhere,
///        so that what error there is changes smoothly), over mirrors and through mirror and glass objects, to where they end: a link with
///        a weight. What the lamps give there is added up at once; what has been passed on is carried over the links again and again
///        (Jacobi's iteration of the rendering equation; Cohen, Wallace, Radiosity and Realistic Image Synthesis, 1993, §5.3), until
///        nothing changes or `passes` is reached. Same numbers for any executor. Points that see the inside of closed things (floor below
///        frames) take on what their neighbours have; coarser levels have what the surface has where they stand for it.
/// Not promised: more detail than `density`; caustics.
[[nodiscard]] std::vector<LightGrid> pass_on(const LitSurfaces& surfaces, const PassOptions& options, const Executor& executor,
                                             const Progress& progress);

}  // namespace orbc::bake
