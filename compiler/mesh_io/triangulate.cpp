// Ear clipping after Meisters (1975), in three dimensions by signs against the polygon's area vector (Newell), which is right for planar
// polygons and sensible for slightly bent ones. Long polygons, and those that touch themselves, go to earcut (third_party/earcut) in the
// plane of two axes.
#include "compiler/mesh_io/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include "third_party/earcut/earcut.hpp"
#pragma GCC diagnostic pop

namespace orbc::mesh_io {
namespace {

using geometry::Vector3;
using mesh::Triangle;

/// Polygons of more corners than this are left to earcut: choosing the best ear takes their number to the third.
constexpr std::size_t kMaxCornersForBestEars = 256;

/// The area vector of a polygon: its length is twice the area, its direction the normal.
Vector3 area_vector(const std::vector<Vector3>& polygon) {
  Vector3 sum;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) sum = sum + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return sum;
}

struct EarCutter {
  const std::vector<Vector3>& polygon;
  Vector3 normal;
  std::vector<std::uint32_t> ring;

  double orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return dot(cross(polygon[b] - polygon[a], polygon[c] - polygon[a]), normal);
  }
  /// How good an ear the corner is: smallest sine² of its triangle, negative if it is none.
  double quality(std::size_t at, std::int64_t& ear_tests) const {
    const auto n = ring.size();
    const auto a = ring[(at + n - 1) % n], b = ring[at], c = ring[(at + 1) % n];
    if (orientation(a, b, c) <= 0) return -1;
    ear_tests -= static_cast<std::int64_t>(n);
    for (std::size_t i = 0; i + 3 < n; ++i) {
      const auto p = ring[(at + 2 + i) % n];
      if (orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0) return -1;
    }
    const Vector3 u = polygon[b] - polygon[a], v = polygon[c] - polygon[b], w = polygon[a] - polygon[c];
    const double lu = dot(u, u), lv = dot(v, v), lw = dot(w, w), longest = std::max({lu, lv, lw}), shortest = std::min({lu, lv, lw});
    const double area = dot(cross(u, v), cross(u, v));
    return longest > 0 ? area / (longest * std::max(longest - shortest / 2, longest / 2)) : 0;
  }
};

/// Cuts the best-shaped ear again and again. When no ear is left, as in a polygon that crosses itself, or the work is spent, the rest
/// becomes a fan.
std::vector<Triangle> by_best_ears(const std::vector<Vector3>& polygon, const Vector3& normal, std::int64_t& ear_tests) {
  std::vector<Triangle> triangles;
  EarCutter cutter{polygon, normal, {}};
  for (std::uint32_t i = 0; i < polygon.size(); ++i) cutter.ring.push_back(i);
  while (cutter.ring.size() > 3 && ear_tests > 0) {
    double best = -1;
    std::size_t best_at = 0;
    for (std::size_t at = 0; at < cutter.ring.size(); ++at) {
      const double quality = cutter.quality(at, ear_tests);
      if (!(quality > best * (1 + 1e-9))) continue;
      best = quality;
      best_at = at;
    }
    if (best < 0) break;
    const auto m = cutter.ring.size();
    triangles.push_back({cutter.ring[(best_at + m - 1) % m], cutter.ring[best_at], cutter.ring[(best_at + 1) % m]});
    cutter.ring.erase(cutter.ring.begin() + static_cast<std::ptrdiff_t>(best_at));
  }
  for (std::size_t i = 1; i + 1 < cutter.ring.size(); ++i) triangles.push_back({cutter.ring[0], cutter.ring[i], cutter.ring[i + 1]});
  return triangles;
}

std::vector<Triangle> fan(std::size_t corners) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.push_back({0, i, i + 1});
  return triangles;
}

using Point2 = std::array<double, 2>;

/// The polygon seen along the axis that is nearest to its normal.
std::vector<Point2> projected(const std::vector<Vector3>& polygon, const Vector3& normal) {
  const double ax = std::abs(normal.x), ay = std::abs(normal.y), az = std::abs(normal.z);
  const int axis = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
  std::vector<Point2> ring;
  for (const auto& p : polygon) {
    const Vector3 q = p - polygon[0];
    ring.push_back(axis == 0 ? Point2{q.y, q.z} : axis == 1 ? Point2{q.z, q.x} : Point2{q.x, q.y});
  }
  return ring;
}

double orientation(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool cross_properly(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

/// Whether two sides cross, by a sweep along x; also when the work is spent before that is known. earcut takes such polygons too, but
/// needs time of the third power of their corners.
bool crosses_itself(const std::vector<Point2>& ring, std::int64_t& side_tests) {
  struct Side {
    double low, high;
    Point2 from, to;
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sides.push_back({std::min(a[0], b[0]), std::max(a[0], b[0]), a, b});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.low < b.low; });
  std::vector<const Side*> active;
  for (const Side& side : sides) {
    active.erase(std::remove_if(active.begin(), active.end(), [&](const Side* s) { return s->high < side.low; }), active.end());
    side_tests -= static_cast<std::int64_t>(active.size());
    if (side_tests <= 0) return true;
    for (const Side* other : active) {
      if (cross_properly(side.from, side.to, other->from, other->to)) return true;
    }
    active.push_back(&side);
  }
  return false;
}

std::vector<Triangle> by_earcut(const std::vector<Vector3>& polygon, const Vector3& normal, std::int64_t& side_tests) {
  const std::vector<std::vector<Point2>> rings{projected(polygon, normal)};
  if (crosses_itself(rings[0], side_tests)) return fan(polygon.size());
  const auto indices = mapbox::earcut<std::uint32_t>(rings);
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    Triangle t{indices[i], indices[i + 1], indices[i + 2]};
    if (dot(cross(polygon[t[1]] - polygon[t[0]], polygon[t[2]] - polygon[t[0]]), normal) < 0) std::swap(t[1], t[2]);
    triangles.push_back(t);
  }
  return triangles.empty() ? fan(polygon.size()) : triangles;
}

bool touches_itself(std::vector<Vector3> polygon) {
  const auto less = [](const Vector3& a, const Vector3& b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; };
  std::sort(polygon.begin(), polygon.end(), less);
  return std::adjacent_find(polygon.begin(), polygon.end(), [&](const Vector3& a, const Vector3& b) { return !less(a, b); }) !=
         polygon.end();
}

}  // namespace

std::vector<Triangle> triangulate(const std::vector<Vector3>& polygon, std::int64_t& ear_tests) {
  if (polygon.size() < 3) return {};
  if (polygon.size() == 3) return {{0, 1, 2}};
  Vector3 normal = area_vector(polygon);
  const double size = length(normal);
  if (!(size > 0)) return fan(polygon.size());
  normal = (1 / size) * normal;
  if (polygon.size() <= kMaxCornersForBestEars && !touches_itself(polygon)) return by_best_ears(polygon, normal, ear_tests);
  return by_earcut(polygon, normal, ear_tests);
}

}  // namespace orbc::mesh_io
