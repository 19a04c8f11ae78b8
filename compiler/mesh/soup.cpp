// From a polygon soup to a triangle mesh. Ear clipping after Meisters (1975), in three dimensions by signs against the polygon's
// area vector (Newell), which is right for planar polygons and sensible for slightly bent ones.
#include "compiler/mesh/soup.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace orbc::mesh {
namespace {

using geometry::Vector3;

struct EarCutter {
  const std::vector<Vector3>& polygon;
  Vector3 normal;
  std::vector<std::uint32_t> ring;

  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return dot(cross(polygon[b] - polygon[a], polygon[c] - polygon[a]), normal);
  }
  /// How good an ear the corner is: smallest sine² of its triangle, negative if it is none.
  double quality(std::size_t at, std::int64_t& budget) const {
    const auto n = ring.size();
    const auto a = ring[(at + n - 1) % n], b = ring[at], c = ring[(at + 1) % n];
    if (turn(a, b, c) <= 0) return -1;
    budget -= static_cast<std::int64_t>(n);
    for (std::size_t i = 0; i + 3 < n; ++i) {
      const auto p = ring[(at + 2 + i) % n];
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return -1;
    }
    const Vector3 u = polygon[b] - polygon[a], v = polygon[c] - polygon[b], w = polygon[a] - polygon[c];
    const double lu = dot(u, u), lv = dot(v, v), lw = dot(w, w), longest = std::max({lu, lv, lw}), shortest = std::min({lu, lv, lw});
    const double area = dot(cross(u, v), cross(u, v));
    return longest > 0 ? area / (longest * std::max(longest - shortest / 2, longest / 2)) : 0;
  }
};

}  // namespace

std::vector<Triangle> triangulate(const std::vector<Vector3>& polygon, std::int64_t& budget) {
  std::vector<Triangle> triangles;
  const auto n = static_cast<std::uint32_t>(polygon.size());
  if (n < 3) return triangles;
  EarCutter cutter{polygon, {}, {}};
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    cutter.normal = cutter.normal + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  const double size = length(cutter.normal);
  if (size > 0) cutter.normal = (1 / size) * cutter.normal;
  for (std::uint32_t i = 0; i < n; ++i) cutter.ring.push_back(i);
  constexpr std::size_t kMaxEars = 256;  // longer polygons occur as flat caps; a fan is drawn right for them if they are convex
  while (cutter.ring.size() > 3 && n <= kMaxEars && budget > 0) {
    double best = -1;
    std::size_t best_at = 0;
    for (std::size_t at = 0; at < cutter.ring.size(); ++at) {
      const double quality = cutter.quality(at, budget);
      if (quality > best * (1 + 1e-9)) best = quality, best_at = at;
    }
    if (best < 0) break;
    const auto m = cutter.ring.size();
    triangles.push_back({cutter.ring[(best_at + m - 1) % m], cutter.ring[best_at], cutter.ring[(best_at + 1) % m]});
    cutter.ring.erase(cutter.ring.begin() + static_cast<std::ptrdiff_t>(best_at));
  }
  for (std::size_t i = 1; i + 1 < cutter.ring.size(); ++i) triangles.push_back({cutter.ring[0], cutter.ring[i], cutter.ring[i + 1]});
  return triangles;
}

namespace {

/// Gives each pair (vertex, uv) of the soup one vertex of the mesh, in order of first use.
class Splitter {
 public:
  Splitter(const Soup& soup, Mesh& mesh) : soup_(soup), mesh_(mesh), first_(soup.positions.size(), kNone) {}

  std::uint32_t vertex(std::uint32_t corner) {
    const auto from = soup_.corners[corner];
    auto at = first_[from];
    if (soup_.uv.empty()) return at != kNone ? at : add(from, corner);
    for (; at != kNone; at = next_[at]) {
      if (mesh_.uv[at] == soup_.uv[corner]) return at;
    }
    return add(from, corner);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t add(std::uint32_t from, std::uint32_t corner) {
    const auto at = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.push_back(soup_.positions[from]);
    if (!soup_.uv.empty()) {
      mesh_.uv.push_back(soup_.uv[corner]);
      next_.push_back(first_[from]);
    }
    first_[from] = at;
    return at;
  }

  const Soup& soup_;
  Mesh& mesh_;
  std::vector<std::uint32_t> first_, next_;
};

}  // namespace

Result<Loaded> to_mesh(const Soup& soup, const std::string& name, const LoadOptions& options) {
  Loaded loaded;
  auto& mesh = loaded.mesh;
  const std::size_t faces = soup.face_begin.empty() ? 0 : soup.face_begin.size() - 1;
  std::uint64_t skipped = 0, triangles = 0;
  for (std::size_t f = 0; f < faces; ++f) triangles += std::max<std::uint64_t>(soup.face_begin[f + 1] - soup.face_begin[f], 2) - 2;
  if (triangles > options.max_triangles) {
    return make_error("mesh.too-big", fmt::format("{}: {} triangles; at most {} are read", name, triangles, options.max_triangles),
                      "simplify the mesh in the program that made it");
  }
  mesh.triangles.reserve(triangles);
  Splitter splitter(soup, mesh);
  std::int64_t budget = 500'000'000;  // half a second of ear cutting: ordinary files need a thousandth of it
  std::vector<Vector3> polygon;
  std::vector<std::uint32_t> sorted;
  for (std::size_t f = 0; f < faces; ++f) {
    const auto begin = soup.face_begin[f], end = soup.face_begin[f + 1];
    sorted.assign(soup.corners.begin() + begin, soup.corners.begin() + end);
    std::sort(sorted.begin(), sorted.end());
    if (sorted.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
      ++skipped;
      continue;
    }
    const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      const auto i = splitter.vertex(begin + a), j = splitter.vertex(begin + b), k = splitter.vertex(begin + c);
      mesh.triangles.push_back({i, j, k});
      if (!soup.look.empty()) mesh.material.push_back(soup.look[f]);
    };
    if (end - begin == 3) {
      emit(0, 1, 2);
      continue;
    }
    polygon.clear();
    for (auto c = begin; c < end; ++c) polygon.push_back(soup.positions[soup.corners[c]]);
    for (const auto& t : triangulate(polygon, budget)) emit(t[0], t[1], t[2]);
  }
  if (mesh.triangles.empty()) {
    return make_error("mesh.no-triangles",
                      fmt::format("{}: there is no triangle in it ({} vertices, {} faces)", name, soup.positions.size(), faces),
                      "export the surface, not only its points or edges");
  }
  if (skipped > 0) {
    loaded.warnings.push_back(
        make_note("mesh.skipped-faces",
                     fmt::format("{}: {} of {} faces use fewer than three different vertices and are left out", name, skipped, faces)));
  }
  return loaded;
}

}  // namespace orbc::mesh
