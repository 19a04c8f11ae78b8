#include "compiler/bake/view_dependent.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "compiler/bake/patch_places.h"
#include "compiler/bake/rect_packing.h"
#include "compiler/bake/view_dependent_parts.h"
#include "compiler/bake/view_patch.h"
#include "compiler/light/connection.h"

namespace orbc::bake {
namespace {

constexpr std::size_t kCopiesPerBatch = 16;  // between two checks of max_texels

/// The texels of a part of one copy.
struct BakedViewPart {
  std::size_t copy = 0, part = 0;
  std::vector<ViewPatch> patches;
};

std::vector<std::size_t> nearest_first(const std::vector<cover::Copy>& copies, const place::Camera& eye) {
  std::vector<double> distance;
  for (const cover::Copy& copy : copies) distance.push_back(connect(unfold_eye(copy, eye), {geometry::Point(), eye.z}).length);
  std::vector<std::size_t> order(copies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
  return order;
}

/// Whether a part is so small in the picture that it gets no texels of its own.
bool is_too_small(const UnfoldedEye& eye, const ViewDependentPart& part, double pixels_per_radian) {
  const double diameter = 2 * part.ball.radius;
  const light::Connection sight = connect(eye, part.ball.centre);
  const bool is_near = sight.length < diameter;
  return !is_near && sight.valid && diameter * max_pixels_per_unit(eye, sight, pixels_per_radian) < part.min_diameter_px;
}

BakedViewPart bake_part_of_copy(const ViewBakeInput& input, const ViewBakeOptions& options, const ViewDependentPart& part, std::size_t copy,
                                const Progress& progress) {
  BakedViewPart baked{copy, part.part, {}};
  if (!part.drawn_in_model.empty() && !part.drawn_in_model[input.drawn.model_of_copy[copy]]) return baked;
  const bool is_known = part.part < input.lighting.normals.size();
  const std::vector<double>& offsets = input.drawn.surface_offset;
  const ViewPart view{input,
                      options,
                      is_known ? input.lighting.normals[part.part] : part.lod_normals,
                      input.copies[copy],
                      part.part,
                      unfold_eye(input.copies[copy], input.eye),
                      place::pixels_per_radian(input.eye),
                      part.part < offsets.size() ? offsets[part.part] : 0};
  if (!is_too_small(view.eye, part, view.pixels_per_radian)) baked.patches = bake_view_part(view, progress);
  return baked;
}

/// All parts of all copies, the nearest copies first, until there are more than max_texels.
struct BakedCopies {
  std::vector<BakedViewPart> parts;  ///< by copy, then by part
  ViewBakeCounts counts;
  std::vector<PatchAboveWhite> above_white;

  /// Takes out what is above white, unless no mirror dims it.
  void take_above_white(BakedViewPart& part, const scene::Color& weight) {
    if (weight == scene::Color{1, 1, 1}) return;
    std::vector<ViewPatch> rest;
    for (ViewPatch& patch : part.patches) {
      if (patch.texels.light.empty()) rest.push_back(std::move(patch));
      else above_white.push_back({part.copy, part.part, patch.patch, std::move(patch.texels)});
    }
    part.patches = std::move(rest);
  }
};
BakedCopies bake_copies(const ViewBakeInput& input, const ViewBakeOptions& options, const Executor& executor, const Progress& progress) {
  BakedCopies all;
  const std::vector<ViewDependentPart> parts =
      find_view_dependent_parts(input.interior, input.lighting, input.drawn, static_cast<bool>(options.specular));
  const std::vector<std::size_t> order = nearest_first(input.copies, input.eye);
  std::size_t next = 0;
  for (; next < order.size() && all.counts.texels <= options.max_texels; next += kCopiesPerBatch) {
    report(progress, "highlights", next, order.size(), "copies");
    std::vector<BakedViewPart> batch(std::min(kCopiesPerBatch, order.size() - next) * parts.size());
    executor(batch.size(), [&](std::size_t i) {
      batch[i] = bake_part_of_copy(input, options, parts[i % parts.size()], order[next + i / parts.size()], progress);
    });
    for (BakedViewPart& part : batch) {
      if (part.patches.empty()) continue;
      for (const ViewPatch& patch : part.patches) all.counts.texels += patch.texels.rgba.size();
      all.take_above_white(part, input.copies[part.copy].weight);
      all.parts.push_back(std::move(part));
    }
  }
  all.counts.copies_left_out = next < order.size() ? order.size() - next : 0;
  std::stable_sort(all.above_white.begin(), all.above_white.end(), [](const PatchAboveWhite& a, const PatchAboveWhite& b) {
    return std::tie(a.copy, a.part, a.patch) < std::tie(b.copy, b.part, b.patch);
  });
  std::sort(all.parts.begin(), all.parts.end(),
            [](const BakedViewPart& a, const BakedViewPart& b) { return std::tie(a.copy, a.part) < std::tie(b.copy, b.part); });
  return all;
}

/// The places of the vertices of a part of a copy. In: those that all copies share, and the rectangles of its patches.
CopyUv make_copy_uv(const BakedViewPart& part, const std::vector<TexelPatch>& patches, const std::vector<std::array<float, 2>>& shared,
                    const PackedRects& packed, std::size_t first_rect) {
  CopyUv places{part.copy, part.part, shared};
  const std::vector<std::size_t> first_vertex = first_vertices(patches);
  for (std::size_t k = 0; k < part.patches.size(); ++k) {
    const std::size_t patch = part.patches[k].patch;
    place_patch(places.uv, patches[patch], first_vertex[patch], packed.rects[first_rect + k], packed);
    places.patches.push_back(patch);
  }
  return places;
}

}  // namespace

ViewBakeOptions view_bake_options(const scene::BakeSpec& spec) {
  ViewBakeOptions options;
  if (spec.quality == scene::BakeQuality::draft) {
    options.min_spacing_px = 1.6;
    options.rays_per_texel = 1;
    options.tolerance = 3;
  }
  if (spec.quality == scene::BakeQuality::fine) {
    options.min_spacing_px = 0.4;
    options.tolerance = 0.5;
  }
  return options;
}

ViewBake bake_view_dependent(const ViewBakeInput& input, const ViewBakeOptions& options, const Executor& executor,
                             const Progress& progress) {
  BakedCopies baked = bake_copies(input, options, executor, progress);
  const Atlas& atlas = input.diffuse.atlas;
  std::vector<TexelRect> rects;
  std::vector<TexelSource> texels;
  for (const BakedViewPart& part : baked.parts)
    for (const ViewPatch& patch : part.patches) {
      rects.push_back({patch.texels.width, patch.texels.height});
      texels.push_back({patch.texels.rgba.data(), patch.texels.rgb16.data()});
    }
  const auto packed = rects.empty() ? std::nullopt : pack_below(std::move(rects), atlas.image.width, atlas.image.height, options.max_side);
  if (!packed) {
    ViewBake unchanged{atlas.image, atlas.image16, atlas.uv, {}, baked.counts, 2, std::move(baked.above_white)};
    unchanged.counts.copies_left_out = texels.empty() ? 0 : input.copies.size();
    return unchanged;
  }
  ViewBake view{assemble_image(atlas.image, texels, *packed), {}, {}, {}, baked.counts, 2, std::move(baked.above_white)};
  if (!atlas.image16.rgb.empty()) view.image16 = assemble_image16(atlas.image16, texels, *packed);
  for (const auto& uv : atlas.uv)
    view.uv.push_back(
        rescale_uv(uv, static_cast<double>(atlas.image.width) / packed->width, static_cast<double>(atlas.image.height) / packed->height));
  std::size_t first_rect = 0;
  for (const BakedViewPart& part : baked.parts) {
    if (view.copy_uv.empty() || view.copy_uv.back().copy != part.copy) ++view.counts.copies;
    view.copy_uv.push_back(make_copy_uv(part, input.diffuse.patches[part.part], view.uv[part.part], *packed, first_rect));
    first_rect += part.patches.size();
  }
  return view;
}

}  // namespace orbc::bake
