// A straight line of the disk chart is no geodesic, but short pieces of it nearly are: a geodesic of the scaled chart Z = 2z, in which the
// metric is |dZ|/(1 + κ|Z|²/4), has at most the curvature k = (|Z|/2)/(1 + κ|Z|²/4) there, so that a chord of length h lies within h²k/8
// of it. Each piece is pulled back into the room by the reflections met so far and followed there; so mirrors are real, and neither copies
// nor bent meshes are made. A line may cross a mirror's geodesic twice, which no geodesic does: the mirrors that count are therefore those
// of the geodesic from the eye to the point that is found.
#include "compiler/render/straight.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"

namespace orbc::render {
namespace {

using geometry::Isometry;
using geometry::Point;
using geometry::Position;
using geometry::Space;

constexpr double kRim = 1e-5;           // of the disk: where lines end, before its rim
constexpr double kPixelsOff = 0.1;      // of a piece's middle, sideways or in height
constexpr double kLongestPiece = 0.25;  // times the distance to the rim, or what stands for it on the sphere
constexpr double kPastHit = 1e-9;
constexpr int kMostPieces = 100'000;  // lines that would need more lie within rounding of the rim

/// std::abs takes hypot from the C library, whose last bit depends on the processor.
double modulus(const std::complex<double>& z) { return math::hypot(z.real(), z.imag()); }

std::complex<double> chart_of(Space space, const Point& p) { return kStraightScale * geometry::disk_from_point(space, p); }

/// The direction in the chart of a tangent vector at P: the derivative of (x + iy)/(1 + w).
std::complex<double> chart_direction(const Point& p, const geometry::Tangent& v) {
  const std::complex<double> z(p.x, p.y), dz(v.x, v.y);
  const std::complex<double> d = dz / (1 + p.w) - z * (v.w / ((1 + p.w) * (1 + p.w)));
  return d / modulus(d);
}

/// The parameter at which the line |at + s·along| = radius is left. In: |at| < radius, |along| = 1.
double leaves_circle(const std::complex<double>& at, const std::complex<double>& along, double radius) {
  const double b = (std::conj(at) * along).real(), c = std::norm(at) - radius * radius;
  return -b + std::sqrt(b * b - c);
}

place::Interior without_objects(const place::Interior& room) {
  place::Interior bare;
  bare.polygon = room.polygon;
  bare.height = room.height;
  bare.mirrors = room.mirrors;
  bare.styles = room.styles;
  for (const place::PlacedMesh& part : room.parts)
    if (part.kind != place::PartKind::object && part.kind != place::PartKind::frame) bare.parts.push_back(part);
  return bare;
}

}  // namespace

/// A line on its way.
struct StraightRays::Walk {
  /// The mirrors met: coordinates of the cover become those of the room by `room_from_cover`, heights by z = sign·(z − offset).
  struct Reflections {
    Isometry room_from_cover;
    double sign = 1, offset = 0;
    int count = 0;
  };

  Space space;
  std::complex<double> start, along;  ///< in the scaled chart
  double z = 0, c = 1, m = 0;         ///< height at the start; the direction's horizontal and vertical part
  double s = 0;                       ///< length so far
  Reflections reflections;

