// Road B of the design: the mirrors are real, the ray is turned back at each wall, nothing is unfolded. Cut-offs: design §6.
#include "compiler/trace/follow.h"

#include <algorithm>
#include <numeric>

namespace orbc::trace {
namespace {

/// As Exit::surface; kNoSurface for what is no part of the prism's border.
constexpr int kNoSurface = -100;
int surface_of(const Hit& hit) {
  if (hit.target == Target::wall) return hit.wall;
  return hit.target == Target::floor ? kFloor : hit.target == Target::ceiling ? kCeiling : kNoSurface;
}

Path path_at_start(const FollowOptions& options) {
  Path path;
  path.length = options.length;
  path.bounces = options.bounces;
  path.weight = options.weight;
  return path;
}

/// Adds the piece from the ray to its hit; at a mirror turns the ray back. False: the path ends here.
bool goes_on(const TraceScene& scene, const FollowOptions& options, const Hit& hit, Ray& ray, Path& path) {
  path.hit = hit;
  path.last = ray;
  if (path.length + hit.t > options.max_length) {
    path.hit = {};
    path.hit.t = options.max_length - path.length;
  }
  path.length += path.hit.t;
  const int surface = surface_of(path.hit);
  const MirrorArea* mirror = surface == kNoSurface ? nullptr : mirror_at(scene, ray, path.hit.t, surface);
  if (!mirror) return false;
  const scene::Color weight = path.weight * mirror->weight;
  if (path.bounces >= options.max_bounces || largest(weight) < options.min_weight) {
    path.cut_off = true;
    return false;
  }
  path.glow = path.glow + path.weight * mirror->glow;
  path.weight = weight;
  ++path.bounces;
  if (options.record_word) path.word.push_back(static_cast<std::int16_t>(surface));
  ray = surface >= 0 ? reflected_in_wall(scene.prism, ray, hit.t, surface) : reflected_in_plane(scene.prism, ray, hit.t, surface);
  return true;
}

}  // namespace

const MirrorArea* mirror_at(const TraceScene& scene, const Ray& ray, double t, int surface) {
  if (surface == kFloor) return scene.floor_mirror ? &*scene.floor_mirror : nullptr;
  if (surface == kCeiling) return scene.ceiling_mirror ? &*scene.ceiling_mirror : nullptr;
  const auto& areas = scene.mirrors[static_cast<std::size_t>(surface)];
  if (areas.empty()) return nullptr;
  if (areas.front().whole) return &areas.front();
  const auto at = position_at(scene.prism.space, ray, t);
  const double s = arc_on_wall(scene.prism.space, scene.prism.walls[static_cast<std::size_t>(surface)], at.floor);
  for (const MirrorArea& area : areas)
    if (s >= area.span[0] && s <= area.span[1] && at.z >= area.height[0] && at.z <= area.height[1]) return &area;
  return nullptr;
}

Path follow(const TraceScene& scene, Ray ray, const FollowOptions& options) {
  Path path = path_at_start(options);
  while (goes_on(scene, options, closest(scene, ray), ray, path)) {
  }
  return path;
}

std::vector<Path> follow(const TraceScene& scene, std::span<const Ray> rays, const FollowOptions& options) {
  std::vector<Path> paths(rays.size(), path_at_start(options));
  std::vector<Ray> going(rays.begin(), rays.end());
  std::vector<std::size_t> index(rays.size());
  std::iota(index.begin(), index.end(), std::size_t{0});
  while (!going.empty()) {  // one piece of every path that is not at its end
    const std::vector<Hit> hits = closest(scene, going);
    std::size_t left = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      Ray ray = going[i];
      if (!goes_on(scene, options, hits[i], ray, paths[index[i]])) continue;
      going[left] = ray;
      index[left++] = index[i];
    }
    going.resize(left);
    index.resize(left);
  }
  return paths;
}

Ray leave(const TraceScene& scene, const SurfacePoint& from, const Direction& direction) {
  Ray ray = ray_from(scene.prism.space, from.at, direction);
  ray.leaves_wall = from.kind == place::PartKind::wall ? from.wall : -1;
  const bool triangle = from.kind == place::PartKind::object || from.kind == place::PartKind::frame;
  ray.t_min = triangle ? kLeave : 0;
  return ray;
}

}  // namespace orbc::trace
