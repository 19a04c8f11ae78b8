#include "compiler/mesh/analyse.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "compiler/mesh/closest_point_tree.h"
#include "compiler/mesh/primitives.h"

using namespace orbc;
using namespace orbc::mesh;
using geometry::Vector3;

namespace {

Mesh moved(Mesh mesh, const Vector3& by) {
  for (auto& p : mesh.positions) p = p + by;
  return mesh;
}
Mesh joined(Mesh a, const Mesh& b) {
  const auto base = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  a.uv.clear();
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  return a;
}
bool has(const Diagnostics& diagnostics, const std::string& code) {
  for (const auto& d : diagnostics) {
    if (d.code == code) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a body inside out, torn, or with a turned triangle is told, with the place", "[mesh]") {
  auto box = moved(make_box({1, 1, 1}, {2, 2, 2}), {10, 0, 0});
  CHECK(report_warnings(analyse(box), "box").empty());
  CHECK(analyse(box).centroid.x == Approx(10));
  auto other = box;
  other = flip_orientation(other);
  auto found = analyse(other);
  CHECK(found.inside_out);
  CHECK(found.volume == Approx(-1));
  CHECK(found.centroid.x == Approx(10));
  CHECK(has(report_warnings(found, "box"), "mesh.inside-out"));
  other = box;
  std::swap(other.triangles[5][0], other.triangles[5][1]);
  found = analyse(other);
  CHECK_FALSE(found.closed);
  CHECK(found.inconsistent_edges == 3);
  CHECK(found.inconsistent_at.x > 9);
  CHECK(has(report_warnings(found, "box"), "mesh.turned-triangles"));
  other = box;
  other.triangles.pop_back();
  found = analyse(other);
  CHECK_FALSE(found.closed);
  CHECK(found.open_edges == 3);
  CHECK(found.volume == 0);
  CHECK(has(report_warnings(found, "box"), "mesh.open"));
  CHECK(report_warnings(found, "box").front().severity == Severity::note);
}

TEST_CASE("an open sheet is centred by its surface, not by its vertices", "[mesh]") {
  Mesh sheet;
  sheet.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0.1, 0, 0}};
  sheet.triangles = {{0, 4, 3}, {4, 2, 3}, {4, 1, 2}};
  const auto found = analyse(sheet);
  CHECK(found.area == Approx(2));
  CHECK(found.centroid.x == Approx(1));
  CHECK(found.centroid.y == Approx(0.5));
}

TEST_CASE("edges of three sheets and triangles without area are told", "[mesh]") {
  Mesh fan;
  fan.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0, 0, 2}};
  fan.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 5}};
  const auto found = analyse(fan);
  CHECK(found.non_manifold_edges == 1);
  CHECK(found.non_manifold_at.z == Approx(0.5));
  CHECK(found.degenerate == 1);
  CHECK(has(report_warnings(found, "fan"), "mesh.not-manifold"));
  CHECK(has(report_warnings(found, "fan"), "mesh.degenerate-triangles"));
  for (const Diagnostic& told : report_warnings(found, "fan")) CHECK(told.severity == Severity::note);  // it looks right
}

TEST_CASE("bodies that cross are told, bodies that touch or lie apart are not", "[mesh]") {
  const auto sphere = make_sphere(1, 24, 12);
  auto found = analyse(joined(sphere, moved(sphere, {0.7, 0.3, 0.2})));
  CHECK(found.crossings > 20);
  CHECK(found.crossings_known);
  CHECK(length(found.crossing_at) < 1.6);
  CHECK(has(report_warnings(found, "x"), "mesh.self-intersections"));
  CHECK(report_warnings(found, "x").front().severity == Severity::note);
  CHECK(analyse(joined(sphere, moved(sphere, {2.5, 0, 0}))).crossings == 0);
  CHECK(analyse(joined(make_box({1, 1, 1}), moved(make_box({1, 1, 1}), {1, 0, 0}))).crossings == 0);
  CHECK(analyse(joined(sphere, make_sphere(0.5, 24, 12))).crossings == 0);
  // The search agrees with a look at all pairs of bodies' triangles, and gives up when it is told to.
  CHECK_FALSE(analyse(joined(sphere, moved(sphere, {0.7, 0, 0})), {.max_pair_tests = 10}).crossings_known);
}

TEST_CASE("distances from points to a surface agree with a plain search", "[mesh]") {
  const auto knot = make_torus_knot(2, 3, 1, 0.2, 60, 8);
  const ClosestPointTree nearest(knot);
  Mesh one;
  one.triangles = {{0, 1, 2}};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-2, 2);
  for (int round = 0; round < 200; ++round) {
    const Vector3 p{any(random), any(random), any(random)};
    double best = 100;
    for (const auto& t : knot.triangles) {
      one.positions = {knot.positions[t[0]], knot.positions[t[1]], knot.positions[t[2]]};
      best = std::min(best, ClosestPointTree(one).distance(p, 100));
    }
    CHECK(nearest.distance(p, 100) == Approx(best).epsilon(1e-12));
  }
  // One triangle against closed forms: above its inside, beyond an edge, beyond a corner.
  one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK(ClosestPointTree(one).distance({0.2, 0.2, 3}, 9) == Approx(3));
  CHECK(ClosestPointTree(one).distance({0.5, -2, 0}, 9) == Approx(2));
  CHECK(ClosestPointTree(one).distance({-3, -4, 0}, 9) == Approx(5));
  CHECK(ClosestPointTree(one).distance({1, 1, 0}, 9) == Approx(std::sqrt(0.5)));
}
