// Repeated passes over all triangles: every edge that has to be split gets one vertex in its middle, and a triangle with one, two or three
// such edges becomes two, three or four (the templates of Ruprecht & Müller 1998).
#include "compiler/mesh/refine.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <unordered_map>

#include "compiler/base/check.h"

namespace orbc::mesh {
namespace {

using geometry::Vector3;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class Pass {
 public:
  Pass(Mesh& mesh, const SplitEdge& split) : mesh_(mesh), split_(split) {}

  /// Returns whether anything was split.
  bool run(std::uint64_t max_triangles) {
    std::vector<Triangle> triangles;
    std::vector<std::uint8_t> material;
    triangles.reserve(mesh_.triangles.size());
    const auto before = mesh_.positions.size();
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      cut(mesh_.triangles[t], triangles);
      if (!mesh_.material.empty()) material.resize(triangles.size(), mesh_.material[t]);
      if (triangles.size() > max_triangles) return too_many_ = true;
    }
    mesh_.triangles = std::move(triangles);
    mesh_.material = std::move(material);
    return mesh_.positions.size() != before;
  }
  bool too_many() const { return too_many_; }

 private:
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [at, fresh] = middles_.try_emplace(std::uint64_t{a} << 32 | b, kNone);
    if (!fresh) return at->second;
    const Vector3 p = mesh_.positions[a], q = mesh_.positions[b];
    if (!split_(p, q)) return kNone;
    const Vector3 m = 0.5 * (p + q);
    // An edge too short to have a middle in double precision stays whole, whatever is asked.
    const auto same = [](const Vector3& u, const Vector3& v) { return u.x == v.x && u.y == v.y && u.z == v.z; };
    if (same(m, p) || same(m, q)) return kNone;
    at->second = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.push_back(m);
    if (!mesh_.uv.empty()) {
      const auto s = mesh_.uv[a], e = mesh_.uv[b];
      mesh_.uv.push_back({(s[0] + e[0]) / 2, (s[1] + e[1]) / 2});
    }
    return at->second;
  }

  void cut(const Triangle& t, std::vector<Triangle>& out) {
    std::array<std::uint32_t, 3> m{};
    int count = 0;
    for (std::size_t k = 0; k < 3; ++k) count += (m[k] = middle(t[k], t[(k + 1) % 3])) != kNone;
    if (count == 0) return out.push_back(t);
    if (count == 3) {
      for (const Triangle& part : {Triangle{t[0], m[0], m[2]}, Triangle{m[0], t[1], m[1]}, Triangle{m[2], m[1], t[2]}, Triangle{m[0], m[1], m[2]}}) {
        out.push_back(part);
      }
      return;
    }
    // Turned so that with one split edge it is the first, with two the whole one is the last.
    std::size_t k = 0;
    while (count == 1 ? m[k] == kNone : m[(k + 2) % 3] != kNone) ++k;
    const auto a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = m[k], bc = m[(k + 1) % 3];
    if (count == 1) {
      out.push_back({a, ab, c}), out.push_back({ab, b, c});
      return;
    }
    out.push_back({ab, b, bc});
    const Vector3 d = mesh_.positions[bc] - mesh_.positions[a], e = mesh_.positions[ab] - mesh_.positions[c];
    if (dot(d, d) <= dot(e, e)) {
      out.push_back({a, ab, bc}), out.push_back({a, bc, c});
    } else {
      out.push_back({a, ab, c}), out.push_back({ab, bc, c});
    }
  }

  Mesh& mesh_;
  const SplitEdge& split_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  // looked up only, never walked through
  bool too_many_ = false;
};

}  // namespace

Result<Mesh> refine(const Mesh& mesh, const SplitEdge& split, std::uint64_t max_triangles) {
  Mesh fine = mesh;
  while (true) {
    Pass pass(fine, split);
    const bool changed = pass.run(max_triangles);
    if (pass.too_many()) {
      return make_error("mesh.too-dense", fmt::format("the mesh would need more than {} triangles to be fine enough", max_triangles),
                        "ask for longer edges, or make the object smaller");
    }
    if (!changed) return fine;
  }
}

Result<Mesh> refine_to_length(const Mesh& mesh, double max_edge, std::uint64_t max_triangles) {
  ORBC_CHECK(max_edge, >, 0);
  const double square = max_edge * max_edge;
  return refine(mesh, [square](const Vector3& a, const Vector3& b) { return dot(a - b, a - b) > square; }, max_triangles);
}

}  // namespace orbc::mesh
