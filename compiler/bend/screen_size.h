#pragma once
#include "compiler/bend/bend.h"
#include "compiler/bend/log_map.h"
#include "compiler/bend/screen_metric.h"

namespace orbc::bend {

/// An upright cylinder around a mesh: a circle on the floor, and a range of heights.
struct BoundingCylinder {
  geometry::Point centre;
  double radius = 0;
  double low = 0, high = 0;
  const place::PlacedMesh* mesh = nullptr;  ///< optional: bounds use its vertices where the eye is close to the cylinder
  double max_edge_length = 0;               ///< of the mesh
};
[[nodiscard]] BoundingCylinder bounding_cylinder(geometry::Space space, const place::PlacedMesh& mesh);

/// How large the content of a cylinder appears in the picture, as part of a copy.
class ScreenSize {
 public:
  ScreenSize(const place::Camera& eye, const BendOptions& options);
  /// An upper bound of the pixels per unit of length, anywhere in the cylinder and up to `margin` (a length) beyond it: a displacement by
  /// less than 1 / this is a displacement by less than a pixel. kUnbounded around the eye, and where the map of S² is torn. What lies
  /// outside of a perspective picture is divided by kOffscreenFactor.
  /// Formula: a displacement (radial, transverse, upright) at distance r appears as (δr, δt·r/sinκ r, δz) at distance |(r, z)| ≥ r.
  [[nodiscard]] double pixels_per_length(const cover::Copy& copy, const BoundingCylinder& cylinder, double margin) const;
  /// An upper bound of the smaller of width and height of the cylinder in the picture, in pixels. kUnbounded around the eye.
  [[nodiscard]] double smaller_side_px(const cover::Copy& copy, const BoundingCylinder& cylinder) const;

 private:
  [[nodiscard]] double nearest_vertex(const LogMap& map, const cover::Copy& copy, const place::PlacedMesh& mesh) const;
  [[nodiscard]] double max_pixels_in_ball(const geometry::Vector3& centre, double radius) const;

  geometry::Isometry eye_from_room_;
  ScreenMetric metric_;
};

}  // namespace orbc::bend
