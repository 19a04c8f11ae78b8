// Light changes slowly except at the borders of shadows, so a patch is sampled adaptively. Interpolated is irradiance, in linear light;
// compared are encoded colours of the picture. Textures and solid patterns are evaluated for each texel.
#include "compiler/bake/diffuse_patch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "compiler/bake/adaptive_grid.h"
#include "compiler/bake/pattern_density.h"
#include "compiler/base/elementary.h"
#include "compiler/image/srgb.h"
#include "compiler/light/connection.h"
#include "compiler/surface/albedo.h"

namespace orbc::bake {
namespace {

using scene::Color;

constexpr double kMostDimmed = 16;  // times white: mirrors that dim more show no more detail
constexpr double kMaxDiffuseStep =
    5;  // steps of 1/255 between neighbouring points: where they differ more, the point between them is sampled
constexpr double kRoughTolerance = 3;  // steps of 1/255: points of the finest grid that are more off their neighbours' mean are rough,
constexpr double kRoughStep = 6;       // and so are cells whose corners differ by more

/// What the surface of a patch looks like.
struct PatchStyle {
  const scene::Material& material;
  Color color;          ///< of all of it, unless it varies
  bool varies = false;  ///< it has a texture or a pattern
};
PatchStyle style_of(const BakePart& part, const TexelPatch& patch) {
  const int number = part.mesh.style[patch.first];
  const place::SurfaceStyle& style = part.interior.styles[static_cast<std::size_t>(number)];
  return {style.material, style.color, surface::varies_in_triangle(part.interior, part.mesh, number)};
}

/// The lamp images that may reach any point of a patch.
std::vector<std::uint32_t> images_near_patch(const BakePart& part, const TexelPatch& patch) {
  const geometry::Space space = part.interior.polygon.space;
  const BarycentricPoint middle = barycentric_point(patch, 0.5, 0.5);
  const geometry::Position centre = surface::shading_point(part.interior, part.mesh, part.normals, middle.triangle, middle.b).at;
  double radius = 0;
  const auto include = [&](std::size_t triangle) {
    for (const std::uint32_t v : part.mesh.triangles[triangle])
      radius = std::max(radius, math::hypot(geometry::distance(space, centre.floor, part.mesh.floor[v]), part.mesh.z[v] - centre.z));
  };
  include(patch.first);
  if (patch.second >= 0) include(static_cast<std::size_t>(patch.second));
  return light::images_within(part.lighting, centre, 1.2 * radius);
}

/// The irradiance of lamps at points of a patch, for refine_grid. Points inside closed things are excluded: nobody sees them.
struct DirectSampler {
  const BakePart& part;
  const CornerLight& corners;
  const TexelPatch& patch;
  PatchStyle style;
  std::optional<std::vector<std::uint32_t>> images = {};                    ///< near the patch; found when the first point needs them
  std::map<std::size_t, std::vector<light::ImageVisibility>> visibility{};  ///< of these images, per sampled point of the finest grid
  std::uint64_t lit_points = 0;                                             ///< points at which shadow rays were traced

  GridSample sample(const GridPoint& at) { return sample(at, std::nullopt); }
  /// In: no parents for points of the coarse grid, which are far apart.
  GridSample sample(const GridPoint& at, const std::optional<GridParents>& parents) {
    if (style.material.kind == scene::MaterialKind::emissive) return {};
    const std::size_t index = static_cast<std::size_t>(at.j) * static_cast<std::size_t>(at.width) + static_cast<std::size_t>(at.i);
    if (at.is_corner()) {
      const CornerSample corner = corners(corner_of(patch, at.i > 0, at.j > 0));
      if (corner.seen) visibility[index] = visibility_of_near_images(*corner.seen);
      return corner.light;
    }
    const BarycentricPoint inside = inset_point(patch, at.u(), at.v(), surface::kInset);
    const BakePoint point = make_bake_point(part, inside.triangle, inside.b, std::max(patch.length_u, patch.length_v) / 2);
    if (point.known_irradiance) return {*point.known_irradiance};
    ++lit_points;
    const auto expected = parents ? agreed_visibility({parents->index.data(), parents->count}) : std::vector<light::ImageVisibility>();
    const auto phase = static_cast<std::uint32_t>(at.i + 2 * at.j);
    light::VisibleIrradiance light = light::irradiance(part.lighting, point.point, {near_images(), expected, phase});
    visibility[index] = std::move(light.visibility);
    return {light.irradiance, light.irradiance == Color{} && light::is_enclosed(part.lighting, point.point)};
  }

