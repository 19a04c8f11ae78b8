#include "compiler/light/guide.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/light/falloff.h"
#include "compiler/light/way.h"
#include "compiler/room/room.h"
#include "compiler/trace/analytic.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using geometry::Vector3;

constexpr double kGuided = 0.5;  // share of directions towards spots: the variance is at most doubled where they are of no use
constexpr double kSpread = 2;    // radius of a spot over its distance from the lamp: within it lies 55 % of the light on that side
constexpr double kWidest = 0.5;  // cosine: wider cones are no better than the cosine alone

// A vector across n; Duff et al., Building an orthonormal basis, revisited (JCGT 2017).
Vector3 across(const Vector3& n) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
}

Vector3 about(const Vector3& axis, double cosine, double turn) {
  const Vector3 e = across(axis), f = cross(axis, e);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return cosine * axis + (sine * math::cos(turn)) * e + (sine * math::sin(turn)) * f;
}

void add_lobe(const LightField& field, const LampImage& image, const Foot& foot, const surface::LightPoint& point,
              std::vector<Guide::Lobe>& lobes, const Guide& guide) {
  const Space space = field.scene.prism.space;
  const HungLamp& lamp = field.lamps[static_cast<std::size_t>(image.lamp)];
  const Way way = way_to(space, point.at, foot.at, image.sheet);
  if (!way.exists) return;
  const double radius = kSpread * foot.reach, size = math::hypot(way.length, radius), cosine = way.length / size;
  const Vector3 axis = surface::local(space, guide.frame, way.start);
  if (cosine < kWidest) return;
  // How much the spot may add, were it seen: its cosines, never quite 0 for the part of it that lies nearer or higher. A spot on the
  // surface's own plane adds nothing.
  if (dot(axis, guide.normal) < 1e-6) return;
  const double here = dot(axis, guide.normal) + radius / size;
  const double there = foot.upright ? std::fabs(way.start.z) + radius / size : 1;
  const double power = std::max({lamp.power.r, lamp.power.g, lamp.power.b}) * image.weight * foot.share;
  Guide::Lobe lobe;
  lobe.axis = axis;
  lobe.cosine = cosine;
  lobe.share = power * std::min(here, 1.0) * std::min(there, 1.0) * falloff(lamp.falloff, space, size, way.arc, radius);
  if (lobe.share > 0) lobes.push_back(lobe);
}

}  // namespace

std::vector<Foot> feet_of(const HungLamp& lamp, const place::PlacedRoom& room) {
  const Space space = room.room.space;
  std::vector<bool> mirror(room.room.walls.size(), false);
  bool floor = true, ceiling = true;
  for (const place::PlacedMirror& m : room.mirrors) {
    if (m.wall >= 0) mirror[static_cast<std::size_t>(m.wall)] = true;
    else (m.wall == -1 ? floor : ceiling) = false;
  }
  std::vector<Foot> feet;
  const auto add = [&](const Position& at, bool upright) {
    const trace::Segment to = trace::segment_between(space, lamp.centre, at);
    if (to.length < 1e-9) return;
    const double share = profile(lamp, trace::inner(space, {to.ray.c * to.ray.along, to.ray.m}, lamp.axes.front()));
    if (share > 0) feet.push_back({at, std::max(to.length, lamp.radius), share, upright});
  };
  if (floor) add({lamp.centre.floor, 0}, true);
  if (ceiling) add({lamp.centre.floor, room.height}, true);
  for (std::size_t w = 0; w < mirror.size(); ++w) {
    if (mirror[w]) continue;
    const geometry::Point image = room::reflection_in_wall(room.room, static_cast<int>(w)) * lamp.centre.floor;
    if (geometry::distance(space, image, lamp.centre.floor) > 3) continue;  // too far to make a spot, and perhaps an antipode
    add({geometry::midpoint(space, image, lamp.centre.floor), lamp.centre.z}, false);
  }
  return feet;
}

Guide guide_at(const LightField& field, const surface::LightPoint& point) {
  const Space space = field.scene.prism.space;
  Guide guide;
  guide.frame = surface::frame_at(space, point.at.floor);
  guide.normal = geometry::normalised(surface::local(space, guide.frame, point.normal));
  guide.flat = point.on_triangle ? surface::local(space, guide.frame, point.flat) : guide.normal;
  guide.across = across(guide.normal);
  guide.other = cross(guide.normal, guide.across);
  std::vector<Guide::Lobe> lobes;
  for (const std::uint32_t i : images_at(field, point.at)) {
    const LampImage& image = field.images[i];
    for (const Foot& foot : image.feet) add_lobe(field, image, foot, point, lobes, guide);
  }
  if (lobes.empty()) return guide;
  std::stable_sort(lobes.begin(), lobes.end(), [](const Guide::Lobe& a, const Guide::Lobe& b) { return a.share > b.share; });
  guide.count = std::min<int>(static_cast<int>(lobes.size()), Guide::kMost);
  double sum = 0;
  for (int i = 0; i < guide.count; ++i) sum += lobes[static_cast<std::size_t>(i)].share;
  for (int i = 0; i < guide.count; ++i) {
    Guide::Lobe& lobe = guide.lobes[static_cast<std::size_t>(i)] = lobes[static_cast<std::size_t>(i)];
    lobe.share *= kGuided / sum;
    lobe.density = lobe.share / (2 * std::numbers::pi * (1 - lobe.cosine));
  }
  guide.by_cosine = 1 - kGuided;
  return guide;
}

Chosen choose(const Guide& guide, const std::array<double, 3>& u) {
  const double turn = 2 * std::numbers::pi * u[1];
  Vector3 d;
  if (u[0] < guide.by_cosine || guide.count == 0) {
    const double r = std::sqrt(u[2]);
    d = std::sqrt(std::max(0.0, 1 - u[2])) * guide.normal + (r * math::cos(turn)) * guide.across + (r * math::sin(turn)) * guide.other;
  } else {
    double left = u[0] - guide.by_cosine;
    int i = 0;
    while (i + 1 < guide.count && left >= guide.lobes[static_cast<std::size_t>(i)].share)
      left -= guide.lobes[static_cast<std::size_t>(i++)].share;
    const Guide::Lobe& lobe = guide.lobes[static_cast<std::size_t>(i)];
    d = about(lobe.axis, 1 - u[2] * (1 - lobe.cosine), turn);
  }
  Chosen chosen;
  const double cosine = dot(d, guide.normal);
  if (cosine <= 0) return chosen;
  double density = guide.by_cosine * cosine / std::numbers::pi;
  for (int i = 0; i < guide.count; ++i)
    if (dot(d, guide.lobes[static_cast<std::size_t>(i)].axis) >= guide.lobes[static_cast<std::size_t>(i)].cosine)
      density += guide.lobes[static_cast<std::size_t>(i)].density;
  chosen.weight = cosine / (std::numbers::pi * density);
  // Below the flat triangle under a smooth normal there is only the triangle itself: such directions are turned up at it.
  const double below = dot(d, guide.flat);
  if (below < 0) d = d - (2 * below) * guide.flat;
  chosen.direction = surface::global(guide.frame, d);
  return chosen;
}

}  // namespace orbc::light
