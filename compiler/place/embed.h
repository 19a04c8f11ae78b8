#pragma once
#include <cstddef>

#include "compiler/base/result.h"
#include "compiler/place/interior.h"

namespace orbc::place {

struct EmbedOptions {
  double tolerance = 1e-4;               ///< intrinsic length, > 0; see Error
  std::size_t max_triangles = 20'000'000;
};

/// Embeds an object's mesh into the room's space and moves it to its place.
/// In:          a mesh as its file has it; the room and its height.
/// Makes:       the mesh after these steps, in this order:
///              1. The shortest rotation turns its axis `object.up` upwards (−z: about x).
///              2. `object.scale` scales it along its axes. Triangles of mirror images are flipped, so that outside stays outside.
///              3. `object.rotate` rotates it about these axes: x, then y, then z.
///              4. Its volume centroid (surface centroid if it is open) is moved onto the vertical axis.
///              5. It is scaled until its longer horizontal extent is `object.size`; heights are scaled by the same factor.
///              6. It is rotated about the vertical by `object.turn`, and its lowest point is put at height `place.z` (default: the floor).
///              7. Conformal: horizontal coordinates (x, y) become the disk point (x + iy)/2 (E²: x + iy), so that lengths on the axis are
///                 true. Exponential: they become log coordinates, so that distances from the axis are true.
///              8. The Möbius translation of the place moves it.
///              `style` is the mesh's own `material`. `pattern_position` includes steps 1, 2, 4 and 5 only.
/// Error:       a geodesic triangle deviates from the embedded flat one by at most about `tolerance`: longer edges are halved, each by its
///              own test.
/// Exact:       containment, for every vertex as stored; touching walls, floor and ceiling is allowed. Since the room is convex, the
///              triangles are inside too.
/// Diagnostics: those of `locate`; place.object-outside-room (wall or ceiling, largest overhang, a size that fits); place.too-large for its
///              space; place.flat-object (`size` of a mesh without horizontal extent); those of mesh::refine.
[[nodiscard]] Result<PlacedMesh> place_object(const mesh::Mesh& mesh, const scene::Object& object, const room::Room& room, double height,
                                              const EmbedOptions& options = {});

/// The factor that gives the interval [low, high] on an axis of the mesh the intrinsic length `size` after embedding.
/// In:      low < 0 < high, in units of the mesh.
/// Formula: the conformal embedding maps x to 2·atanκ(f·x/2), so tanκ(size/2) = f(a−b)/(1 + κf²ab) with a = high/2, b = low/2, solved for
/// the smaller f.
[[nodiscard]] double scale_for_size(geometry::Space space, scene::Embedding embedding, double low, double high, double size);

}  // namespace orbc::place