  const std::vector<std::uint32_t>& near_images() {
    if (!images) images = images_near_patch(part, patch);
    return *images;
  }

  std::vector<light::ImageVisibility> visibility_of_near_images(const SeenImages& seen) {
    std::vector<light::ImageVisibility> near;
    std::size_t next = 0;
    for (const std::uint32_t image : near_images()) {
      while (next < seen.images.size() && seen.images[next] < image) ++next;
      const bool is_known = next < seen.images.size() && seen.images[next] == image;
      near.push_back(is_known ? seen.visibility[next] : light::ImageVisibility{});
    }
    return near;
  }

  /// What the sampled ones among points of the grid agree on. Nothing if fewer than two were sampled.
  [[nodiscard]] std::vector<light::ImageVisibility> agreed_visibility(std::span<const std::size_t> points) const {
    std::vector<light::ImageVisibility> agreed;
    int known_points = 0;
    for (const std::size_t point : points) {
      const auto known = visibility.find(point);
      if (known == visibility.end()) continue;
      if (++known_points == 1) agreed = known->second;
      for (std::size_t i = 0; i < agreed.size(); ++i)
        if (known->second[i] != agreed[i]) agreed[i] = {light::Visibility::partial, {}};
    }
    return known_points < 2 ? std::vector<light::ImageVisibility>() : agreed;
  }

