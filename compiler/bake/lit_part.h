#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/bake/bake.h"
#include "compiler/bake/light_grid.h"
#include "compiler/bake/surface_map.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"

namespace orbc::bake {

/// A part of a room on its way through the bake.
struct LitPart {
  const place::PlacedRoom& room;
  const light::LightingContext& lighting;
  const BakeOptions& options;
  const place::PlacedMesh& mesh;
  const surface::PartNormals& normals;
  const SurfaceMap* surfaces = nullptr;    ///< of a coarser level of another part: the parts themselves, whose light is this one's too,
  const std::vector<LightGrid>& lamps;     ///< as far as it is known
  std::vector<scene::Color> at_vertex;     ///< irradiance at normals.vertices
  std::vector<std::uint8_t> blind_vertex;  ///< covered by a closed thing
};

/// A point to be lit, or its light.
struct PointToLight {
  surface::ShadingPoint point;
  std::optional<scene::Color> known;
};
/// A point of a triangle; points of a coarser level have the light of the surface there. In: how far off that may be.
[[nodiscard]] PointToLight point_to_light(const LitPart& part, std::size_t triangle, const std::array<double, 3>& b, double reach);

/// Lights the vertices that blocks share. Makes: how many of them were asked.
std::uint64_t light_vertices(LitPart& part, const Executor& executor, const Progress& progress);

}  // namespace orbc::bake
