#pragma once
#include <vector>

#include "compiler/bake/bake_options.h"
#include "compiler/bake/irradiance_grid.h"
#include "compiler/bake/patches.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/light/lighting.h"

namespace orbc::bake {

/// The patches of a room with their direct light.
struct LitPatches {
  const place::Interior& interior;
  const light::LightingContext& lighting;
  const std::vector<const surface::PartNormals*>& normals;  ///< per part
  const std::vector<std::vector<TexelPatch>>& patches;      ///< per part
  const std::vector<IrradianceGrid>& direct;                ///< of all patches, in the order of the parts
};

/// Finds the light that surfaces give each other.
/// Makes:   for every patch ∫ radiance·cosθ dω/π, which is irradiance / π, after at most LightOptions::indirect_bounces reflections by
///          matte surfaces.
/// Source:  Jacobi's iteration of the radiosity equation (Cohen, Wallace, Radiosity and realistic image synthesis, 1993, §5.3), with rays
///          instead of form factors. From every gather point `samples` geodesics go out, in the same lattice of directions everywhere, so
///          that errors change smoothly along surfaces. Each goes over mirrors and through mirror and glass objects to the surface where it
///          ends. The direct light of that surface is gathered at once. What it gets from other surfaces is gathered again in every pass,
///          over a part of the directions, until nothing changes.
/// Error:   gather points inside closed things (the floor below frames) take on the light of their neighbours. Levels of detail take over
///          the light of the surface that they stand for. Same numbers for any executor.
/// Not promised: detail finer than the density of gather points; caustics.
[[nodiscard]] std::vector<IrradianceGrid> solve_radiosity(const LitPatches& surfaces, const RadiosityOptions& options,
                                                          const Executor& executor, const Progress& progress);

}  // namespace orbc::bake
