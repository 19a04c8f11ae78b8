// Omni-directional stereo, held to panoramas from eyes that are placed along geodesics by other formulas.
#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/geometry/chart.h"
#include "compiler/geometry/line.h"
#include "compiler/mesh_io/load.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/render/draw.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"

using namespace orbc;
using geometry::Point;
using geometry::Space;

namespace {

constexpr double kSeparation = 0.07;

// Squares as the test draws them: a stereo picture is twice as high as a panorama of the same width.
place::Camera stereo_eye(Space space, int width) {
  place::Camera eye;
  eye.room_from_eye = geometry::translation_by(space, 0.11, -0.07);
  eye.z = 0.6;
  eye.forward = {std::cos(0.4), std::sin(0.4), 0};
  eye.right = {std::sin(0.4), -std::cos(0.4), 0};
  eye.projection = scene::Projection::stereo;
  eye.eye_separation = kSeparation;
  eye.width = eye.height = width;
  return eye;
}

// The azimuth of a column of the picture, counter-clockwise from the x axis of the eye.
double azimuth_of(double x, int width) { return 0.4 - 2 * M_PI * (x / width - 0.5); }

// A panorama from where one of the eyes stands for a column. The frame of the log map there is transported along the geodesic from the
// camera's place.
place::Camera panorama_beside(const place::Camera& stereo, double x, bool left) {
  const Space space = stereo.room_from_eye.space;
  const double sideways = azimuth_of(x, stereo.width) + (left ? M_PI / 2 : -M_PI / 2);
  const Point there = geometry::point_along(space, {}, {0, std::cos(sideways), std::sin(sideways)}, kSeparation / 2);
  place::Camera eye = stereo;
  eye.projection = scene::Projection::panorama;
  eye.height = stereo.height / 2;
  eye.room_from_eye = stereo.room_from_eye * geometry::translation_to(space, there);
  return eye;
}

place::Interior room_with_ball(const char* notation) {
  scene::Scene s = scene::default_scene(*notation::parse(notation));
  s.room.floor.material.pattern = scene::Pattern::checker;
  s.room.floor.material.second = {0.1, 0.1, 0.1};
  s.room.floor.material.cell = 0.15;
  scene::Object ball;
  ball.name = "ball";
  ball.shape = scene::SphereSpec{0.1};
  ball.material.emplace().color = {1, 0, 0};
  ball.place.floor = scene::AtPolar{0.3, Angle::from_degrees(100)};
  ball.place.z = 0.4;
  s.objects = {ball};
  return place::furnish(s, *room::realise(s.orbifold, s.room.shape), mesh_io::assets_from_files())->interior;
}

}  // namespace

TEST_CASE("both eyes of a column stand at right angles to where they look, the left one on the left, above in the picture", "[render]") {
  for (const Space space : {Space::euclidean, Space::hyperbolic, Space::spherical}) {
    CAPTURE(geometry::name(space));
    const place::Camera eye = stereo_eye(space, 64);
    const Point middle = eye.room_from_eye * Point{};
    for (const double x : {0.5, 17.5, 31.5, 40.0, 63.5})
      for (const bool left : {true, false}) {
        CAPTURE(x, left);
        const trace::Ray ray = render::eye_ray(eye, x, left ? 16 : 48);  // both at the horizon
        CHECK(ray.m == Approx(0).margin(1e-15));
        CHECK(geometry::distance(space, ray.at, middle) == Approx(kSeparation / 2).epsilon(1e-12));
        const double a = azimuth_of(x, 64);
        const geometry::Line ahead =
            geometry::line_along(space, middle, eye.room_from_eye * geometry::Tangent(0, std::cos(a), std::sin(a)));
        CHECK(geometry::signed_distance(space, ahead, ray.at) == Approx(left ? kSeparation / 2 : -kSeparation / 2).epsilon(1e-12));
        // The geodesic from the camera's place meets the ray at a right angle, as it left the direction of the column.
        const geometry::Tangent back = geometry::direction_to(space, ray.at, middle);
        CHECK(trace::inner(space, {back, 0}, {ray.along, 0}) == Approx(0).margin(1e-12));
        CHECK(geometry::signed_distance(space, geometry::line_along(space, ray.at, ray.along), middle) * (left ? -1 : 1) > 0);
      }
  }
}

