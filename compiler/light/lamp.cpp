// Samples: a Kronecker sequence (golden ratio, and in two dimensions the plastic number: Roberts, The unreasonable effectiveness of
// quasirandom sequences, 2018), whose every beginning is well spread; each with its mirror image in the middle of the lamp, so that their
// mean is just there; spheres by Archimedes' map from the cylinder.
#include "compiler/light/lamp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/geometry/predicates.h"
#include "compiler/place/locate.h"
#include "compiler/surface/frame.h"
#include "compiler/surface/random.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using geometry::Vector3;
using scene::LampKind;

constexpr int kSamples = 128;           // of a lamp with an extent; single points ask the first of them, pixels of many samples all
constexpr double kPointRadius = 0.02;   // points have none; this keeps the focus of S² finite
constexpr double kDefaultHeight = 0.9;  // of the room's

// From the fifth on samples come in pairs about the middle: which pair, and whether it is the second of it.
int pair_of(int i) { return (i - kDesign) / 2; }
bool opposite(int i) { return i >= kDesign && (i - kDesign) % 2 == 1; }

// The i-th point of the unit square; the first four have its mean and its second moments, the others come in equal pairs.
std::array<double, 2> spread(int i) {
  constexpr double kAside = 0.28867513459481287;  // 1/√12
  if (i < kDesign) return {0.5 + (i % 2 ? kAside : -kAside), 0.5 + (i / 2 ? kAside : -kAside)};
  constexpr double kPlastic = 1.32471795724474602596;
  const int k = pair_of(i) + 1;
  return {surface::fraction(0.5 + k / kPlastic), surface::fraction(0.5 + k / (kPlastic * kPlastic))};
}

/// The lamp's own frame: axis, and two vectors across.
struct Mount {
  surface::Frame floor;
  Vector3 axis{0, 0, -1}, across{1, 0, 0}, other{0, -1, 0};
};

Mount mount_of(Space space, const Position& centre, const std::optional<Position>& to) {
  Mount mount;
  mount.floor = surface::frame_at(space, centre.floor);
  if (!to) return mount;
  const trace::Segment segment = trace::segment_between(space, centre, *to);
  if (segment.length <= 0) return mount;
  mount.axis = geometry::normalised(surface::local(space, mount.floor, {segment.ray.c * segment.ray.along, segment.ray.m}));
  const double h = math::hypot(mount.axis.x, mount.axis.y);
  if (h < 1e-9) {
    mount.axis = {0, 0, mount.axis.z < 0 ? -1.0 : 1.0};
    return mount;
  }
  mount.across = {-mount.axis.y / h, mount.axis.x / h, 0};  // level
  mount.other = geometry::cross(mount.axis, mount.across);
  return mount;
}

Vector3 offset(const scene::Lamp& lamp, const Mount& mount, int i) {
  if (opposite(i)) return -1.0 * offset(lamp, mount, i - 1);
  const auto [u, v] = spread(i);
  if (lamp.kind == LampKind::rectangle) return ((u - 0.5) * lamp.size[0]) * mount.across + ((v - 0.5) * lamp.size[1]) * mount.other;
  const double turn = 2 * std::numbers::pi * u;
  if (lamp.kind == LampKind::disk && i < kDesign)
    return ((i % 2 ? 0.5 : -0.5) * lamp.radius) * mount.across + ((i / 2 ? 0.5 : -0.5) * lamp.radius) * mount.other;
  if (lamp.kind == LampKind::disk)
    return (lamp.radius * std::sqrt(v) * math::cos(turn)) * mount.across + (lamp.radius * std::sqrt(v) * math::sin(turn)) * mount.other;
  // Points of the ball whose shadow on any plane is the even disk of a Lambertian sphere up to its rim: on its sphere of radius √(3/4).
  if (i < kDesign) {  // a tetrahedron
    const double side = lamp.radius / 2, x = i == 0 || i == 1 ? side : -side, y = i == 0 || i == 2 ? side : -side;
    return {x, y, i == 0 || i == 3 ? side : -side};
  }
  const double z = 1 - 2 * v, r = std::sqrt(std::max(0.0, 1 - z * z)), size = lamp.radius * 0.8660254037844386;
  return {size * r * math::cos(turn), size * r * math::sin(turn), size * z};
}

