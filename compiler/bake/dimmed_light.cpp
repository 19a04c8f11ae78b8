#include "compiler/bake/dimmed_light.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "compiler/bake/patch_places.h"
#include "compiler/bake/patch_texels.h"
#include "compiler/image/srgb.h"

namespace orbc::bake {
namespace {

using scene::Color;

/// Whether texels look different when they are dimmed before they are cut off.
bool shows(const PatchTexels& texels, const Color& weight) {
  constexpr double kStep = 0.75 / 255;
  const std::array<double, 3> w{weight.r, weight.g, weight.b};
  return std::any_of(texels.light.begin(), texels.light.end(), [&](const std::array<float, 3>& light) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto l = static_cast<double>(light[c]);
      if (l > 1 && image::encode_srgb(std::min(1.0, w[c] * l)) - image::encode_srgb(w[c]) > kStep) return true;
    }
    return false;
  });
}

bool is_in(const std::vector<std::uint32_t>& model, std::size_t part) { return std::find(model.begin(), model.end(), part) != model.end(); }

/// A patch of a part of a copy, and where its dimmed texels are among all.
struct DimmedPatch {
  std::size_t copy = 0, part = 0, patch = 0, texels = 0;
};

/// The dimmed texels of all copies.
struct DimmedTexels {
  std::vector<PatchTexels> texels;
  std::vector<DimmedPatch> patches;  ///< by copy, then by part
  std::map<std::tuple<std::size_t, std::size_t, std::array<double, 3>>, std::size_t> shared;
  std::uint64_t count = 0;

  /// Texels that copies of the same weight share.
  void add_shared(const DimmedPatch& at, const PatchTexels& light, const Color& weight, bool with_rgb16) {
    const auto [known, is_new] = shared.try_emplace({at.part, at.patch, {weight.r, weight.g, weight.b}}, texels.size());
    if (is_new) add(light, weight, with_rgb16);
    patches.push_back({at.copy, at.part, at.patch, known->second});
  }
  void add(const PatchTexels& light, const Color& weight, bool with_rgb16) {
    texels.push_back(encode_dimmed(light, weight, with_rgb16));
    count += light.light.size();
  }
};

bool has_own_texels(const std::vector<CopyUv>& all, std::size_t copy, std::size_t part, std::size_t patch) {
  const auto at =
      std::lower_bound(all.begin(), all.end(), std::pair(copy, part),
                       [](const CopyUv& a, const std::pair<std::size_t, std::size_t>& b) { return std::pair(a.copy, a.part) < b; });
  return at != all.end() && at->copy == copy && at->part == part && std::binary_search(at->patches.begin(), at->patches.end(), patch);
}

DimmedTexels dimmed_texels(const ViewBake& view, const DiffuseBake& diffuse, const std::vector<cover::Copy>& copies,
                           const DrawnParts& drawn, std::uint64_t max_texels) {
  DimmedTexels all;
  const bool with_rgb16 = !view.image16.rgb.empty();
  std::size_t next = 0;  // among what is above white for this eye
  for (std::size_t c = 0; c < copies.size() && all.count < max_texels; ++c) {
    const Color& weight = copies[c].weight;
    for (std::size_t p = 0; p < diffuse.above_white.size(); ++p) {
      const bool is_drawn = drawn.models.empty() || is_in(drawn.models[drawn.model_of_copy[c]], p);
      std::vector<std::size_t> own;
      for (; next < view.above_white.size() && view.above_white[next].copy == c && view.above_white[next].part == p; ++next) {
        const PatchAboveWhite& at = view.above_white[next];
        own.push_back(at.patch);
        all.patches.push_back({c, p, at.patch, all.texels.size()});
        all.add(at.texels, weight, with_rgb16);
      }
      if (!is_drawn || weight == Color{1, 1, 1}) continue;
      for (const auto& [patch, texels] : diffuse.above_white[p])
        if (!std::binary_search(own.begin(), own.end(), patch) && !has_own_texels(view.copy_uv, c, p, patch) && shows(texels, weight))
          all.add_shared({c, p, patch, 0}, texels, weight, with_rgb16);
    }
  }
  return all;
}

}  // namespace

ViewBake add_dimmed_light(ViewBake view, const DiffuseBake& diffuse, const std::vector<cover::Copy>& copies, const DrawnParts& drawn,
                          const ViewBakeOptions& options) {
  const DimmedTexels dimmed = dimmed_texels(view, diffuse, copies, drawn, options.max_texels);
  std::vector<TexelRect> rects;
  std::vector<TexelSource> sources;
  for (const PatchTexels& texels : dimmed.texels) {
    rects.push_back({texels.width, texels.height});
    sources.push_back({texels.rgba.data(), texels.rgb16.data()});
  }
  const int width = view.image.width, height = view.image.height;
  const auto packed = rects.empty() ? std::nullopt : pack_below(std::move(rects), width, height, options.max_side);
  if (!packed) return view;
  view.image = assemble_image(view.image, sources, *packed);
  if (!view.image16.rgb.empty()) view.image16 = assemble_image16(view.image16, sources, *packed);
  const double u = static_cast<double>(width) / packed->width, v = static_cast<double>(height) / packed->height;
  for (auto& uv : view.uv) uv = rescale_uv(std::move(uv), u, v);
  for (CopyUv& own : view.copy_uv) own.uv = rescale_uv(std::move(own.uv), u, v);
  view.first_dimmed_v = v;
  std::vector<std::vector<std::size_t>> first_vertex;
  for (const std::vector<TexelPatch>& patches : diffuse.patches) first_vertex.push_back(first_vertices(patches));
  std::map<std::pair<std::size_t, std::size_t>, CopyUv> places;
  for (CopyUv& own : view.copy_uv) places.emplace(std::pair(own.copy, own.part), std::move(own));
  for (const DimmedPatch& at : dimmed.patches) {
    CopyUv& own = places.try_emplace({at.copy, at.part}, CopyUv{at.copy, at.part, {}, {}}).first->second;
    if (own.uv.empty()) own.uv = view.uv[at.part];
    place_patch(own.uv, diffuse.patches[at.part][at.patch], first_vertex[at.part][at.patch], packed->rects[at.texels], *packed);
  }
  view.copy_uv.clear();
  for (auto& [key, own] : places) view.copy_uv.push_back(std::move(own));
  return view;
}

}  // namespace orbc::bake
