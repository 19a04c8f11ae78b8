// Repeated passes over all triangles: every edge that has to be split gets one vertex in its middle, and a triangle with one, two or three
// such edges becomes two, three or four (the templates of Ruprecht & Müller 1998).
#include "compiler/mesh/refine.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>

namespace orbc::mesh {
namespace {

using geometry::Vector3;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// An edge that was asked about: its further end, and its middle if it was split.
struct Edge {
  std::uint32_t to, middle, next;
};

class Refinement {
 public:
  Refinement(const Mesh& mesh, const SplitEdge& split) : mesh_(mesh), split_(split), edges_of_(mesh.positions.size(), kNone) {}

  /// False when more than `max_triangles` would be needed.
  bool run(std::uint64_t max_triangles) {
    // An edge that stays whole once stays whole for ever, so triangles that were not cut are done.
    open_ = std::move(mesh_.triangles);
    open_material_ = std::move(mesh_.triangle_material);
    mesh_.triangles.clear();
    mesh_.triangle_material.clear();
    while (!open_.empty()) {
      std::vector<Triangle> parts;
      std::vector<std::uint16_t> material;
      for (std::size_t t = 0; t < open_.size(); ++t) {
        const bool whole = cut(open_[t], parts);
        if (!open_material_.empty()) {
          if (whole) mesh_.triangle_material.push_back(open_material_[t]);
          else material.resize(parts.size(), open_material_[t]);
        }
        if (mesh_.triangles.size() + parts.size() > max_triangles) return false;
      }
      open_ = std::move(parts);
      open_material_ = std::move(material);
      // Edges of the next pass are halves and new ones: what was asked before is not asked again.
      edges_.clear();
      edges_of_.assign(mesh_.positions.size(), kNone);
    }
    return true;
  }
  Mesh take() { return std::move(mesh_); }

 private:
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    for (auto e = edges_of_[a]; e != kNone; e = edges_[e].next) {
      if (edges_[e].to == b) return edges_[e].middle;
    }
    const auto m = make_middle(a, b);
    edges_.push_back({b, m, edges_of_[a]});
    edges_of_[a] = static_cast<std::uint32_t>(edges_.size() - 1);
    return m;
  }
  std::uint32_t make_middle(std::uint32_t a, std::uint32_t b) {
    const Vector3 p = mesh_.positions[a], q = mesh_.positions[b];
    if (!split_(p, q)) return kNone;
    const Vector3 m = 0.5 * (p + q);
    // An edge too short to have a middle in double precision stays whole, whatever is asked.
    const auto same = [](const Vector3& u, const Vector3& v) { return u.x == v.x && u.y == v.y && u.z == v.z; };
    if (same(m, p) || same(m, q)) return kNone;
    mesh_.positions.push_back(m);
    if (!mesh_.uv.empty()) {
      const auto s = mesh_.uv[a], e = mesh_.uv[b];
      mesh_.uv.push_back({(s[0] + e[0]) / 2, (s[1] + e[1]) / 2});
    }
    if (!mesh_.colors.empty()) {
      const auto s = mesh_.colors[a], e = mesh_.colors[b];
      mesh_.colors.push_back({(s[0] + e[0]) / 2, (s[1] + e[1]) / 2, (s[2] + e[2]) / 2});
    }
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
  }

  /// Whether the triangle is done; else its parts are added to `out`.
  bool cut(const Triangle& t, std::vector<Triangle>& out) {
    std::array<std::uint32_t, 3> m{};
    int count = 0;
    for (std::size_t k = 0; k < 3; ++k) count += (m[k] = middle(t[k], t[(k + 1) % 3])) != kNone;
    if (count == 0) {
      mesh_.triangles.push_back(t);
      return true;
    }
    if (count == 3) {
      for (const Triangle& part :
           {Triangle{t[0], m[0], m[2]}, Triangle{m[0], t[1], m[1]}, Triangle{m[2], m[1], t[2]}, Triangle{m[0], m[1], m[2]}}) {
        out.push_back(part);
      }
      return false;
    }
    // Turned so that with one split edge it is the first, with two the whole one is the last.
    std::size_t k = 0;
    while (count == 1 ? m[k] == kNone : m[(k + 2) % 3] != kNone) ++k;
    const auto a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = m[k], bc = m[(k + 1) % 3];
    if (count == 1) {
      out.push_back({a, ab, c});
      out.push_back({ab, b, c});
      return false;
    }
    out.push_back({ab, b, bc});
    const Vector3 d = mesh_.positions[bc] - mesh_.positions[a], e = mesh_.positions[ab] - mesh_.positions[c];
    if (dot(d, d) <= dot(e, e)) {
      out.push_back({a, ab, bc});
      out.push_back({a, bc, c});
    } else {
      out.push_back({a, ab, c});
      out.push_back({ab, bc, c});
    }
    return false;
  }

  Mesh mesh_;
  const SplitEdge& split_;
  std::vector<Triangle> open_;
  std::vector<std::uint16_t> open_material_;
  std::vector<std::uint32_t> edges_of_;  // of each vertex the first of its edges to later vertices
  std::vector<Edge> edges_;
};

}  // namespace

Result<Mesh> refine(const Mesh& mesh, const SplitEdge& split, std::uint64_t max_triangles) {
  Refinement refinement(mesh, split);
  if (refinement.run(max_triangles)) return refinement.take();
  return make_error("mesh.too-dense", fmt::format("the mesh would need more than {} triangles to be fine enough", max_triangles),
                    "ask for longer edges, or make the object smaller");
}

}  // namespace orbc::mesh
