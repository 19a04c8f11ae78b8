// Road B of the design: the ray is reflected at each mirror, and no copies of the room are made. Cut-offs: design §6.
#include "compiler/trace/follow.h"

#include <algorithm>
#include <numeric>

namespace orbc::trace {
namespace {

/// As Exit::surface; kNoSurface for hits that are not on the prism.
constexpr int kNoSurface = -100;
int surface_of(const Hit& hit) {
  if (hit.kind == HitKind::wall) return hit.wall;
  return hit.kind == HitKind::floor ? kFloor : hit.kind == HitKind::ceiling ? kCeiling : kNoSurface;
}

Path path_at_start(const FollowOptions& options) {
  Path path;
  path.length = options.length;
  path.bounces = options.bounces;
  path.throughput = options.throughput;
  return path;
}

/// Adds the segment from the ray to its hit, and at a mirror reflects the ray. Makes: false if the path ends.
bool advance_path(const TraceScene& scene, const FollowOptions& options, const Hit& hit, Ray& ray, Path& path) {
  path.hit = hit;
  path.last_ray = ray;
  if (path.length + hit.t > options.max_length) {
    path.hit = {};
    path.hit.t = options.max_length - path.length;
  }
  path.length += path.hit.t;
  const int surface = surface_of(path.hit);
  const MirrorRect* mirror = surface == kNoSurface ? nullptr : mirror_at(scene, ray, path.hit.t, surface);
  if (!mirror) return false;
  const scene::Color throughput = path.throughput * mirror->throughput;
  if (path.bounces >= options.max_bounces || max_channel(throughput) < options.min_weight) {
    path.cut_off = true;
    return false;
  }
  path.emission = path.emission + path.throughput * mirror->emission;
  path.throughput = throughput;
  ++path.bounces;
  if (options.record_word) path.word.push_back(static_cast<std::int16_t>(surface));
  ray = surface >= 0 ? reflected_in_wall(scene.prism, ray, hit.t, surface) : reflected_in_plane(scene.prism, ray, hit.t, surface);
  return true;
}

}  // namespace

const MirrorRect* mirror_at(const TraceScene& scene, const Ray& ray, double t, int surface) {
  const bool is_everywhere = surface < 0 || (!scene.mirrors[static_cast<std::size_t>(surface)].empty() &&
                                             scene.mirrors[static_cast<std::size_t>(surface)].front().covers_surface);
  return mirror_at(scene, is_everywhere ? geometry::Position{} : position_at(scene.prism.space, ray, t), surface);
}

const MirrorRect* mirror_at(const TraceScene& scene, const geometry::Position& at, int surface) {
  if (surface == kFloor) return scene.floor_mirror ? &*scene.floor_mirror : nullptr;
  if (surface == kCeiling) return scene.ceiling_mirror ? &*scene.ceiling_mirror : nullptr;
  const auto& areas = scene.mirrors[static_cast<std::size_t>(surface)];
  if (areas.empty()) return nullptr;
  if (areas.front().covers_surface) return &areas.front();
  const geometry::Space space = scene.prism.space;
  const room::Wall& wall = scene.prism.walls[static_cast<std::size_t>(surface)];
  const bool is_round = space == geometry::Space::spherical;  // else lengths are compared by their tanκ, which increases with them
  const double s = is_round ? arc_on_wall(space, wall, at.floor) : tan_on_wall(space, wall, at.floor);
  for (const MirrorRect& area : areas) {
    const double* span = is_round ? area.span : area.tan_span;
    if (s >= span[0] && s <= span[1] && at.z >= area.height[0] && at.z <= area.height[1]) return &area;
  }
  return nullptr;
}

Path follow(const TraceScene& scene, Ray ray, const FollowOptions& options) {
  Path path = path_at_start(options);
  while (advance_path(scene, options, closest(scene, ray), ray, path)) {
  }
  return path;
}

std::vector<Path> follow(const TraceScene& scene, std::span<const Ray> rays, const FollowOptions& options) {
  std::vector<Path> paths(rays.size(), path_at_start(options));
  std::vector<Ray> going(rays.begin(), rays.end());
  std::vector<std::size_t> index(rays.size());
  std::iota(index.begin(), index.end(), std::size_t{0});
  while (!going.empty()) {  // one segment of every path that has not ended
    const std::vector<Hit> hits = closest(scene, going);
    std::size_t left = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      Ray ray = going[i];
      if (!advance_path(scene, options, hits[i], ray, paths[index[i]])) continue;
      going[left] = ray;
      index[left++] = index[i];
    }
    going.resize(left);
    index.resize(left);
  }
  return paths;
}

Ray spawn_ray(const TraceScene& scene, const SurfacePoint& from, const Direction& direction) {
  Ray ray = ray_from(scene.prism.space, from.at, direction);
  ray.start_wall = from.kind == place::PartKind::wall ? from.wall : -1;
  const bool triangle = from.kind == place::PartKind::object || from.kind == place::PartKind::frame;
  ray.t_min = triangle ? kRayEpsilon : 0;
  return ray;
}

}  // namespace orbc::trace
