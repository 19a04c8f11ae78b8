#include "compiler/light/guide.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "compiler/base/elementary.h"
#include "compiler/light/connection.h"
#include "compiler/light/falloff.h"
#include "compiler/room/room.h"
#include "compiler/trace/analytic.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using geometry::Vector3;

constexpr double kLobeProbability = 0.5;      // of directions from lobes: the variance at most doubles where they are of no use
constexpr double kSpotRadiusPerDistance = 2;  // of the lamp: 55 % of the light on that side falls within this radius
constexpr double kMinLobeCosine = 0.5;        // wider cones are no better than the cosine density
constexpr double kMaxWallSpotDistance = 3;    // between a lamp and its mirror image: farther walls get no spot, nor do antipodes

// A unit vector orthogonal to n (Duff et al., Building an orthonormal basis, revisited, JCGT 2017).
Vector3 any_orthogonal(const Vector3& n) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
}

// The direction at an angle of this cosine to the axis, turned around it by phi.
Vector3 cone_direction(const Vector3& axis, double cosine, double phi) {
  const Vector3 e = any_orthogonal(axis), f = cross(axis, e);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return cosine * axis + (sine * math::cos(phi)) * e + (sine * math::sin(phi)) * f;
}

// The lobe towards a hot spot, with a probability in proportion to the light that the spot may send to the point if nothing blocks it.
std::optional<Guide::Lobe> lobe_of(const LightingContext& lighting, const LampImage& image, const HotSpot& spot,
                                   const surface::ShadingPoint& point, const Guide& guide) {
  const Space space = lighting.scene.prism.space;
  const PlacedLamp& lamp = lamp_of_image(lighting, image);
  const Connection connection = connect(space, point.at, spot.at, image.sheet);
  if (!connection.valid) return std::nullopt;
  const double radius = kSpotRadiusPerDistance * spot.distance, size = math::hypot(connection.length, radius),
               cosine = connection.length / size;
  const Vector3 axis = surface::to_local(space, guide.frame, connection.direction);
  if (cosine < kMinLobeCosine) return std::nullopt;
  if (dot(axis, guide.normal) < 1e-6) return std::nullopt;  // a spot in the plane of the surface adds nothing
  // The cosines at both ends are raised by the extent of the spot, parts of which lie nearer or higher.
  const double cos_point = dot(axis, guide.normal) + radius / size;
  const double cos_spot = spot.horizontal ? std::fabs(connection.direction.z) + radius / size : 1;
  const double power = std::max({lamp.power.r, lamp.power.g, lamp.power.b}) * image.max_throughput * spot.angular_intensity;
  Guide::Lobe lobe;
  lobe.axis = axis;
  lobe.cosine = cosine;
  lobe.probability =
      power * std::min(cos_point, 1.0) * std::min(cos_spot, 1.0) * falloff(lamp.falloff, space, size, connection.arc, radius);
  if (lobe.probability <= 0) return std::nullopt;
  return lobe;
}

}  // namespace

std::vector<HotSpot> find_hot_spots(const PlacedLamp& lamp, const place::Interior& interior) {
  const Space space = interior.polygon.space;
  std::vector<bool> has_mirror(interior.polygon.walls.size(), false);
  bool plain_floor = true, plain_ceiling = true;
  for (const place::PlacedMirror& m : interior.mirrors) {
    if (m.wall >= 0) has_mirror[static_cast<std::size_t>(m.wall)] = true;
    else (m.wall == -1 ? plain_floor : plain_ceiling) = false;
  }
  std::vector<HotSpot> spots;
  const auto add = [&](const Position& at, bool horizontal) {
    const trace::Segment to = trace::segment_between(space, lamp.centre, at);
    if (to.length < 1e-9) return;
    const double intensity = angular_intensity(lamp, trace::inner(space, {to.ray.c * to.ray.along, to.ray.m}, lamp.axes.front()));
    if (intensity > 0) spots.push_back({at, std::max(to.length, lamp.radius), intensity, horizontal});
  };
  if (plain_floor) add({lamp.centre.floor, 0}, true);
  if (plain_ceiling) add({lamp.centre.floor, interior.height}, true);
  for (std::size_t w = 0; w < has_mirror.size(); ++w) {
    if (has_mirror[w]) continue;
    const geometry::Point image = room::reflection_in_wall(interior.polygon, static_cast<int>(w)) * lamp.centre.floor;
    if (geometry::distance(space, image, lamp.centre.floor) > kMaxWallSpotDistance) continue;
    add({geometry::midpoint(space, image, lamp.centre.floor), lamp.centre.z}, false);
  }
  return spots;
}

