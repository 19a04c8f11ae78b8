#include <catch2/catch.hpp>

#include "tests/unit/trace/support.h"

using namespace orbc;
using namespace orbc::trace;
using namespace orbc::trace::testing;

namespace {

Vertex vertex(const Point& p, double z) { return {p.w, p.x, p.y, z}; }

/// Barycentric weights of the triangle over a floor point by Cramer's rule: an independent way to its height.
bool over(const Vertex v[3], const Point& x, long double& height) {
  const auto det = [](const Vertex& a, const Vertex& b, long double w, long double xx, long double y) {
    return w * ((long double)a.x * b.y - (long double)a.y * b.x) + xx * ((long double)a.y * b.w - (long double)a.w * b.y) +
           y * ((long double)a.w * b.x - (long double)a.x * b.w);
  };
  long double b[3];
  for (int i = 0; i < 3; ++i) b[i] = det(v[(i + 1) % 3], v[(i + 2) % 3], x.w, x.x, x.y);
  const long double all = det(v[0], v[1], v[2].w, v[2].x, v[2].y);
  for (auto& weight : b) weight /= all;
  const long double sum = b[0] + b[1] + b[2];
  height = (b[0] * v[0].z + b[1] * v[1].z + b[2] * v[2].z) / sum;
  return b[0] > 0 && b[1] > 0 && b[2] > 0;
}

/// The first meeting by walking along the ray in small steps and halving where the ray changes its side of the triangle.
double march(Space space, const Ray& ray, const Vertex v[3], double length, int steps) {
  bool was_over = false;
  long double was = 0;
  double at_was = 0;
  for (int i = 0; i <= steps; ++i) {
    double t = length * i / steps;
    long double height;
    const bool is_over = over(v, position_at(space, ray, t).floor, height);
    const long double now = ray.z + ray.m * t - height;
    if (is_over && was_over && (now < 0) != (was < 0)) {
      double lo = at_was, hi = t;
      for (int j = 0; j < 60; ++j) {
        const double middle = 0.5 * (lo + hi);
        over(v, position_at(space, ray, middle).floor, height);
        ((ray.z + ray.m * middle - height < 0) == (was < 0) ? lo : hi) = middle;
      }
      return 0.5 * (lo + hi);
    }
    was_over = is_over;
    was = now;
    at_was = t;
  }
  return kInfinity;
}

}  // namespace

TEST_CASE("a ray meets a triangle where walking along it finds it", "[trace]") {
  Random random;
  for (const auto& placed :
       {furnished(regular_room(Space::spherical, 3, 2)), furnished(regular_room(Space::euclidean, 4, 2)),
        furnished(regular_room(Space::hyperbolic, 5, 2)), furnished(regular_room(Space::hyperbolic, 8, 4)), furnished(hemisphere())}) {
    const Space space = placed.polygon.space;
    const auto mesh = soup_of(placed, 300, 0.7, random);
    int hits = 0;
    for (const auto& t : mesh.triangles) {
      const Vertex v[3] = {vertex(mesh.floor[t[0]], mesh.z[t[0]]), vertex(mesh.floor[t[1]], mesh.z[t[1]]),
                           vertex(mesh.floor[t[2]], mesh.z[t[2]])};
      for (int i = 0; i < 6; ++i) {
        Ray ray = random_ray(placed, random, i < 2 ? 1 : 0.2);
        if (i >= 4) {  // aimed at a point of the triangle
          const double b0 = random.unit(), b1 = (1 - b0) * random.unit(), b2 = 1 - b0 - b1;
          const Point to = geometry::normalised_point(space, b0 * mesh.floor[t[0]] + b1 * mesh.floor[t[1]] + b2 * mesh.floor[t[2]]);
          ray = segment_between(space, {ray.at, ray.z}, {to, b0 * v[0].z + b1 * v[1].z + b2 * v[2].z}).ray;
        }
        const double length = space == Space::spherical ? 0.999 * kPi : 6;
        const TriangleHit hit = intersect(plane_of(space, ray), v[0], v[1], v[2], length);
        const double walked = march(space, ray, v, length, 1500);
        if (walked < kInfinity) {
          ++hits;
          REQUIRE(hit.found);
          CHECK(hit.t <= walked + 1e-9);
        }
        if (!hit.found) continue;
        // The point of the triangle and the point of the ray are the same.
        const Ambient sum = hit.b[0] * mesh.floor[t[0]] + hit.b[1] * mesh.floor[t[1]] + hit.b[2] * mesh.floor[t[2]];
        const auto at = position_at(space, ray, hit.t);
        CHECK(geometry::distance(space, geometry::normalised_point(space, sum), at.floor) <
              1e-12 * (1 + hit.t) * (space == Space::hyperbolic ? 50 : 1));
        CHECK(std::fabs(hit.b[0] * v[0].z + hit.b[1] * v[1].z + hit.b[2] * v[2].z - at.z) < 1e-12 * (1 + hit.t));
        CHECK(std::fabs(hit.b[0] + hit.b[1] + hit.b[2] - 1) < 1e-12);
        for (double b : hit.b) CHECK(b > -1e-12);
        if (std::min({hit.b[0], hit.b[1], hit.b[2]}) > 0.05 && walked < kInfinity) CHECK(std::fabs(walked - hit.t) < 1e-9);
      }
    }
    CHECK(hits > 300);
  }
}

