// Shadow rays: the geodesic to a lamp's image, followed through the real mirrors, which turn it back to the lamp itself or do not.
#include "compiler/light/way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compiler/light/falloff.h"
#include "compiler/trace/analytic.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using scene::Color;

constexpr double kArrival = 1e-5;     // how near to the lamp's sample a shadow ray must end; its own error is below 1e-12 in rooms

/// A shadow ray's way through the room: its pieces between mirrors, as long as they meet no plain wall.
struct ShadowPath {
  static constexpr int kMost = 32;
  std::array<trace::Ray, kMost> rays;
  std::array<double, kMost> lengths{};
  std::array<std::int16_t, kMost> walls{};
  int pieces = 0, crossed = 0;
  Color weight{1, 1, 1};
  bool complete = false;
};

// The same steps as trace::follow, without triangles: most paths that fail, fail here.
ShadowPath reflected_path(const trace::TraceScene& scene, trace::Ray ray, double length, int bounces) {
  ShadowPath path;
  for (;;) {
    const trace::Exit exit = trace::exit_of(scene.prism, ray);
    path.rays[static_cast<std::size_t>(path.pieces)] = ray;
    path.lengths[static_cast<std::size_t>(path.pieces++)] = std::min(exit.t, length);
    if (exit.t >= length) {
      path.complete = true;
      return path;
    }
    const trace::MirrorArea* mirror = trace::mirror_at(scene, ray, exit.t, exit.surface);
    if (!mirror || path.pieces > bounces || path.pieces == ShadowPath::kMost) return path;
    path.weight = path.weight * mirror->weight;
    if (exit.surface >= 0) path.walls[static_cast<std::size_t>(path.crossed++)] = static_cast<std::int16_t>(exit.surface);
    length -= exit.t;
    ray = exit.surface >= 0 ? trace::reflected_in_wall(scene.prism, ray, exit.t, exit.surface)
                            : trace::reflected_in_plane(scene.prism, ray, exit.t, exit.surface);
  }
}

}  // namespace

Way way_to(Space space, const Position& from, const Position& to, int sheet) {
  Way way;
  const double near = geometry::distance(space, from.floor, to.floor), dz = to.z - from.z;
  way.arc = near;
  if (sheet > 0) way.arc = sheet % 2 == 0 ? near + sheet * std::numbers::pi : (sheet + 1) * std::numbers::pi - near;
  way.length = std::hypot(way.arc, dz);
  if (way.length < 1e-9) return way;
  way.exists = true;
  if (way.arc < 1e-9) {
    way.start = {{0, 0, 0}, dz < 0 ? -1.0 : 1.0};
    return way;
  }
  way.exists = near >= 1e-9 && (space != Space::spherical || near <= std::numbers::pi - 1e-9);
  if (!way.exists) return way;  // seen from all sides at once: the focus itself has no direction
  const geometry::Tangent d = geometry::direction_to(space, from.floor, to.floor);
  const double sign = sheet % 2 == 0 ? 1 : -1, c = way.arc / way.length;
  way.start = {(sign * c) * d, dz / way.length};
  return way;
}

Color arriving(const LightField& field, const LampImage& image, const HungLamp& lamp, std::size_t sample, const LightPoint& point,
               const Way& way) {
  const Space space = field.scene.prism.space;
  const ShadowPath path = reflected_path(field.scene, leaving(field, point, way.start), way.length * (1 - 1e-9), field.options.bounces);
  if (!path.complete) return {};
  const auto last = static_cast<std::size_t>(path.pieces - 1);
  const Position end = trace::position_at(space, path.rays[last], path.lengths[last]);
  const Position& there = lamp.samples[sample];
  const geometry::Ambient off = end.floor - there.floor;
  const double apart = std::fabs(off.x) + std::fabs(off.y) + std::fabs(off.w) + std::fabs(end.z - there.z);
  if (apart > kArrival * (1 + std::fabs(there.floor.w)) + 1e-7 * way.length) return {};
  if (image.exact && !std::equal(path.walls.begin(), path.walls.begin() + path.crossed, image.walls.begin(), image.walls.end())) return {};
  for (std::size_t i = 0; i <= last; ++i)
    if (trace::occluded(field.scene, path.rays[i], path.lengths[i])) return {};
  return path.weight;
}

double unhindered(const LightField& field, const LampImage& image, const HungLamp& lamp, std::size_t sample, const LightPoint& point,
                  const Way& way) {
  const Space space = field.scene.prism.space;
  double value = falloff(lamp.falloff, space, way.length, way.arc, lamp.radius);
  if (lamp.kind == scene::LampKind::point || lamp.kind == scene::LampKind::sphere) return value;
  const trace::Ray ray = trace::ray_from(space, point.at, way.start);
  return value * profile(lamp, -trace::inner(space, trace::direction_at(space, ray, way.length), image.axes[sample]));
}

LightPoint on_surface(const LightField& field, const LightPoint& point, double reach) {
  const Space space = field.scene.prism.space;
  LightPoint nearest = point;
  for (const double side : {1.0, -1.0}) {
    const trace::Ray ray = trace::ray_from(space, point.at, side * point.flat);
    const trace::Hit hit = trace::closest_triangle(field.scene, ray, reach);
    if (hit.target != trace::Target::triangle || hit.t >= reach) continue;
    const LightPoint there = light_point(field, *field.casting, trace::surface_at(field.scene, ray, hit), hit);
    if (std::fabs(trace::inner(space, there.normal, point.normal)) < 0.7) continue;  // the other side of an edge
    reach = hit.t;
    nearest = there;
  }
  return nearest;
}

trace::Ray leaving(const LightField& field, const LightPoint& point, const trace::Direction& direction) {
  trace::Ray ray = trace::ray_from(field.scene.prism.space, point.origin, direction);
  ray.leaves_wall = point.wall;
  ray.t_min = point.on_triangle ? trace::kLeave : 0;
  return ray;
}

}  // namespace orbc::light
