// Mirror objects reflect in the product metric. At glass both branches are followed while their share counts, so that what the eye sees
// through it needs no random numbers. Rough metals are sums over directions sampled from a lattice.
#include "compiler/render/radiance.h"

#include <algorithm>

#include "compiler/render/indirect.h"
#include "compiler/surface/albedo.h"
#include "compiler/surface/ggx.h"
#include "compiler/surface/specular.h"

namespace orbc::render {
namespace {

using scene::Color;
using trace::Direction;

constexpr double kMinGlassShare = 1.0 / 512;        // a branch of glass below it does not change an 8-bit picture,
constexpr double kMinGlassShareInMetal = 1.0 / 64;  // nor does one below this, if the glass is seen in a metal
constexpr int kMaxMetals = 3;                       // that mirror each other on one path
constexpr double kMinMetalShare = 1.0 / 48;         // metals with a smaller share show their albedo
constexpr double kSamplesPerAlpha = 1500;           // directions for a metal, per α: 32 for gold (α = 0.02)

Color clamped(const Color& c, double most) { return {std::min(c.r, most), std::min(c.g, most), std::min(c.b, most)}; }

/// The number of directions that are sampled for the room in a metal: a power of 2, or `most`. It grows with the roughness, until steps
/// between the directions are invisible. In: `share`: of the pixel, for all its samples together.
int specular_sample_count(const scene::Material& material, double share, int most) {
  const double wanted = kSamplesPerAlpha * surface::ggx_alpha(material) * std::min(1.0, 2 * share);
  int count = 2;
  while (1.5 * count < wanted && count < most) count *= 2;
  return std::min(count, most);
}

/// A ray that goes on from a surface.
struct Branch {
  trace::SurfacePoint from;
  Direction direction;
  Color weight;      ///< of the path so far, but for `share`
  double share = 1;  ///< of the pixel
};

/// Adds up the radiance along one ray of the eye, branch by branch.
struct RayShader {
  const trace::TraceScene& scene;
  const DrawOptions& options;
  PixelSampler sampler;
  RayResult& result;
  double sample_share = 1;  ///< 1 / (directions sampled at the metals that the path has met)
  int metal_depth = 0;      ///< metals that the path has met

  void add(const Color& radiance) {
    result.radiance = result.radiance + sample_share * radiance;
  }

  // In: the path up to the branch; what the branch can hit.
  void continue_path(const trace::Path& path, const Branch& branch, int depth, const trace::TraceScene& target) {
    trace::FollowOptions follow = follow_options(options);
    follow.throughput = branch.weight;
    follow.bounces = path.bounces;
    follow.length = path.length;
    shade(trace::follow(target, trace::spawn_ray(target, branch.from, branch.direction), follow), branch.share, depth + 1, target);
  }

  // The point with the normal of the smooth surface that the triangles approximate: mirror, glass and metal would look like mosaics. The
  // normal of the triangle stays where the smooth one turns away from the ray, or would reflect the ray into the triangle.
  [[nodiscard]] trace::SurfacePoint smoothed(trace::SurfacePoint point, const trace::Hit& hit) const {
    if (!options.lighting || hit.kind != trace::HitKind::triangle) return point;
    const geometry::Space space = scene.interior->polygon.space;
    Direction normal = light::shading_point(*options.lighting, *scene.interior, point, hit).normal;
    if (trace::inner(space, normal, point.normal) < 0) normal = -normal;
    const Direction flat = point.normal;
    if (trace::inner(space, normal, point.incoming) < 0) point.normal = normal;
    if (trace::inner(space, surface::reflect(space, point), flat) <= 0) point.normal = flat;
    return point;
  }

  [[nodiscard]] Color direct_irradiance(const trace::Hit& hit, const trace::SurfacePoint& point, const surface::ShadingPoint& at) const {
    if (options.irradiance) return options.irradiance->at(point, hit, at, sampler.stratum);
    return light::irradiance(*options.lighting, at, sampler.stratum);
  }

