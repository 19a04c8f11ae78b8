#include "compiler/bake/irradiance_cache.h"

#include <algorithm>

#include "compiler/light/connection.h"

namespace orbc::bake {
namespace {

std::vector<std::vector<TexelPatch>> patches_of(const place::Interior& interior, const light::LightingContext& lighting) {
  std::vector<std::vector<TexelPatch>> patches;
  for (std::size_t p = 0; p < interior.parts.size(); ++p)
    patches.push_back(make_patches(interior, static_cast<std::uint32_t>(p), lighting.normals[p]));
  return patches;
}

constexpr float kPhases = 4096;  // of a patch: neighbouring points check different images

/// The cell of a grid of `points` points in which a coordinate from 0 to 1 lies.
std::size_t cell_of(float at, int points) {
  return static_cast<std::size_t>(std::clamp(static_cast<int>(at * static_cast<float>(points - 1)), 0, points - 2));
}

}  // namespace

IrradianceCache::IrradianceCache(const place::Interior& interior, const light::LightingContext& lighting, const BakeOptions& options)
    : interior_(interior), lighting_(lighting), options_(options), patches_(patches_of(interior, lighting)), locator_(interior, patches_) {
  std::size_t vertices = 0;
  for (std::size_t p = 0; p < interior.parts.size(); ++p) {
    first_vertex_.push_back(vertices);
    vertices += lighting.normals[p].vertices.size();
    corner_.resize(vertices);
    for (std::size_t t = interior.parts[p].triangles.size(); t-- > 0;)  // the first corner of a vertex counts
      for (std::size_t k = 3; k-- > 0;) corner_[first_vertex_[p] + lighting.normals[p].corners[t][k]] = {t, k};
    for (const TexelPatch& patch : patches_[p]) patch_.push_back(&patch);
  }
  light_ = std::make_unique<Patch[]>(patch_.size());
  vertices_ = std::make_unique<Vertex[]>(vertices);
}

BakePart IrradianceCache::part_at(std::size_t part) const {
  return {interior_, lighting_, options_, interior_.parts[part], lighting_.normals[part], nullptr};
}

CornerSample IrradianceCache::light_at(std::size_t part, const PatchCorner& corner) const {
  const std::size_t v = first_vertex_[part] + lighting_.normals[part].corners[corner.triangle][corner.k];
  Vertex& vertex = vertices_[v];
  std::call_once(vertex.once, [&] {
    const auto [triangle, k] = corner_[v];
    const BakePoint point = make_bake_point(part_at(part), triangle, surface::inset_corner(k), light::kVertexTolerance);
    vertex.seen.images = light::images_at(lighting_, point.point.at);
    light::VisibleIrradiance light = light::irradiance(lighting_, point.point, light::ExpectedImages{vertex.seen.images, {}});
    vertex.seen.visibility = std::move(light.visibility);
    vertex.light = {light.irradiance, light.irradiance == scene::Color{} && light::is_enclosed(lighting_, point.point)};
    ++lit_points_;
  });
  return {vertex.light, &vertex.seen};
}

const DirectLight& IrradianceCache::light_of(std::size_t patch) const {
  std::call_once(light_[patch].once, [&] {
    const TexelPatch& of = *patch_[patch];
    light_[patch].light = bake_direct(
        part_at(of.part), [&](const PatchCorner& corner) { return light_at(of.part, corner); }, of);
    lit_points_ += light_[patch].light.irradiance.lit_points;
  });
  return light_[patch].light;
}

scene::Color IrradianceCache::at(const trace::SurfacePoint& point, const trace::Hit& hit, const surface::ShadingPoint& lit,
                                 const light::SampleStratum& stratum) const {
  const PatchUv on = locator_.find(point, hit);
  if (on.patch < 0) return light::irradiance(lighting_, lit, stratum);
  const DirectLight& light = light_of(static_cast<std::size_t>(on.patch));
  const IrradianceGrid& grid = light.irradiance;
  if (!light.rough_cell.empty()) {
    const std::size_t cell = cell_of(on.v, grid.height) * static_cast<std::size_t>(grid.width - 1) + cell_of(on.u, grid.width);
    if (const std::uint32_t rough = light.rough_cell[cell]; rough != 0) {
      const auto phase = static_cast<std::uint32_t>(std::max(0.0f, kPhases * (on.u + on.v))) + static_cast<std::uint32_t>(stratum.index);
      return light::irradiance(lighting_, lit, {light.images, light.expected[rough - 1], phase}, stratum).irradiance;
    }
  }
  return interpolate(grid, static_cast<double>(on.u), static_cast<double>(on.v));
}

}  // namespace orbc::bake
