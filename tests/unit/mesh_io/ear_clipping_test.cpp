#include "compiler/mesh_io/ear_clipping.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "compiler/mesh_io/triangulate.h"

namespace orbc::mesh_io {
namespace {

using Ring = std::vector<PlanePoint>;

double twice_area(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double twice_area(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += twice_area(ring[0], ring[i], ring[i + 1]);
  return sum;
}

PlanePoint at_angle(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

Ring circle(int n) {
  Ring ring;
  for (int i = 0; i < n; ++i) ring.push_back(at_angle(1, 2 * std::numbers::pi * i / n));
  return ring;
}

/// Many corners on one line, long teeth opposite.
Ring comb(int n) {
  Ring ring;
  for (int i = 0; i < n / 2; ++i) ring.push_back({double(i), 0});
  for (int i = n / 2; i-- > 0;) ring.push_back({double(i), i % 2 == 1 ? 1.0 : 100.0});
  return ring;
}

Ring spiral(int n) {
  const double step = -4 * std::numbers::pi * std::min(20.0, n / 15.0) / n;
  Ring ring;
  for (int i = 0; i < n / 2; ++i) ring.push_back(at_angle(20.0 + 120.0 * i / n, step * i));
  for (int i = n / 2; i-- > 0;) ring.push_back(at_angle(21.0 + 120.0 * i / n, step * i));
  return ring;
}

Ring star(int n) {
  std::mt19937 random(3);
  Ring ring;
  for (int i = 0; i < n; ++i) ring.push_back(at_angle(0.2 + (random() % 1000) / 1000.0, 2 * std::numbers::pi * i / n));
  return ring;
}

/// A square with rows of square holes; bridges join the holes of a row to each other and to the left side.
Ring holes(int n) {
  const int rows = static_cast<int>(std::sqrt(n / 10.0));
  const double size = 4.0 * rows;
  Ring ring{{0, 0}, {size, 0}, {size, size}, {0, size}};
  for (int row = rows; row-- > 0;) {
    const double y = 4 * row + 2;
    ring.push_back({0, y});
    for (int column = 0; column < rows; ++column)
      ring.insert(ring.end(), {{4.0 * column + 1, y}, {4.0 * column + 2, y + 1}, {4.0 * column + 3, y}});
    for (int column = rows; column-- > 0;)
      ring.insert(ring.end(), {{4.0 * column + 3, y}, {4.0 * column + 2, y - 1}, {4.0 * column + 1, y}});
    ring.push_back({0, y});
  }
  return ring;
}

Ring with_repeated_corners(int n) {
  Ring ring;
  for (const PlanePoint& p : circle(n)) ring.insert(ring.end(), ring.size() % 3 == 0 ? 2 : 1, p);
  return ring;
}

Ring all_but_one_on_a_line(int n) {
  Ring ring;
  for (int i = 0; i < n; ++i) ring.push_back({double(i), 0});
  ring.push_back({n / 2.0, 1});
  return ring;
}

struct Shape {
  std::string name;
  Ring (*make)(int);
};
const Shape kShapes[] = {{"circle", circle},
                         {"comb", comb},
                         {"spiral", spiral},
                         {"star", star},
                         {"holes", holes},
                         {"repeated corners", with_repeated_corners},
                         {"a line", all_but_one_on_a_line}};

TEST_CASE("a long polygon is covered once by triangles of its own orientation", "[mesh_io]") {
  const Shape& shape = GENERATE(from_range(std::begin(kShapes), std::end(kShapes)));
  const int n = GENERATE(10, 300, 20000);
  CAPTURE(shape.name, n);
  const Ring ring = shape.make(n);
  const double area = twice_area(ring);
  REQUIRE(area > 0);
  std::int64_t steps = std::numeric_limits<std::int64_t>::max();
  const std::int64_t before = steps;
  const auto triangles = clip_ears(ring, steps);
  CHECK(triangles.size() == ring.size() - 2);
  CHECK(before - steps < 250 * static_cast<std::int64_t>(ring.size()));
  double sum = 0, least = 0;
  for (const auto& [a, b, c] : triangles) {
    sum += std::abs(twice_area(ring[a], ring[b], ring[c]));
    least = std::min(least, twice_area(ring[a], ring[b], ring[c]));
  }
  CHECK(sum == Approx(area).epsilon(1e-9));
  CHECK(least >= -1e-12 * area);
}

TEST_CASE("a polygon that crosses itself ends in time, and in triangles", "[mesh_io]") {
  std::mt19937 random(5);
  Ring ring;
  for (int i = 0; i < 20000; ++i) ring.push_back({random() / 4e9, random() / 4e9});
  std::int64_t steps = 5'000'000;
  CHECK(clip_ears(ring, steps).size() == ring.size() - 2);
  CHECK(steps > -1'000'000);  // one more search
}

TEST_CASE("a long polygon keeps its orientation whichever way it faces", "[mesh_io]") {
  const Ring ring = star(500);
  for (const int axis : {0, 1, 2})
    for (const bool reversed : {false, true}) {
      CAPTURE(axis, reversed);
      std::vector<geometry::Vector3> polygon;
      for (const auto& [x, y] : ring)
        polygon.push_back(axis == 0   ? geometry::Vector3{0.2 * x, x, y}
                          : axis == 1 ? geometry::Vector3{y, 0.3 * x, x}
                                      : geometry::Vector3{x, y, 0.1 * y});
      if (reversed) std::reverse(polygon.begin(), polygon.end());
      geometry::Vector3 normal;
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i) normal = normal + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
      std::int64_t steps = 1'000'000;
      geometry::Vector3 sum;
      double least = 0;
      for (const auto& [a, b, c] : triangulate(polygon, steps)) {
        const geometry::Vector3 area = cross(polygon[b] - polygon[a], polygon[c] - polygon[a]);
        sum = sum + area;
        least = std::min(least, dot(area, normal));
      }
      CHECK(length(sum - normal) < 1e-9 * length(normal));
      CHECK(least >= -1e-9 * dot(normal, normal));
    }
}

}  // namespace
}  // namespace orbc::mesh_io
