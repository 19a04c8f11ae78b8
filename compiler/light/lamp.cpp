// Samples follow a Kronecker sequence: of the golden ratio, in two dimensions of the plastic number (Roberts, The unreasonable
// effectiveness of quasirandom sequences, 2018). Every first part of it is well spread. Each sample is followed by its mirror image about
// the lamp's centre, so that their mean is the centre. Spheres use Archimedes' map from the cylinder.
#include "compiler/light/lamp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/geometry/predicates.h"
#include "compiler/place/locate.h"
#include "compiler/surface/sampling.h"
#include "compiler/surface/tangent_frame.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using geometry::Vector3;
using scene::LampKind;

constexpr int kSamples = 128;           // of a lamp with an extent; single points use the first of them, pixels with many samples all
constexpr double kPointRadius = 0.02;   // of points and spots, which have no extent: it keeps the focus of S² finite
constexpr double kDefaultHeight = 0.9;  // of the room's

// Samples beyond the quadrature come in pairs about the centre.
int pair_index(int i) { return (i - kQuadratureSamples) / 2; }
bool is_second_of_pair(int i) { return i >= kQuadratureSamples && (i - kQuadratureSamples) % 2 == 1; }

// Sample i in the unit square. The quadrature has the square's mean and second moments.
std::array<double, 2> square_sample(int i) {
  constexpr double kAside = 0.28867513459481287;  // 1/√12
  if (i < kQuadratureSamples) return {0.5 + (i % 2 ? kAside : -kAside), 0.5 + (i / 2 ? kAside : -kAside)};
  constexpr double kPlastic = 1.32471795724474602596;
  const int k = pair_index(i) + 1;
  return {surface::fract(0.5 + k / kPlastic), surface::fract(0.5 + k / (kPlastic * kPlastic))};
}

/// Orthonormal vectors of a lamp, in the tangent frame at its centre.
struct LampFrame {
  surface::TangentFrame tangent;
  Vector3 axis{0, 0, -1}, right{1, 0, 0}, up{0, -1, 0};
};

LampFrame lamp_frame(Space space, const Position& centre, const std::optional<Position>& to) {
  LampFrame frame;
  frame.tangent = surface::tangent_frame(space, centre.floor);
  if (!to) return frame;
  const trace::Segment segment = trace::segment_between(space, centre, *to);
  if (segment.length <= 0) return frame;
  frame.axis = geometry::normalised(surface::to_local(space, frame.tangent, {segment.ray.c * segment.ray.along, segment.ray.m}));
  const double h = math::hypot(frame.axis.x, frame.axis.y);
  if (h < 1e-9) {
    frame.axis = {0, 0, frame.axis.z < 0 ? -1.0 : 1.0};
    return frame;
  }
  frame.right = {-frame.axis.y / h, frame.axis.x / h, 0};  // horizontal
  frame.up = geometry::cross(frame.axis, frame.right);
  return frame;
}

// Sample i as a vector from the centre.
Vector3 sample_offset(const scene::Lamp& lamp, const LampFrame& frame, int i) {
  if (is_second_of_pair(i)) return -1.0 * sample_offset(lamp, frame, i - 1);
  const auto [u, v] = square_sample(i);
  if (lamp.kind == LampKind::rectangle) return ((u - 0.5) * lamp.size[0]) * frame.right + ((v - 0.5) * lamp.size[1]) * frame.up;
  const double phi = 2 * std::numbers::pi * u;
  if (lamp.kind == LampKind::disk && i < kQuadratureSamples)
    return ((i % 2 ? 0.5 : -0.5) * lamp.radius) * frame.right + ((i / 2 ? 0.5 : -0.5) * lamp.radius) * frame.up;
  if (lamp.kind == LampKind::disk)
    return (lamp.radius * std::sqrt(v) * math::cos(phi)) * frame.right + (lamp.radius * std::sqrt(v) * math::sin(phi)) * frame.up;
  // A Lambertian sphere looks like an evenly bright disk. Points on the sphere of radius √(3/4)·r have the second moments of that disk.
  if (i < kQuadratureSamples) {  // a tetrahedron
    const double side = lamp.radius / 2, x = i == 0 || i == 1 ? side : -side, y = i == 0 || i == 2 ? side : -side;
    return {x, y, i == 0 || i == 3 ? side : -side};
  }
  const double z = 1 - 2 * v, r = std::sqrt(std::max(0.0, 1 - z * z)), size = lamp.radius * 0.8660254037844386;
  return {size * r * math::cos(phi), size * r * math::sin(phi), size * z};
}

/// The samples of a lamp: see PlacedLamp.
struct LampSamples {
  std::vector<Position> positions;
  std::vector<trace::Direction> axes;
  double extent = 0;
};

LampSamples tube_samples(const scene::Lamp& lamp, Space space, const Position& from, const Position& to) {
  const trace::Segment segment = trace::segment_between(space, from, to);
  LampSamples samples;
  const auto add = [&](double t) {
    samples.positions.push_back(trace::position_at(space, segment.ray, t));
    samples.axes.push_back(trace::direction_at(space, segment.ray, t));
  };
  add(segment.length / 2);
  for (const double u : {0.104, 0.4, 0.6, 0.896}) add(segment.length * u);  // mean ½, variance 1/12
  for (int i = kQuadratureSamples; i < kSamples; ++i) {
    const double u = surface::fract(0.5 + (pair_index(i) + 1) * 0.6180339887498949);
    add(segment.length * (is_second_of_pair(i) ? 1 - u : u));
  }
  samples.extent = segment.length / 2 + lamp.radius;
  return samples;
}

