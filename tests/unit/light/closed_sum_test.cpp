// The light of a room of mirrors against the closed sum over the images of its lamp, Φ·cosθ / (4πL²·sinκ(ρ)/ρ)·(albedo/π)·Πr, with the
// images enumerated here: products of reflections, shortest first, each element of the group once.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "compiler/image/srgb.h"
#include "compiler/light/lighting.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/place/locate.h"
#include "compiler/room/realise.h"
#include "compiler/room/room.h"
#include "compiler/scene/defaults.h"
#include "compiler/surface/tangent_frame.h"
#include "compiler/trace/follow.h"
#include "compiler/trace/ray.h"

using namespace orbc;
using geometry::Isometry;
using geometry::Position;
using geometry::Space;

namespace {

struct MirrorRoom {
  const char* orbifold = "*2222";
  double reflectance = 0.9, power = 10;
  int mirrors = 4;
};

struct Lit {
  scene::Scene scene;
  place::Interior interior;
  light::LightingContext lighting;
};

/// Walls that are mirrors all over, and a point lamp off the middle. In: whether a ball hangs in the room.
Lit make(const MirrorRoom& of, bool ball = false) {
  Lit lit;
  lit.scene = scene::default_scene(notation::parse(of.orbifold).value());
  for (scene::Wall& wall : lit.scene.room.walls) {
    wall.mirrors.assign(1, {});
    wall.mirrors[0].reflectance = of.reflectance;
  }
  lit.scene.room.floor.mirror.reset(), lit.scene.room.ceiling.mirror.reset();
  lit.scene.objects.clear();
  if (ball) {
    scene::Object object;
    object.name = "ball";
    object.shape = scene::SphereSpec{0.1};
    object.place.floor = scene::AtPolar{0.15, Angle::from_degrees(200)};
    object.place.z = 0.15 * lit.scene.room.height;
    lit.scene.objects.push_back(object);
  }
  scene::Lamp lamp;
  lamp.kind = scene::LampKind::point;
  lamp.place.floor = scene::AtPolar{0.1, Angle::from_degrees(-10)};
  lamp.place.z = 0.55 * lit.scene.room.height;
  lamp.power = of.power;
  lit.scene.lamps = {lamp};
  lit.scene.bake.mirror_bounces = of.mirrors;
  const room::Room room = room::realise(lit.scene.orbifold, lit.scene.room.shape).value();
  lit.interior = place::furnish(lit.scene, room).value().interior;
  lit.lighting = light::prepare_light(lit.scene, lit.interior, light::light_options(lit.scene)).value();
  return lit;
}

/// An element of the group of mirrors and the length of its shortest word.
struct Image {
  Position at;
  int length = 0;
};

/// The images of a point over all words of at most `most` letters.
std::vector<Image> images_by_words(const room::Room& room, const Position& lamp, int most) {
  std::vector<Isometry> reflections;
  for (int w = 0; w < static_cast<int>(room.walls.size()); ++w) reflections.push_back(room::reflection_in_wall(room, w));
  std::map<std::array<long long, 3>, bool> known;
  const auto is_new = [&](const geometry::Point& p) {
    const auto round = [](double v) { return std::llround(v * 1e6 / (1 + std::fabs(v) * 1e-3)); };
    return known.emplace(std::array{round(p.w), round(p.x), round(p.y)}, true).second;
  };
  std::vector<Image> images;
  std::vector<Isometry> shell{geometry::identity(room.space)};
  is_new(lamp.floor);
  for (int length = 0; length <= most && !shell.empty(); ++length) {
    std::vector<Isometry> next;
    for (const Isometry& g : shell) {
      images.push_back({{g * lamp.floor, lamp.z}, length});
      for (const Isometry& r : reflections)
        if (is_new((g * r) * lamp.floor)) next.push_back(g * r);
    }
    shell = std::move(next);
  }
  return images;
}

/// A point with its normal, and how far rays start from it.
struct Spot {
  Position at;
  trace::Direction normal;
  int wall = -1;
};

/// The closed sum at a spot: irradiance. In: whether objects cast shadows, by rays that the tracer follows.
double closed_sum(const Lit& lit, const MirrorRoom& of, const Spot& spot, bool shadows = false) {
  const room::Room& room = lit.interior.polygon;
  const Space space = room.space;
  const Position lamp = lit.lighting.lamps->lamps[0].centre;
  const bool sphere = space == Space::spherical;
  const std::vector<Image> images = images_by_words(room, lamp, sphere ? 1000 : of.mirrors);
  int half_turn = 0;  // mirrors crossed by half a great circle: the length of the longest element
  for (const Image& image : images) half_turn = std::max(half_turn, image.length);
  double sum = 0;
  for (const Image& image : images)
    for (int sheet = 0; sheet == 0 || (sphere && sheet * half_turn <= of.mirrors); ++sheet) {
      const int length = sheet % 2 == 0 ? sheet * half_turn + image.length : (sheet + 1) * half_turn - image.length;
      if (length > of.mirrors) continue;
      const double shortest = geometry::distance(space, spot.at.floor, image.at.floor), turn = std::numbers::pi;
      const double arc = sheet % 2 == 0 ? shortest + sheet * turn : (sheet + 1) * turn - shortest;
      const double dz = image.at.z - spot.at.z, l = std::hypot(arc, dz);
      const double sign = sheet % 2 == 0 ? 1 : -1;
      const geometry::Tangent t = geometry::direction_to(space, spot.at.floor, image.at.floor);
      const trace::Direction towards{(sign * arc / l) * geometry::Ambient(t), dz / l};
      const double cosine = trace::inner(space, towards, spot.normal);
      if (cosine <= 0) continue;
      if (shadows) {
        trace::Ray ray = trace::ray_from(space, spot.at, towards);
        ray.start_wall = spot.wall;
        ray.t_min = 1e-6;
        trace::FollowOptions follow;
        follow.max_bounces = of.mirrors;
        follow.max_length = l * (1 - 1e-9);
        const trace::Path path = trace::follow(lit.lighting.scene, ray, follow);
        if (path.cut_off || path.hit.kind != trace::HitKind::none) continue;
      }
      const double spread = arc > 1e-9 ? std::fabs(geometry::sin_k(space, arc)) / arc : 1;
      sum += of.power * std::pow(of.reflectance, length) * cosine / (4 * turn * l * l * spread);
    }
  return sum;
}

/// Points of floor, ceiling and walls, and of balls in the air.
std::vector<Spot> spots_of(const Lit& lit) {
  const room::Room& room = lit.interior.polygon;
  const double height = lit.interior.height;
  std::vector<Spot> spots;
  for (int k = 0; k < 8; ++k) {
    const double phi = 0.4 + 0.785 * k, reach = place::distance_to_boundary(room, phi);
    const geometry::Point p =
        geometry::point_along(room.space, {}, geometry::Tangent(0, std::cos(phi), std::sin(phi)), reach * (0.15 + 0.1 * k));
    spots.push_back({{p, 0}, {{0, 0, 0}, 1}, -1});
    spots.push_back({{p, height}, {{0, 0, 0}, -1}, -1});
    // The normal of a ball in some direction.
    const Position in_air{p, (0.2 + 0.07 * k) * height};
    const surface::TangentFrame frame = surface::tangent_frame(room.space, p);
    const geometry::Vector3 n = geometry::normalised({std::cos(2.1 * k), std::sin(2.1 * k), 0.9 - 0.25 * k});
    spots.push_back({in_air, surface::to_ambient(frame, n), -1});
  }
  for (int w = 0; w < static_cast<int>(room.walls.size()); ++w) {
    const auto at = static_cast<std::size_t>(w);
    spots.push_back({{room::point_on_wall(room, w, room.walls[at].length * 0.37), 0.41 * height},
                     trace::normal_of_wall(room.space, room.walls[at]),
                     w});
  }
  return spots;
}

double code(double irradiance) { return 255 * image::encode_srgb(std::min(1.0, irradiance / std::numbers::pi)); }

double shown(const Lit& lit, const Spot& spot) {
  return light::irradiance(lit.lighting, {spot.at, spot.normal, spot.at, spot.wall, false}).r;
}

}  // namespace

