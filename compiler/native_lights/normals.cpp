// Bent copies are ordinary meshes in flat space, whatever the space of the room: they get the normals that parts of a flat room would have.
#include "compiler/native_lights/normals.h"

#include "compiler/surface/normals.h"

namespace orbc::native_lights {
namespace {

/// A copy whose vertices are repeated where normals differ.
struct CopyWithNormals {
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 2>> uv;
  std::vector<std::uint32_t> indices;  ///< from 0
};

CopyWithNormals copy_with_normals(const bend::BentCover& cover, const bend::BentRange& range) {
  place::Interior flat;
  place::PlacedMesh mesh;
  for (std::size_t i = range.first_vertex; i < range.first_vertex + range.vertex_count; ++i) {
    const auto& p = cover.positions[i];
    mesh.floor.push_back({1, static_cast<double>(p[0]), static_cast<double>(p[1])});
    mesh.z.push_back(static_cast<double>(p[2]));
  }
  for (std::size_t i = range.first_index; i < range.first_index + range.index_count; i += 3) {
    mesh::Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) t[k] = cover.indices[i + k] - static_cast<std::uint32_t>(range.first_vertex);
    mesh.triangles.push_back(t);
  }
  const surface::PartNormals normals = surface::part_normals(flat, mesh);
  CopyWithNormals made;
  for (const surface::ShadingVertex& v : normals.vertices) {
    made.positions.push_back(cover.positions[range.first_vertex + v.vertex]);
    made.uv.push_back(cover.uv[range.first_vertex + v.vertex]);
    made.normals.push_back({static_cast<float>(v.normal.floor.x), static_cast<float>(v.normal.floor.y), static_cast<float>(v.normal.z)});
  }
  for (const auto& corners : normals.corners) made.indices.insert(made.indices.end(), corners.begin(), corners.end());
  return made;
}

}  // namespace

CoverWithNormals with_normals(bend::BentCover cover, const Executor& executor) {
  std::vector<CopyWithNormals> copies(cover.copies.size());
  executor(copies.size(), [&](std::size_t i) { copies[i] = copy_with_normals(cover, cover.copies[i]); });
  CoverWithNormals made{std::move(cover), {}};
  made.cover.positions.clear();
  made.cover.uv.clear();
  made.cover.indices.clear();
  for (std::size_t i = 0; i < copies.size(); ++i) {
    bend::BentRange& range = made.cover.copies[i];
    const CopyWithNormals& copy = copies[i];
    range.first_vertex = made.cover.positions.size();
    range.vertex_count = copy.positions.size();
    range.first_index = made.cover.indices.size();
    range.index_count = copy.indices.size();
    for (const std::uint32_t index : copy.indices) made.cover.indices.push_back(static_cast<std::uint32_t>(range.first_vertex) + index);
    made.cover.positions.insert(made.cover.positions.end(), copy.positions.begin(), copy.positions.end());
    made.cover.uv.insert(made.cover.uv.end(), copy.uv.begin(), copy.uv.end());
    made.normals.insert(made.normals.end(), copy.normals.begin(), copy.normals.end());
    copies[i] = {};
  }
  return made;
}

}  // namespace orbc::native_lights
