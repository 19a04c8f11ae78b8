// Shadow rays: the geodesic to a lamp's image, followed through the real mirrors, which turn it back to the lamp itself or do not.
#include "compiler/light/way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/light/falloff.h"
#include "compiler/surface/frame.h"
#include "compiler/trace/analytic.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using scene::Color;

constexpr double kArrival = 1e-5;  // how near to the lamp's sample a shadow ray must end; its own error is below 1e-12 in rooms

constexpr double kUnder = 1e-4;  // of the room's height: a thing's own underside lies nearer to the floor on which it stands

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

/// Distance and unit direction of a floor point.
struct Towards {
  double arc = 0;
  geometry::Ambient direction{0, 0, 0};
};

// geometry::distance and direction_to in one: from e = Q − P and |e|² = ±4 sin²κ(d/2), the tangent Q − cosκ(d)·P = e ± (|e|²/2)·P has the
// length sinκ d, and nothing cancels for points near each other. No hypot: coordinates in rooms are tame, and this is asked most of all.
Towards towards(Space space, const geometry::Point& p, const geometry::Point& q) {
  const double dx = q.x - p.x, dy = q.y - p.y;
  Towards to;
  double sine = 0;  // of the arc
  if (space == Space::euclidean) {
    to.arc = sine = std::sqrt(dx * dx + dy * dy);
    to.direction = {0, dx, dy};
  } else if (space == Space::spherical) {
    const double dw = q.w - p.w, chord2 = dw * dw + dx * dx + dy * dy, half = chord2 / 2;
    to.direction = {dw + half * p.w, dx + half * p.x, dy + half * p.y};
    sine = std::sqrt(to.direction.w * to.direction.w + to.direction.x * to.direction.x + to.direction.y * to.direction.y);
    to.arc = math::atan2(sine, 1 - half);
  } else {
    // cosh d − 1: near by the chord, whose w comes from ρ² differences since w alone has lost the small ones; far by the product.
    const double dw = (dx * (p.x + q.x) + dy * (p.y + q.y)) / (p.w + q.w), chord2 = dx * dx + dy * dy, ww = p.w * q.w;
    const double half = chord2 > 2 * ww ? std::max(0.0, (ww - 1) - (p.x * q.x + p.y * q.y)) : std::max(0.0, chord2 - dw * dw) / 2;
    sine = std::sqrt(half * (half + 2));
    to.arc = math::log1p(half + sine);
    const double x = dx - half * p.x, y = dy - half * p.y;
    to.direction = {(p.x * x + p.y * y) / p.w, x, y};
  }
  if (sine > 0) to.direction = (1 / sine) * to.direction;
  return to;
}

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
  const Towards floor = towards(space, from.floor, to.floor);
  const double near = floor.arc, dz = to.z - from.z;
  way.arc = near;
  if (sheet > 0) way.arc = sheet % 2 == 0 ? near + sheet * std::numbers::pi : (sheet + 1) * std::numbers::pi - near;
  way.length = std::sqrt(way.arc * way.arc + dz * dz);
  if (way.length < 1e-9) return way;
  way.exists = true;
  if (way.arc < 1e-9) {
    way.start = {{0, 0, 0}, dz < 0 ? -1.0 : 1.0};
    return way;
  }
  way.exists = near >= 1e-9 && (space != Space::spherical || near <= std::numbers::pi - 1e-9);
  if (!way.exists) return way;  // seen from all sides at once: the focus itself has no direction
  const double sign = sheet % 2 == 0 ? 1 : -1, c = way.arc / way.length;
  way.start = {(sign * c) * floor.direction, dz / way.length};
  return way;
}

Color arriving(const LightField& field, const LampImage& image, const HungLamp& lamp, std::size_t sample, const surface::LightPoint& point,
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

double unhindered(const LightField& field, const LampImage& image, const HungLamp& lamp, std::size_t sample,
                  const surface::LightPoint& point, const Way& way) {
  const Space space = field.scene.prism.space;
  double value = falloff(lamp.falloff, space, way.length, way.arc, lamp.radius);
  if (lamp.kind == scene::LampKind::point || lamp.kind == scene::LampKind::sphere) return value;
  const trace::Ray ray = trace::ray_from(space, point.at, way.start);
  return value * profile(lamp, -trace::inner(space, trace::direction_at(space, ray, way.length), image.axes[sample]));
}

OnSurface on_surface(const LightField& field, const surface::LightPoint& point, double reach) {
  const Space space = field.scene.prism.space;
  const surface::Frame frame = surface::frame_at(space, point.at.floor);
  const geometry::Vector3 flat = surface::local(space, frame, point.flat);
  OnSurface nearest{point, {}};
  for (const double side : {1.0, -1.0}) {
    // From a little behind: the surface may be just here.
    const Position start = surface::exponential(space, point.at, frame, (-side * trace::kLeave) * flat);
    const trace::Ray ray = trace::ray_from(space, start, side * point.flat);
    const trace::Hit hit = trace::closest_triangle(field.scene, ray, reach + trace::kLeave);
    if (hit.target != trace::Target::triangle || std::fabs(hit.t - trace::kLeave) >= reach) continue;
    const surface::LightPoint there = light_point(field, *field.casting, trace::surface_at(field.scene, ray, hit), hit);
    if (trace::inner(space, there.normal, point.normal) < 0.7) continue;  // beyond an edge, or the far side of something thin
    reach = std::fabs(hit.t - trace::kLeave);
    nearest = {there, hit};
  }
  return nearest;
}

bool covered(const LightField& field, const surface::LightPoint& point) {
  if (field.scene.room == nullptr) return false;
  const Space space = field.scene.prism.space;
  const surface::Frame frame = surface::frame_at(space, point.at.floor);
  const geometry::Vector3 n = geometry::normalised(surface::local(space, frame, point.flat)),
                          other = std::fabs(n.z) < 0.7 ? geometry::Vector3{0, 0, 1} : geometry::Vector3{1, 0, 0};
  const geometry::Vector3 a = geometry::normalised(cross(n, other)), b = cross(n, a);
  for (const geometry::Vector3& d : {n, n + 0.5 * a + 0.3 * b, n - 0.45 * a + 0.35 * b, n + 0.1 * a - 0.6 * b}) {
    trace::Ray ray = trace::ray_from(space, point.at, surface::global(frame, geometry::normalised(d)));
    ray.t_min = std::max(trace::kLeave, kUnder * field.scene.room->height);
    const trace::Hit hit = trace::closest_triangle(field.scene, ray);
    if (hit.target != trace::Target::triangle || trace::surface_at(field.scene, ray, hit).outside) return false;
  }
  return true;
}

trace::Ray leaving(const LightField& field, const surface::LightPoint& point, const trace::Direction& direction) {
  trace::Ray ray = trace::ray_from(field.scene.prism.space, point.origin, direction);
  ray.leaves_wall = point.wall;
  ray.t_min = point.on_triangle ? trace::kLeave : 0;
  return ray;
}

}  // namespace orbc::light