  [[nodiscard]] std::complex<double> chart_at(double t) const { return start + (c * t) * along; }
  [[nodiscard]] Position room_position(double t) const {
    const Point p = geometry::point_from_disk(space, chart_at(t) / kStraightScale);
    return {reflections.room_from_cover * p, reflections.sign * (z + m * t - reflections.offset)};
  }
};

StraightRays::StraightRays(const trace::TraceScene& scene, const place::Camera& eye, const trace::FollowOptions& limits)
    : scene_(&scene),
      bare_room_(std::make_unique<place::Interior>(without_objects(*scene.interior))),
      bare_(trace::prepare(*bare_room_)),
      limits_(limits),
      eye_{eye.room_from_eye * Point(), eye.z},
      radians_per_pixel_(1 / place::pixels_per_radian(eye)) {
  for (const room::Wall& wall : scene.interior->polygon.walls)
    reflections_.push_back(geometry::reflection(scene.interior->polygon.space, wall.line));
}

double StraightRays::piece_length(const Walk& walk) const {
  const double far = modulus(walk.chart_at(walk.s));
  const bool is_disk = walk.space == Space::hyperbolic;
  const double stretch = is_disk ? 1 - far * far / 4 : 1 + far * far / 4, bend = far / 2 / stretch;
  const double most = kLongestPiece * (is_disk ? kStraightScale - far : 1 + far);
  // h²k/8 ≤ kPixelsOff · radians per pixel · (s + h)
  const double off = 8 * kPixelsOff * radians_per_pixel_ / std::max(bend, 1e-9);
  const double horizontal = std::min(most, std::max(std::sqrt(off * walk.s), off));
  return std::min(horizontal / std::max(walk.c, 1e-9), 1 + walk.s);
}

/// Whether a point of the cover is drawn, and if so what the mirrors on the geodesic from the eye make of it.
bool StraightRays::is_drawn(const Position& in_cover, trace::Path& path) const {
  const trace::Segment sight = trace::segment_between(scene_->prism.space, eye_, in_cover);
  trace::FollowOptions options = limits_;
  options.max_length = sight.length * (1 - kPastHit) - kPastHit;
  if (!(options.max_length > 0)) return true;
  const trace::Path seen = trace::follow(bare_, sight.ray, options);
  if (seen.cut_off || seen.hit.kind != trace::HitKind::none) return false;
  path.throughput = seen.throughput;
  path.bounces = seen.bounces;
  return true;
}

trace::Path StraightRays::follow(const trace::Ray& first) const {
  const Space space = scene_->prism.space;
  Walk walk{space, chart_of(space, first.at), chart_direction(first.at, first.along), first.z, first.c, first.m, 0, {}};
  walk.reflections.room_from_cover = geometry::identity(space);
  Walk::Reflections& met = walk.reflections;
  trace::Path nothing;
  nothing.cut_off = true;
  const double radius = space == Space::hyperbolic ? kStraightScale * (1 - kRim) : kStraightHorizon;
  const double end = leaves_circle(walk.start, walk.along, radius) / std::max(walk.c, 1e-9);
  for (int piece = 0; piece < kMostPieces && walk.s < end; ++piece) {
    const double next = std::min(end, walk.s + piece_length(walk));
    const trace::Segment segment = trace::segment_between(space, walk.room_position(walk.s), walk.room_position(next));
    trace::Ray ray = segment.ray;
    double left = segment.length;
    for (;;) {
      trace::FollowOptions options;
      options.max_bounces = 0;
      options.max_length = left;
      trace::Path path = trace::follow(*scene_, ray, options);
      if (path.hit.kind == trace::HitKind::none) break;
      if (path.cut_off) {
        if (path.hit.kind == trace::HitKind::wall) {
          const auto wall = static_cast<std::size_t>(path.hit.wall);
          met.room_from_cover = reflections_[wall] * met.room_from_cover;
          if (++met.count % 8 == 0) met.room_from_cover = geometry::renormalised(met.room_from_cover);
          ray = trace::reflected_in_wall(scene_->prism, ray, path.hit.t, path.hit.wall);
        } else {
          const bool is_ceiling = path.hit.kind == trace::HitKind::ceiling;
          if (is_ceiling) met.offset += 2 * scene_->interior->height * met.sign;
          met.sign = -met.sign;
          if (std::fabs(met.offset) > 2 * scene_->interior->height * (limits_.max_bounces + 2)) return nothing;
          ray = trace::reflected_in_plane(scene_->prism, ray, path.hit.t, is_ceiling ? trace::kCeiling : trace::kFloor);
        }
        left -= path.length;
        continue;
      }
      const Position in_room = trace::position_at(space, ray, path.hit.t);
      const Position in_cover{geometry::inverse(met.room_from_cover) * in_room.floor, met.sign * in_room.z + met.offset};
      if (is_drawn(in_cover, path)) {
        path.length = math::hypot(modulus(chart_of(space, in_cover.floor) - walk.start), in_cover.z - walk.z);
        return path;
      }
      if (path.hit.kind != trace::HitKind::triangle) return nothing;  // nothing is drawn behind a wall, floor or ceiling
      ray.t_min = path.hit.t + kPastHit;
    }
    walk.s = next;
  }
  return nothing;
}

}  // namespace orbc::render