TEST_CASE("a curved ray may meet one triangle three times, and the first counts", "[trace]") {
  // κ = ±1: over a long chord of a triangle that the ray follows, the ray's height and the triangle's differ by a bent function.
  for (const Space space : {Space::spherical, Space::hyperbolic}) {
    const Vertex v[3] = {vertex(at_polar(space, 1.2, kPi), 0), vertex(at_polar(space, 1.2, 0.1), 1), vertex(at_polar(space, 1.2, -0.1), 1)};
    // The triangle's height over the x-axis at three places; a line through two points of that curve meets it there and in between.
    const auto height_at = [&](double s) {
      long double h;
      over(v, at_polar(space, std::fabs(s), s < 0 ? kPi : 0), h);
      return static_cast<double>(h);
    };
    const double a = -0.7, b = 0.6, slope = (height_at(b) - height_at(a)) / (b - a);
    Ray ray;
    ray.at = at_polar(space, 1.1, kPi);
    ray.along = geometry::direction_to(space, ray.at, Point());
    ray.z = height_at(a) + slope * (-1.1 - a);
    ray.c = 1 / std::hypot(1, slope);
    ray.m = slope * ray.c;
    TriangleHit hit = intersect(plane_of(space, ray), v[0], v[1], v[2], 3);
    REQUIRE(hit.found);
    CHECK(hit.t * ray.c == Approx(1.1 + a));
    ray.t_min = hit.t + 1e-6;
    hit = intersect(plane_of(space, ray), v[0], v[1], v[2], 3);
    REQUIRE(hit.found);  // in between: the curve is nearly odd
    ray.t_min = hit.t + 1e-6;
    hit = intersect(plane_of(space, ray), v[0], v[1], v[2], 3);
    REQUIRE(hit.found);
    CHECK(hit.t * ray.c == Approx(1.1 + b));
    ray.t_min = hit.t + 1e-6;
    CHECK_FALSE(intersect(plane_of(space, ray), v[0], v[1], v[2], 3).found);
  }
}

TEST_CASE("on S² a ray meets a triangle at its antipode, and after many turns", "[trace]") {
  const Point start = at_polar(Space::spherical, 0.3, 1);
  const Point far{-start.w, -start.x, -start.y};
  const auto move = geometry::translation_to(Space::spherical, start);
  for (int turns = 0; turns < 5; ++turns)
    for (int i = 0; i < 16; ++i) {
      const double m = 0.05, c = std::sqrt(1 - m * m), s = kPi + 2 * kPi * turns;
      const double height = m / c * s;
      Vertex v[3];
      for (int j = 0; j < 3; ++j) {
        const Point p = move * at_polar(Space::spherical, 0.2, 0.3 + 2 * kPi * j / 3);
        v[j] = vertex({-p.w, -p.x, -p.y}, height);
      }
      const Ray ray = ray_from(Space::spherical, {start, 0}, {c * (move * Tangent(0, std::cos(0.4 * i), std::sin(0.4 * i))), m});
      const TriangleHit hit = intersect(plane_of(Space::spherical, ray), v[0], v[1], v[2], 1000);
      REQUIRE(hit.found);
      CHECK(hit.t * c == Approx(s));
      CHECK(geometry::distance(Space::spherical, position_at(Space::spherical, ray, hit.t).floor, far) < 1e-12);
      CHECK_FALSE(intersect(plane_of(Space::spherical, ray), v[0], v[1], v[2], hit.t - 1e-6).found);
    }
}

TEST_CASE("vertical rays, vertical triangles and rays that start on a triangle", "[trace]") {
  for (const Space space : {Space::spherical, Space::euclidean, Space::hyperbolic}) {
    const Vertex flat[3] = {vertex(at_polar(space, 0.5, 0), 0.5), vertex(at_polar(space, 0.5, 2), 0.6),
                            vertex(at_polar(space, 0.5, 4), 0.7)};
    const Ray up = ray_from(space, {at_polar(space, 0.1, 1), 0.1}, {{0, 0, 0}, 1});
    const TriangleHit above = intersect(plane_of(space, up), flat[0], flat[1], flat[2]);
    REQUIRE(above.found);
    long double height;
    over(flat, up.at, height);
    CHECK(above.t == Approx(static_cast<double>(height) - 0.1));
    const Ray down = ray_from(space, {at_polar(space, 0.1, 1), 0.9}, {{0, 0, 0}, -1});
    CHECK(intersect(plane_of(space, down), flat[0], flat[1], flat[2]).t == Approx(0.9 - static_cast<double>(height)));
    CHECK_FALSE(
        intersect(plane_of(space, ray_from(space, {at_polar(space, 0.1, 1), 0.9}, {{0, 0, 0}, 1})), flat[0], flat[1], flat[2]).found);

    const Vertex wall[3] = {vertex(at_polar(space, 0.4, 0.5), 0.2), vertex(at_polar(space, 0.4, -0.5), 0.2),
                            vertex(at_polar(space, 0.4, -0.5), 0.8)};
    const Ray level = ray_from(space, {{}, 0.4}, {{0, 1, -0.2}, 0});
    CHECK(intersect(plane_of(space, level), wall[0], wall[1], wall[2]).found);
    const Ray over_it = ray_from(space, {{}, 0.81}, {{0, 1, -0.2}, 0});
    CHECK_FALSE(intersect(plane_of(space, over_it), wall[0], wall[1], wall[2]).found);
    // In the plane of the vertical triangle: it is seen edge on.
    const Point from = at_polar(space, 0.4, 0.5), to = at_polar(space, 0.4, -0.5);
    const Ray inside = ray_from(space, {from, 0.3}, {geometry::direction_to(space, from, to), 0});
    (void)intersect(plane_of(space, inside), wall[0], wall[1], wall[2]);

    Ray again = ray_from(space, position_at(space, up, above.t), {{0, 0, 0}, 1});
    again.t_min = kRayEpsilon;
    CHECK_FALSE(intersect(plane_of(space, again), flat[0], flat[1], flat[2]).found);
  }
}
