// Straight rays in the disk chart, held to the chart itself: where a line meets the floor is told by similar triangles, and which copy that
// is by reflecting the point into the room.
#include "compiler/render/straight.h"

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

constexpr double kReflectance = 0.9;

place::Interior bare_room(const char* notation) {
  scene::Scene s = scene::default_scene(*notation::parse(notation));
  for (scene::Wall& wall : s.room.walls)
    for (scene::Mirror& mirror : wall.mirrors) mirror.reflectance = kReflectance, mirror.frame.reset();
  return place::furnish(s, *room::realise(s.orbifold, s.room.shape), mesh_io::assets_from_files())->interior;
}

place::Camera eye_in(Space space) {
  place::Camera eye;
  eye.room_from_eye = geometry::translation_by(space, 0.04, -0.03);  // in the smallest of the rooms, too
  eye.z = 0.5;
  eye.forward = {std::cos(0.4), std::sin(0.4), 0};
  eye.right = {std::sin(0.4), -std::cos(0.4), 0};
  eye.width = 640, eye.height = 480;
  return eye;
}

/// A point of the cover moved into the room, and by how many reflections. Each brings it nearer.
struct Folded {
  Point at;
  int reflections = 0;
};
Folded fold(const place::Interior& room, Point p) {
  Folded folded{p, 0};
  for (bool moved = true; moved;) {
    moved = false;
    for (const room::Wall& wall : room.polygon.walls)
      if (geometry::value_at(wall.line, folded.at) < 0) {
        folded.at = geometry::reflection(room.polygon.space, wall.line) * folded.at;
        ++folded.reflections;
        moved = true;
      }
  }
  return folded;
}

}  // namespace

TEST_CASE("a straight ray meets the floor where the straight line of the chart does, through the mirrors of that copy", "[render]") {
  for (const char* notation : {"*222", "*235", "*22222", "*237"}) {
    CAPTURE(notation);
    const place::Interior room = bare_room(notation);
    const Space space = room.polygon.space;
    const trace::TraceScene scene = trace::prepare(room);
    const place::Camera eye = eye_in(space);
    trace::FollowOptions limits;
    limits.max_bounces = 40;
    const render::StraightRays straight(scene, eye, limits);
    const std::complex<double> from = 2.0 * geometry::disk_from_point(space, eye.room_from_eye * Point());
    int reflected = 0, sure = 0;
    for (const double x : {20.5, 150.5, 320.5, 480.5, 630.5})
      for (const double y : {280.5, 310.5, 400.5, 470.5}) {
        CAPTURE(x, y);
        const geometry::Vector3 d = place::direction_through(eye, x, y);
        // In the chart the camera looks in the direction of its frame: a translation from the centre does not turn it.
        const double s = eye.z / -d.z;
        const std::complex<double> there = from + s * std::complex<double>(d.x, d.y);
        if (space == Space::hyperbolic && std::abs(there) > 1.98) continue;
        const Folded truth = fold(room, geometry::point_from_disk(space, there / 2.0));
        const trace::Path path = straight.follow(render::eye_ray(eye, x, y));
        REQUIRE(path.hit.kind == trace::HitKind::floor);
        const Point found = trace::position_at(space, path.last_ray, path.hit.t).floor;
        // Half a pixel, as the chart at that place and the slope of the ray magnify it.
        const double stretch = space == Space::hyperbolic ? 1 - std::norm(there) / 4 : 1 + std::norm(there) / 4;
        const double half_pixel = 0.5 / place::pixels_per_radian(eye) * s / -d.z / stretch;
        CHECK(geometry::distance(space, found, truth.at) < half_pixel);
        CHECK(path.length == Approx(s).epsilon(1e-2));
        // A point beside a mirror may be found on its other side.
        double to_wall = 1;
        for (const room::Wall& wall : room.polygon.walls)
          to_wall = std::min(to_wall, geometry::signed_distance(space, wall.line, truth.at));
        const bool is_sure = to_wall > half_pixel;
        sure += is_sure;
        if (is_sure) CHECK(path.bounces == truth.reflections);
        CHECK(path.throughput.g == Approx(std::pow(kReflectance, path.bounces)));
        reflected += path.bounces > 0;
      }
    CHECK(reflected >= 4);
    CHECK(sure >= 8);
  }
}

TEST_CASE("straight rays show copies within the bounces of the scene, and the background beyond as it is", "[render]") {
  const place::Interior room = bare_room("*22222");
  const trace::TraceScene scene = trace::prepare(room);
  const place::Camera eye = eye_in(Space::hyperbolic);
  int most = 0, cut = 0;
  trace::FollowOptions limits;
  limits.max_bounces = 2;
  const render::StraightRays straight(scene, eye, limits);
  for (double x = 0.5; x < 640; x += 20)
    for (double y = 200.5; y < 480; y += 20) {
      const trace::Path path = straight.follow(render::eye_ray(eye, x, y));
      most = std::max(most, path.bounces);
      if (!path.cut_off) continue;
      ++cut;
      CHECK(path.throughput == scene::Color{1, 1, 1});
    }
  CHECK(most == 2);
  CHECK(cut > 0);
}
