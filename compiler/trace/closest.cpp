// The first thing on a ray: triangles through the BVH, the prism's border by formula. Holes are asked for outside of the tree: a ray that
// meets one starts again behind it; rooms without holes pay one branch a ray.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/place/texel.h"
#include "compiler/trace/bvh.h"
#include "compiler/trace/scene.h"

namespace orbc::trace {
namespace {

Hit hit_of_triangle(const Soup& soup, const BvhHit& found) {
  const auto next = std::upper_bound(soup.parts.begin(), soup.parts.end(), found.triangle,
                                     [](std::uint32_t triangle, const Soup::Part& part) { return triangle < part.first; });
  const Soup::Part& part = *(next - 1);
  Hit hit;
  hit.target = Target::triangle;
  hit.t = found.t;
  hit.part = part.part;
  hit.triangle = static_cast<int>(found.triangle - part.first);
  std::copy(found.b, found.b + 3, hit.b);
  return hit;
}

Hit hit_of_exit(const Exit& exit) {
  Hit hit;
  hit.target = exit.surface >= 0 ? Target::wall : exit.surface == kFloor ? Target::floor : Target::ceiling;
  hit.t = exit.t;
  hit.wall = exit.surface >= 0 ? exit.surface : -1;
  return hit;
}

/// A ray in a room of S² is out after half a turn: no triangle needs to be looked for beyond.
double longest_in_room(const TraceScene& scene, const Ray& ray) {
  return scene.prism.space == geometry::Space::spherical && ray.c > 0 ? std::numbers::pi / ray.c : kEndless;
}

/// As closest, holes included.
Hit first_met(const TraceScene& scene, const Ray& ray) {
  if (scene.all_inside) {
    const BvhHit found = scene.objects->closest(ray, longest_in_room(scene, ray));
    return found.triangle != kNone ? hit_of_triangle(scene.objects->soup(), found) : hit_of_exit(exit_of(scene.prism, ray));
  }
  const Exit exit = exit_of(scene.prism, ray);
  const BvhHit found = scene.objects->closest(ray, exit.t);
  return found.triangle != kNone ? hit_of_triangle(scene.objects->soup(), found) : hit_of_exit(exit);
}

bool in_hole(const TraceScene& scene, const Hit& hit) {
  return hit.target == Target::triangle &&
         place::in_hole(*scene.room, scene.room->parts[static_cast<std::size_t>(hit.part)], static_cast<std::size_t>(hit.triangle), hit.b);
}

/// What lies behind the holes that a ray meets first.
template <class Meet>
Hit behind_holes(const TraceScene& scene, Ray ray, Hit hit, const Meet& meet) {
  while (in_hole(scene, hit)) {
    ray.t_min = hit.t;
    hit = meet(ray);
  }
  return hit;
}
Hit behind_holes(const TraceScene& scene, const Ray& ray, const Hit& hit) {
  return behind_holes(scene, ray, hit, [&](const Ray& on) { return first_met(scene, on); });
}

}  // namespace

Hit closest(const TraceScene& scene, const Ray& ray) {
  const Hit hit = first_met(scene, ray);
  return scene.masked ? behind_holes(scene, ray, hit) : hit;
}

std::vector<Hit> closest(const TraceScene& scene, std::span<const Ray> rays) {
  constexpr std::size_t kPiece = 64;  // small enough to stay in the first-level cache
  std::vector<Hit> hits;
  hits.reserve(rays.size());
  BvhHit found[kPiece];
  Exit exits[kPiece];
  for (std::size_t first = 0; first < rays.size(); first += kPiece) {
    const std::size_t count = std::min(kPiece, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      found[i].triangle = kNone;
      if (!scene.all_inside) exits[i] = exit_of(scene.prism, rays[first + i]);
      found[i].t = scene.all_inside ? longest_in_room(scene, rays[first + i]) : exits[i].t;
    }
    scene.objects->closest_many(&rays[first], found, count);
    for (std::size_t i = 0; i < count; ++i)
      hits.push_back(found[i].triangle != kNone ? hit_of_triangle(scene.objects->soup(), found[i])
                                                : hit_of_exit(scene.all_inside ? exit_of(scene.prism, rays[first + i]) : exits[i]));
  }
  if (scene.masked)
    for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = behind_holes(scene, rays[i], hits[i]);
  return hits;
}

Hit closest_triangle(const TraceScene& scene, const Ray& ray, double max_length) {
  const auto meet = [&](const Ray& from) {
    const BvhHit found = scene.objects->closest(from, std::min(max_length, longest_in_room(scene, from)));
    return found.triangle != kNone ? hit_of_triangle(scene.objects->soup(), found) : Hit{};
  };
  const Hit hit = meet(ray);
  return scene.masked ? behind_holes(scene, ray, hit, meet) : hit;
}

bool occluded(const TraceScene& scene, const Ray& ray, double max_length) {
  if (scene.masked) return closest_triangle(scene, ray, max_length).target == Target::triangle;
  return scene.objects->occluded(ray, std::min(max_length, longest_in_room(scene, ray)));
}

}  // namespace orbc::trace
