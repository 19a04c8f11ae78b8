#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/bake/bake_options.h"
#include "compiler/bake/irradiance_grid.h"
#include "compiler/bake/patch_locator.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/light/lighting.h"

namespace orbc::bake {

/// The direct light of the parts of a room, which their levels of detail take over.
struct BaseLight {
  const PatchLocator& locator;
  const std::vector<IrradianceGrid>& direct;  ///< of all patches that the locator knows
};

/// A part of a room to be baked.
struct BakePart {
  const place::Interior& interior;
  const light::LightingContext& lighting;
  const BakeOptions& options;
  const place::PlacedMesh& mesh;
  const surface::PartNormals& normals;
  const BaseLight* base = nullptr;  ///< of a level of detail: the light of the parts themselves; null: the part is one of them
};

/// A point to be lit, or the irradiance that it takes over from a part of which it is a level of detail.
struct BakePoint {
  surface::ShadingPoint point;
  std::optional<scene::Color> known_irradiance;
};
/// The point of a triangle at barycentric coordinates b. The points of a level of detail are moved onto the surface that it stands for, if
/// that lies within `reach`.
[[nodiscard]] BakePoint make_bake_point(const BakePart& part, std::size_t triangle, const std::array<double, 3>& b, double reach);

/// The direct light at the vertices of a part, which patches share. Black at emissive vertices.
struct VertexLight {
  std::vector<scene::Color> irradiance;  ///< per vertex of BakePart::normals
  std::vector<std::uint8_t> enclosed;    ///< 1: inside of a closed thing
  std::uint64_t lit_points = 0;          ///< vertices at which shadow rays were traced
};
[[nodiscard]] VertexLight light_vertices(const BakePart& part, const Executor& executor, const Progress& progress);

}  // namespace orbc::bake
