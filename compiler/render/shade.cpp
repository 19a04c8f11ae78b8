// Mirror objects: reflection in the product metric. Glass: Snell and Fresnel for unpolarised light (Born & Wolf §1.5); both branches are
// followed while their share counts, so that no random number is needed.
#include "compiler/render/shade.h"

#include <algorithm>
#include <cmath>

#include "compiler/light/shade.h"

namespace orbc::render {
namespace {

using scene::Color;
using trace::Direction;

constexpr double kLeastShare = 1.0 / 512;  // a branch of glass below it cannot change an 8-bit picture

// Share of light that a boundary of relative index `eta` (to / from) reflects, and the cosine of the refracted ray; 1 at total reflection.
double fresnel(double cosine, double eta, double& refracted) {
  const double sine2 = (1 - cosine * cosine) / (eta * eta);
  if (sine2 >= 1) return 1;
  refracted = std::sqrt(1 - sine2);
  const double parallel = (eta * cosine - refracted) / (eta * cosine + refracted);
  const double across = (cosine - eta * refracted) / (cosine + eta * refracted);
  return (parallel * parallel + across * across) / 2;
}

struct Walker {
  const trace::TraceScene& scene;
  const DrawOptions& options;

  Color go_on(const trace::Path& path, const trace::SurfacePoint& at, const Direction& direction, const Color& weight, double share, int depth) {
    trace::FollowOptions follow;
    follow.max_bounces = options.max_bounces;
    follow.min_weight = options.min_weight;
    follow.weight = weight;
    follow.bounces = path.bounces;
    follow.length = path.length;
    const trace::Path next = trace::follow(scene, trace::leave(scene, at, direction), follow);
    return light(next, share, depth + 1, nullptr, nullptr);
  }

  // What a surface that is neither mirror nor glass shows under the lamps.
  Color lit(const trace::Path& path, const trace::SurfacePoint& point, const scene::Material& material, const Color& color) {
    const light::LightField& field = *options.light;
    if (material.kind == scene::MaterialKind::emissive) return light::radiance_out(field, material, color, {});
    const light::LightPoint at = light::light_point(field, *scene.room, point, path.hit);
    const bool shines = material.kind == scene::MaterialKind::glossy || material.kind == scene::MaterialKind::metal;
    Color out = light::radiance_out(field, material, color, light::irradiance(field, at));
    if (shines) out = out + light::highlight(field, at, -point.arriving, material, color);
    const double white = 1 / std::max(field.exposure, 1e-300);
    return {std::min(out.r, white), std::min(out.g, white), std::min(out.b, white)};
  }

  Color light(const trace::Path& path, double share, int depth, trace::SurfacePoint* first, bool* hit) {
    if (path.cut_off || path.hit.target == trace::Target::nothing) return options.background;
    const trace::SurfacePoint point = trace::surface_at(scene, path.last, path.hit);
    if (first) *first = point, *hit = true;
    const scene::Material* material = point.look >= 0 ? &scene.room->looks[static_cast<std::size_t>(point.look)].material : nullptr;
    const Color color = surface_color(*scene.room, point);
    if (!material) return path.weight * color;
    const bool glows = material->kind == scene::MaterialKind::emissive;
    if (glows && !options.light) return material->emission * (path.weight * color);
    const bool mirror = material->kind == scene::MaterialKind::mirror, glass = material->kind == scene::MaterialKind::glass;
    if (!(mirror || glass) || depth >= options.max_depth) return path.weight * (options.light ? lit(path, point, *material, color) : color);

    const double cosine = std::clamp(-trace::inner(scene.room->room.space, point.arriving, point.normal), 0.0, 1.0);
    const Direction reflected = point.arriving + 2 * cosine * point.normal;
    if (mirror) return go_on(path, point, reflected, path.weight * color, share, depth);
    const double eta = point.outside ? material->index : 1 / material->index;
    double refracted_cosine = 0;
    const double reflectance = fresnel(cosine, eta, refracted_cosine);
    Color sum;
    if (share * reflectance >= kLeastShare) sum = sum + reflectance * go_on(path, point, reflected, path.weight, share * reflectance, depth);
    if (share * (1 - reflectance) >= kLeastShare) {
      const Direction refracted = (1 / eta) * point.arriving + (cosine / eta - refracted_cosine) * point.normal;
      trace::SurfacePoint through = point;
      through.normal = -point.normal;
      sum = sum + (1 - reflectance) * go_on(path, through, refracted, point.outside ? path.weight * color : path.weight, share * (1 - reflectance), depth);
    }
    return sum;
  }
};

}  // namespace

Color surface_color(const place::PlacedRoom& room, const trace::SurfacePoint& point) {
  light::SurfaceKey key;
  key.look = point.look, key.color = point.color;
  key.uv[0] = point.uv[0], key.uv[1] = point.uv[1];
  const place::PlacedMesh* part = point.part >= 0 ? &room.parts[static_cast<std::size_t>(point.part)] : nullptr;
  key.solid = part && !part->pattern_position.empty();
  key.pattern_position = point.pattern_position;
  return light::surface_albedo(room, key);
}

Seen radiance(const trace::TraceScene& scene, const trace::Ray& ray, const DrawOptions& options) {
  trace::FollowOptions follow;
  follow.max_bounces = options.max_bounces;
  follow.min_weight = options.min_weight;
  Seen seen;
  seen.path = trace::follow(scene, ray, follow);
  seen.radiance = Walker{scene, options}.light(seen.path, 1, 0, &seen.surface, &seen.hit);
  return seen;
}

}  // namespace orbc::render
