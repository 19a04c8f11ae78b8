#include "compiler/light/light_path.h"

#include <utility>

#include "compiler/surface/albedo.h"
#include "compiler/surface/specular.h"

namespace orbc::light {
namespace {

using scene::Color;

constexpr int kMaxSpecularObjects = 16;  // mirror and glass objects between two matte surfaces

}  // namespace

trace::FollowOptions path_follow_options(const LightingContext& lighting) {
  trace::FollowOptions follow;
  follow.max_bounces = lighting.options.path_bounces;
  follow.min_weight = lighting.options.path_min_weight;
  return follow;
}

LightPath extend_path(const place::Interior& interior, const LightingContext& lighting, LightPath path, const trace::Ray& ray,
                      surface::Random& random) {
  return extend_path(interior, lighting, std::move(path), trace::follow(lighting.scene, ray, path_follow_options(lighting)), random);
}

LightPath extend_path(const place::Interior& interior, const LightingContext& lighting, LightPath path, trace::Path followed,
                      surface::Random& random) {
  const geometry::Space space = lighting.scene.prism.space;
  path.end.reset();
  for (int objects = 0; objects <= kMaxSpecularObjects; ++objects) {
    path.radiance = path.radiance + path.throughput * followed.emission;
    if (followed.cut_off || followed.hit.kind == trace::HitKind::none) {
      path.radiance = path.radiance + path.throughput * lighting.options.background;
      return path;
    }
    path.throughput = path.throughput * followed.throughput;
    trace::SurfacePoint point = trace::surface_at(lighting.scene, followed.last_ray, followed.hit);
    const scene::Material* material = point.style >= 0 ? &interior.styles[static_cast<std::size_t>(point.style)].material : nullptr;
    if (material && material->kind == scene::MaterialKind::emissive) {
      path.radiance = path.radiance + material->emission * (path.throughput * surface::hit_albedo(interior, point));
      return path;
    }
    const bool mirror = material && material->kind == scene::MaterialKind::mirror;
    if (!mirror && !(material && material->kind == scene::MaterialKind::glass)) {
      path.end = LightPath::End{point, followed.hit};
      return path;
    }
    trace::Direction onward = surface::reflect(space, point);
    if (mirror) {
      path.throughput = path.throughput * surface::hit_albedo(interior, point);
    } else if (const surface::Refraction glass = surface::refract(space, point, material->index); random.next() >= glass.reflectance) {
      if (point.front_facing) path.throughput = path.throughput * surface::hit_albedo(interior, point);
      point.normal = -point.normal;
      onward = glass.direction;
    }
    trace::FollowOptions follow = path_follow_options(lighting);
    follow.bounces = followed.bounces;
    followed = trace::follow(lighting.scene, trace::spawn_ray(lighting.scene, point, onward), follow);
  }
  return path;
}

}  // namespace orbc::light
