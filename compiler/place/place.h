#pragma once
#include <cstddef>

#include "compiler/base/result.h"
#include "compiler/place/placed.h"

namespace orbc::place {

struct EmbedOptions {
  double tolerance = 1e-4;               ///< intrinsic length; > 0
  std::size_t max_triangles = 20'000'000;
};

/// Embeds an object's mesh and moves it to its place.
/// In:          a mesh as its file has it; the room and its height.
/// Makes:       the mesh posed: by the shortest turn that brings its axis `object.up` up (−z: about x), stretched along its axes as they
///              are now by `object.scale` (triangles of mirror images are turned over, so that outside stays outside), turned about these
///              axes by `object.rotate`: x, then y, then z. Then centred by its volume centroid (surface centroid if it is open) on the
///              vertical axis, scaled so that its longer horizontal extent, as it lies now, is `object.size`, turned about the vertical,
///              standing at height `place.z` (its lowest point; on the floor if missing).
///              Conformal: horizontal coordinates (x, y) become the disk point (x + iy)/2 (E²: x + iy), so that lengths on the axis are
///              true. Exponential: they become log coordinates, so that distances from the axis are true. Heights are scaled like the rest.
///              Then the Möbius translation of the place moves it. `look` is the mesh's own `material`; `pattern_position` is centred and
///              scaled, but neither rotated nor turned.
/// Error:       a geodesic triangle departs from the embedded flat one by at most about `tolerance`: longer edges are halved, each judged
///              by itself.
/// Exact:       containment, for every vertex as stored; touching walls, floor and ceiling is allowed. Since the room is convex, all
///              between is inside too.
/// Diagnostics: those of `locate`; place.object-outside-room (wall or ceiling, largest overhang, a size that fits); place.too-large for its
///              space; place.flat-object (`size` of a mesh without horizontal extent); those of mesh::refine.
[[nodiscard]] Result<PlacedMesh> place_object(const mesh::Mesh& mesh, const scene::Object& object, const room::Room& room, double height,
                                              const EmbedOptions& options = {});

/// The factor that gives the interval [low, high] on the axis (low < 0 < high, own units) the intrinsic length `size` once embedded.
/// Formula: conformal maps x to 2·atanκ(f·x/2), so tanκ(size/2) = f(a−b)/(1 + κf²ab) with a = high/2, b = low/2, solved for the smaller f.
[[nodiscard]] double scale_for_size(geometry::Space space, scene::Embedding embedding, double low, double high, double size);

}  // namespace orbc::place
