#include "exporters/html/core/drawn_mesh.h"

#include <algorithm>
#include <map>
#include <utility>

namespace orbc::html {
namespace {

using geometry::Ambient;
using place::PlacedMesh;

constexpr int kMaxDepth = 6;  // of splitting: a cheap guard against edges of absurd length

struct Corner {
  std::uint32_t vertex = 0;
  geometry::Point at;
  double z = 0;
  std::array<double, 3> b{1, 0, 0};
};

bool is_plain(const place::SurfaceStyle& style, const PlacedMesh& part) {
  const scene::Pattern pattern = style.material.pattern;
  const bool solid = pattern == scene::Pattern::marble || pattern == scene::Pattern::wood || pattern == scene::Pattern::granite;
  const scene::MaterialKind kind = style.material.kind;
  return style.texture < 0 && !(solid && !part.pattern_position.empty()) && kind != scene::MaterialKind::glass &&
         kind != scene::MaterialKind::mirror && kind != scene::MaterialKind::metal && kind != scene::MaterialKind::emissive;
}

/// Adds the triangles of one part to the meshes.
class PartSplitter {
 public:
  PartSplitter(const place::Interior& interior, std::uint32_t part, const surface::PartNormals& normals, double max_edge, DrawnMeshes& out)
      : interior_(interior), mesh_(interior.parts[part]), part_(part), normals_(normals), max_edge_(max_edge), out_(out) {}

  void run() {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      triangle_ = t;
      std::array<Corner, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) corners[k] = own_corner(k);
      split(corners, 0);
    }
  }

 private:
  DrawnMesh& target() {
    const int style = mesh_.style[triangle_];
    const bool plain = is_plain(interior_.styles[static_cast<std::size_t>(style)], mesh_);
    const int part = mesh_.kind == place::PartKind::frame ? -1 : static_cast<int>(part_), wanted = plain ? -1 : style;
    for (DrawnMesh& mesh : out_.meshes)
      if (mesh.style == wanted && mesh.part == part) return mesh;
    out_.meshes.push_back({wanted, part, {}});
    return out_.meshes.back();
  }

  // Vertices are shared between triangles of one style, where the shading normal is the same.
  Corner own_corner(std::size_t k) {
    const std::uint32_t v = mesh_.triangles[triangle_][k];
    Corner corner{0, mesh_.floor[v], mesh_.z[v], {0, 0, 0}};
    corner.b[k] = 1;
    const std::pair key(normals_.corners[triangle_][k], mesh_.style[triangle_]);
    const auto [at, fresh] = corners_.emplace(key, 0);
    if (fresh) at->second = add_vertex(corner);
    corner.vertex = at->second;
    return corner;
  }

  Corner middle(const Corner& a, const Corner& b) {
    const Ambient sum = (a.at + b.at);
    Corner corner;
    corner.at = geometry::normalised_point(interior_.polygon.space, 0.5 * sum);
    corner.z = (a.z + b.z) / 2;
    for (std::size_t k = 0; k < 3; ++k) corner.b[k] = (a.b[k] + b.b[k]) / 2;
    const auto [at, fresh] = middles_.emplace(std::minmax(a.vertex, b.vertex), 0);
    if (fresh) at->second = add_vertex(corner);
    corner.vertex = at->second;
    return corner;
  }

  [[nodiscard]] bool is_long(const Corner& a, const Corner& b) const {
    return geometry::distance(interior_.polygon.space, a.at, b.at) > max_edge_;
  }

  void split(const std::array<Corner, 3>& c, int depth) {
    std::array<bool, 3> cut{};
    int count = 0;
    for (std::size_t k = 0; k < 3; ++k) count += cut[k] = depth < kMaxDepth && is_long(c[k], c[(k + 1) % 3]);
    if (count == 0) {
      DrawnMesh& mesh = target();
      for (const Corner& corner : c) mesh.indices.push_back(corner.vertex);
      return;
    }
    if (count == 3) {
      const Corner m0 = middle(c[0], c[1]), m1 = middle(c[1], c[2]), m2 = middle(c[2], c[0]);
      split({c[0], m0, m2}, depth + 1);
      split({m0, c[1], m1}, depth + 1);
      split({m2, m1, c[2]}, depth + 1);
      return split({m0, m1, m2}, depth + 1);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (!cut[k]) continue;
      const Corner m = middle(c[k], c[(k + 1) % 3]), last = c[(k + 2) % 3];
      split({c[k], m, last}, depth + 1);
      return split({m, c[(k + 1) % 3], last}, depth + 1);
    }
  }

  std::uint32_t add_vertex(const Corner& corner) {
    const auto index = static_cast<std::uint32_t>(out_.vertices.size());
    out_.vertices.push_back({part_, triangle_, corner.b});
    const surface::ShadingPoint point = surface::shading_point(interior_, mesh_, normals_, triangle_, corner.b);
    for (const double x : {corner.at.w, corner.at.x, corner.at.y, corner.z}) out_.positions.push_back(static_cast<float>(x));
    for (const double x : {point.normal.floor.w, point.normal.floor.x, point.normal.floor.y, point.normal.z})
      out_.normals.push_back(static_cast<float>(x));
    const mesh::Triangle& t = mesh_.triangles[triangle_];
    const place::SurfaceStyle& style = interior_.styles[mesh_.style[triangle_]];
    std::array<double, 3> color{style.color.r, style.color.g, style.color.b}, at{0, 0, 0};
    for (std::size_t c = 0; c < 3; ++c) {
      double own = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!mesh_.color.empty()) own += corner.b[k] * static_cast<double>(mesh_.color[t[k]][c]);
        if (style.texture >= 0 && !mesh_.uv.empty()) at[c] += c < 2 ? corner.b[k] * static_cast<double>(mesh_.uv[t[k]][c]) : 0;
        else if (!mesh_.pattern_position.empty()) {
          const geometry::Vector3& p = mesh_.pattern_position[t[k]];
          at[c] += corner.b[k] * (c == 0 ? p.x : c == 1 ? p.y : p.z);
        }
      }
      if (!mesh_.color.empty()) color[c] *= own;
    }
    for (const double x : color) out_.colors.push_back(static_cast<float>(x));
    for (const double x : at) out_.coordinates.push_back(static_cast<float>(x));
    return index;
  }

  const place::Interior& interior_;
  const PlacedMesh& mesh_;
  std::uint32_t part_, triangle_ = 0;
  const surface::PartNormals& normals_;
  double max_edge_;
  DrawnMeshes& out_;
  std::map<std::pair<std::uint32_t, std::uint16_t>, std::uint32_t> corners_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

}  // namespace

DrawnMeshes drawn_meshes(const place::Interior& interior, const std::vector<surface::PartNormals>& normals, double max_edge) {
  DrawnMeshes out;
  for (std::uint32_t p = 0; p < interior.parts.size(); ++p) {
    const PlacedMesh& part = interior.parts[p];
    if (part.kind == place::PartKind::object || part.kind == place::PartKind::frame)
      PartSplitter(interior, p, normals[p], max_edge, out).run();
  }
  return out;
}

}  // namespace orbc::html