LampSamples lamp_samples(const scene::Lamp& lamp, Space space, const Position& centre, const std::optional<Position>& to) {
  if (lamp.kind == LampKind::tube) return tube_samples(lamp, space, centre, *to);
  const LampFrame frame = lamp_frame(space, centre, to);
  LampSamples samples;
  samples.positions.push_back(centre);
  samples.axes.push_back(surface::to_ambient(frame.tangent, frame.axis));
  if (lamp.kind == LampKind::point || lamp.kind == LampKind::spot) return samples;
  for (int i = 0; i < kSamples; ++i) {
    const Vector3 v = sample_offset(lamp, frame, i);
    samples.extent = std::max(samples.extent, geometry::length(v));
    samples.positions.push_back(surface::exponential(space, centre, frame.tangent, v));
    samples.axes.push_back(samples.axes.front());
  }
  return samples;
}

double falloff_radius(const scene::Lamp& lamp) {
  switch (lamp.kind) {
    case LampKind::point:
    case LampKind::spot:
      return kPointRadius;
    case LampKind::rectangle:
      return std::min(lamp.size[0], lamp.size[1]) / 2;
    default:
      return lamp.radius;
  }
}

PlacedLamp placed_lamp(const scene::Lamp& lamp, Space space, const Position& centre, const std::optional<Position>& to) {
  PlacedLamp placed;
  placed.kind = lamp.kind;
  placed.falloff = lamp.falloff;
  placed.power = lamp.power * lamp.color;
  placed.radius = falloff_radius(lamp);
  LampSamples samples = lamp_samples(lamp, space, centre, to);
  placed.centre = samples.positions.front();
  placed.samples = std::move(samples.positions);
  placed.axes = std::move(samples.axes);
  placed.extent = samples.extent;
  if (lamp.kind == LampKind::rectangle || lamp.kind == LampKind::disk) placed.peak_intensity = 4;
  if (lamp.kind == LampKind::tube) placed.peak_intensity = 4 / std::numbers::pi;
  if (lamp.kind == LampKind::spot) {
    placed.cone_outer = math::cos(lamp.cone.radians / 2);
    placed.cone_inner = math::cos(0.9 * lamp.cone.radians / 2);
    placed.peak_intensity = 2 / (1 - (placed.cone_inner + placed.cone_outer) / 2);  // the smooth step has the mean of its ends
  }
  return placed;
}

bool is_inside(const room::Room& room, double height, const Position& p) {
  return geometry::contains(room.outline, p.floor) != geometry::Containment::outside && p.z >= 0 && p.z <= height;
}

}  // namespace

double angular_intensity(const PlacedLamp& lamp, double cos_axis) {
  switch (lamp.kind) {
    case LampKind::rectangle:
    case LampKind::disk:
      return std::max(0.0, lamp.peak_intensity * cos_axis);
    case LampKind::tube:
      return lamp.peak_intensity * std::sqrt(std::max(0.0, 1 - cos_axis * cos_axis));
    case LampKind::spot: {
      const double t = std::clamp((cos_axis - lamp.cone_outer) / (lamp.cone_inner - lamp.cone_outer), 0.0, 1.0);
      return lamp.peak_intensity * t * t * (3 - 2 * t);
    }
    default:
      return 1;
  }
}

Result<PlacedLamps> place_lamps(const scene::Scene& scene, const room::Room& room) {
  PlacedLamps result;
  Diagnostics errors;
  const double height = scene.room.height;
  for (std::size_t i = 0; i < scene.lamps.size(); ++i) {
    const scene::Lamp& lamp = scene.lamps[i];
    const auto fail = [&](Diagnostics ds) {
      for (Diagnostic& d : located(std::move(ds), lamp.span)) errors.push_back(std::move(d));
    };
    const auto centre = place::locate(lamp.place, room, height, kDefaultHeight * height);
    if (!centre) {
      fail(centre.error());
      continue;
    }
    std::optional<Position> to;
    if (lamp.to) {
      const auto there = place::locate(*lamp.to, room, height, lamp.kind == LampKind::tube ? centre->z : 0);
      if (!there) {
        fail(there.error());
        continue;
      }
      to = *there;
    }
    PlacedLamp placed = placed_lamp(lamp, room.space, *centre, to);
    const auto out =
        std::find_if(placed.samples.begin(), placed.samples.end(), [&](const Position& p) { return !is_inside(room, height, p); });
    if (out != placed.samples.end()) {
      fail({make_error("light.lamp-in-wall", fmt::format("lamp {} reaches through a wall, the floor or the ceiling", i + 1),
                       fmt::format("move it into the room, or make it smaller; the room is {} high", place::to_text(height)),
                       lamp.place.span)});
      continue;
    }
    if (lamp.power <= 0)
      result.warnings.push_back(
          make_warning("light.no-power", fmt::format("lamp {} has no power", i + 1), "give it a `power`, such as 10", lamp.span));
    result.lamps.push_back(std::move(placed));
  }
  if (has_error(errors)) return errors;
  return result;
}

}  // namespace orbc::light