Guide guide_at(const LightingContext& lighting, const surface::ShadingPoint& point) {
  const Space space = lighting.scene.prism.space;
  Guide guide;
  guide.frame = surface::tangent_frame(space, point.at.floor);
  guide.normal = geometry::normalised(surface::to_local(space, guide.frame, point.normal));
  guide.geometric_normal = point.on_triangle ? surface::to_local(space, guide.frame, point.geometric_normal) : guide.normal;
  guide.tangent = any_orthogonal(guide.normal);
  guide.bitangent = cross(guide.normal, guide.tangent);
  std::vector<Guide::Lobe> lobes;
  for (const std::uint32_t i : images_at(lighting, point.at)) {
    const LampImage& image = lighting.lamps->images[i];
    for (const HotSpot& spot : image.hot_spots)
      if (const auto lobe = lobe_of(lighting, image, spot, point, guide)) lobes.push_back(*lobe);
  }
  if (lobes.empty()) return guide;
  // Rounded: lobes that are equal by symmetry keep their order, whatever the last bits say.
  std::stable_sort(lobes.begin(), lobes.end(), [](const Guide::Lobe& a, const Guide::Lobe& b) {
    return static_cast<float>(a.probability) > static_cast<float>(b.probability);
  });
  guide.count = std::min<int>(static_cast<int>(lobes.size()), Guide::kMaxLobes);
  double sum = 0;
  for (int i = 0; i < guide.count; ++i) sum += lobes[static_cast<std::size_t>(i)].probability;
  for (int i = 0; i < guide.count; ++i) {
    Guide::Lobe& lobe = guide.lobes[static_cast<std::size_t>(i)] = lobes[static_cast<std::size_t>(i)];
    lobe.probability *= kLobeProbability / sum;
    lobe.density = lobe.probability / (2 * std::numbers::pi * (1 - lobe.cosine));
  }
  guide.cosine_probability = 1 - kLobeProbability;
  return guide;
}

DirectionSample sample_direction(const Guide& guide, const std::array<double, 3>& u) {
  const double phi = 2 * std::numbers::pi * u[1];
  Vector3 d;
  if (u[0] < guide.cosine_probability || guide.count == 0) {
    const double r = std::sqrt(u[2]);
    d = std::sqrt(std::max(0.0, 1 - u[2])) * guide.normal + (r * math::cos(phi)) * guide.tangent + (r * math::sin(phi)) * guide.bitangent;
  } else {
    double left = u[0] - guide.cosine_probability;
    int i = 0;
    while (i + 1 < guide.count && left >= guide.lobes[static_cast<std::size_t>(i)].probability)
      left -= guide.lobes[static_cast<std::size_t>(i++)].probability;
    const Guide::Lobe& lobe = guide.lobes[static_cast<std::size_t>(i)];
    d = cone_direction(lobe.axis, 1 - u[2] * (1 - lobe.cosine), phi);
  }
  DirectionSample sample;
  const double cosine = dot(d, guide.normal);
  if (cosine <= 0) return sample;
  double density = guide.cosine_probability * cosine / std::numbers::pi;
  for (int i = 0; i < guide.count; ++i) {
    const Guide::Lobe& lobe = guide.lobes[static_cast<std::size_t>(i)];
    if (dot(d, lobe.axis) >= lobe.cosine) density += lobe.density;
  }
  sample.weight = cosine / (std::numbers::pi * density);
  // Below the flat triangle under a smooth normal there is only the triangle itself. Such directions are reflected at its plane.
  const double below = dot(d, guide.geometric_normal);
  if (below < 0) d = d - (2 * below) * guide.geometric_normal;
  sample.direction = surface::to_ambient(guide.frame, d);
  return sample;
}

}  // namespace orbc::light
