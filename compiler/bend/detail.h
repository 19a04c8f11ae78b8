#pragma once
#include "compiler/bend/bend.h"
#include "compiler/bend/log_map.h"
#include "compiler/bend/sight.h"

namespace orbc::bend {

/// An upright cylinder around a mesh: a circle on the floor, and heights.
struct Extent {
  geometry::Point centre;
  double radius = 0;
  double low = 0, high = 0;
  const place::PlacedMesh* mesh = nullptr;   ///< close to the eye the cylinder tells too little: then the mesh is asked; may be missing
  double longest = 0;                        ///< edge of the mesh
};
[[nodiscard]] Extent extent_of(geometry::Space space, const place::PlacedMesh& mesh);

/// How large things of a copy are seen.
class Detail {
 public:
  Detail(const place::Eye& eye, const BendOptions& options);
  /// A bound of the pixels that a unit of length takes in the picture anywhere in the extent, in the copy: whatever is displaced by less
  /// than 1 / this is displaced by less than a pixel. Infinite where it cannot tell: around the eye, and where S² is torn. What lies
  /// outside of a perspective picture counts an eighth, as for bending. `margin`: displacements reach that far beyond the extent.
  /// Formula: a displacement (radial, transverse, upright) at distance r is seen as (δr, δt·r/sinκ r, δz) at distance |(r, z)| ≥ r.
  [[nodiscard]] double pixels_per_length(const cover::Copy& copy, const Extent& extent, double margin) const;
  /// The smaller side of the extent as it is seen, in pixels at most: of something narrower than that a picture shows little. Infinite
  /// around the eye.
  [[nodiscard]] double smaller_side_px(const cover::Copy& copy, const Extent& extent) const;

 private:
  [[nodiscard]] double nearest_vertex(const LogMap& map, const cover::Copy& copy, const Extent& extent) const;

  geometry::Isometry eye_from_room_;
  Sight sight_;
};

}  // namespace orbc::bend