TEST_CASE("light over mirrors is the closed sum over images, dim and bright, in all three spaces and round the sphere", "[light]") {
  for (const MirrorRoom& of : {MirrorRoom{"*222", 0.9, 3, 7}, MirrorRoom{"*234", 0.95, 1, 12}, MirrorRoom{"*222", 0.9, 0.05, 6},
                               MirrorRoom{"*2222", 0.9, 10, 6}, MirrorRoom{"*2222", 1, 0.3, 6}, MirrorRoom{"*333", 0.95, 0.05, 8},
                               MirrorRoom{"*22222", 0.9, 10, 5}, MirrorRoom{"*22222", 0.95, 0.2, 5}, MirrorRoom{"*237", 0.97, 0.02, 12}}) {
    const Lit lit = make(of);
    double most = 0, largest_share = 0;
    for (const Spot& spot : spots_of(lit)) {
      const double expected = closed_sum(lit, of, spot), found = shown(lit, spot);
      most = std::max(most, std::fabs(code(found) - code(expected)));
      largest_share = std::max(largest_share, std::fabs(found / expected - 1));
    }
    INFO(of.orbifold << ", power " << of.power << ", " << of.mirrors << " mirrors: " << largest_share << " of the light");
    CHECK(most < 1);
    CHECK(largest_share < 1.0 / 255);
  }
}

TEST_CASE("a dim room has the light of all of its images, not of those that alone are bright enough", "[light]") {
  const MirrorRoom of{"*2222", 1, 0.3, 6};
  const Lit lit = make(of);
  CHECK(lit.lighting.lamps->images.size() + lit.lighting.lamps->faint.size() == 85);
  const Spot middle{{{}, 0}, {{0, 0, 0}, 1}, -1};
  CHECK(code(shown(lit, middle)) == Approx(code(closed_sum(lit, of, middle))).margin(0.2));
}

TEST_CASE("with things in the room each image has its own shadow, and the sum is that of the images that are seen", "[light]") {
  for (const MirrorRoom& of : {MirrorRoom{"*2222", 0.95, 10, 6}, MirrorRoom{"*2222", 0.95, 0.3, 6}, MirrorRoom{"*22222", 0.95, 10, 5},
                               MirrorRoom{"*222", 0.9, 3, 6}}) {
    const Lit lit = make(of, true);
    REQUIRE(lit.lighting.scene.interior->parts.size() >= 1);
    double most = 0, shadow = 0;
    for (const Spot& spot : spots_of(lit)) {
      const double expected = closed_sum(lit, of, spot, true), found = shown(lit, spot);
      most = std::max(most, std::fabs(code(found) - code(expected)));
      shadow = std::max(shadow, 1 - expected / closed_sum(lit, of, spot));
    }
    INFO(of.orbifold << ", power " << of.power);
    CHECK(shadow > 0.02);  // the ball is in the way somewhere
    CHECK(most < 2);
  }
}
