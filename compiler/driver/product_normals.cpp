// Drawn copies are ordinary meshes in flat space, whatever space they come from: their normals are those that light would give such parts.
#include "compiler/driver/product_normals.h"

#include "compiler/surface/normals.h"

namespace orbc::driver {
namespace {

/// A copy with its vertices doubled where normals differ.
struct Faceted {
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 2>> uv;
  std::vector<std::uint32_t> indices;  ///< from 0
};

Faceted faceted(const Product& product, const DrawnCopy& copy) {
  place::Interior flat;
  place::PlacedMesh mesh;
  for (std::size_t i = copy.first_vertex; i < copy.first_vertex + copy.vertex_count; ++i) {
    const auto& p = product.positions[i];
    mesh.floor.push_back({1, static_cast<double>(p[0]), static_cast<double>(p[1])});
    mesh.z.push_back(static_cast<double>(p[2]));
  }
  for (std::size_t i = copy.first_index; i < copy.first_index + copy.index_count; i += 3) {
    mesh::Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) t[k] = product.indices[i + k] - static_cast<std::uint32_t>(copy.first_vertex);
    mesh.triangles.push_back(t);
  }
  const surface::PartNormals normals = surface::part_normals(flat, mesh);
  Faceted made;
  for (const surface::ShadingVertex& v : normals.vertices) {
    made.positions.push_back(product.positions[copy.first_vertex + v.vertex]);
    made.uv.push_back(product.uv[copy.first_vertex + v.vertex]);
    made.normals.push_back({static_cast<float>(v.normal.floor.x), static_cast<float>(v.normal.floor.y), static_cast<float>(v.normal.z)});
  }
  for (const auto& corners : normals.corners) made.indices.insert(made.indices.end(), corners.begin(), corners.end());
  return made;
}

}  // namespace

void add_normals(Product& product, const Executor& executor) {
  std::vector<Faceted> copies(product.copies.size());
  executor(copies.size(), [&](std::size_t i) { copies[i] = faceted(product, product.copies[i]); });
  product.positions.clear(), product.uv.clear(), product.indices.clear(), product.normals.clear();
  for (std::size_t i = 0; i < copies.size(); ++i) {
    DrawnCopy& copy = product.copies[i];
    const Faceted& made = copies[i];
    copy.first_vertex = product.positions.size(), copy.vertex_count = made.positions.size();
    copy.first_index = product.indices.size(), copy.index_count = made.indices.size();
    for (const std::uint32_t index : made.indices) product.indices.push_back(static_cast<std::uint32_t>(copy.first_vertex) + index);
    product.positions.insert(product.positions.end(), made.positions.begin(), made.positions.end());
    product.normals.insert(product.normals.end(), made.normals.begin(), made.normals.end());
    product.uv.insert(product.uv.end(), made.uv.begin(), made.uv.end());
    copies[i] = {};
  }
}

}  // namespace orbc::driver
