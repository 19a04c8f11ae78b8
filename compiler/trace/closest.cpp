// The first hit of a ray: triangles through the BVH, the prism's surfaces by formula. Alpha masks are evaluated outside of the tree: a ray
// that hits a masked point starts again behind it. Rooms without masks pay one branch per ray.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/place/alpha_mask.h"
#include "compiler/trace/bvh/bvh.h"
#include "compiler/trace/scene.h"

namespace orbc::trace {
namespace {

Hit hit_of_triangle(const SceneTriangles& triangles, const BvhHit& found) {
  const auto next = std::upper_bound(triangles.parts.begin(), triangles.parts.end(), found.triangle,
                                     [](std::uint32_t triangle, const SceneTriangles::Part& part) { return triangle < part.first; });
  const SceneTriangles::Part& part = *(next - 1);
  Hit hit;
  hit.kind = HitKind::triangle;
  hit.t = found.t;
  hit.part = part.part;
  hit.triangle = static_cast<int>(found.triangle - part.first);
  std::copy(found.b, found.b + 3, hit.b);
  return hit;
}

Hit hit_of_exit(const Exit& exit) {
  Hit hit;
  hit.kind = exit.surface >= 0 ? HitKind::wall : exit.surface == kFloor ? HitKind::floor : HitKind::ceiling;
  hit.t = exit.t;
  hit.wall = exit.surface >= 0 ? exit.surface : -1;
  return hit;
}

/// On S² a ray has left every room after half a revolution; no triangle beyond it can be hit.
double max_length_in_room(const TraceScene& scene, const Ray& ray) {
  return scene.prism.space == geometry::Space::spherical && ray.c > 0 ? std::numbers::pi / ray.c : kInfinity;
}

/// As `closest`, but masked points count as hits.
Hit closest_ignoring_masks(const TraceScene& scene, const Ray& ray) {
  if (scene.all_inside) {
    const BvhHit found = scene.objects->closest(ray, max_length_in_room(scene, ray));
    return found.triangle != kNoTriangle ? hit_of_triangle(scene.objects->triangles(), found) : hit_of_exit(exit_of(scene.prism, ray));
  }
  const Exit exit = exit_of(scene.prism, ray);
  const BvhHit found = scene.objects->closest(ray, exit.t);
  return found.triangle != kNoTriangle ? hit_of_triangle(scene.objects->triangles(), found) : hit_of_exit(exit);
}

bool is_masked_at(const TraceScene& scene, const Hit& hit) {
  return hit.kind == HitKind::triangle && place::is_masked_at(*scene.interior, scene.interior->parts[static_cast<std::size_t>(hit.part)],
                                                         static_cast<std::size_t>(hit.triangle), hit.b);
}

/// The first hit that is not masked. In: `hit` is the first hit of `ray`, and `intersect_ray` finds the first hit of any ray.
template <class IntersectRay>
Hit skip_masked(const TraceScene& scene, Ray ray, Hit hit, const IntersectRay& intersect_ray) {
  while (is_masked_at(scene, hit)) {
    ray.t_min = hit.t;
    hit = intersect_ray(ray);
  }
  return hit;
}
Hit skip_masked(const TraceScene& scene, const Ray& ray, const Hit& hit) {
  return skip_masked(scene, ray, hit, [&](const Ray& on) { return closest_ignoring_masks(scene, on); });
}

}  // namespace

Hit closest(const TraceScene& scene, const Ray& ray) {
  const Hit hit = closest_ignoring_masks(scene, ray);
  return scene.masked ? skip_masked(scene, ray, hit) : hit;
}

std::vector<Hit> closest(const TraceScene& scene, std::span<const Ray> rays) {
  constexpr std::size_t kStreamRays = 64;  // fits into the first-level cache
  std::vector<Hit> hits;
  hits.reserve(rays.size());
  BvhHit found[kStreamRays];
  Exit exits[kStreamRays];
  for (std::size_t first = 0; first < rays.size(); first += kStreamRays) {
    const std::size_t count = std::min(kStreamRays, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      found[i].triangle = kNoTriangle;
      if (!scene.all_inside) exits[i] = exit_of(scene.prism, rays[first + i]);
      found[i].t = scene.all_inside ? max_length_in_room(scene, rays[first + i]) : exits[i].t;
    }
    scene.objects->closest_many(&rays[first], found, count);
    for (std::size_t i = 0; i < count; ++i)
      hits.push_back(found[i].triangle != kNoTriangle ? hit_of_triangle(scene.objects->triangles(), found[i])
                                                      : hit_of_exit(scene.all_inside ? exit_of(scene.prism, rays[first + i]) : exits[i]));
  }
  if (scene.masked)
    for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = skip_masked(scene, rays[i], hits[i]);
  return hits;
}

Hit closest_triangle(const TraceScene& scene, const Ray& ray, double max_length) {
  const auto intersect_ray = [&](const Ray& from) {
    const BvhHit found = scene.objects->closest(from, std::min(max_length, max_length_in_room(scene, from)));
    return found.triangle != kNoTriangle ? hit_of_triangle(scene.objects->triangles(), found) : Hit{};
  };
  const Hit hit = intersect_ray(ray);
  return scene.masked ? skip_masked(scene, ray, hit, intersect_ray) : hit;
}

bool occluded(const TraceScene& scene, const Ray& ray, double max_length) {
  if (scene.masked) return closest_triangle(scene, ray, max_length).kind == HitKind::triangle;
  return scene.objects->occluded(ray, std::min(max_length, max_length_in_room(scene, ray)));
}

}  // namespace orbc::trace
