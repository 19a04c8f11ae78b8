#pragma once
#include <array>
#include <map>
#include <memory>
#include <vector>

#include "compiler/bend/tessellate.h"

namespace orbc::bend {

/// A part made for one copy: cut, lifted, or both. Keeps what its net refers to.
struct OwnPart {
  place::PlacedMesh mesh;
  Uv uv;                ///< of parts that are cut
  PartNet net;
};

/// How a part lies to a wedge. `margin`: radians, as the eye sees it, that still count as near a border.
enum class InWedge { all, some, none };
[[nodiscard]] InWedge place_in(const cover::Wedge& wedge, const LogMap& map, const PartNet& net, double margin = 0);

/// The triangles of a part that lie in the wedge or reach into it, whole: what is bent and then cut (cut_as_seen.h).
/// In: how far beyond a border, in radians as the eye sees it, triangles still count as reaching it.
[[nodiscard]] std::unique_ptr<OwnPart> reaching(const cover::Wedge& wedge, const LogMap& map, const PartNet& net, const Uv& uv,
                                                double margin);

/// Cuts a part to the wedge in which its copy is seen, before it is bent: for the views that do not keep the eye's rays straight. The
/// borders are planes through the eye, so the cuts are straight in the parts' own barycentric coordinates and stay flat.
/// Makes:  vertices on cuts as Σ bᵢXᵢ, not scaled back to the surface, so that heights and uv stay affine (design §2); `net.points` has
///         them on the surface. Where a cut meets an edge follows from the edge's two ends and the border alone: the copy on the other side
///         gets the same vertex bit by bit.
/// Error:  vertices within 1e-12 radians of a border, as the eye sees them, count as on it.
[[nodiscard]] std::unique_ptr<OwnPart> clipped(const cover::Wedge& wedge, const LogMap& map, const PartNet& net, const Uv& uv);

/// The part as it is on a storey: z ↦ sign·z + offset. Triangles keep their order of corners and vertices their uv; the copy is turned
/// inside out when sign < 0.
[[nodiscard]] std::unique_ptr<OwnPart> lifted(const cover::Storey& storey, geometry::Space space, const PartNet& net);

}  // namespace orbc::bend
