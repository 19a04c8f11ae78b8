// Highlights move with the eye, so every copy has its own; but they are small. A patch is sampled at its corners and on a grid of a few
// pixels. Where that shows no highlight, the patch keeps its diffuse texels. Elsewhere it is refined to about one texel a pixel, and made
// coarser again where colours are linear.
#include "compiler/bake/view_patch.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "compiler/bake/adaptive_grid.h"
#include "compiler/bake/view_dependent_parts.h"
#include "compiler/base/elementary.h"
#include "compiler/image/srgb.h"
#include "compiler/light/connection.h"
#include "compiler/surface/ggx.h"

namespace orbc::bake {
namespace {

using geometry::Position;
using place::PlacedMesh;
using scene::Color;
using trace::Direction;

constexpr int kMaxViewHalvings = 10;     // of a side of a patch: 1025 texels
constexpr double kMaxViewStep = 3;       // steps of 1/255 between neighbouring points: where they differ more, the point between is sampled
constexpr double kGrazingCosine = 0.02;  // surfaces are looked at from no lower
constexpr double kMinRoughAlpha = 0.05;  // of metals: from here on single samples take as many directions as texels do

const PlacedMesh& mesh_of(const ViewPart& part) { return part.input.interior.parts[part.part]; }

/// A part of the room itself; false: a level of detail of one.
bool is_base(const ViewPart& part) { return !part.input.lighting.lit || part.part < part.input.lighting.normals.size(); }

/// What the surface of a patch looks like.
struct ViewStyle {
  const scene::Material& material;
  int number = 0;            ///< of the style
  bool is_specular = false;  ///< all of its light depends on the eye; false: only its highlights do
};

/// What vertices send to the eye; patches that meet there share it.
struct VertexColors {
  std::vector<int> style;  ///< for which style the colour is known; −1: none
  std::vector<Color> color;
};

/// Moves a direction up to the horizon of the surface. Where a patch turns away from the eye there is nothing to see; what is sampled there
/// continues what is seen at the outline.
Direction clamp_to_horizon(geometry::Space space, const surface::ShadingPoint& point, Direction to_eye) {
  for (const Direction& n : {point.normal, point.geometric_normal})
    if (const double cosine = trace::inner(space, to_eye, n); cosine < kGrazingCosine) to_eye = to_eye + (kGrazingCosine - cosine) * n;
  return (1 / std::sqrt(trace::inner(space, to_eye, to_eye))) * to_eye;
}

/// What a point sends to the eye and not to every eye, in linear light times the exposure.
Color view_color(const ViewPart& part, const ViewStyle& style, const surface::ShadingPoint& point, const light::SampleStratum& sample) {
  const light::Connection sight = connect(part.eye, point.at);
  if (!sight.valid) return {};
  if (style.is_specular)
    return part.options.specular(point.at, clamp_to_horizon(part.eye.space, point, sight.direction), part.copy, part.surface_offset,
                                 sample);
  const light::LightingContext& lighting = part.input.lighting;
  return lighting.exposure * light::highlight(lighting, point, sight.direction, style.material, {1, 1, 1});
}

/// The lobe of a metal is sampled in many directions. Where it shows detail, `supersample` takes all of them; at single points a part of
/// them is enough. It is the second part, in the middle between the sharpest and the widest.
light::SampleStratum sample_at_points(const ViewPart& part, const scene::Material& material) {
  const int parts = part.options.rays_per_texel * part.options.rays_per_texel;
  if (parts < 2 || material.kind != scene::MaterialKind::metal || surface::ggx_alpha(material) >= kMinRoughAlpha) return {};
  return {1, parts};
}

/// Colours of a patch as refine_grid samples them.
struct ViewSampler {
  const ViewPart& part;
  const ViewStyle& style;
  const TexelPatch& patch;
  VertexColors& vertices;