  // A surface that is neither mirror nor glass, under the lamps.
  void shade_lit(const trace::Path& path, const trace::SurfacePoint& point, const scene::Material& material, const Color& color,
                 double share) {
    const light::LightingContext& lighting = *options.lighting;
    const Color weight = share * path.throughput;
    if (material.kind == scene::MaterialKind::emissive) return add(weight * light::outgoing_radiance(lighting, material, color, {}));
    const surface::ShadingPoint at = light::shading_point(lighting, *scene.interior, point, path.hit);
    const auto baked = options.baked ? options.baked->at(point, path.hit) : std::nullopt;
    Color out = baked ? light::white_level(lighting) * *baked
                      : light::outgoing_radiance(lighting, material, color, direct_irradiance(path.hit, point, at));
    if (options.highlights && material.kind == scene::MaterialKind::glossy)
      out = out + light::highlight(lighting, at, -point.incoming, material, color, sample_share * std::min(1.0, max_channel(weight)));
    if (baked || lighting.options.indirect_bounces == 0) return add(weight * out);
    const int paths = std::max(1, static_cast<int>(sample_share * options.paths));
    const Color indirect = color * indirect_irradiance(*scene.interior, lighting, at, sampler, paths);
    result.radiance = result.radiance + sample_share * weight * (out + indirect);
    result.indirect = result.indirect + sample_share * weight * indirect;
  }

  // Whether a metal mirrors the room. A metal seen in metals shows its albedo if it is faint or the fourth. Its inside is hit by rounding
  // errors alone.
  [[nodiscard]] bool mirrors_room(const trace::SurfacePoint& point, double share, int depth) const {
    return metal_depth < kMaxMetals && share >= kMinMetalShare && (point.front_facing || depth == 0);
  }

  // The room in a rough metal: the mean over sampled directions, which continue the stratification of the pixel; and the lamps, whose
  // bodies the directions must not hit, as highlights.
  void shade_metal(const trace::Path& path, const trace::SurfacePoint& point, const scene::Material& material, const Color& color,
                   double share, int depth) {
    const light::LightingContext& lighting = *options.lighting;
    const geometry::Space space = scene.prism.space;
    const Color f0 = surface::f0(material, color);
    const surface::ShadingPoint at = light::shading_point(lighting, *scene.interior, point, path.hit);
    add(share * path.throughput * light::highlight(lighting, at, -point.incoming, material, color));
    const trace::SurfacePoint smooth = smoothed(point, path.hit);
    const light::SampleStratum stratum = sampler.stratum;
    const int lattice_index = sampler.lattice_index;
    const int all =
        specular_sample_count(material, share * max_channel(path.throughput), std::max(1, options.specular_samples >> (3 * metal_depth)));
    const int count = std::max(1, all / stratum.count);
    const double alpha = surface::ggx_alpha(material), cos_eye = -trace::inner(space, smooth.incoming, smooth.normal);
    const Color throughput = surface::multiscatter_compensation(f0, cos_eye, alpha) * path.throughput;
    sample_share /= count;
    ++metal_depth;
    for (int i = 0; i < count; ++i) {
      sampler.stratum = {stratum.index * count + i, stratum.count * count};
      sampler.lattice_index = lattice_index * count + i;
      const auto u = surface::vndf_point(sampler.stratum.index, sampler.stratum.count, metal_depth - 1);
      const surface::BsdfSample sample = surface::sample_ggx(space, smooth, alpha, u);
      if (sample.weight <= 0 || trace::inner(space, sample.direction, point.normal) <= 0) continue;
      const Branch branch{smooth, sample.direction, throughput * surface::fresnel_schlick(f0, sample.cos_half), share * sample.weight};
      continue_path(path, branch, depth, lighting.scene);
    }
    sample_share *= count;
    --metal_depth;
    sampler.stratum = stratum;
    sampler.lattice_index = lattice_index;
  }

