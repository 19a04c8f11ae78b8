#pragma once
#include <cstdint>
#include <vector>

#include "compiler/trace/scene.h"

namespace orbc::trace {

/// Where a path starts and ends.
struct FollowOptions {
  int max_bounces = 12;              ///< most reflections; the mirror hit after them cuts the path off
  double min_weight = 0;             ///< a mirror that would bring the throughput's largest channel below this cuts the path off
  double max_length = kInfinity;     ///< total path length; a path that reaches it ends with HitKind::none and is not cut off
  scene::Color throughput{1, 1, 1};  ///< at the start, for paths that continue after an object
  int bounces = 0;                   ///< number of reflections before the start
  double length = 0;                 ///< path length before the start
  bool record_word = false;          ///< whether Path::word is filled
};

/// A path: a ray that is reflected by mirrors until it hits something else.
struct Path {
  Hit hit;                           ///< the end, with t along `last_ray`; none: max_length was reached
  bool cut_off = false;              ///< the path ended at a mirror by max_bounces or min_weight; it shows the background × throughput
  Ray last_ray;                      ///< its last segment, in room coordinates
  double length = 0;                 ///< of the whole path, FollowOptions::length included
  int bounces = 0;                   ///< number of reflections, FollowOptions::bounces included
  scene::Color throughput{1, 1, 1};  ///< product of the mirrors' throughputs
  scene::Color emission{0, 0, 0};    ///< radiance that the mirrors add: the sum of throughput (before the mirror) × its emission
  std::vector<std::int16_t> word;    ///< the mirrors in order: walls from 0, kFloor, kCeiling
};

/// Follows a ray through the mirrors of the room until it hits an object, a frame or a plain part of a wall, floor or ceiling, or is cut
/// off. In a corner the ray is reflected by each wall that it points out of, one after the other. That is the limit of the rays beside it
/// when the angle is π/k. Error:  S², E² ~1e-16 per bounce; H² ~1e-16·e^L in place after length L (rounding is amplified by the space
/// itself).
[[nodiscard]] Path follow(const TraceScene& scene, Ray ray, const FollowOptions& options = {});

/// The same for many rays with the same options, faster (see `closest`). Makes: paths in the order of the rays.
[[nodiscard]] std::vector<Path> follow(const TraceScene& scene, std::span<const Ray> rays, const FollowOptions& options = {});

/// The mirror that a ray hits at path length t on a surface of the prism (wall from 0, kFloor, kCeiling), or nullptr where it is plain.
[[nodiscard]] const MirrorRect* mirror_at(const TraceScene& scene, const Ray& ray, double t, int surface);
/// The same where the point of the surface is known.
[[nodiscard]] const MirrorRect* mirror_at(const TraceScene& scene, const geometry::Position& at, int surface);

/// The surface at a hit point.
struct SurfacePoint {
  geometry::Position at;
  Direction normal;          ///< unit normal at `at`, on the side from which the ray comes
  Direction incoming;        ///< unit direction of travel of the ray
  bool front_facing = true;  ///< triangles: the ray hits the counter-clockwise side. Walls, floor and ceiling: always true
  place::PartKind kind = place::PartKind::object;
  int part = -1;              ///< index into Interior::parts; −1: a wall without a panel
  int style = -1;             ///< index into Interior::styles: of the triangle, or the first of the wall's, floor's or ceiling's part
  bool second_color = false;  ///< walls, floor, ceiling with a checker: the cell is of `material.second`
  scene::Color color{0.8, 0.8, 0.8};   ///< the style's flat colour; of checkers on walls, floor and ceiling the cell's
  double uv[2] = {0, 0};               ///< triangles: interpolated. Floor and ceiling: axial coordinates. Walls: (arc length, z).
                                       ///< With a texture: its uv in repeats, not wrapped
  geometry::Vector3 pattern_position;  ///< triangles with pattern positions: interpolated
  int wall = -1;                       ///< kind wall: its index (from 0), and start_wall of rays that start there
};

/// In: a hit that is not HitKind::none, with its ray (Path::hit, Path::last_ray).
[[nodiscard]] SurfacePoint surface_at(const TraceScene& scene, const Ray& ray, const Hit& hit);

/// The ray from a surface point in a direction; it ignores the surface where it starts.
[[nodiscard]] Ray spawn_ray(const TraceScene& scene, const SurfacePoint& from, const Direction& direction);

}  // namespace orbc::trace
