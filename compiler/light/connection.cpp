// Shadow rays. The geodesic to a lamp's image is followed over the real mirrors, which lead it to the lamp itself or not.
#include "compiler/light/connection.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/light/falloff.h"
#include "compiler/surface/tangent_frame.h"
#include "compiler/trace/analytic.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using scene::Color;

constexpr double kArrivalTolerance = 1e-5;  // distance of a shadow ray's end from the lamp's sample; its own error is below 1e-12 in rooms
constexpr double kUndersideGap = 1e-4;      // of the room's height: an object's own underside is nearer to the floor under it

constexpr std::size_t kMaxSegments = 32;

/// A segment of a shadow ray between two mirrors.
struct ShadowSegment {
  trace::Ray ray;
  double length = 0;
  bool ends_at_wall = false;
};

/// A shadow ray up to the first wall without a mirror.
struct ShadowPath {
  boost::container::static_vector<ShadowSegment, kMaxSegments> segments;
  boost::container::static_vector<std::int16_t, kMaxSegments> walls;  ///< with the mirrors between segments, without floor and ceiling
  Color throughput{1, 1, 1};
  bool complete = false;  ///< it has the whole length
};

/// Distance and unit direction of a floor point.
struct FloorGeodesic {
  double arc = 0;
  geometry::Ambient direction{0, 0, 0};
};

// geometry::distance and geometry::direction_to together. With e = Q − P and |e|² = ±4 sin²κ(d/2), the tangent Q − cosκ(d)·P = e ±
// (|e|²/2)·P has the length sinκ d, and nothing cancels for points near each other. Coordinates in rooms are small enough to do without
// hypot.
FloorGeodesic floor_geodesic(Space space, const geometry::Point& p, const geometry::Point& q) {
  const double dx = q.x - p.x, dy = q.y - p.y;
  FloorGeodesic to;
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
    // cosh d − 1. For near points from the chord, whose w is a difference of ρ², since w itself has lost the small digits; for far points
    // from the product.
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

// Follows a ray as trace::follow does, but without triangles. Most paths that are blocked are blocked by walls.
ShadowPath reflected_path(const trace::TraceScene& scene, trace::Ray ray, double length, int bounces) {
  ShadowPath path;
  for (;;) {
    const trace::Exit exit = trace::exit_of(scene.prism, ray, length);
    path.segments.push_back({ray, std::min(exit.t, length), exit.t < length && exit.surface >= 0});
    if (exit.t >= length) {
      path.complete = true;
      return path;
    }
    if (path.segments.size() > static_cast<std::size_t>(bounces) || path.segments.size() == kMaxSegments) return path;
    ray = exit.surface >= 0 ? trace::reflected_in_wall(scene.prism, ray, exit)
                            : trace::reflected_in_plane(scene.prism, ray, exit.t, exit.surface);
    const trace::MirrorRect* mirror = trace::mirror_at(scene, {ray.at, ray.z}, exit.surface);
    if (!mirror) return path;
    path.throughput = path.throughput * mirror->throughput;
    if (exit.surface >= 0) path.walls.push_back(static_cast<std::int16_t>(exit.surface));
    length -= exit.t;
  }
}

// Whether a path ends at the sample of the lamp. In orbifolds every complete path does, because the room is the quotient of the space by
// its mirrors: the geodesic to an image folds up into the path to the lamp.
bool arrives(const LightingContext& lighting, const ShadowPath& path, const LampImage& image, std::size_t sample, double length) {
  if (!image.path_specific) return true;
  const Position end = trace::position_at(lighting.scene.prism.space, path.segments.back().ray, path.segments.back().length);
  const Position& target = lamp_of_image(lighting, image).samples[sample];
  const geometry::Ambient off = end.floor - target.floor;
  const double distance = std::fabs(off.x) + std::fabs(off.y) + std::fabs(off.w) + std::fabs(end.z - target.z);
  return distance <= kArrivalTolerance * (1 + std::fabs(target.floor.w)) + 1e-7 * length &&
         std::equal(path.walls.begin(), path.walls.end(), image.walls.begin(), image.walls.end());
}

bool is_blocked_by_triangles(const LightingContext& lighting, const ShadowPath& path) {
  return std::any_of(path.segments.begin(), path.segments.end(), [&](const ShadowSegment& segment) {
    // Where no triangle reaches out of the room, a segment that ends at a wall need not be told where.
    const bool needs_end = !(segment.ends_at_wall && lighting.scene.all_inside);
    return trace::occluded(lighting.scene, segment.ray, needs_end ? segment.length : trace::kInfinity);
  });
}

}  // namespace

Connection connect(Space space, const Position& from, const Position& to, int sheet) {
  Connection connection;
  const FloorGeodesic floor = floor_geodesic(space, from.floor, to.floor);
  const double shortest = floor.arc, dz = to.z - from.z;
  connection.arc = shortest;
  if (sheet > 0) connection.arc = sheet % 2 == 0 ? shortest + sheet * std::numbers::pi : (sheet + 1) * std::numbers::pi - shortest;
  connection.length = std::sqrt(connection.arc * connection.arc + dz * dz);
  if (connection.length < 1e-9) return connection;
  connection.valid = true;
  if (connection.arc < 1e-9) {
    connection.direction = {{0, 0, 0}, dz < 0 ? -1.0 : 1.0};
    return connection;
  }
  // A point's focus on S² is seen in all directions at once.
  connection.valid = shortest >= 1e-9 && (space != Space::spherical || shortest <= std::numbers::pi - 1e-9);
  if (!connection.valid) return connection;
  const double sign = sheet % 2 == 0 ? 1 : -1, c = connection.arc / connection.length;
  connection.direction = {(sign * c) * floor.direction, dz / connection.length};
  return connection;
}

