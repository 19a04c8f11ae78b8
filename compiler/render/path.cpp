// Path tracing with next-event estimation (Kajiya, The rendering equation, 1986) along geodesics. Because the product metric has an
// orthonormal frame at every point, everything local (cosines, solid angles, mirrors) is that of Euclidean space; the space shows only in
// where a direction leads, and in the falloff of lamps.
#include "compiler/render/path.h"

#include <algorithm>
#include <cmath>

#include "compiler/light/guide.h"
#include "compiler/light/way.h"
#include "compiler/render/shade.h"

namespace orbc::render {
namespace {

using scene::Color;
using trace::Direction;

constexpr int kSurePasses = 2;      // surfaces before which no path is ended by chance: they make most of the light

double largest(const Color& c) { return std::max({c.r, c.g, c.b}); }

struct Walk {
  const place::PlacedRoom& room;
  const DrawOptions& options;
  const light::LightField& field;
  light::Random& random;
  Color sum, weight{1, 1, 1};

  // Follows the ray to the next matte surface, through mirror and glass objects; none: the path is over.
  bool arrive(trace::Ray ray, trace::SurfacePoint& point, trace::Hit& hit) {
    trace::FollowOptions follow;
    follow.max_bounces = options.max_bounces;
    follow.min_weight = options.min_weight;
    for (int depth = 0; depth <= options.max_depth; ++depth) {
      const trace::Path path = trace::follow(field.scene, ray, follow);
      sum = sum + weight * path.glow;
      if (path.cut_off || path.hit.target == trace::Target::nothing) {
        sum = sum + weight * options.background;
        return false;
      }
      weight = weight * path.weight;
      hit = path.hit;
      point = trace::surface_at(field.scene, path.last, hit);
      const scene::Material* material = point.look >= 0 ? &room.looks[static_cast<std::size_t>(point.look)].material : nullptr;
      if (!material) return true;
      if (material->kind == scene::MaterialKind::emissive) {
        sum = sum + material->emission * (weight * surface_color(room, point));
        return false;
      }
      const bool mirror = material->kind == scene::MaterialKind::mirror;
      if (!mirror && material->kind != scene::MaterialKind::glass) return true;
      ray = mirror ? reflected(point) : through_glass(point, *material);
      follow.bounces = path.bounces;
    }
    return false;
  }

  trace::Ray reflected(const trace::SurfacePoint& point) {
    weight = weight * surface_color(room, point);
    return trace::leave(field.scene, point, mirrored(field.scene, point));
  }

  trace::Ray through_glass(trace::SurfacePoint point, const scene::Material& material) {
    const Refraction glass = refracted(field.scene, point, material.index);
    if (random.next() < glass.reflectance) return trace::leave(field.scene, point, mirrored(field.scene, point));
    if (point.outside) weight = weight * surface_color(room, point);
    point.normal = -point.normal;
    return trace::leave(field.scene, point, glass.direction);
  }

  // Whether the path goes on: by a chance that its weight makes up for.
  bool survives(int passes) {
    if (passes < kSurePasses) return true;
    const double chance = std::min(1.0, largest(weight));
    if (random.next() >= chance) return false;
    weight = (1 / chance) * weight;
    return true;
  }

  Color run(light::LightPoint at) {
    for (int passes = 0; passes < field.options.passes; ++passes) {
      if (!survives(passes)) break;
      const light::Chosen chosen = light::choose(light::guide_at(field, at), random.next_three());
      if (chosen.weight <= 0) break;
      weight = chosen.weight * weight;
      trace::SurfacePoint point;
      trace::Hit hit;
      if (!arrive(light::leaving(field, at, chosen.direction), point, hit)) break;
      at = light::light_point(field, *field.casting, point, hit);
      weight = weight * surface_color(room, point);
      sum = sum + weight * (field.ambient + (1 / 3.14159265358979323846) * light::irradiance_guess(field, at, random.next_three()));
      if (largest(weight) <= 0) break;
    }
    return sum;
  }
};

}  // namespace

Color passed_on(const place::PlacedRoom& room, const DrawOptions& options, const light::LightPoint& from, light::Random& random) {
  return Walk{room, options, *options.light, random, {}, {1, 1, 1}}.run(from);
}

double noise_of(const Film& film, double exposure) {
  if (film.error.empty()) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < film.error.size(); ++i) {
    const Color& c = film.color[i];
    const double value = exposure * largest(c), step = std::min(exposure * static_cast<double>(film.error[i]), 1.0);
    const double shown = 255 * (scene::encode_srgb(value + step) - scene::encode_srgb(std::max(0.0, value - step))) / 2;
    sum += shown * shown;
  }
  return std::sqrt(sum / static_cast<double>(film.error.size()));
}

}  // namespace orbc::render
