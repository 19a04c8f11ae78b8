#pragma once
#include <cstdint>
#include <vector>

#include "compiler/trace/scene.h"

namespace orbc::trace {

/// Where a path ends, and with how much of its light it starts.
struct FollowOptions {
  int max_bounces = 12;             ///< reflections allowed; the mirror met after them is the cut-off
  double min_weight = 0;            ///< a path ends at the mirror that would bring its largest channel below this
  double max_length = kEndless;     ///< total path length; a path that gets there in free air ends with Target::nothing, not cut off
  scene::Color weight{1, 1, 1};     ///< at the start, for paths that are continued after an object
  int bounces = 0;                  ///< already made
  double length = 0;                ///< already gone
  bool record_word = false;
};

/// A ray followed through real mirrors to the first thing that is none.
struct Path {
  Hit hit;                          ///< the end; t counts on the last piece. nothing: max_length reached, or cut off
  bool cut_off = false;             ///< ended at a mirror by max_bounces or min_weight: shows the background, times `weight`
  Ray last;                         ///< the last straight piece, in room coordinates
  double length = 0;                ///< of the whole path, `FollowOptions::length` included
  int bounces = 0;
  scene::Color weight{1, 1, 1};     ///< product of reflectance × tint
  scene::Color glow{0, 0, 0};       ///< what the mirrors on the way add by themselves: the sum of weight (before each) × glow
  std::vector<std::int16_t> word;   ///< the mirrors in order: walls from 0, kFloor, kCeiling
};

/// Follows a ray through the mirrors of the room until it meets an object, a frame, a plain part of a wall, floor or ceiling, or is cut
/// off. In corners the ray is reflected by each wall it points out of, in turn: the limit of its neighbours when the angle is π/k.
/// Error:  S², E² ~1e-16 per bounce; H² ~1e-16·e^L in place after length L (rounding is amplified by the space itself).
[[nodiscard]] Path follow(const TraceScene& scene, Ray ray, const FollowOptions& options = {});

/// The same for many rays with the same options, faster (see closest); paths in the order of the rays.
[[nodiscard]] std::vector<Path> follow(const TraceScene& scene, std::span<const Ray> rays, const FollowOptions& options = {});

/// The mirror that a ray meets at path length t on a surface of the prism (wall from 0, kFloor, kCeiling); none where the surface is plain.
[[nodiscard]] const MirrorArea* mirror_at(const TraceScene& scene, const Ray& ray, double t, int surface);

/// What is seen at the end of a path.
struct SurfacePoint {
  geometry::Position at;
  Direction normal;                 ///< unit, ambient frame of the room at `at`, towards the side the ray came from
  Direction arriving;               ///< unit direction of travel of the ray there
  bool outside = true;              ///< triangles: their counter-clockwise side is seen. Walls, floor, ceiling: always
  place::PartKind kind = place::PartKind::object;
  int part = -1;                    ///< index into PlacedRoom::parts; −1: a wall without a panel
  int look = -1;                    ///< index into PlacedRoom::looks: the triangle's; of walls, floor and ceiling the part's first
  bool checker_second = false;      ///< walls, floor, ceiling with a checker: the cell is of `material.second`
  scene::Color color{0.8, 0.8, 0.8};  ///< the look's flat colour; of checkers on walls, floor and ceiling the cell's
  double uv[2] = {0, 0};            ///< triangles: interpolated. Floor and ceiling: axial coordinates, walls: (arc from the start, z);
                                    ///< with a texture: its uv, in repeats (not wrapped)
  geometry::Vector3 pattern_position;  ///< triangles with pattern positions: interpolated
  int wall = -1;                    ///< kind wall: which; a ray that leaves it starts with leaves_wall = wall
};

/// In: a hit that is not `nothing`, with the ray that made it (Path::hit, Path::last).
[[nodiscard]] SurfacePoint surface_at(const TraceScene& scene, const Ray& ray, const Hit& hit);

/// The ray that leaves a surface point in a direction: continues from a mirror object, or looks for a lamp.
[[nodiscard]] Ray leave(const TraceScene& scene, const SurfacePoint& from, const Direction& direction);

}  // namespace orbc::trace
