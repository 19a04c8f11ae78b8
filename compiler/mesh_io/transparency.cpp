#include "compiler/mesh_io/transparency.h"

#include <algorithm>
#include <utility>

#include "compiler/mesh/weld.h"

namespace orbc::mesh_io {
namespace {

constexpr double kThreshold = 0.5;

bool has_alpha(const image::Image& image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    if (image.rgba[i] < 255) return true;
  }
  return false;
}

bool has_partial_alpha(const image::Image& image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    if (image.rgba[i] > 0 && image.rgba[i] < 255) return true;
  }
  return false;
}

/// The texel of a picture that covers the middle of texel (x, y) of a picture of the given size.
const std::uint8_t* texel_below(const image::Image& image, int x, int y, int width, int height) {
  const auto index = [](int at, int size, int own) { return std::min(static_cast<int>((at + 0.5) / size * own), own - 1); };
  const auto row = static_cast<std::size_t>(index(y, height, image.height)),
             column = static_cast<std::size_t>(index(x, width, image.width));
  return image.rgba.data() + 4 * (row * static_cast<std::size_t>(image.width) + column);
}

}  // namespace

UnblendedMaterial without_blending(mesh::Material material, double alpha, const image::Image* texture) {
  UnblendedMaterial made{std::move(material), true};
  if (texture && has_alpha(*texture)) {
    made.is_exact = alpha == 1 && !has_partial_alpha(*texture);
    made.material.alpha_cutoff = alpha > kThreshold ? kThreshold / alpha : 2;
  } else {
    made.is_exact = alpha == 1 || alpha == 0;
  }
  made.material.is_invisible = alpha < kThreshold;
  return made;
}

Diagnostic blending_warning(const std::string& name) {
  return make_warning(
      "mesh.blended",
      name + ": some surfaces are blended by their alpha; where it is below one half they are left out, unless that leaves nothing",
      "give the object a `material` of its own, such as glass");
}

mesh::Mesh without_invisible_triangles(mesh::Mesh mesh) {
  const auto is_visible = [&](std::size_t t) {
    const std::size_t material = mesh.triangle_material.empty() ? 0 : mesh.triangle_material[t];
    return material >= mesh.materials.size() || !mesh.materials[material].is_invisible;
  };
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) kept += is_visible(t) ? 1 : 0;
  if (kept == 0 || kept == mesh.triangles.size()) return mesh;
  std::vector<mesh::Triangle> triangles;
  std::vector<std::uint16_t> materials;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_visible(t)) continue;
    triangles.push_back(mesh.triangles[t]);
    if (!mesh.triangle_material.empty()) materials.push_back(mesh.triangle_material[t]);
  }
  mesh.triangles = std::move(triangles);
  mesh.triangle_material = std::move(materials);
  return mesh::remove_unused_vertices(std::move(mesh)).mesh;
}

image::Image with_opacity_mask(const image::Image* colors, const image::Image& mask) {
  const bool by_alpha = has_alpha(mask);
  const int width = std::max(mask.width, colors ? colors->width : 1), height = std::max(mask.height, colors ? colors->height : 1);
  image::Image made{width, height, {}};
  made.rgba.reserve(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  constexpr std::uint8_t kWhite[] = {255, 255, 255};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* color = colors ? texel_below(*colors, x, y, width, height) : kWhite;
      const std::uint8_t* m = texel_below(mask, x, y, width, height);
      const int alpha = by_alpha ? m[3] : (2126 * m[0] + 7152 * m[1] + 722 * m[2] + 5000) / 10000;
      made.rgba.insert(made.rgba.end(), {color[0], color[1], color[2], static_cast<std::uint8_t>(alpha)});
    }
  }
  return made;
}

}  // namespace orbc::mesh_io
