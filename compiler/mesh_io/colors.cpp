#include "compiler/mesh_io/colors.h"

#include <algorithm>
#include <map>
#include <utility>

#include "compiler/image/srgb.h"

namespace orbc::mesh_io {

float white_of(const std::vector<mesh::LinearColor>& encoded) {
  float largest = 0;
  for (const auto& color : encoded) largest = std::max({largest, color[0], color[1], color[2]});
  return largest <= 1 ? 1.0f : largest <= 255 ? 255.0f : 65535.0f;
}

std::vector<mesh::LinearColor> decode_colors(std::vector<mesh::LinearColor> encoded, float white) {
  for (auto& color : encoded) {
    for (auto& channel : color)
      channel = static_cast<float>(image::decode_srgb(std::clamp(static_cast<double>(channel) / static_cast<double>(white), 0.0, 1.0)));
  }
  return encoded;
}

mesh::Mesh fold_uniform_colors(mesh::Mesh mesh) {
  constexpr std::size_t kMaxFoldedMaterials = 4096;
  if (mesh.colors.empty()) return mesh;
  std::map<std::pair<std::uint16_t, mesh::LinearColor>, std::uint16_t> index_of;
  std::vector<mesh::Material> materials;
  std::vector<std::uint16_t> triangle_material;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const auto& color = mesh.colors[v[0]];
    if (mesh.colors[v[1]] != color || mesh.colors[v[2]] != color || materials.size() > kMaxFoldedMaterials) return mesh;
    const std::uint16_t own = mesh.triangle_material.empty() ? std::uint16_t{0} : mesh.triangle_material[t];
    const auto [known, is_new] = index_of.insert({{own, color}, static_cast<std::uint16_t>(materials.size())});
    if (is_new) {
      materials.push_back(own < mesh.materials.size() ? mesh.materials[own] : mesh::Material{});
      for (std::size_t k = 0; k < 3; ++k) materials.back().color[k] *= static_cast<double>(color[k]);
    }
    triangle_material.push_back(known->second);
  }
  mesh.colors.clear();
  mesh.materials = std::move(materials);
  mesh.triangle_material = std::move(triangle_material);
  return mesh;
}

}  // namespace orbc::mesh_io
