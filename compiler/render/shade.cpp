// Mirror objects: reflection in the product metric. Glass: both branches are followed while their share counts, so that no random number
// is needed for what the eye sees through it.
#include "compiler/render/shade.h"

#include <algorithm>

#include "compiler/light/leg.h"
#include "compiler/render/path.h"

namespace orbc::render {
namespace {

using scene::Color;
using trace::Direction;

constexpr double kLeastShare = 1.0 / 512;  // a branch of glass below it cannot change an 8-bit picture

Color at_most(const Color& c, double most) { return {std::min(c.r, most), std::min(c.g, most), std::min(c.b, most)}; }

struct Walker {
  const trace::TraceScene& scene;
  const DrawOptions& options;
  Chance chance;
  Seen& seen;

  void add(const Color& radiance) {
    seen.radiance = seen.radiance + radiance;
    seen.most = seen.most + radiance;
  }

  void go_on(const trace::Path& path, const trace::SurfacePoint& at, const Direction& direction, const Color& weight, double share,
             int depth) {
    trace::FollowOptions follow = follow_options(options);
    follow.weight = weight;
    follow.bounces = path.bounces;
    follow.length = path.length;
    light(trace::follow(scene, trace::leave(scene, at, direction), follow), share, depth + 1);
  }

  // The surface that the triangles stand for: seen in facets, mirror and glass would be mosaics. Not where it turns away from the ray,
  // or would mirror it into the triangle.
  void smooth(trace::SurfacePoint& point, const trace::Hit& hit) {
    if (!options.light || hit.target != trace::Target::triangle) return;
    const geometry::Space space = scene.room->room.space;
    Direction normal = light::light_point(*options.light, *scene.room, point, hit).normal;
    if (trace::inner(space, normal, point.normal) < 0) normal = -normal;
    const Direction flat = point.normal;
    if (trace::inner(space, normal, point.arriving) < 0) point.normal = normal;
    if (trace::inner(space, light::mirrored(scene, point), flat) <= 0) point.normal = flat;
  }

  // What a surface that is neither mirror nor glass shows under the lamps.
  void lit(const trace::Path& path, const trace::SurfacePoint& point, const scene::Material& material, const Color& color, double share) {
    const light::LightField& field = *options.light;
    const Color weight = share * path.weight;
    if (material.kind == scene::MaterialKind::emissive) return add(weight * light::radiance_out(field, material, color, {}));
    const light::LightPoint at = light::light_point(field, *scene.room, point, path.hit);
    const bool shines = material.kind == scene::MaterialKind::glossy || material.kind == scene::MaterialKind::metal;
    const double white = light::white_of(field);
    const auto known = options.baked ? options.baked->at(point, path.hit) : std::nullopt;
    Color out = known ? white * *known : light::radiance_out(field, material, color, light::irradiance(field, at, chance.turn));
    if (shines) out = out + light::highlight(field, at, -point.arriving, material, color, chance.turn);
    out = at_most(out, white);
    if (known || field.options.passes == 0) return add(weight * out);
    // What a guess lifts beyond white must not be cut off guess by guess: their mean would become too dark.
    const Color more = color * passed_on(*scene.room, field, at, chance, options.paths);
    const Color kept{out.r < white ? more.r : 0, out.g < white ? more.g : 0, out.b < white ? more.b : 0};
    seen.radiance = seen.radiance + weight * (out + kept);
    seen.passed_on = seen.passed_on + weight * kept;
    seen.most = seen.most + white * weight;
  }

  void light(const trace::Path& path, double share, int depth) {
    add(share * path.glow);
    if (path.cut_off || path.hit.target == trace::Target::nothing)
      return add(share * (options.weighs_background ? path.weight * options.background : options.background));
    trace::SurfacePoint point = trace::surface_at(scene, path.last, path.hit);
    if (depth == 0) seen.surface = point, seen.hit = true;
    const scene::Material* material = point.look >= 0 ? &scene.room->looks[static_cast<std::size_t>(point.look)].material : nullptr;
    const Color color = light::surface_color(*scene.room, point);
    if (!material) return add(share * (path.weight * at_most(color, options.white)));
    const bool glows = material->kind == scene::MaterialKind::emissive;
    if (glows && !options.light) return add(share * (path.weight * at_most(material->emission * color, options.white)));
    const bool mirror = material->kind == scene::MaterialKind::mirror, glass = material->kind == scene::MaterialKind::glass;
    if (!(mirror || glass) || depth >= options.max_depth) {
      if (options.light) return lit(path, point, *material, color, share);
      return add(share * (path.weight * at_most(color, options.white)));
    }
    smooth(point, path.hit);
    if (mirror) return go_on(path, point, light::mirrored(scene, point), path.weight * color, share, depth);
    const light::Refraction through = light::refracted(scene, point, material->index);
    const double back = share * through.reflectance, on = share * (1 - through.reflectance);
    if (back >= kLeastShare) go_on(path, point, light::mirrored(scene, point), path.weight, back, depth);
    if (on < kLeastShare) return;
    trace::SurfacePoint behind = point;
    behind.normal = -point.normal;
    go_on(path, behind, through.direction, point.outside ? path.weight * color : path.weight, on, depth);
  }
};

}  // namespace

trace::FollowOptions follow_options(const DrawOptions& options) {
  trace::FollowOptions follow;
  follow.max_bounces = options.max_bounces;
  follow.min_weight = options.min_weight;
  return follow;
}

Seen radiance(const trace::TraceScene& scene, trace::Path path, const DrawOptions& options, const Chance& chance) {
  Seen seen;
  seen.path = std::move(path);
  Walker{scene, options, chance, seen}.light(seen.path, 1, 0);
  return seen;
}

Seen radiance(const trace::TraceScene& scene, const trace::Ray& ray, const DrawOptions& options, const Chance& chance) {
  return radiance(scene, trace::follow(scene, ray, follow_options(options)), options, chance);
}

}  // namespace orbc::render
