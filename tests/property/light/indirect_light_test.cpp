// Laws of indirect light.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "compiler/light/connection.h"
#include "compiler/light/guide.h"
#include "compiler/place/locate.h"
#include "compiler/room/room.h"
#include "compiler/surface/sampling.h"
#include "compiler/trace/analytic.h"
#include "tests/support/lit_room.h"

using namespace orbc;
using geometry::Space;
using test::LitRoom;

namespace {

constexpr double kPi = std::numbers::pi;

LitRoom lit(const char* notation, double height, bool mirrors, scene::LampKind kind = scene::LampKind::point) {
  scene::Scene scene = test::lit_scene(notation, kind, mirrors);
  scene.room.height = height;
  scene.lamps.front().place.z = 0.6 * height;
  return test::light_room(scene, 0, 4);
}

}  // namespace

TEST_CASE("guided directions weigh the hemisphere as the cosine does", "[light]") {
  for (const char* notation : {"*222", "*2222", "*22222"})
    for (const bool mirrors : {false, true}) {
      const LitRoom l = lit(notation, 0.8, mirrors);
      surface::Random random(11);
      for (int place = 0; place < 6; ++place) {
        const double phi = 2 * kPi * random.next(), r = place::distance_to_boundary(l.interior.polygon, phi) * random.next();
        const geometry::Point at =
            geometry::point_along(l.interior.polygon.space, {}, geometry::Tangent(0, std::cos(phi), std::sin(phi)), r);
        const surface::ShadingPoint point{{at, 0}, {{0, 0, 0}, 1}, {at, 0}, -1, false};
        const light::Guide guide = light::guide_at(l.lighting, point);
        double ones = 0, heights = 0, squares = 0;
        constexpr int kCount = 40000;
        for (int i = 0; i < kCount; ++i) {
          const light::DirectionSample c = light::sample_direction(guide, random.next_three());
          ones += c.weight, heights += c.weight * c.direction.z, squares += c.weight * c.weight;
        }
        const double error = std::sqrt(squares / kCount / kCount);
        CHECK(std::fabs(ones / kCount - 1) < 4 * error);           // ∫ cosθ dω/π
        CHECK(std::fabs(heights / kCount - 2.0 / 3) < 4 * error);  // ∫ cos²θ dω/π
      }
    }
}

TEST_CASE("a lamp seen from where it shines: both ways of counting its light agree", "[light]") {
  // Power per area by the falloff, times area, against the share of directions that lead there: in all three spaces, from the lamp's side.
  for (const char* notation : {"*222", "*2222", "*22222"}) {
    const LitRoom l = lit(notation, 0.8, false);
    const geometry::Position lamp = l.lighting.lamps->lamps[0].centre;
    const Space space = l.interior.polygon.space;
    surface::Random random(5);
    constexpr int kCount = 400000;
    double by_directions = 0;
    for (int i = 0; i < kCount; ++i) {
      const double z = 2 * random.next() - 1, turn = 2 * kPi * random.next(), h = std::sqrt(1 - z * z);
      const surface::TangentFrame frame = surface::tangent_frame(space, lamp.floor);
      const trace::Ray ray = trace::ray_from(space, lamp, surface::to_ambient(frame, {h * std::cos(turn), h * std::sin(turn), z}));
      const trace::Hit hit = trace::closest(l.lighting.scene, ray);
      const geometry::Position at = trace::position_at(space, ray, hit.t);
      by_directions += hit.kind == trace::HitKind::floor && geometry::distance(space, at.floor, {}) < 0.25;
    }
    by_directions *= 10.0 / kCount;
    double by_falloff = 0;
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const double r = 0.25 * (i + 0.5) / kSteps, phi = 2 * kPi * (j + 0.5) / kSteps;
        const geometry::Point at = geometry::point_along(space, {}, geometry::Tangent(0, std::cos(phi), std::sin(phi)), r);
        by_falloff += light::irradiance(l.lighting, {{at, 0}, {{0, 0, 0}, 1}, {at, 0}, -1, false}).r * geometry::sin_k(space, r) * 0.25 /
                      kSteps * 2 * kPi / kSteps;
      }
    INFO(notation << ": " << by_directions << ", " << by_falloff);
    CHECK(by_directions == Approx(by_falloff).epsilon(0.012));
  }
}

