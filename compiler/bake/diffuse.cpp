#include "compiler/bake/diffuse.h"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

#include "compiler/bake/patch_texels.h"

namespace orbc::bake {
namespace {

using place::PlacedMesh;

/// The places of the vertices of split_by_patch in a picture.
std::vector<std::array<float, 2>> uv_of(const std::vector<TexelPatch>& patches, const std::vector<TexelRect>& rects, int width,
                                        int height) {
  std::vector<std::array<float, 2>> uv;
  const auto add = [&](double x, double y) { uv.push_back({static_cast<float>(x / width), static_cast<float>(y / height)}); };
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const TexelRect& rect = rects[i];
    const double x0 = rect.x + 0.5, y0 = rect.y + 0.5, x1 = rect.x + rect.width - 0.5, y1 = rect.y + rect.height - 0.5;
    add(x0, y0);
    add(x1, y0);
    add(x0, y1);
    if (patches[i].second >= 0) add(x1, y1);
  }
  return uv;
}

Diagnostic too_large(const std::vector<PartToPack>& parts, int max_side) {
  std::size_t worst = 0, max_texels = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::size_t texels = parts[p].texels ? parts[p].texels->rgba.size() : 0;
    if (texels <= max_texels) continue;
    max_texels = texels;
    worst = p;
  }
  return make_error(
      "light.atlas-too-large", fmt::format("the baked light of this scene does not fit into a picture of {0}×{0} pixels", max_side),
      fmt::format(
          "most of it, {} texels, is on \"{}\": a simpler mesh there, larger lamps with softer shadows, or --quality draft need less",
          max_texels, *parts[worst].name));
}

/// The texels of all patches, in the order of the parts.
std::vector<TexelSource> sources_of(const std::vector<PartToPack>& parts) {
  std::vector<TexelSource> sources;
  for (const PartToPack& part : parts) {
    if (!part.patches) continue;
    const bool has_rgb16 = !part.texels->rgb16.empty();
    std::size_t first = 0;
    for (const TexelRect& rect : part.texels->rects) {
      sources.push_back({part.texels->rgba.data() + first, has_rgb16 ? part.texels->rgb16.data() + first : nullptr});
      first += static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height);
    }
  }
  return sources;
}

}  // namespace

PlacedMesh split_by_patch(const PlacedMesh& part, const std::vector<TexelPatch>& patches) {
  PlacedMesh split = part;
  split.floor.clear();
  split.z.clear();
  split.uv.clear();
  split.color.clear();
  split.pattern_position.clear();
  const auto copy_vertex = [&](std::uint32_t v) {
    split.floor.push_back(part.floor[v]);
    split.z.push_back(part.z[v]);
    return static_cast<std::uint32_t>(split.floor.size() - 1);
  };
  for (const TexelPatch& patch : patches) {
    const auto [c00, c10, c01] = patch.corner_order;
    const mesh::Triangle& first = part.triangles[patch.first];
    const std::uint32_t v00 = copy_vertex(first[c00]), v10 = copy_vertex(first[c10]), v01 = copy_vertex(first[c01]);
    mesh::Triangle& t = split.triangles[patch.first];
    t[c00] = v00;
    t[c10] = v10;
    t[c01] = v01;
    if (patch.second < 0) continue;
    const auto [s11, s01, s10] = patch.second_corner_order;
    const auto second = static_cast<std::size_t>(patch.second);
    const std::uint32_t v11 = copy_vertex(part.triangles[second][s11]);
    mesh::Triangle& s = split.triangles[second];
    s[s11] = v11;
    s[s01] = v01;
    s[s10] = v10;
  }
  return split;
}

Result<DiffuseBake> pack_texels(const std::vector<PartToPack>& parts, const BakeOptions& options) {
  std::vector<TexelRect> rects;
  for (const PartToPack& part : parts)
    if (part.patches) rects.insert(rects.end(), part.texels->rects.begin(), part.texels->rects.end());
  const auto packed = pack_rects(std::move(rects), options.max_side);
  if (!packed) return too_large(parts, options.max_side);
  const std::vector<TexelSource> sources = sources_of(parts);
  DiffuseBake baked;
  baked.atlas.image = assemble_image({}, sources, *packed);
  if (options.with_image16) baked.atlas.image16 = assemble_image16({}, sources, *packed);
  auto next = packed->rects.begin();
  for (const PartToPack& part : parts) {
    baked.patches.push_back(part.patches ? *part.patches : std::vector<TexelPatch>());
    const auto end = next + static_cast<std::ptrdiff_t>(baked.patches.back().size());
    baked.rects.emplace_back(next, end);
    baked.above_white.push_back(part.patches ? part.texels->above_white : std::map<std::size_t, PatchTexels>());
    next = end;
    baked.atlas.uv.push_back(uv_of(baked.patches.back(), baked.rects.back(), packed->width, packed->height));
    if (part.patches) baked.counts.texels += part.texels->rgba.size();
  }
  return baked;
}

Result<DiffuseBake> bake_diffuse(const place::Interior& interior, const light::LightingContext& lighting, const BakeOptions& options,
                                 const Executor& executor, const Progress& progress) {
  std::vector<std::vector<TexelPatch>> patches;
  for (std::size_t p = 0; p < interior.parts.size(); ++p) {
    const bool is_known = p < lighting.normals.size();
    patches.push_back(make_patches(interior, static_cast<std::uint32_t>(p),
                                   is_known ? lighting.normals[p] : surface::part_normals(interior, interior.parts[p])));
  }
  const DiffuseTexels texels = bake_texels(interior, patches, lighting, options, executor, progress);
  std::vector<PartToPack> parts;
  for (std::size_t p = 0; p < interior.parts.size(); ++p) parts.push_back({&interior.parts[p].name, &patches[p], &texels.parts[p]});
  auto baked = pack_texels(parts, options);
  if (!baked) return baked.error();
  baked->counts = texels.counts;
  baked->atlas.room = interior;
  for (std::size_t p = 0; p < interior.parts.size(); ++p) baked->atlas.room.parts[p] = split_by_patch(interior.parts[p], patches[p]);
  return baked;
}

}  // namespace orbc::bake