  [[nodiscard]] std::array<double, 3> encoded(const Color& irradiance) const {
    const Color c = part.lighting.exposure * light::outgoing_radiance(part.lighting, style.material, style.color, irradiance);
    return {code(c.r), code(c.g), code(c.b)};
  }
  /// Steps of 1/255 of the picture. Above white, of one in a mirror that dims the colour to white: the code goes on with the logarithm.
  static double code(double c) {
    if (c <= 1) return 255 * image::encode_srgb(c);
    return 255 + 255 * 1.055 / 2.4 * math::log(std::min(c, kMostDimmed));
  }
  /// Steps of 1/255 of the picture, in the channel that differs most.
  [[nodiscard]] double difference(const Color& a, const Color& b) const {
    if (a == b) return 0;
    const auto x = encoded(a), y = encoded(b);
    return std::max({std::fabs(x[0] - y[0]), std::fabs(x[1] - y[1]), std::fabs(x[2] - y[2])});
  }
};

/// Every step-th point of a grid.
IrradianceGrid downsample(const AdaptiveGrid& grid, const TexelPatch& patch) {
  const GridStep step = grid.sampled;
  IrradianceGrid few;
  few.width = (grid.width - 1) / step.u + 1;
  few.height = (grid.height - 1) / step.v + 1;
  few.light.resize(static_cast<std::size_t>(few.width) * static_cast<std::size_t>(few.height));
  for (int j = 0; j < few.height; ++j)
    for (int i = 0; i < few.width; ++i) {
      const Color& c = grid.color[grid.index(i * step.u, j * step.v)];
      few.point(i, j) = {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
    }
  return extrapolate_beyond_patch(std::move(few), patch);
}

/// Light with its rough cells: those with a rough corner, and those over which light changes much. The irradiance is not
/// yet set. In: a grid before excluded points are filled in.
DirectLight find_rough_cells(const AdaptiveGrid& grid, const TexelPatch& patch, DirectSampler& sampler) {
  const GridStep step = grid.sampled;
  DirectLight direct;
  std::vector<std::uint32_t> cells;
  for (int j = 0; j + step.v < grid.height; j += step.v)
    for (int i = 0; i + step.u < grid.width; i += step.u) {
      cells.push_back(0);
      if (!on_patch(patch, i, j, grid.width, grid.height)) continue;
      std::vector<std::size_t> corners{grid.index(i, j)};
      for (const auto& [x, y] : {std::array{i + step.u, j}, std::array{i, j + step.v}, std::array{i + step.u, j + step.v}})
        if (on_patch(patch, x, y, grid.width, grid.height)) corners.push_back(grid.index(x, y));
      bool is_rough = false;
      for (const std::size_t a : corners)
        is_rough = is_rough || grid.rough[a] != 0 || grid.excluded[a] != grid.excluded[corners[0]] ||
                   std::any_of(corners.begin(), corners.end(),
                               [&](std::size_t b) { return b > a && sampler.difference(grid.color[a], grid.color[b]) > kRoughStep; });
      if (!is_rough) continue;
      direct.expected.push_back(sampler.agreed_visibility(corners));
      cells.back() = static_cast<std::uint32_t>(direct.expected.size());
    }
  if (direct.expected.empty()) return direct;
  direct.rough_cell = std::move(cells);
  direct.images = sampler.near_images();
  return direct;
}

/// The least number of points that has those of `own`, and is as fine as `other`: texels on the points of the first stay on them.
int aligned_points(int own, int other) {
  int cells = own - 1;
  while (cells < other - 1) cells *= 2;
  return cells + 1;
}

/// The size of a patch in texels.
std::array<int, 2> texel_count(const BakePart& part, const TexelPatch& patch, const PatchStyle& style, const IrradianceGrid& direct,
                               const IrradianceGrid* indirect) {
  const double density = style.varies ? pattern_density(part.interior, part.mesh, patch, part.options) : 0;
  const auto for_pattern = [&](double length) { return (1 << halvings(length * density)) + 1; };
  const int width = indirect ? aligned_points(direct.width, indirect->width) : direct.width;
  const int height = indirect ? aligned_points(direct.height, indirect->height) : direct.height;
  return {std::max(width, for_pattern(patch.length_u)), std::max(height, for_pattern(patch.length_v))};
}

}  // namespace

CornerLight corner_light(const BakePart& part, const VertexLight& vertices) {
  return [&](const PatchCorner& corner) {
    const std::uint32_t v = part.normals.corners[corner.triangle][corner.k];
    return CornerSample{{vertices.irradiance[v], vertices.enclosed[v] != 0}, nullptr};
  };
}

DirectLight bake_direct(const BakePart& part, const CornerLight& corners, const TexelPatch& patch) {
  GridLevels levels;
  levels.coarse_u = halvings(patch.length_u * part.options.min_density);
  levels.coarse_v = halvings(patch.length_v * part.options.min_density);
  levels.fine_u = std::max(levels.coarse_u, halvings(patch.length_u * part.options.max_density));
  levels.fine_v = std::max(levels.coarse_v, halvings(patch.length_v * part.options.max_density));
  DirectSampler sampler{part, corners, patch, style_of(part, patch)};
  const std::vector<GridSample> coarse = sample_coarse_grid(patch, levels, sampler);
  AdaptiveGrid grid = refine_grid(patch, levels, coarse, {kMaxDiffuseStep, part.options.tolerance, kRoughTolerance}, sampler);
  DirectLight direct = find_rough_cells(grid, patch, sampler);
  // In front of an object on the floor, light is interpolated from the open floor alone, and not from the dark floor below the object.
  const GridStep step = grid.sampled;
  grid = inpaint_excluded(std::move(grid), patch, step);
  direct.irradiance = downsample(grid, patch);
  direct.irradiance.lit_points = sampler.lit_points;
  return direct;
}

PatchTexels shade_patch(const BakePart& part, const TexelPatch& patch, const IrradianceGrid& direct, const IrradianceGrid* indirect) {
  const PatchStyle style = style_of(part, patch);
  const auto [width, height] = texel_count(part, patch, style, direct, indirect);
  ColorGrid shown{width, height, std::vector<Color>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const double u = static_cast<double>(i) / (width - 1), v = static_cast<double>(j) / (height - 1);
      if (patch.second < 0 && u + v > 1 + 1e-9) {  // beyond the long side of a single triangle: a look-up reaches one texel deep
        shown.color[shown.index(i, j)] = extrapolate_beyond_patch(shown, i, j);
        continue;
      }
      Color irradiance = interpolate(direct, u, v);
      if (indirect) irradiance = irradiance + std::numbers::pi * interpolate(*indirect, u, v);
      const Color albedo = style.varies ? albedo_at(part.interior, part.mesh, patch, u, v) : style.color;
      shown.color[shown.index(i, j)] = part.lighting.exposure * light::outgoing_radiance(part.lighting, style.material, albedo, irradiance);
    }
  return encode_texels(part.interior, patch, shown, part.options.with_image16);
}

}  // namespace orbc::bake
