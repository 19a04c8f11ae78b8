// Depth of field, held to closed forms and to geodesics that are built another way.
#include "compiler/render/lens.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/geometry/chart.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/render/draw.h"
#include "compiler/room/realise.h"
#include "compiler/mesh_io/load.h"
#include "compiler/scene/defaults.h"
#include "tests/support/threads.h"

using namespace orbc;
using geometry::Point;
using geometry::Space;
using geometry::Vector3;

namespace {

place::Camera eye_with_lens(Space space, double radius, double focus) {
  place::Camera eye;
  eye.room_from_eye = geometry::translation_by(space, 0.11, -0.07);
  eye.z = 0.6;
  const double a = 0.4, e = -0.3;
  eye.forward = {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
  eye.right = {std::sin(a), -std::cos(a), 0};
  eye.up = geometry::cross(eye.right, eye.forward);
  eye.width = 80, eye.height = 60;
  eye.lens = place::ThinLens{radius, focus};
  return eye;
}

double apart(Space space, const geometry::Position& a, const geometry::Position& b) {
  return std::hypot(geometry::distance(space, a.floor, b.floor), a.z - b.z);
}

// A square room with black walls, seen along +x from its middle: a small bright ball before the black.
place::Interior room_with_ball(double distance, double radius) {
  scene::Scene s = scene::default_scene(*notation::parse("*2222"));
  s.room.shape.scale = 2;
  s.room.height = 2;
  for (scene::Wall& wall : s.room.walls) wall.mirrors.clear(), wall.material.color = {0, 0, 0};
  s.room.floor.material = s.room.ceiling.material = s.room.walls[0].material;
  scene::Object ball;
  ball.shape = scene::SphereSpec{radius};
  ball.material.emplace().color = {1, 1, 1};
  ball.place.floor = scene::AtXy{distance, 0};
  ball.place.z = 1 - radius;
  s.objects = {ball};
  return place::furnish(s, *room::realise(s.orbifold, s.room.shape), mesh_io::assets_from_files())->interior;
}

}  // namespace

TEST_CASE("all rays of a point of the picture meet at the focus distance along the ray through the middle", "[render]") {
  for (const Space space : {Space::euclidean, Space::hyperbolic, Space::spherical})
    for (const double focus : {0.05, 0.8, 2.9}) {
      CAPTURE(geometry::name(space), focus);
      const place::Camera eye = eye_with_lens(space, 0.03, focus);
      const geometry::Position middle{eye.room_from_eye * Point{}, eye.z};
      for (const auto& [x, y] : {std::pair{40.0, 30.0}, {3.5, 7.25}, {79.0, 59.0}}) {
        const geometry::Position sharp = trace::position_at(space, render::eye_ray(eye, x, y), focus);
        for (int k = 0; k < 50; ++k) {
          const auto on_lens = render::lens_point(7, 3, k);
          const trace::Ray ray = render::lens_ray(eye, x, y, on_lens);
          CHECK(apart(space, {ray.at, ray.z}, middle) == Approx(0.03 * std::hypot(on_lens[0], on_lens[1])));
          CHECK(apart(space, trace::position_at(space, ray, trace::segment_between(space, {ray.at, ray.z}, sharp).length), sharp) < 1e-9);
        }
        CHECK(apart(space, {render::lens_ray(eye, x, y, {0, 0}).at, eye.z}, middle) < 1e-15);
      }
    }
}

TEST_CASE("what is nearer or farther than the focus is blurred as wide as the space's trigonometry says", "[render]") {
  // A level ray through the lens's rim at the distance a to the right is to meet the axis at the focus F. At the distance D on the axis it
  // has then the offset o from it: in the triangle of the axis, the ray and the perpendicular at the lens, tan ψ = tanκ(a)/sinκ(F) at the
  // focus; the perpendicular at D, |F − D| from there, is cut at tanκ(o) = tan ψ · sinκ|F − D| (Napier's rule).
  const double a = 0.05;
  for (const Space space : {Space::euclidean, Space::hyperbolic, Space::spherical})
    for (const auto& [focus, distance] : {std::pair{0.8, 1.2}, {0.8, 0.3}, {2.2, 0.7}}) {
      CAPTURE(geometry::name(space), focus, distance);
      place::Camera eye = eye_with_lens(space, a, focus);
      eye.forward = {1, 0, 0}, eye.right = {0, -1, 0}, eye.up = {0, 0, 1};
      const trace::Ray ray = render::lens_ray(eye, 40, 30, {1, 0});
      CHECK(ray.m == Approx(0).margin(1e-15));
      // Where it crosses the perpendicular at D, by bisection: the sign of the distance from that line.
      const geometry::Isometry here = geometry::translation_by(space, distance, 0);
      const geometry::Line across = eye.room_from_eye * (here * geometry::line_along(space, {}, {0, 0, 1}));
      double low = 0, high = 2 * distance;
      const double before = geometry::signed_distance(space, across, ray.at);
      for (int i = 0; i < 80; ++i) {
        const double t = 0.5 * (low + high);
        (geometry::signed_distance(space, across, trace::position_at(space, ray, t).floor) * before > 0 ? low : high) = t;
      }
      const Point axis = eye.room_from_eye * (here * Point{});
      const double offset = geometry::distance(space, axis, trace::position_at(space, ray, low).floor);
      const double psi = std::atan(geometry::tan_k(space, a) / geometry::sin_k(space, focus));
      CHECK(offset == Approx(geometry::atan_k(space, std::tan(psi) * geometry::sin_k(space, std::fabs(focus - distance)))).epsilon(1e-9));
      if (space == Space::euclidean) CHECK(offset == Approx(a * std::fabs(1 - distance / focus)));
    }
}

TEST_CASE("a point of light out of focus is a disk of the size of the circle of confusion, in focus a point", "[render]") {
  const double ball = 0.01, distance = 1.2, lens = 0.04;
  const place::Interior room = room_with_ball(distance, ball);
  place::Camera eye;
  eye.room_from_eye = geometry::identity(Space::euclidean);
  eye.z = 1;
  eye.width = eye.height = 81;
  eye.fov = Angle::from_degrees(16);
  render::DrawOptions options;
  options.samples = 256;
  const auto scene = trace::prepare(room);
  const double pixels = place::pixels_per_radian(eye), seen = ball / distance * pixels;
  // Of a disk of even brightness: its light, and its radius by the second moment, ⟨r²⟩ = R²/2.
  const auto measured = [&](double focus) {
    eye.lens = place::ThinLens{lens, focus};
    const render::Film film = render::draw(scene, eye, options, serial_executor());
    double light = 0, moment = 0;
    for (int y = 0; y < eye.height; ++y)
      for (int x = 0; x < eye.width; ++x) {
        const double v = film.color[static_cast<std::size_t>(y * eye.width + x)].g;
        light += v, moment += v * (std::pow(x + 0.5 - eye.width / 2.0, 2) + std::pow(y + 0.5 - eye.height / 2.0, 2));
      }
    return std::pair{light, std::sqrt(2 * moment / light)};
  };
  const auto sharp = measured(distance);
  CHECK(sharp.first == Approx(M_PI * seen * seen).epsilon(0.05));
  CHECK(sharp.second == Approx(seen).epsilon(0.05));
  for (const double focus : {0.8, 2.0}) {
    CAPTURE(focus);
    const double confusion = lens * std::fabs(1 / focus - 1 / distance) * pixels;
    const auto blurred = measured(focus);
    CHECK(blurred.first == Approx(sharp.first).epsilon(0.05));   // its light is spread, not lost
    CHECK(blurred.second == Approx(std::hypot(confusion, seen)).epsilon(0.04));   // second moments add
  }
}

TEST_CASE("a picture through a lens is the same for any number of threads", "[render]") {
  const place::Interior room = room_with_ball(1.2, 0.1);
  place::Camera eye = eye_with_lens(Space::euclidean, 0.05, 0.5);
  render::DrawOptions options;
  options.samples = 5;
  const auto scene = trace::prepare(room);
  const render::Film one = render::draw(scene, eye, options, serial_executor());
  const render::Film many = render::draw(scene, eye, options, testing::threads(5));
  for (std::size_t i = 0; i < one.color.size(); ++i) REQUIRE(one.color[i] == many.color[i]);
}

TEST_CASE("the points of a lens cover it evenly", "[render]") {
  for (const std::uint64_t pixel : {0u, 17u, 1234567u}) {
    double inner = 0, right = 0, top = 0;
    constexpr int kPoints = 512;
    for (int k = 0; k < kPoints; ++k) {
      const auto p = render::lens_point(1, pixel, k);
      CHECK(std::hypot(p[0], p[1]) <= 1 + 1e-12);
      inner += std::hypot(p[0], p[1]) < std::sqrt(0.5), right += p[0] > 0, top += p[1] > 0;
    }
    CHECK(inner / kPoints == Approx(0.5).margin(0.02));
    CHECK(right / kPoints == Approx(0.5).margin(0.02));
    CHECK(top / kPoints == Approx(0.5).margin(0.02));
  }
}
