#pragma once
#include <memory>

#include "compiler/bend/edge_mesh.h"

namespace orbc::bend {

/// A part that was made for one copy: clipped, or moved to a storey. `part` refers to `mesh`, so a ClippedPart stays where it is.
struct ClippedPart {
  place::PlacedMesh mesh;
  Uv uv;  ///< of clipped parts
  EdgeMesh part;
};

enum class WedgeOverlap { inside, partial, outside };

/// How a part lies to the wedge of its copy, from its bounding circle: `partial` when the circle does not decide.
/// In: a margin in radians at the eye; parts closer to a border count as partial.
[[nodiscard]] WedgeOverlap wedge_overlap(const cover::Wedge& wedge, const LogMap& map, const EdgeMesh& part, double margin = 0);

/// The triangles of a part that overlap the wedge of its copy, uncut. They are bent and then clipped (clip_in_eye_space.h).
/// In: uv parallel to the part's vertices; a margin in radians at the eye, by which the wedge is enlarged.
[[nodiscard]] std::unique_ptr<ClippedPart> triangles_touching(const cover::Wedge& wedge, const LogMap& map, const EdgeMesh& part,
                                                              const Uv& uv, double margin);

/// Clips a part to the wedge of its copy, before bending: for views in which the eye's rays are not straight. The borders are planes
/// through the eye, so the cuts are straight in the triangles' barycentric coordinates.
/// In:    uv parallel to the part's vertices.
/// Makes: vertices on cuts as Σ bᵢXᵢ, not scaled back to the surface, so that heights and uv stay affine (design §2); part.points has them
///        on the surface. The cut of an edge depends on its two ends and the border alone: the copy on the other side gets the same vertex
///        bit by bit.
/// Error: vertices within 1e-12 radians of a border, as seen from the eye, count as on it.
[[nodiscard]] std::unique_ptr<ClippedPart> clipped(const cover::Wedge& wedge, const LogMap& map, const EdgeMesh& part, const Uv& uv);

/// The part on a storey: z ↦ sign·z + offset. Vertices and corners keep their order, so the part is inside out when sign < 0.
[[nodiscard]] std::unique_ptr<ClippedPart> on_storey(const cover::Storey& storey, geometry::Space space, const EdgeMesh& part);

}  // namespace orbc::bend
