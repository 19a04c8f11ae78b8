#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/bend/log_map.h"
#include "compiler/bend/sight.h"

namespace orbc::bend {

/// A part of the room made ready for bending many times: its edges, each once, and how large it is. Uv go beside it: copies may differ in
/// them.
struct PartNet {
  const place::PlacedMesh* mesh = nullptr;
  PointColumns points;
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::array<std::uint32_t, 3>> triangle_edges;  ///< edge k of a triangle joins its corners k and k+1
  geometry::Point centre;                                    ///< of a circle on the floor around all vertices
  double radius = 0;
  double low = 0, high = 0;          ///< range of z
  double longest = 0, steepest = 0;  ///< largest length on the floor and largest rise of an edge
  double along = 0;                  ///< > 0: colours vary inside triangles; their shift counts with this tolerance
};

[[nodiscard]] PartNet part_net(geometry::Space space, const place::PlacedMesh& mesh, double along);

/// The curved map of one copy, for both views.
struct CopyMap {
  View view = View::eye;
  LogMap log;
};

/// The image in double. In: v a positive multiple of a point (H²: in the frame of the room, where nothing cancels).
[[nodiscard]] geometry::Vector3 image_of(const CopyMap& map, const geometry::Ambient& v, double z);

/// View::eye: a bound of the acceleration of the image of a unit-speed geodesic whose points lie at distances from … to of the eye's foot;
/// infinite where it cannot tell. Formulas: part_net.cpp.
[[nodiscard]] double acceleration(const CopyMap& map, double from, double to);

/// A bound of the error (in tolerances) of drawing the part as it is, from distances alone; infinite when it cannot tell.
[[nodiscard]] double error_bound(const CopyMap& map, const Sight& sight, const PartNet& net);

/// A vertex that a split has made. `v` = Σ bᵢXᵢ is not scaled back to the surface: so b, z and uv stay affine (design §2).
struct NewVertex {
  geometry::Ambient v;
  double z = 0;
  std::array<double, 2> uv{};
  geometry::Vector3 at;
  bool fixed = false;  ///< on the circle around a singular axis of S²: `at` is its only image
};

/// A bent part: vertices [0, net.points.w.size()) are those of the part, further ones are `vertices`.
struct Tessellation {
  std::vector<NewVertex> vertices;
  std::vector<mesh::Triangle> triangles;
  std::vector<bool> decisions;  ///< of every edge and triangle, as they came up, whether it is split
  double worst = 0;             ///< largest error in the picture, in tolerances
  bool too_many = false;        ///< stopped at `most` triangles
};

/// Splits the part until every chord and every triangle lies within the tolerance. Each edge is judged by itself, from what its two ends
/// are in the room and in the picture, in an order that does not depend on the triangle: neighbours agree, so there are no cracks and no
/// T-junctions. On S² the axes through the eye's foot and its antipode, where the image is torn, are cut out: a triangle around one becomes
/// a ring that ends on the circle that is the image of the axis.
[[nodiscard]] Tessellation tessellate(const CopyMap& map, const Sight& sight, const PartNet& net, const Uv& uv, std::uint64_t most);

/// The same vertices and triangles from what was decided: nothing is judged again. Only vertices that are `fixed` are told where they lie
/// in the picture; `decisions` and `worst` stay empty.
[[nodiscard]] Tessellation tessellate_again(const CopyMap& map, const Sight& sight, const PartNet& net, const Uv& uv,
                                            const std::vector<bool>& decisions);

}  // namespace orbc::bend
