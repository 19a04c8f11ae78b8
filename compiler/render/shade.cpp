// Mirror objects: reflection in the product metric. Glass: both branches are followed while their share counts, so that no random number
// is needed for what the eye sees through it. Metals: facets, on ways of a lattice.
#include "compiler/render/shade.h"

#include <algorithm>

#include "compiler/light/leg.h"
#include "compiler/render/path.h"
#include "compiler/surface/lobe.h"

namespace orbc::render {
namespace {

using scene::Color;
using trace::Direction;

constexpr double kLeastShare = 1.0 / 512;   // a branch of glass below it cannot change an 8-bit picture,
constexpr double kLeastInMetal = 1.0 / 64;  // nor one below this what a metal shows

constexpr int kMostMetals = 3;            // that mirror each other
constexpr double kLeastMetal = 1.0 / 48;  // share below which a metal is not looked into
constexpr double kGlances = 1500;         // per α: gold's lobe (α = 0.02) is seen by 32 ways

Color at_most(const Color& c, double most) { return {std::min(c.r, most), std::min(c.g, most), std::min(c.b, most)}; }

/// How many ways to look for what a metal mirrors: the rougher, the more, until steps between them no longer show; fewer where it is faint.
int glances_of(const scene::Material& material, double counts, int most) {
  const double wanted = kGlances * surface::facet_width(material) * std::min(1.0, 2 * counts);
  int count = 2;
  while (1.5 * count < wanted && count < most) count *= 2;
  return std::min(count, most);
}

struct Walker {
  const trace::TraceScene& scene;
  const DrawOptions& options;
  Chance chance;
  Seen& seen;
  double part = 1;  // of what is added now: one of so many ways
  int metals = 0;   // met so far

  void add(const Color& radiance) {
    seen.radiance = seen.radiance + part * radiance;
    seen.most = seen.most + part * radiance;
  }

  // In: `bare`: the room without the bodies of its lamps, which facets have mirrored already.
  void go_on(const trace::Path& path, const trace::SurfacePoint& at, const Direction& direction, const Color& weight, double share,
             int depth, bool bare = false) {
    trace::FollowOptions follow = follow_options(options);
    follow.weight = weight;
    follow.bounces = path.bounces;
    follow.length = path.length;
    const trace::TraceScene& where = bare ? options.light->scene : scene;
    light(trace::follow(where, trace::leave(where, at, direction), follow), share, depth + 1, where);
  }

  // The surface that the triangles stand for: seen in triangles, mirror, glass and metal would be mosaics. Not where it turns away from the
  // ray, or would mirror it into the triangle.
  void smooth(trace::SurfacePoint& point, const trace::Hit& hit) {
    if (!options.light || hit.target != trace::Target::triangle) return;
    const geometry::Space space = scene.room->room.space;
    Direction normal = light::light_point(*options.light, *scene.room, point, hit).normal;
    if (trace::inner(space, normal, point.normal) < 0) normal = -normal;
    const Direction flat = point.normal;
    if (trace::inner(space, normal, point.arriving) < 0) point.normal = normal;
    if (trace::inner(space, surface::mirrored(scene, point), flat) <= 0) point.normal = flat;
  }

  // What a surface that is neither mirror nor glass shows under the lamps.
  void lit(const trace::Path& path, const trace::SurfacePoint& point, const scene::Material& material, const Color& color, double share) {
    const light::LightField& field = *options.light;
    const Color weight = share * path.weight;
    // In metal all counts that shines, since each way is but a part of what it shows.
    if (material.kind == scene::MaterialKind::emissive)
      return add(weight * (metals > 0 ? material.emission * color : light::radiance_out(field, material, color, {})));
    const surface::LightPoint at = light::light_point(field, *scene.room, point, path.hit);
    const double white = light::white_of(field);
    const auto known = options.baked ? options.baked->at(point, path.hit) : std::nullopt;
    Color out = known ? white * *known : light::radiance_out(field, material, color, light::irradiance(field, at, chance.turn));
    if (material.kind == scene::MaterialKind::glossy) out = out + light::highlight(field, at, -point.arriving, material, color);
    out = at_most(out, white);
    if (known || field.options.passes == 0) return add(weight * out);
    // What a guess lifts beyond white must not be cut off guess by guess: their mean would become too dark.
    const Color more = color * passed_on(*scene.room, field, at, chance, std::max(1, static_cast<int>(part * options.paths)));
    const Color kept{out.r < white ? more.r : 0, out.g < white ? more.g : 0, out.b < white ? more.b : 0};
    seen.radiance = seen.radiance + part * weight * (out + kept);
    seen.passed_on = seen.passed_on + part * weight * kept;
    seen.most = seen.most + part * white * weight;
  }

