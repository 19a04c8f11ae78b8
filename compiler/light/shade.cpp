// Light of a point: for every image of every lamp the straight geodesic to it, and, if it could matter, a shadow ray that is really turned
//                   back by the mirrors. How
// many points of a lamp are asked follows from what the image could add: a step of its shadow stays below what 8 bits show.
#include "compiler/light/shade.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compiler/light/falloff.h"
#include "compiler/light/frame.h"
#include "compiler/trace/analytic.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using scene::Color;
using trace::Direction;

constexpr double kStep = 0.012;       // of white: what one sample of a lamp may add
constexpr int kProbes = 4;            // samples that decide whether there is a penumbra at all
constexpr double kArrival = 1e-5;     // how near to the lamp's sample a shadow ray must end; its own error is below 1e-12 in rooms

double largest(const Color& c) { return std::max({c.r, c.g, c.b}); }

/// The straight path from a point to a sample of an image.
struct Way {
  Direction start;                  ///< unit, at the surface point
  double length = 0, arc = 0;
  trace::Ray ray;
  bool exists = false;
};

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

/// What a path brings along: nothing, or the weight of its mirrors.
Color arriving(const LightField& field, const LampImage& image, const HungLamp& lamp, std::size_t sample, const LightPoint& point,
               const Way& way) {
  const Space space = field.scene.prism.space;
  trace::Ray ray = trace::ray_from(space, point.origin, way.start);
  ray.leaves_wall = point.wall;
  ray.t_min = point.on_triangle ? trace::kLeave : 0;
  const ShadowPath path = reflected_path(field.scene, ray, way.length * (1 - 1e-9), field.options.bounces);
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

/// Light per unit of power that would come from a sample if nothing stood between, on a surface across the path; times its profile.
double unhindered(const LightField& field, const LampImage& image, const HungLamp& lamp, std::size_t sample, const LightPoint& point,
                  const Way& way) {
  const Space space = field.scene.prism.space;
  double value = falloff(lamp.falloff, space, way.length, way.arc, lamp.radius);
  if (lamp.kind == scene::LampKind::point || lamp.kind == scene::LampKind::sphere) return value;
  const trace::Ray ray = trace::ray_from(space, point.at, way.start);
  return value * profile(lamp, -trace::inner(space, trace::direction_at(space, ray, way.length), image.axes[sample]));
}

/// Adds up f(way, light) over the samples of an image, light = unhindered × weight; f(way) = 0 costs no ray.
template <class F>
Color gather(const LightField& field, const LampImage& image, const LightPoint& point, bool by_cosine, const F& f) {
  const Space space = field.scene.prism.space;
  const HungLamp& lamp = field.lamps[static_cast<std::size_t>(image.lamp)];
  const Way middle = way_to(space, point.origin, image.samples[0], image.sheet);
  const double power = largest(lamp.power) / std::numbers::pi * field.exposure;
  double most = power * image.weight * lamp.gain *
                falloff(lamp.falloff, space, std::max(middle.length - lamp.extent, lamp.radius), middle.arc, lamp.radius);
  if (most < field.options.cut) return {};
  if (by_cosine && middle.exists) {  // the lamp's own extent turns the direction to its samples by little
    const double cosine = trace::inner(space, middle.start, point.normal) + 2 * lamp.extent / middle.length;
    if (cosine <= 0 && middle.length > 2 * lamp.extent) return {};
    if (cosine < 1 && image.sheet == 0) most *= std::max(cosine, 0.0);
    if (most < field.options.cut) return {};
  }
  const int all = static_cast<int>(image.samples.size()) - 1;
  const int count = all > 0 ? std::clamp(static_cast<int>(std::ceil(most / kStep)), 1, all) : 1;
  const auto sample = [&](int i) { return static_cast<std::size_t>(count == 1 ? 0 : i + 1); };
  Color sum, seen;
  int asked = 0;
  bool same = true;
  for (int i = 0; i < count; ++i) {
    const Way way = way_to(space, point.origin, image.samples[sample(i)], image.sheet);
    if (!way.exists) continue;
    const double share = f(way);
    if (share <= 0) continue;
    const double light = share * unhindered(field, image, lamp, sample(i), point, way);
    if (light <= 0) continue;
    if (!(asked >= kProbes && same)) {
      const Color weight = arriving(field, image, lamp, sample(i), point, way);
      same = same && (asked == 0 || weight == seen);
      seen = weight;
      ++asked;
    }
    sum = sum + light * seen;
  }
  return (1.0 / count) * (lamp.power * sum);
}

bool inside_something(const trace::TraceScene& scene, const Position& p) {
  const trace::Ray ray = trace::ray_from(scene.prism.space, p, {{0, 0.6, 0.3}, 0.74});
  const trace::Hit hit = trace::closest_triangle(scene, ray);
  return hit.target == trace::Target::triangle && !trace::surface_at(scene, ray, hit).outside;
}

}  // namespace

