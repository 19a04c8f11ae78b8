// The stages of the diffuse bake: direct light of all patches, light between surfaces, texels. Vertices are lit once and shared by all
// patches that meet there.
#include "compiler/bake/diffuse_texels.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>

#include "compiler/bake/bake_part.h"
#include "compiler/bake/diffuse_patch.h"
#include "compiler/bake/radiosity.h"

namespace orbc::bake {
namespace {

struct RoomBake {
  const place::Interior& interior;
  const std::vector<std::vector<TexelPatch>>& patches;  ///< per part
  const light::LightingContext& lighting;
  const BakeOptions& options;
};

/// The direct light of all patches of a room.
struct LitRoom {
  std::vector<surface::PartNormals> lod_normals;     ///< per part; empty for those that the lighting knows
  std::vector<const surface::PartNormals*> normals;  ///< per part
  std::vector<std::size_t> first;                    ///< per part: its first patch among all
  std::vector<IrradianceGrid> direct;                ///< of all patches
  std::uint64_t lit_points = 0;
};

bool is_lod(const light::LightingContext& lighting, std::size_t part) { return lighting.lit && part >= lighting.normals.size(); }

LitRoom light_room(const RoomBake& bake, const Executor& executor, const Progress& progress) {
  const place::Interior& interior = bake.interior;
  const light::LightingContext& lighting = bake.lighting;
  LitRoom lit;
  lit.lod_normals.resize(interior.parts.size());
  for (std::size_t p = 0; p < interior.parts.size(); ++p) {
    const bool is_known = p < lighting.normals.size();
    if (!is_known) lit.lod_normals[p] = surface::part_normals(interior, interior.parts[p]);
    lit.normals.push_back(is_known ? &lighting.normals[p] : &lit.lod_normals[p]);
    lit.first.push_back(p == 0 ? 0 : lit.first.back() + bake.patches[p - 1].size());
  }
  lit.direct.resize(lit.first.empty() ? 0 : lit.first.back() + bake.patches.back().size());
  const std::size_t base_parts = std::min(lighting.normals.size(), interior.parts.size());
  const PatchLocator locator(interior, std::span(bake.patches).first(base_parts));
  const BaseLight base{locator, lit.direct};
  for (std::size_t p = 0; p < interior.parts.size(); ++p) {
    const BakePart part{interior, lighting, bake.options, interior.parts[p], *lit.normals[p], is_lod(lighting, p) ? &base : nullptr};
    const VertexLight vertices = light_vertices(part, executor, progress);
    lit.lit_points += vertices.lit_points;
    const CornerLight corners = corner_light(part, vertices);
    const std::vector<TexelPatch>& patches = bake.patches[p];
    std::atomic<std::uint64_t> done{0};
    executor(patches.size(), [&](std::size_t i) {
      lit.direct[lit.first[p] + i] = bake_direct(part, corners, patches[i]).irradiance;
      report(progress, "baking", done.fetch_add(1), patches.size(), "blocks");
    });
  }
  for (const IrradianceGrid& grid : lit.direct) lit.lit_points += grid.lit_points;
  return lit;
}

/// The texels of a part. In: the light between surfaces, of all patches or empty.
PartTexels shade_part(const RoomBake& bake, const LitRoom& lit, const std::vector<IrradianceGrid>& indirect, std::size_t p,
                      const Executor& executor) {
  const std::vector<TexelPatch>& patches = bake.patches[p];
  const BakePart part{bake.interior, bake.lighting, bake.options, bake.interior.parts[p], *lit.normals[p], nullptr};
  std::vector<PatchTexels> shaded(patches.size());
  executor(patches.size(), [&](std::size_t i) {
    const std::size_t at = lit.first[p] + i;
    shaded[i] = shade_patch(part, patches[i], lit.direct[at], indirect.empty() ? nullptr : &indirect[at]);
  });
  PartTexels texels;
  for (PatchTexels& patch : shaded) {
    texels.rects.push_back({patch.width, patch.height});
    texels.rgba.insert(texels.rgba.end(), patch.rgba.begin(), patch.rgba.end());
    texels.rgb16.insert(texels.rgb16.end(), patch.rgb16.begin(), patch.rgb16.end());
    if (!patch.light.empty()) texels.above_white.emplace(texels.rects.size() - 1, std::move(patch));
  }
  return texels;
}

}  // namespace

DiffuseTexels bake_texels(const place::Interior& interior, const std::vector<std::vector<TexelPatch>>& patches,
                          const light::LightingContext& lighting, const BakeOptions& options, const Executor& executor,
                          const Progress& progress) {
  const RoomBake bake{interior, patches, lighting, options};
  const LitRoom lit = light_room(bake, executor, progress);
  std::vector<IrradianceGrid> indirect;
  if (lighting.options.indirect_bounces > 0)
    indirect = solve_radiosity({interior, lighting, lit.normals, patches, lit.direct}, options.radiosity, executor, progress);
  DiffuseTexels texels;
  texels.counts.lit_points = lit.lit_points;
  for (std::size_t p = 0; p < interior.parts.size(); ++p) {
    texels.parts.push_back(shade_part(bake, lit, indirect, p, executor));
    texels.counts.texels += texels.parts.back().rgba.size();
  }
  return texels;
}

}  // namespace orbc::bake
