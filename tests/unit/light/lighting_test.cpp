#include "compiler/light/lighting.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "compiler/geometry/chart.h"
#include "compiler/light/falloff.h"
#include "compiler/notation/parse.h"
#include "compiler/place/locate.h"
#include "compiler/room/realise.h"
#include "compiler/room/room.h"
#include "compiler/scene/defaults.h"
#include "compiler/surface/tangent_frame.h"
#include "compiler/trace/analytic.h"
#include "tests/support/lit_room.h"

using namespace orbc;
using geometry::Position;
using geometry::Space;
using test::light_room;
using test::lit_scene;
using test::LitRoom;

namespace {

constexpr double kHalfTurn = std::numbers::pi;

double on_floor(const LitRoom& l, const geometry::Point& p, double z, double up) {
  return light::irradiance(l.lighting, {{p, z}, {{0, 0, 0}, up}, {p, z}, -1, false}).r;
}

// Power that arrives on floor, ceiling and walls together: midpoint sums over polar coordinates and over (arc, height).
double flux(const LitRoom& l) {
  const room::Room& room = l.interior.polygon;
  const double height = l.interior.height;
  double sum = 0;
  constexpr int kTurn = 120, kOut = 60, kAlong = 60;
  for (int i = 0; i < kTurn; ++i) {
    const double phi = 2 * kHalfTurn * (i + 0.5) / kTurn, reach = place::distance_to_boundary(room, phi);
    for (int j = 0; j < kOut; ++j) {
      const double r = reach * (j + 0.5) / kOut, area = geometry::sin_k(room.space, r) * reach / kOut * 2 * kHalfTurn / kTurn;
      const geometry::Point p = geometry::point_along(room.space, {}, geometry::Tangent(0, std::cos(phi), std::sin(phi)), r);
      sum += area * (on_floor(l, p, 0, 1) + on_floor(l, p, height, -1));
    }
  }
  for (int w = 0; w < static_cast<int>(room.walls.size()); ++w)
    for (int i = 0; i < kAlong; ++i)
      for (int j = 0; j < kAlong; ++j) {
        const Position at{room::point_on_wall(room, w, room.walls[w].length * (i + 0.5) / kAlong), height * (j + 0.5) / kAlong};
        sum += room.walls[w].length / kAlong * height / kAlong *
               light::irradiance(l.lighting, {at, trace::normal_of_wall(room.space, room.walls[w]), at, w, false}).r;
      }
  return sum;
}

}  // namespace

TEST_CASE("the falloff of E² is the inverse square, and all spaces agree with it near the lamp", "[light]") {
  CHECK(light::geodesic_falloff(Space::euclidean, 2, 1.3, 0.01) == Approx(1 / (16 * kHalfTurn)));
  for (const Space space : {Space::hyperbolic, Space::spherical})
    CHECK(light::geodesic_falloff(space, 0.02, 0.015, 0.001) == Approx(1 / (4 * kHalfTurn * 0.0004)).epsilon(1e-4));
  CHECK(light::geodesic_falloff(Space::euclidean, 1e-9, 0, 0.05) == Approx(1 / (4 * kHalfTurn * 0.0025)));
}

TEST_CASE("the focus at the antipode is as bright as a lamp of that radius allows, and no more", "[light]") {
  const double at = light::geodesic_falloff(Space::spherical, kHalfTurn, kHalfTurn, 0.05),
               beside = light::geodesic_falloff(Space::spherical, kHalfTurn - 0.05, kHalfTurn - 0.05, 0.05);
  CHECK(std::isfinite(at));
  CHECK(at == Approx(1 / (4 * kHalfTurn * kHalfTurn * std::sin(0.05))).epsilon(0.01));
  CHECK(at == Approx(beside).epsilon(0.05));
}