TEST_CASE("the light of a lamp, asked at random places of a closed room, is its power, in all three spaces and for every kind",
          "[light][long]") {
  for (const char* notation : {"*222", "*2222", "*22222"})
    for (const scene::LampKind kind :
         {scene::LampKind::point, scene::LampKind::sphere, scene::LampKind::disk, scene::LampKind::rectangle, scene::LampKind::spot}) {
      const LitRoom l = lit(notation, 1, false, kind);
      const room::Room& room = l.interior.polygon;
      surface::Random random(17);
      double sum = 0, squares = 0;
      const auto add = [&](const surface::ShadingPoint& point, double area) {
        const double flux = area * light::irradiance(l.lighting, point).r;
        sum += flux, squares += flux * flux;
      };
      const int kCount = kind == scene::LampKind::spot ? 240000 : 40000;  // little of the room is lit by a spot
      for (int i = 0; i < kCount; ++i) {
        const double phi = 2 * kPi * random.next(), reach = place::distance_to_boundary(room, phi), r = reach * random.next();
        const geometry::Point at = geometry::point_along(room.space, {}, geometry::Tangent(0, std::cos(phi), std::sin(phi)), r);
        const double area = geometry::sin_k(room.space, r) * reach * 2 * kPi / kCount;
        for (const double up : {1.0, -1.0}) {
          const double z = up > 0 ? 0 : l.interior.height;
          add({{at, z}, {{0, 0, 0}, up}, {at, z}, -1, false}, area);
        }
        for (int w = 0; w < static_cast<int>(room.walls.size()); ++w) {
          const room::Wall& wall = room.walls[static_cast<std::size_t>(w)];
          const geometry::Position on{room::point_on_wall(room, w, wall.length * random.next()), l.interior.height * random.next()};
          add({on, trace::normal_of_wall(room.space, wall), on, w, false}, wall.length * l.interior.height / kCount);
        }
      }
      const double error = std::sqrt(squares);
      INFO(notation << ", kind " << static_cast<int>(kind) << ": " << sum << " ± " << error);
      CHECK(error < 0.06);
      CHECK(std::fabs(sum - 10) < 0.1);
    }
}

TEST_CASE("light goes both ways alike: what a passes on to b, b passes on to a", "[light]") {
  // Two patches, each a third of the floor and of the ceiling: the share of the light that leaves one and meets the other, times its area.
  for (const char* notation : {"*222", "*2222", "*22222"})
    for (const bool mirrors : {false, true}) {
      const LitRoom l = lit(notation, 0.5, mirrors);
      const Space space = l.interior.polygon.space;
      surface::Random random(8);
      const auto in_floor_patch = [&](const geometry::Point& p) { return geometry::distance(space, p, {}) < 0.3; };
      const auto in_ceiling_patch = [&](const geometry::Point& p) { return p.x / p.w > 0.05; };
      double there = 0, back = 0, squares = 0;
      constexpr int kCount = 120000;
      for (const bool from_floor : {true, false}) {
        for (int i = 0; i < kCount; ++i) {
          const double phi = 2 * kPi * random.next(), reach = place::distance_to_boundary(l.interior.polygon, phi),
                       r = reach * random.next();
          const geometry::Point at = geometry::point_along(space, {}, geometry::Tangent(0, std::cos(phi), std::sin(phi)), r);
          if (!(from_floor ? in_floor_patch(at) : in_ceiling_patch(at))) continue;
          const double area = geometry::sin_k(space, r) * reach * 2 * kPi / kCount, up = from_floor ? 1 : -1;
          const double z = from_floor ? 0 : l.interior.height;
          const surface::ShadingPoint point{{at, z}, {{0, 0, 0}, up}, {at, z}, -1, false};
          const light::DirectionSample chosen = light::sample_direction(light::guide_at(l.lighting, point), random.next_three());
          if (chosen.weight <= 0) continue;
          trace::FollowOptions follow;
          follow.max_bounces = 40;
          const trace::Path path = trace::follow(l.lighting.scene, light::spawn_ray(l.lighting, point, chosen.direction), follow);
          if (path.hit.kind != (from_floor ? trace::HitKind::ceiling : trace::HitKind::floor)) continue;
          const geometry::Point end = trace::position_at(space, path.last_ray, path.hit.t).floor;
          if (!(from_floor ? in_ceiling_patch(end) : in_floor_patch(end))) continue;
          const double share = area * chosen.weight * path.throughput.r;
          (from_floor ? there : back) += share;
          squares += share * share;
        }
      }
      INFO(notation << (mirrors ? " with mirrors" : "") << ": " << there << ", " << back << " ± " << std::sqrt(squares));
      CHECK(there > 0.01);
      CHECK(std::fabs(there - back) < 4 * std::sqrt(squares));
    }
}