  [[nodiscard]] surface::ShadingPoint point_at(std::size_t triangle, const std::array<double, 3>& b, double reach) const {
    const surface::ShadingPoint point = surface::shading_point(part.input.interior, mesh_of(part), part.normals, triangle, b);
    // A level of detail shines where the part itself does. The specular query moves its points by itself.
    return is_base(part) || style.is_specular ? point : light::project_to_surface(part.input.lighting, point, reach).point;
  }
  Color at_corner(const PatchCorner& corner) {
    const std::uint32_t v = part.normals.corners[corner.triangle][corner.k];
    if (vertices.style[v] != style.number) {
      const surface::ShadingPoint point = point_at(corner.triangle, surface::inset_corner(corner.k), light::kVertexTolerance);
      vertices.color[v] = view_color(part, style, point, sample_at_points(part, style.material));
      vertices.style[v] = style.number;
    }
    return vertices.color[v];
  }
  GridSample sample(const GridPoint& at) {
    if (at.is_corner()) return {at_corner(corner_of(patch, at.i > 0, at.j > 0))};
    const BarycentricPoint inside = inset_point(patch, at.u(), at.v(), surface::kInset);
    const surface::ShadingPoint point = point_at(inside.triangle, inside.b, std::max(patch.length_u, patch.length_v) / 2);
    return {view_color(part, style, point, sample_at_points(part, style.material))};
  }
  [[nodiscard]] double difference(const Color& a, const Color& b) const {
    if (a == b) return 0;
    const Color& weight = part.copy.weight;  // what is faint in the picture needs no detail
    const auto code = [](double w, double c) { return 255 * image::encode_srgb(std::clamp(w * c, 0.0, 1.0)); };
    return std::max({std::fabs(code(weight.r, a.r) - code(weight.r, b.r)), std::fabs(code(weight.g, a.g) - code(weight.g, b.g)),
                     std::fabs(code(weight.b, a.b) - code(weight.b, b.b))});
  }
};

/// Pixels that the two sides of a patch take in the picture, at the corner where it is most; none when all of the patch turns away from the
/// eye. The sides are measured apart: near the antipode the picture is drawn out around the eye, but not in height.
std::optional<std::array<double, 2>> sides_in_pixels(const ViewPart& part, const TexelPatch& patch) {
  const PlacedMesh& mesh = mesh_of(part);
  const auto vertex_at = [&](bool far_u, bool far_v) -> const surface::ShadingVertex& {
    const PatchCorner corner = corner_of(patch, far_u, far_v);
    return part.normals.vertices[part.normals.corners[corner.triangle][corner.k]];
  };
  const std::uint32_t origin = vertex_at(false, false).vertex;
  const auto side_to = [&](std::uint32_t v) {
    return Direction{geometry::Ambient(mesh.floor[v]) + -1.0 * geometry::Ambient(mesh.floor[origin]), mesh.z[v] - mesh.z[origin]};
  };
  const Direction u = side_to(vertex_at(true, false).vertex), v = side_to(vertex_at(false, true).vertex);
  std::array<double, 2> pixels{};
  bool faces_eye = false;
  std::vector<geometry::Vector3> directions;
  for (int c = 0; c < (patch.second >= 0 ? 4 : 3); ++c) {
    const surface::ShadingVertex& corner = vertex_at(c == 1 || c == 3, c >= 2);
    const Position at{mesh.floor[corner.vertex], mesh.z[corner.vertex]};
    const light::Connection sight = connect(part.eye, at);
    const auto from_eye = direction_from_eye(part.copy, part.input.eye, at);
    if (!sight.valid || !from_eye) continue;
    directions.push_back(*from_eye);
    faces_eye = faces_eye || trace::inner(part.eye.space, sight.direction, corner.normal) > 0;
    pixels[0] = std::max(pixels[0], patch.length_u * pixel_footprint(part.eye, sight, at, u, part.pixels_per_radian));
    pixels[1] = std::max(pixels[1], patch.length_v * pixel_footprint(part.eye, sight, at, v, part.pixels_per_radian));
  }
  if (!faces_eye) return std::nullopt;
  if (outside_frustum(part.input.eye, directions))
    for (double& side : pixels) side /= part.options.offscreen_factor;
  return pixels;
}

GridLevels levels_for(const std::array<double, 2>& pixels, const ViewBakeOptions& options) {
  const auto halvings_for = [](double cells) {
    return std::clamp(static_cast<int>(std::ceil(math::log2(std::max(1.0, cells)) - 1e-9)), 0, kMaxViewHalvings);
  };
  GridLevels levels;
  levels.fine_u = halvings_for(pixels[0] / options.min_spacing_px);
  levels.fine_v = halvings_for(pixels[1] / options.min_spacing_px);
  levels.coarse_u = std::min(levels.fine_u, halvings_for(pixels[0] / options.probe_spacing_px));
  levels.coarse_v = std::min(levels.fine_v, halvings_for(pixels[1] / options.probe_spacing_px));
  return levels;
}

/// The diffuse colour of a patch at (u, v), to which highlights are added; black under specular surfaces.
Color diffuse_at(const ViewPart& part, const ViewStyle& style, std::size_t patch, double u, double v) {
  if (style.is_specular) return {};
  const TexelRect& rect = part.input.diffuse.rects[part.part][patch];
  const auto& above_white = part.input.diffuse.above_white[part.part];
  if (const auto above = above_white.find(patch); above != above_white.end()) return color_in_rect(above->second.light, rect, u, v);
  return color_in_rect(part.input.diffuse.atlas.image, rect, u, v);
}

/// Whether any coarse sample shows a highlight.
bool shows_highlight(const ViewSampler& sampler, std::size_t number, const GridLevels& levels, const std::vector<GridSample>& coarse) {
  const GridStep step = coarse_step(levels);
  std::size_t next = 0;
  for (int j = 0; j < levels.height(); j += step.v)
    for (int i = 0; i < levels.width(); i += step.u) {
      const Color highlight = coarse[next++].color;
      if (highlight == Color{}) continue;
      const GridPoint at{i, j, levels.width(), levels.height()};
      const Color diffuse = diffuse_at(sampler.part, sampler.style, number, at.u(), at.v());
      if (sampler.difference(diffuse + highlight, diffuse) > 0.5 * sampler.part.options.tolerance) return true;
    }
  return false;
}

/// The mean over the area of a texel, of `side` × `side` samples.
Color texel_mean(const ViewSampler& sampler, const ColorGrid& grid, int i, int j, int side) {
  Color sum;
  for (int k = 0; k < side * side; ++k) {
    double u = std::clamp((i - 0.5 + (k % side + 0.5) / side) / (grid.width - 1), 0.0, 1.0);
    double v = std::clamp((j - 0.5 + (k / side + 0.5) / side) / (grid.height - 1), 0.0, 1.0);
    if (sampler.patch.second < 0 && u + v > 1) {  // a single triangle: back over its long side
      const double beyond = (u + v - 1) / 2;
      u = std::max(0.0, u - beyond);
      v = std::max(0.0, v - beyond);
    }
    const BarycentricPoint at = barycentric_point(sampler.patch, u, v);
    const ViewPart& part = sampler.part;
    const surface::ShadingPoint point = surface::shading_point(part.input.interior, mesh_of(part), part.normals, at.triangle, at.b);
    sum = sum + view_color(part, sampler.style, point, {k, side * side});
  }
  return (1.0 / (side * side)) * sum;
}

/// What is refracted or mirrored is often finer than texels. Where neighbours differ, a texel shows the mean over its area, as a pixel
/// does.
ColorGrid supersample(const ViewSampler& sampler, ColorGrid grid) {
  const int side = sampler.part.options.rays_per_texel;
  if (side < 2) return grid;
  const auto differs = [&](int i, int j, const Color& here) {
    return i >= 0 && j >= 0 && i < grid.width && j < grid.height && on_patch(sampler.patch, i, j, grid.width, grid.height) &&
           sampler.difference(grid.color[grid.index(i, j)], here) > kMaxViewStep;
  };
  std::vector<Color> means = grid.color;
  for (int j = 0; j < grid.height; ++j)
    for (int i = 0; i < grid.width; ++i) {
      if (!on_patch(sampler.patch, i, j, grid.width, grid.height)) continue;
      const Color& here = grid.color[grid.index(i, j)];
      if (differs(i - 1, j, here) || differs(i + 1, j, here) || differs(i, j - 1, here) || differs(i, j + 1, here))
        means[grid.index(i, j)] = texel_mean(sampler, grid, i, j, side);
    }
  grid.color = std::move(means);
  return grid;
}

/// Whether every second column (or row) is the mean of its neighbours.
bool is_linear(const ViewSampler& sampler, const ColorGrid& grid, bool columns) {
  const int di = columns, dj = !columns;
  for (int j = dj; j < grid.height; j += 1 + dj)
    for (int i = di; i < grid.width; i += 1 + di) {
      if (!on_patch(sampler.patch, i + di, j + dj, grid.width, grid.height)) {
        if (on_patch(sampler.patch, i, j, grid.width, grid.height)) return false;
        continue;
      }
      const Color mean = 0.5 * (grid.color[grid.index(i - di, j - dj)] + grid.color[grid.index(i + di, j + dj)]);
      if (sampler.difference(grid.color[grid.index(i, j)], mean) > 0.5 * sampler.part.options.tolerance) return false;
    }
  return true;
}

/// Every second column (or row).
ColorGrid halve(const ColorGrid& grid, bool columns) {
  ColorGrid half{columns ? (grid.width + 1) / 2 : grid.width, columns ? grid.height : (grid.height + 1) / 2, {}};
  for (int j = 0; j < half.height; ++j)
    for (int i = 0; i < half.width; ++i) half.color.push_back(grid.color[grid.index(columns ? 2 * i : i, columns ? j : 2 * j)]);
  return half;
}

/// Diffuse light and highlights together, on as few points as show them. None if the highlights do not show.
std::optional<ColorGrid> add_diffuse(const ViewSampler& sampler, std::size_t number, const ColorGrid& highlights) {
  ColorGrid sum{highlights.width, highlights.height, std::vector<Color>(highlights.color.size())};
  bool is_visible = sampler.style.is_specular;
  for (int j = 0; j < sum.height; ++j)
    for (int i = 0; i < sum.width; ++i) {
      if (!on_patch(sampler.patch, i, j, sum.width, sum.height)) continue;
      const GridPoint at{i, j, sum.width, sum.height};
      const Color diffuse = diffuse_at(sampler.part, sampler.style, number, at.u(), at.v());
      const Color all = diffuse + highlights.color[sum.index(i, j)];
      is_visible = is_visible || sampler.difference(all, diffuse) > sampler.part.options.tolerance;
      sum.color[sum.index(i, j)] = all;
    }
  if (!is_visible) return std::nullopt;
  while (sum.width > 2 && is_linear(sampler, sum, true)) sum = halve(sum, true);
  while (sum.height > 2 && is_linear(sampler, sum, false)) sum = halve(sum, false);
  for (int j = 0; j < sum.height; ++j)
    for (int i = 0; i < sum.width; ++i)
      if (!on_patch(sampler.patch, i, j, sum.width, sum.height)) sum.color[sum.index(i, j)] = extrapolate_beyond_patch(sum, i, j);
  return sum;
}

std::optional<ViewPatch> bake_view_patch(ViewSampler& sampler, std::size_t number) {
  const ViewPart& part = sampler.part;
  const auto pixels = sides_in_pixels(part, sampler.patch);
  if (!pixels) return std::nullopt;
  const GridLevels levels = levels_for(*pixels, part.options);
  const std::vector<GridSample> coarse = sample_coarse_grid(sampler.patch, levels, sampler);
  if (!sampler.style.is_specular && !shows_highlight(sampler, number, levels, coarse)) return std::nullopt;
  ColorGrid grid = refine_grid(sampler.patch, levels, coarse, {kMaxViewStep, part.options.tolerance}, sampler);
  if (sampler.style.is_specular) grid = supersample(sampler, std::move(grid));
  const auto shown = add_diffuse(sampler, number, grid);
  if (!shown) return std::nullopt;
  const bool with_rgb16 = !part.input.diffuse.atlas.image16.rgb.empty();
  return ViewPatch{number, encode_texels(part.input.interior, sampler.patch, *shown, with_rgb16)};
}

}  // namespace

std::vector<ViewPatch> bake_view_part(const ViewPart& part, const Progress& progress) {
  const std::vector<TexelPatch>& patches = part.input.diffuse.patches[part.part];
  VertexColors vertices{std::vector<int>(part.normals.vertices.size(), -1), std::vector<Color>(part.normals.vertices.size())};
  std::vector<ViewPatch> baked;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    stop_if_cancelled(progress);
    const int number = mesh_of(part).style[patches[i].first];
    const scene::Material& material = part.input.interior.styles[static_cast<std::size_t>(number)].material;
    const ViewStyle style{material, number, part.options.specular && is_specular(material, part.input.lighting.lit)};
    if (!style.is_specular && !is_glossy(material)) continue;
    ViewSampler sampler{part, style, patches[i], vertices};
    if (auto patch = bake_view_patch(sampler, i)) baked.push_back(*std::move(patch));
  }
  return baked;
}

}  // namespace orbc::bake
