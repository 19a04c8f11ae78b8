#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/place/interior.h"
#include "compiler/trace/analytic.h"
#include "compiler/trace/ray.h"

namespace orbc::trace {

class Bvh;

/// A mirror rectangle on a wall, floor or ceiling. Ends within 1e-9 of the wall's own ends are moved to infinity, so that rays into a
/// corner or an edge of the room cannot pass beside the mirror.
struct MirrorRect {
  double span[2] = {-kInfinity, kInfinity};  ///< arc length along the wall
  double height[2] = {-kInfinity, kInfinity};
  double tan_span[2] = {-kInfinity, kInfinity};  ///< in E² and H²: tanκ of `span`
  bool covers_surface = false;                   ///< the mirror covers all of its wall, floor or ceiling
  scene::Color throughput;                       ///< reflectance × tint
  scene::Color emission;                         ///< radiance that the mirror emits itself
  int mirror = -1;                               ///< index into Interior::mirrors
};

/// The style of a wall, the floor or the ceiling where it is no mirror.
struct ShellStyle {
  int part = -1;   ///< its first part, or −1 if a mirror covers all of it
  int style = -1;  ///< the part's first style, index into Interior::styles
};

/// An interior prepared for ray tracing. It refers to the Interior, which must outlive it and stay at its address. Copies share the BVH.
struct TraceScene {
  const place::Interior* interior = nullptr;
  Prism prism;
  std::vector<std::vector<MirrorRect>> mirrors;  ///< per wall; of overlapping mirrors the first counts
  std::optional<MirrorRect> floor_mirror, ceiling_mirror;
  std::vector<ShellStyle> walls;
  ShellStyle floor, ceiling;
  std::shared_ptr<const Bvh> objects;  ///< the triangles of parts of kind object and frame
  bool masked = false;     ///< some triangles have alpha masks (SurfaceStyle::alpha_cutoff), whose masked points do not stop rays
  bool all_inside = true;  ///< no triangle reaches out of the prism, so that a hit of a triangle always comes before the prism's surface
};

/// Prepares an interior for ray tracing and builds its BVH in parallel through `execute`; the tree is the same for any number of threads.
[[nodiscard]] TraceScene prepare(const place::Interior& room, const Executor& execute = serial_executor());

enum class HitKind { none, triangle, wall, floor, ceiling };

/// What a ray hits first, and after which path length t.
struct Hit {
  HitKind kind = HitKind::none;
  double t = kInfinity;
  int part = -1;            ///< triangle: index into Interior::parts
  int triangle = -1;        ///< triangle: index into PlacedMesh::triangles
  double b[3] = {0, 0, 0};  ///< triangle: affine barycentric coordinates of its corners, in order
  int wall = -1;            ///< wall: its index (from 0)
};

/// The first hit of a ray: a triangle of an object or frame, or the wall, floor or ceiling (mirror or not) where it leaves the room.
/// In:     a ray that starts in the room. Thread-safe.
/// Exact:  the same triangle, t and b as calling `intersect` for every triangle, except for ties in t.
[[nodiscard]] Hit closest(const TraceScene& scene, const Ray& ray);
/// The same for many rays, bit by bit, in about two thirds of the time; best for 32 rays and more.
[[nodiscard]] std::vector<Hit> closest(const TraceScene& scene, std::span<const Ray> rays);
/// The first triangle on the ray up to the path length max_length, or HitKind::none.
[[nodiscard]] Hit closest_triangle(const TraceScene& scene, const Ray& ray, double max_length = kInfinity);
/// Whether a triangle lies on the ray between t_min and max_length. Walls, floor and ceiling are ignored.
[[nodiscard]] bool occluded(const TraceScene& scene, const Ray& ray, double max_length);

}  // namespace orbc::trace