TEST_CASE("rays of a stereo panorama are those of panoramas from where its eyes stand", "[render]") {
  for (const Space space : {Space::euclidean, Space::hyperbolic, Space::spherical}) {
    CAPTURE(geometry::name(space));
    const place::Camera eye = stereo_eye(space, 64);
    for (const double x : {0.5, 9.25, 33.5, 63.5})
      for (const double y : {0.5, 10.5, 31.5})
        for (const bool left : {true, false}) {
          CAPTURE(x, y, left);
          const trace::Ray one = render::eye_ray(eye, x, left ? y : y + 32);
          const trace::Ray other = render::eye_ray(panorama_beside(eye, x, left), x, y);
          CHECK(geometry::distance(space, one.at, other.at) < 1e-9);
          CHECK(geometry::distance(space, geometry::point_along(space, one.at, one.along, 1),
                                   geometry::point_along(space, other.at, other.along, 1)) < 1e-9);
          CHECK(one.m == Approx(other.m).margin(1e-12));
          CHECK(one.z == other.z);
        }
  }
}

TEST_CASE("columns of a stereo picture are columns of panoramas from displaced eyes", "[render]") {
  constexpr int kWidth = 32;
  for (const char* notation : {"*222", "*2222", "*22222"}) {
    CAPTURE(notation);
    const place::Interior room = room_with_ball(notation);
    const trace::TraceScene scene = trace::prepare(room);
    const place::Camera eye = stereo_eye(room.polygon.space, kWidth);
    render::DrawOptions options;
    options.max_bounces = 4;
    const render::Film film = render::draw(scene, eye, options, serial_executor());
    int same = 0, pairs = 0, eyes_differ = 0;
    for (int x = 0; x < kWidth; ++x)
      for (const bool left : {true, false}) {
        const render::Film single = render::draw(scene, panorama_beside(eye, x + 0.5, left), options, serial_executor());
        for (int y = 0; y < kWidth / 2; ++y) {
          const auto here = static_cast<std::size_t>((left ? y : y + kWidth / 2) * kWidth + x);
          const auto there = static_cast<std::size_t>(y * kWidth + x);
          const auto twin = static_cast<std::size_t>((left ? y + kWidth / 2 : y) * kWidth + x);
          ++pairs;
          same += film.color[here] == single.color[there] && film.object[here] == single.object[there];
          eyes_differ += !(film.color[twin] == single.color[there]);
        }
      }
    CHECK(same >= pairs - 2);  // rounding may decide a pixel whose middle lies on an edge
    CHECK(eyes_differ > pairs / 20);
  }
}

TEST_CASE("what is near lies farther to the right for the left eye", "[render]") {
  for (const char* notation : {"*222", "*2222", "*22222"}) {
    CAPTURE(notation);
    const place::Interior room = room_with_ball(notation);
    int ball = -1;
    for (std::size_t i = 0; i < room.parts.size(); ++i)
      if (room.parts[i].name == "ball") ball = static_cast<int>(i);
    place::Camera eye = stereo_eye(room.polygon.space, 128);
    const std::complex<double> to_ball = geometry::log_from_point(
        room.polygon.space, geometry::inverse(eye.room_from_eye) *
                                geometry::point_from_log(room.polygon.space, std::polar(0.3, 100 * M_PI / 180)));
    const double a = std::arg(to_ball), distance = std::abs(to_ball);
    eye.forward = {std::cos(a), std::sin(a), 0}, eye.right = {std::sin(a), -std::cos(a), 0};
    render::DrawOptions options;
    options.max_bounces = 0;
    const render::Film film = render::draw(trace::prepare(room), eye, options, serial_executor());
    double sum[2] = {0, 0};
    int count[2] = {0, 0};
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 128; ++x)
        if (film.object[static_cast<std::size_t>(y * 128 + x)] == ball) sum[y / 64] += x + 0.5 - 64, ++count[y / 64];
    REQUIRE(count[0] > 20);
    // The ball is seen where its middle lies straight ahead of an eye: in flat rooms where sin φ = half the separation over the distance.
    const double off = std::asin(geometry::tan_k(room.polygon.space, kSeparation / 2) / geometry::tan_k(room.polygon.space, distance));
    CHECK(sum[0] / count[0] == Approx(off * 128 / (2 * M_PI)).margin(0.4));
    CHECK(sum[1] / count[1] == Approx(-off * 128 / (2 * M_PI)).margin(0.4));
    CHECK(sum[0] / count[0] > 0.4);
  }
}
