// Holes by the alpha of a texture: a ray goes through them, whoever asks.
#include <catch2/catch.hpp>

#include "compiler/image/image.h"
#include "compiler/place/alpha_mask.h"
#include "tests/unit/trace/support.h"

using namespace orbc;
using namespace orbc::trace;
using namespace orbc::trace::testing;

namespace {

/// A soup of triangles, half of whose texels are holes.
place::Interior holed(room::Room room, double size, Random& random) {
  place::Interior placed = furnished(std::move(room));
  placed.parts.push_back(soup_of(placed, 60, size, random));
  place::PlacedMesh& part = placed.parts[0];
  for (std::size_t i = 0; i < part.floor.size(); ++i)
    part.uv.push_back({static_cast<float>(random.unit()), static_cast<float>(random.unit())});
  image::Image image{8, 8, {}};
  for (int i = 0; i < 64; ++i) image.rgba.insert(image.rgba.end(), {9, 9, 9, static_cast<std::uint8_t>(random.bits() & 255)});
  placed.textures.push_back(image);
  placed.styles.push_back({{1, 1, 1}, 0, {}, 0.5});
  return placed;
}

/// Tries every triangle, and every point of it that is no hole.
Hit try_all_points(const place::Interior& placed, const Ray& ray, double most) {
  const place::PlacedMesh& part = placed.parts[0];
  Hit best;
  best.t = most;
  const auto vertex = [&](std::uint32_t i) { return Vertex{part.floor[i].w, part.floor[i].x, part.floor[i].y, part.z[i]}; };
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    RayPlane plane = plane_of(placed.polygon.space, ray);
    const auto& c = part.triangles[t];
    for (;;) {
      const TriangleHit hit = intersect(plane, vertex(c[0]), vertex(c[1]), vertex(c[2]), best.t);
      if (!hit.found) break;
      if (!place::is_masked_at(placed, part, t, {hit.b[0], hit.b[1], hit.b[2]})) {
        best = {HitKind::triangle, hit.t, 0, static_cast<int>(t), {hit.b[0], hit.b[1], hit.b[2]}, -1};
        break;
      }
      plane.t_min = hit.t;
    }
  }
  return best;
}

bool same(const Hit& a, const Hit& b) {
  return a.kind == b.kind && a.t == b.t && a.part == b.part && a.triangle == b.triangle && a.b[0] == b.b[0] && a.b[1] == b.b[1] &&
         a.b[2] == b.b[2] && a.wall == b.wall;
}

}  // namespace

TEST_CASE("rays go through holes, and meet what trying every triangle behind them finds", "[trace]") {
  Random random;
  for (const auto& [room, size] : {std::pair{regular_room(Space::spherical, 3, 2), 0.5},
                                   {regular_room(Space::euclidean, 4, 2), 0.6},
                                   {regular_room(Space::hyperbolic, 5, 2), 0.7}}) {
    const place::Interior placed = holed(room, size, random);
    const TraceScene scene = prepare(placed);
    REQUIRE(scene.masked);
    std::vector<Ray> rays;
    for (int i = 0; i < 2000; ++i) rays.push_back(random_ray(placed, random));
    const std::vector<Hit> together = closest(scene, rays);
    int through = 0, met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit hit = closest(scene, rays[i]), triangle = closest_triangle(scene, rays[i]);
      REQUIRE(same(hit, together[i]));
      const Hit wanted = try_all_points(placed, rays[i], hit.kind == HitKind::triangle ? kInfinity : hit.t);
      REQUIRE((hit.kind == HitKind::triangle) == (wanted.kind == HitKind::triangle));
      // The tree refines in its own way
      if (wanted.kind == HitKind::triangle) REQUIRE((hit.triangle == wanted.triangle && std::fabs(hit.t - wanted.t) < 1e-12));
      REQUIRE(same(triangle, hit.kind == HitKind::triangle ? hit : triangle));
      const double reach = random.between(0.1, 1.5);
      CHECK(occluded(scene, rays[i], reach) == (triangle.kind == HitKind::triangle && triangle.t < reach));
      TraceScene whole = scene;
      whole.masked = false;
      const Hit first = closest(whole, rays[i]);
      met += first.kind == HitKind::triangle;
      through += !same(first, hit);
    }
    CHECK(through > met / 4);
    CHECK(through < 3 * met / 4);
  }
}

TEST_CASE("a room without holes is none of that", "[trace]") {
  Random random;
  place::Interior placed = holed(regular_room(Space::euclidean, 4, 2), 0.5, random);
  placed.styles[0].alpha_cutoff = -1;
  CHECK_FALSE(prepare(placed).masked);
  placed.styles[0].alpha_cutoff = 0.5;
  placed.styles[0].texture = -1;
  CHECK_FALSE(prepare(placed).masked);
}