Color shadow_transmittance(const LightingContext& lighting, const LampImage& image, std::size_t sample, const surface::ShadingPoint& point,
                           const Connection& connection) {
  const trace::Ray ray = spawn_ray(lighting, point, connection.direction);
  const ShadowPath path = reflected_path(lighting.scene, ray, connection.length * (1 - 1e-9), lighting.options.bounces);
  if (!path.complete || !arrives(lighting, path, image, sample, connection.length)) return {};
  return is_blocked_by_triangles(lighting, path) ? Color{} : path.throughput;
}

bool is_unobstructed(const LightingContext& lighting, const surface::ShadingPoint& point, const Connection& connection, int bounces,
                     double clearance) {
  trace::Ray ray = spawn_ray(lighting, point, connection.direction);
  ray.t_min = std::max(ray.t_min, clearance);
  const ShadowPath path = reflected_path(lighting.scene, ray, connection.length * (1 - 1e-9), bounces);
  return path.complete && !is_blocked_by_triangles(lighting, path);
}

double unoccluded_irradiance(const LightingContext& lighting, const LampImage& image, std::size_t sample,
                             const surface::ShadingPoint& point, const Connection& connection) {
  const Space space = lighting.scene.prism.space;
  const PlacedLamp& lamp = lamp_of_image(lighting, image);
  const double value = falloff(lamp.falloff, space, connection.length, connection.arc, lamp.radius);
  if (lamp.kind == scene::LampKind::point || lamp.kind == scene::LampKind::sphere) return value;
  const trace::Ray ray = trace::ray_from(space, point.at, connection.direction);
  const trace::Direction at_lamp = trace::direction_at(space, ray, connection.length);
  return value * angular_intensity(lamp, -trace::inner(space, at_lamp, image.axes[sample]));
}

SurfaceProjection project_to_surface(const LightingContext& lighting, const surface::ShadingPoint& point, double max_distance) {
  const Space space = lighting.scene.prism.space;
  const surface::TangentFrame frame = surface::tangent_frame(space, point.at.floor);
  const geometry::Vector3 normal = surface::to_local(space, frame, point.geometric_normal);
  SurfaceProjection nearest{point, {}};
  for (const double side : {1.0, -1.0}) {
    // The ray starts a little behind the point, since the surface may pass through it.
    const Position start = surface::exponential(space, point.at, frame, (-side * trace::kRayEpsilon) * normal);
    const trace::Ray ray = trace::ray_from(space, start, side * point.geometric_normal);
    const trace::Hit hit = trace::closest_triangle(lighting.scene, ray, max_distance + trace::kRayEpsilon);
    if (hit.kind != trace::HitKind::triangle || std::fabs(hit.t - trace::kRayEpsilon) >= max_distance) continue;
    const surface::ShadingPoint found = shading_point(lighting, *lighting.shadow_casters, trace::surface_at(lighting.scene, ray, hit), hit);
    if (trace::inner(space, found.normal, point.normal) < 0.7) continue;  // beyond an edge, or the far side of a thin body
    max_distance = std::fabs(hit.t - trace::kRayEpsilon);
    nearest = {found, hit};
  }
  return nearest;
}

bool is_enclosed(const LightingContext& lighting, const surface::ShadingPoint& point) {
  if (lighting.scene.interior == nullptr) return false;
  const Space space = lighting.scene.prism.space;
  const surface::TangentFrame frame = surface::tangent_frame(space, point.at.floor);
  const geometry::Vector3 n = geometry::normalised(surface::to_local(space, frame, point.geometric_normal)),
                          helper = std::fabs(n.z) < 0.7 ? geometry::Vector3{0, 0, 1} : geometry::Vector3{1, 0, 0};
  const geometry::Vector3 a = geometry::normalised(cross(n, helper)), b = cross(n, a);
  for (const geometry::Vector3& d : {n, n + 0.5 * a + 0.3 * b, n - 0.45 * a + 0.35 * b, n + 0.1 * a - 0.6 * b}) {
    trace::Ray ray = trace::ray_from(space, point.at, surface::to_ambient(frame, geometry::normalised(d)));
    ray.t_min = std::max(trace::kRayEpsilon, kUndersideGap * lighting.scene.interior->height);
    const trace::Hit hit = trace::closest_triangle(lighting.scene, ray);
    if (hit.kind != trace::HitKind::triangle || trace::surface_at(lighting.scene, ray, hit).front_facing) return false;
  }
  return true;
}

trace::Ray spawn_ray(const LightingContext& lighting, const surface::ShadingPoint& point, const trace::Direction& direction) {
  trace::Ray ray = trace::ray_from(lighting.scene.prism.space, point.ray_origin, direction);
  ray.start_wall = point.wall;
  ray.t_min = point.on_triangle ? trace::kRayEpsilon : 0;
  return ray;
}

}  // namespace orbc::light