  // Metal seen in metal is, where it is faint or seen in a third, its plain colour; its inside is met by rounding alone.
  [[nodiscard]] bool mirrors(const trace::SurfacePoint& point, double share, int depth) const {
    return metals < kMostMetals && share >= kLeastMetal && (point.outside || depth == 0);
  }

  // The room in a metal's facets, each way of this sample a sample by itself; and the lamps, by their highlights. Together they show no
  // more than white, but what comes on single ways may: their mean counts.
  void metal(const trace::Path& path, trace::SurfacePoint point, const scene::Material& material, const Color& color, double share,
             int depth) {
    const light::LightField& field = *options.light;
    const Color face_on = surface::face_on(material, color), weight = part * share * path.weight, white = light::white_of(field) * weight;
    const surface::LightPoint at = light::light_point(field, *scene.room, point, path.hit);
    const Color lamps = least(weight * light::highlight(field, at, -point.arriving, material, color), white);
    const Color before = seen.radiance, most_before = seen.most;
    const Direction flat = point.normal;
    smooth(point, path.hit);
    const light::Turn turn = chance.turn;
    const int paths_before = chance.before;
    const int all = glances_of(material, share * largest(path.weight), std::max(1, options.glances >> (3 * metals)));
    const int count = std::max(1, all / turn.of);
    const double alpha = surface::facet_width(material), facing = -trace::inner(scene.prism.space, point.arriving, point.normal);
    const Color kept = surface::by_several_facets(face_on, facing, alpha) * path.weight;
    part /= count, ++metals;
    for (int i = 0; i < count; ++i) {
      chance.turn = {turn.rank * count + i, turn.of * count};
      chance.before = paths_before * count + i;
      const auto u = surface::facet_numbers(chance.turn.rank, chance.turn.of, metals - 1);
      const surface::Glance way = surface::glance(scene.prism.space, point, alpha, u);
      if (way.weight <= 0 || trace::inner(scene.prism.space, way.direction, flat) <= 0) continue;
      go_on(path, point, way.direction, kept * surface::reflectance(face_on, way.cosine), share * way.weight, depth, true);
    }
    part *= count, --metals;
    chance.turn = turn, chance.before = paths_before;
    const Color ways = seen.radiance + -1.0 * before;
    seen.radiance = before + lamps + Color{lamps.r < white.r ? ways.r : 0, lamps.g < white.g ? ways.g : 0, lamps.b < white.b ? ways.b : 0};
    seen.most = most_before + white;
  }

  // In: where the path was followed.
  void light(const trace::Path& path, double share, int depth, const trace::TraceScene& where) {
    add(share * path.glow);
    if (path.cut_off || path.hit.target == trace::Target::nothing) return add(share * (path.weight * options.background));
    trace::SurfacePoint point = trace::surface_at(where, path.last, path.hit);
    if (depth == 0) seen.surface = point, seen.hit = true;
    const scene::Material* material = point.look >= 0 ? &scene.room->looks[static_cast<std::size_t>(point.look)].material : nullptr;
    const Color color = surface::surface_color(*scene.room, point);
    if (!material) return add(share * (path.weight * at_most(color, options.white)));
    const bool glows = material->kind == scene::MaterialKind::emissive;
    if (glows && !options.light) return add(share * (path.weight * at_most(material->emission * color, options.white)));
    const bool mirror = material->kind == scene::MaterialKind::mirror, glass = material->kind == scene::MaterialKind::glass;
    const bool polished = options.light && surface::polished(*material) && (point.outside || depth == 0);
    if (options.light && material->kind == scene::MaterialKind::metal && !polished && depth < options.max_depth &&
        mirrors(point, share, depth))
      return metal(path, point, *material, color, share, depth);
    if (!(mirror || glass || polished) || depth >= options.max_depth) {
      if (options.light) return lit(path, point, *material, color, share);
      return add(share * (path.weight * at_most(color, options.white)));
    }
    smooth(point, path.hit);
    if (mirror) return go_on(path, point, surface::mirrored(scene, point), path.weight * color, share, depth);
    if (polished) {
      const double facing = -trace::inner(scene.prism.space, point.arriving, point.normal);
      const Color kept = surface::reflectance(surface::face_on(*material, color), facing);
      return go_on(path, point, surface::mirrored(scene, point), path.weight * kept, share, depth);
    }
    const surface::Refraction through = surface::refracted(scene, point, material->index);
    const double back = share * through.reflectance, on = share * (1 - through.reflectance), least = metals ? kLeastInMetal : kLeastShare;
    if (back >= least) go_on(path, point, surface::mirrored(scene, point), path.weight, back, depth);
    if (on < least) return;
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
  Walker{scene, options, chance, seen}.light(seen.path, 1, 0, scene);
  return seen;
}

Seen radiance(const trace::TraceScene& scene, const trace::Ray& ray, const DrawOptions& options, const Chance& chance) {
  return radiance(scene, trace::follow(scene, ray, follow_options(options)), options, chance);
}

}  // namespace orbc::render
