// Ear clipping after Meisters (1975), in three dimensions by signs against the polygon's area vector (Newell), which is right for planar
// polygons and sensible for slightly bent ones. Long polygons, and those that touch themselves, are cut in the plane of two axes
// (ear_clipping.h).
#include "compiler/mesh_io/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "compiler/mesh_io/ear_clipping.h"

namespace orbc::mesh_io {
namespace {

using geometry::Vector3;
using mesh::Triangle;

/// Polygons of more corners than this are cut as ears come: choosing the best ear takes the third power of their number.
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

/// The polygon, counter-clockwise, seen along the axis that is nearest to its normal.
std::vector<PlanePoint> projected(const std::vector<Vector3>& polygon, const Vector3& normal) {
  const double ax = std::abs(normal.x), ay = std::abs(normal.y), az = std::abs(normal.z);
  const int axis = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
  const bool from_behind = (axis == 0 ? normal.x : axis == 1 ? normal.y : normal.z) < 0;
  std::vector<PlanePoint> ring;
  for (const auto& p : polygon) {
    const Vector3 q = p - polygon[0];
    const PlanePoint seen = axis == 0 ? PlanePoint{q.y, q.z} : axis == 1 ? PlanePoint{q.z, q.x} : PlanePoint{q.x, q.y};
    ring.push_back(from_behind ? PlanePoint{seen[1], seen[0]} : seen);
  }
  return ring;
}

/// Corner tests that ear clipping may spend on one corner of a long polygon. Simple polygons need up to 200; more is spent only on polygons
/// that cross themselves, which have no right answer.
constexpr std::int64_t kMaxStepsPerCorner = 1000;

std::vector<Triangle> by_ears_in_plane(const std::vector<Vector3>& polygon, const Vector3& normal, std::int64_t& ear_tests) {
  const std::int64_t allowed = std::min(ear_tests, kMaxStepsPerCorner * static_cast<std::int64_t>(polygon.size()));
  std::int64_t left = allowed;
  std::vector<Triangle> triangles = clip_ears(projected(polygon, normal), left);
  ear_tests -= allowed - left;
  return triangles;
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
  return by_ears_in_plane(polygon, normal, ear_tests);
}

}  // namespace orbc::mesh_io