void add_samples(const scene::Lamp& lamp, Space space, const std::optional<Position>& to, HungLamp& hung) {
  if (lamp.kind == LampKind::tube) {
    const trace::Segment segment = trace::segment_between(space, hung.centre, *to);
    const auto add = [&](double t) {
      hung.samples.push_back(trace::position_at(space, segment.ray, t));
      hung.axes.push_back(trace::direction_at(space, segment.ray, t));
    };
    add(segment.length / 2);
    for (const double u : {0.104, 0.4, 0.6, 0.896}) add(segment.length * u);  // mean ½, variance 1/12
    for (int i = kDesign; i < kSamples; ++i) {
      const double u = surface::fraction(0.5 + (pair_of(i) + 1) * 0.6180339887498949);
      add(segment.length * (opposite(i) ? 1 - u : u));
    }
    hung.centre = hung.samples.front();
    hung.extent = segment.length / 2 + lamp.radius;
    return;
  }
  const Mount mount = mount_of(space, hung.centre, to);
  hung.samples.push_back(hung.centre);
  hung.axes.push_back(surface::global(mount.floor, mount.axis));
  if (lamp.kind == LampKind::point || lamp.kind == LampKind::spot) return;
  for (int i = 0; i < kSamples; ++i) {
    const Vector3 v = offset(lamp, mount, i);
    hung.extent = std::max(hung.extent, geometry::length(v));
    hung.samples.push_back(surface::exponential(space, hung.centre, mount.floor, v));
    hung.axes.push_back(hung.axes.front());
  }
}

void set_profile(const scene::Lamp& lamp, HungLamp& hung) {
  if (lamp.kind == LampKind::rectangle || lamp.kind == LampKind::disk) hung.gain = 4;
  if (lamp.kind == LampKind::tube) hung.gain = 4 / std::numbers::pi;
  if (lamp.kind != LampKind::spot) return;
  hung.cone_outer = math::cos(lamp.cone.radians / 2);
  hung.cone_inner = math::cos(0.9 * lamp.cone.radians / 2);
  hung.gain = 2 / (1 - (hung.cone_inner + hung.cone_outer) / 2);  // the smooth step has the mean of its ends
}

bool inside(const room::Room& room, double height, const Position& p) {
  return geometry::contains(room.outline, p.floor) != geometry::Containment::outside && p.z >= 0 && p.z <= height;
}

}  // namespace

double profile(const HungLamp& lamp, double cos_axis) {
  switch (lamp.kind) {
    case LampKind::rectangle:
    case LampKind::disk:
      return std::max(0.0, lamp.gain * cos_axis);
    case LampKind::tube:
      return lamp.gain * std::sqrt(std::max(0.0, 1 - cos_axis * cos_axis));
    case LampKind::spot: {
      const double t = std::clamp((cos_axis - lamp.cone_outer) / (lamp.cone_inner - lamp.cone_outer), 0.0, 1.0);
      return lamp.gain * t * t * (3 - 2 * t);
    }
    default:
      return 1;
  }
}

Result<HungLamps> hang_lamps(const scene::Scene& scene, const room::Room& room) {
  HungLamps result;
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
    HungLamp hung;
    hung.kind = lamp.kind, hung.falloff = lamp.falloff, hung.centre = *centre;
    hung.power = lamp.power * lamp.color;
    hung.radius = lamp.kind == LampKind::point || lamp.kind == LampKind::spot ? kPointRadius
                  : lamp.kind == LampKind::rectangle                          ? std::min(lamp.size[0], lamp.size[1]) / 2
                                                                              : lamp.radius;
    add_samples(lamp, room.space, to, hung);
    set_profile(lamp, hung);
    const auto out = std::find_if(hung.samples.begin(), hung.samples.end(), [&](const Position& p) { return !inside(room, height, p); });
    if (out != hung.samples.end()) {
      fail({make_error("light.lamp-in-wall", fmt::format("lamp {} reaches through a wall, the floor or the ceiling", i + 1),
                       fmt::format("move it into the room, or make it smaller; the room is {} high", place::to_text(height)),
                       lamp.place.span)});
      continue;
    }
    if (lamp.power <= 0)
      result.warnings.push_back(
          make_warning("light.no-power", fmt::format("lamp {} has no power", i + 1), "give it a `power`, such as 10", lamp.span));
    result.lamps.push_back(std::move(hung));
  }
  if (has_error(errors)) return errors;
  return result;
}

}  // namespace orbc::light
