#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/place/placed.h"
#include "compiler/trace/analytic.h"
#include "compiler/trace/ray.h"

namespace orbc::trace {

class Bvh;

/// A mirror rectangle as the tracer sees it; ends that coincide with the wall's own (to 1e-9) reach to infinity, so that rays into a corner
/// or an edge of the room cannot slip past it.
struct MirrorArea {
  double span[2] = {-kEndless, kEndless}, height[2] = {-kEndless, kEndless};
  bool whole = false;               ///< no end is left: it holds every point of its surface
  scene::Color weight;              ///< reflectance × tint
  scene::Color glow;                ///< radiance of its own
  int mirror = -1;                  ///< index into PlacedRoom::mirrors
};

/// What one looks up about the look of a wall, the floor or the ceiling where it is no mirror.
struct Panel {
  int part = -1;                    ///< first part of that kind, or −1: there is none to see
  int look = -1;                    ///< its first look
};

/// A furnished room made ready for rays. Refers to the PlacedRoom, which must live as long and keep its place. Copies share the BVH.
struct TraceScene {
  const place::PlacedRoom* room = nullptr;
  Prism prism;
  std::vector<std::vector<MirrorArea>> mirrors;  ///< per wall; the first that holds the point counts
  std::optional<MirrorArea> floor_mirror, ceiling_mirror;
  std::vector<Panel> walls;
  Panel floor, ceiling;
  std::shared_ptr<const Bvh> objects;  ///< the triangles of parts of kind object and frame
  bool masked = false;              ///< some triangles have holes, by the alpha of their texture (Look::cutoff): there rays go on
  bool all_inside = true;           ///< no triangle reaches out of the prism: the walls need asking only when no triangle is met
};

/// Makes a room ready for rays: packs the triangles, builds the BVH (in parallel through `execute`; same tree for any number of threads).
[[nodiscard]] TraceScene prepare(const place::PlacedRoom& room, const Executor& execute = serial_executor());

enum class Target { nothing, triangle, wall, floor, ceiling };

/// What a ray meets first, and after which path length.
struct Hit {
  Target target = Target::nothing;
  double t = kEndless;
  int part = -1;                    ///< triangle: index into PlacedRoom::parts
  int triangle = -1;                ///< and into PlacedMesh::triangles
  double b[3] = {0, 0, 0};          ///< affine barycentric coordinates there, of the triangle's corners in order
  int wall = -1;                    ///< wall (from 0)
};

/// The first thing on the ray: a triangle of an object or frame, or the wall, floor or ceiling by which it leaves the room (mirror or not).
/// In:     a ray that starts in the room. Thread-safe.
/// Exact:  the same triangle, t and b as trying `intersect` on every triangle (ties in t aside).
[[nodiscard]] Hit closest(const TraceScene& scene, const Ray& ray);
/// The same for many rays at once, bit by bit, in about two thirds of the time: set up eight at a time, walked in turns. Best for 32 and
/// more.
[[nodiscard]] std::vector<Hit> closest(const TraceScene& scene, std::span<const Ray> rays);
/// The triangles alone, up to max_length.
[[nodiscard]] Hit closest_triangle(const TraceScene& scene, const Ray& ray, double max_length = kEndless);
/// Whether a triangle lies between t_min and max_length on the ray. Walls do not count: follow() answers for those.
[[nodiscard]] bool occluded(const TraceScene& scene, const Ray& ray, double max_length);

}  // namespace orbc::trace