Result<LightField> prepare_light(const scene::Scene& scene, const place::PlacedRoom& room, const LightOptions& options,
                                 const Executor& executor) {
  LightField field;
  field.lit = !scene.lamps.empty();
  if (!field.lit) {
    field.ambient = {1, 1, 1};
    return field;
  }
  auto hung = hang_lamps(scene, room.room);
  if (!hung) return hung.error();
  field.ambient = scene.ambient;
  field.exposure = scene.exposure;
  field.options = options;
  field.lamps = std::move(hung->lamps);
  field.warnings = std::move(hung->warnings);
  field.images = lamp_images(field.lamps, room, options.bounces);
  field.normals.resize(room.parts.size());
  executor(room.parts.size(), [&](std::size_t i) { field.normals[i] = part_normals(room, room.parts[i]); });
  auto casting = std::make_shared<place::PlacedRoom>(room);
  casting->textures.clear();
  casting->parts.erase(
      std::remove_if(casting->parts.begin(), casting->parts.end(), [](const place::PlacedMesh& part) { return lamp_of(part) >= 0; }),
      casting->parts.end());
  field.casting = casting;
  field.scene = trace::prepare(*field.casting, executor);
  for (std::size_t i = 0; i < field.lamps.size(); ++i)
    if (inside_something(field.scene, field.lamps[i].centre))
      field.warnings.push_back(make_warning("light.lamp-inside-object",
                                            fmt::format("lamp {} is inside an object, which keeps its light", i + 1), "move it out",
                                            scene.lamps[i].span));
  return field;
}

Color irradiance(const LightField& field, const LightPoint& point) {
  Color sum;
  const Space space = field.scene.prism.space;
  const auto cosine = [&](const Way& way) { return trace::inner(space, way.start, point.normal); };
  for (const LampImage& image : field.images) sum = sum + gather(field, image, point, true, cosine);
  return sum;
}

Color radiance_out(const LightField& field, const scene::Material& material, const Color& albedo, const Color& e) {
  Color out =
      material.kind == scene::MaterialKind::emissive ? material.emission * albedo : albedo * (field.ambient + (1 / std::numbers::pi) * e);
  const double white = 1 / std::max(field.exposure, 1e-300);
  return {std::min(out.r, white), std::min(out.g, white), std::min(out.b, white)};
}

LightPoint light_point(const LightField& field, const place::PlacedRoom& room, const trace::SurfacePoint& point, const trace::Hit& hit) {
  if (hit.target == trace::Target::triangle) {
    const auto part = static_cast<std::size_t>(hit.part);
    return light_point(room, room.parts[part], field.normals[part], static_cast<std::size_t>(hit.triangle), {hit.b[0], hit.b[1], hit.b[2]});
  }
  return {point.at, point.normal, point.at, point.wall, false};
}

Color highlight(const LightField& field, const LightPoint& point, const Direction& to_eye, const scene::Material& material,
                const Color& albedo) {
  const Space space = field.scene.prism.space;
  const double alpha = std::max(material.roughness * material.roughness, 0.002), a2 = alpha * alpha;
  const double nv = trace::inner(space, point.normal, to_eye);
  if (nv <= 0) return {};
  const bool metal = material.kind == scene::MaterialKind::metal;
  const double f0 = metal ? 1 : std::pow((material.index - 1) / (material.index + 1), 2);
  const auto smith = [&](double c) { return 2 * c / (c + std::sqrt(a2 + (1 - a2) * c * c)); };
  const auto shine = [&](const Way& way) {
    const double nl = trace::inner(space, point.normal, way.start);
    if (nl <= 0) return 0.0;
    const Direction sum = way.start + to_eye;
    const double size = std::sqrt(trace::inner(space, sum, sum));
    if (size < 1e-9) return 0.0;
    const Direction half = (1 / size) * sum;
    const double nh = trace::inner(space, point.normal, half), lh = trace::inner(space, way.start, half);
    const double base = nh * nh * (a2 - 1) + 1, d = a2 / (std::numbers::pi * base * base);
    const double fresnel = f0 + (1 - f0) * std::pow(1 - std::clamp(lh, 0.0, 1.0), 5);
    return fresnel * d * smith(nl) * smith(nv) / (4 * nv);
  };
  Color sum;
  for (const LampImage& image : field.images) sum = sum + gather(field, image, point, false, shine);
  return metal ? albedo * sum : sum;
}

}  // namespace orbc::light