TEST_CASE("the falloff counts the geodesics that reach a small patch", "[light]") {
  for (const Space space : {Space::hyperbolic, Space::euclidean, Space::spherical}) {
    // Geodesics of all directions alike from height 0.5 over the origin; the patch: floor between the arcs 0.9 and 1.0.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    constexpr int kCount = 2'000'000;
    int arrived = 0;
    for (int i = 0; i < kCount; ++i) {
      const double m = 2 * uniform(random) - 1;
      if (m >= 0) continue;
      const double t = 0.5 / -m, s = t * std::sqrt(1 - m * m);
      arrived += s > 0.9 && s < 1.0;
    }
    double expected = 0;
    for (int i = 0; i < 100; ++i) {
      const double s = 0.9 + (i + 0.5) * 0.001, l = std::hypot(s, 0.5);
      expected += light::geodesic_falloff(space, l, s, 0.01) * (0.5 / l) * 2 * kHalfTurn * geometry::sin_k(space, s) * 0.001;
    }
    CHECK(static_cast<double>(arrived) / kCount == Approx(expected).epsilon(0.01));
  }
}

TEST_CASE("all the power of a lamp arrives in a closed room, in all three spaces and for every kind", "[light]") {
  for (const char* orbifold : {"*222", "*2222", "*22222"})
    for (const scene::LampKind kind : {scene::LampKind::point, scene::LampKind::spot, scene::LampKind::disk, scene::LampKind::sphere}) {
      if (kind != scene::LampKind::point && std::string(orbifold) == "*222") continue;
      const LitRoom l = light_room(lit_scene(orbifold, kind, false), 0);
      INFO(orbifold << ", kind " << static_cast<int>(kind));
      CHECK(flux(l) == Approx(10).epsilon(0.012));
    }
}

TEST_CASE("light over a mirror is the light of an image behind it, times the reflectance", "[light]") {
  scene::Scene scene = lit_scene("*2222", scene::LampKind::point, true);
  const LitRoom straight = light_room(scene, 0), once = light_room(scene, 1);
  const geometry::Point p = geometry::point_from_log(Space::euclidean, {0.05, -0.1});
  double expected = on_floor(straight, p, 0, 1);
  const Position lamp = straight.lighting.lamps->lamps[0].centre;
  for (int w = 0; w < 4; ++w) {
    const geometry::Point image = room::reflection_in_wall(straight.interior.polygon, w) * lamp.floor;
    const double l = std::hypot(geometry::distance(Space::euclidean, image, p), lamp.z);
    expected += 0.9 * 10 / (4 * kHalfTurn * l * l) * lamp.z / l;
  }
  CHECK(on_floor(once, p, 0, 1) == Approx(expected).epsilon(1e-9));
}

TEST_CASE("on a half sphere light comes back from the mirror, past the antipode", "[light]") {
  scene::Scene scene = lit_scene("*", scene::LampKind::point, true);
  const LitRoom l = light_room(scene, 2);
  REQUIRE(l.lighting.lamps->images.size() == 5);  // straight, and around both ways; by the mirror, near and far
  const geometry::Point p = geometry::point_from_log(Space::spherical, {-0.4, 0.3});
  const Position lamp = l.lighting.lamps->lamps[0].centre;
  double expected = 0;
  const double d = geometry::distance(Space::spherical, p, lamp.floor);
  const double e = geometry::distance(Space::spherical, p, room::reflection_in_wall(l.interior.polygon, 0) * lamp.floor);
  const std::pair<double, double> ways[] = {
      {d, 1}, {2 * kHalfTurn - d, 0.81}, {2 * kHalfTurn + d, 0.81}, {e, 0.9}, {2 * kHalfTurn - e, 0.9}};
  for (const auto& [arc, weight] : ways) {
    const double length = std::hypot(arc, lamp.z);
    expected += weight * 10 * light::geodesic_falloff(Space::spherical, length, arc, 0.02) * lamp.z / length;
  }
  CHECK(on_floor(l, p, 0, 1) == Approx(expected).epsilon(1e-6));
}