  void shade_glass(const trace::Path& path, const trace::SurfacePoint& point, const Color& color, double index, double share, int depth) {
    const geometry::Space space = scene.prism.space;
    const surface::Refraction glass = surface::refract(space, point, index);
    const double reflected = share * glass.reflectance, transmitted = share * (1 - glass.reflectance),
                 least = metal_depth ? kMinGlassShareInMetal : kMinGlassShare;
    if (reflected >= least) continue_path(path, {point, surface::reflect(space, point), path.throughput, reflected}, depth, scene);
    if (transmitted < least) return;
    trace::SurfacePoint behind = point;
    behind.normal = -point.normal;
    continue_path(path, {behind, glass.direction, point.front_facing ? path.throughput * color : path.throughput, transmitted}, depth,
                  scene);
  }

  // In: the scene in which the path was followed.
  void shade(const trace::Path& path, double share, int depth, const trace::TraceScene& followed_in) {
    add(share * path.emission);
    if (path.cut_off || path.hit.kind == trace::HitKind::none) return add(share * (path.throughput * options.background));
    const trace::SurfacePoint point = trace::surface_at(followed_in, path.last_ray, path.hit);
    if (depth == 0) {
      result.surface = point;
      result.hit = true;
    }
    const scene::Material* material = point.style >= 0 ? &scene.interior->styles[static_cast<std::size_t>(point.style)].material : nullptr;
    const Color color = surface::hit_albedo(*scene.interior, point);
    if (!material) return add(share * (path.throughput * clamped(color, options.max_radiance)));
    const bool emissive = material->kind == scene::MaterialKind::emissive;
    if (emissive && !options.lighting) return add(share * (path.throughput * clamped(material->emission * color, options.max_radiance)));
    const bool mirror = material->kind == scene::MaterialKind::mirror, glass = material->kind == scene::MaterialKind::glass;
    const bool specular_metal = options.lighting && surface::is_specular_metal(*material) && (point.front_facing || depth == 0);
    if (options.lighting && material->kind == scene::MaterialKind::metal && !specular_metal && depth < options.max_depth &&
        mirrors_room(point, share, depth))
      return shade_metal(path, point, *material, color, share, depth);
    if (!(mirror || glass || specular_metal) || depth >= options.max_depth) {
      if (options.lighting) return shade_lit(path, point, *material, color, share);
      return add(share * (path.throughput * clamped(color, options.max_radiance)));
    }
    const geometry::Space space = scene.prism.space;
    const trace::SurfacePoint smooth = smoothed(point, path.hit);
    if (glass) return shade_glass(path, smooth, color, material->index, share, depth);
    const double cos_eye = -trace::inner(space, smooth.incoming, smooth.normal);
    const Color reflectance = mirror ? color : surface::fresnel_schlick(surface::f0(*material, color), cos_eye);
    continue_path(path, {smooth, surface::reflect(space, smooth), path.throughput * reflectance, share}, depth, scene);
  }
};

}  // namespace

ShownRadiance shown_radiance(const RayResult& result, double white) {
  const Color cut = clamped(result.radiance, white);
  return {{result.indirect.r > 0 ? result.radiance.r : cut.r, result.indirect.g > 0 ? result.radiance.g : cut.g,
           result.indirect.b > 0 ? result.radiance.b : cut.b},
          {result.indirect.r > 0 ? white : cut.r, result.indirect.g > 0 ? white : cut.g, result.indirect.b > 0 ? white : cut.b}};
}

trace::FollowOptions follow_options(const DrawOptions& options) {
  trace::FollowOptions follow;
  follow.max_bounces = options.max_bounces;
  follow.min_weight = options.min_weight;
  return follow;
}

RayResult radiance(const trace::TraceScene& scene, trace::Path path, const DrawOptions& options, const PixelSampler& sampler) {
  RayResult result;
  result.path = std::move(path);
  RayShader{scene, options, sampler, result}.shade(result.path, 1, 0, scene);
  return result;
}

RayResult radiance(const trace::TraceScene& scene, const trace::Ray& ray, const DrawOptions& options, const PixelSampler& sampler) {
  return radiance(scene, trace::follow(scene, ray, follow_options(options)), options, sampler);
}

}  // namespace orbc::render