TEST_CASE("rooms that are no orbifolds get each image only through its own mirrors", "[light]") {
  scene::Scene scene = scene::default_scene(notation::parse("*2222").value());
  const LitRoom by_group = light_room(lit_scene("*2222", scene::LampKind::point, true), 2);
  std::vector<light::LampImage> images = by_group.lighting.lamps->images;
  CHECK(images.size() == 13);
  // The same room, asked word by word, gives the same light.
  LitRoom by_words = light_room(lit_scene("*2222", scene::LampKind::point, true), 2);
  place::Interior other = by_words.interior;
  other.polygon.orbifold.corners[0] = Rational(5, 2);  // only what decides how images are listed
  light::LampSet set = *by_words.lighting.lamps;
  set.images = light::lamp_images(set.lamps, other).value().images;
  by_words.lighting.lamps = std::make_shared<const light::LampSet>(std::move(set));
  by_words.lighting.cull_grid = light::make_light_cull_grid(by_words.lighting, serial_executor());
  CHECK(by_words.lighting.lamps->images.size() == 1 + 4 + 12);
  for (const double x : {0.03, 0.21, -0.17}) {
    const geometry::Point p = geometry::point_from_log(Space::euclidean, {x, 0.111});
    CHECK(on_floor(by_words, p, 0, 1) == Approx(on_floor(by_group, p, 0, 1)).epsilon(1e-9));
  }
}

TEST_CASE("a lamp that reaches through a wall is refused; one without power is warned of", "[light]") {
  scene::Scene scene = lit_scene("*2222", scene::LampKind::sphere, true);
  scene.lamps[0].place.z = scene.room.height;
  const auto room = room::realise(scene.orbifold, scene.room.shape).value();
  const auto refused = light::place_lamps(scene, room);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().front().code == "light.lamp-in-wall");
  scene.lamps[0].place.z = 0.5;
  scene.lamps[0].power = 0;
  CHECK(light::place_lamps(scene, room)->warnings.front().code == "light.no-power");
}

TEST_CASE("the mean over the strata of a pixel is the light of a single full sample", "[light]") {
  for (const char* orbifold : {"*222", "*333", "*22222"})
    for (const scene::LampKind kind : {scene::LampKind::point, scene::LampKind::sphere, scene::LampKind::rectangle}) {
      scene::Scene scene = lit_scene(orbifold, kind, true);
      scene.lamps.front().power = 3;
      const LitRoom l = light_room(scene, 3);
      REQUIRE(l.lighting.lamps->images.size() > 5);
      for (const int samples : {2, 4, 9, 16, 64}) {
        double most = 0, spread = 0;
        for (int k = 0; k < 20; ++k) {
          const geometry::Point p =
              geometry::point_along(l.interior.polygon.space, {}, geometry::Tangent(0, std::cos(0.3 * k), std::sin(0.3 * k)), 0.02 * k);
          const surface::ShadingPoint point{{p, 0}, {{0, 0, 0}, 1}, {p, 0}, -1, false};
          const double whole = light::irradiance(l.lighting, point).r / kHalfTurn;
          double sum = 0;
          for (int s = 0; s < samples; ++s) {
            const double one = light::irradiance(l.lighting, point, light::SampleStratum{s, samples}).r / kHalfTurn;
            sum += one, spread = std::max(spread, std::fabs(one - whole));
          }
          most = std::max(most, std::fabs(sum / samples - whole));
        }
        INFO(orbifold << ", " << samples << " samples");
        CHECK(most < l.lighting.options.max_step);
        CHECK(spread < 0.25);  // each may be off by its steps, since only the mean is seen
        if (samples == 64) CHECK(spread > 0);
      }
    }
}

TEST_CASE("a white surface under E = π shows as white", "[light]") {
  light::LightingContext lighting;
  const scene::Color shown = light::outgoing_radiance(lighting, {}, {1, 1, 1}, {kHalfTurn, kHalfTurn / 2, 0});
  CHECK(shown.r == Approx(1));
  CHECK(shown.g == Approx(0.5));
}
