#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "compiler/bend/edge_mesh.h"
#include "compiler/bend/screen_metric.h"

namespace orbc::bend {

/// The upright axes at which the log map of S² is torn: through the antipode of the eye's foot, and from sheet 1 on also through the foot.
enum class Axis : std::uint8_t { none, foot, antipode };

/// A vertex of a tessellation and its image.
struct Corner {
  geometry::Ambient v;  ///< Σ bᵢXᵢ in room coordinates, not scaled back to the surface
  double z = 0;
  std::array<double, 2> uv{};
  geometry::Vector3 image;        ///< of a corner on an axis: some point of the circle
  Axis axis = Axis::none;         ///< the axis on which the corner lies
  geometry::Ambient eye_ambient;  ///< eye_from_copy · v
  double distance = 0;            ///< on the floor, from the eye's foot
  double norm = 1;                ///< of v; 1 on the surface
};

/// The point at parameter t between two corners, without its image.
[[nodiscard]] Corner lerp(const Corner& a, const Corner& b, double t);

/// The map of a copy with what tessellation must know of the axes at which it is torn. The image of an axis is a circle around the eye's
/// axis. It is drawn as a regular polygon, which is the same for all parts and for both sheets that meet there.
/// Error: points closer than 1e-9 radians to an axis, as seen from the eye, count as on it.
class TornMap {
 public:
  TornMap(const CopyMap& map, const ScreenMetric& metric);

  [[nodiscard]] const CopyMap& map() const { return map_; }
  [[nodiscard]] bool has_axes() const { return map_.log.space == geometry::Space::spherical; }
  /// The circle that is the image of an axis; radius 0 when the map is not torn there.
  [[nodiscard]] double circle_radius(Axis axis) const;
  [[nodiscard]] double circle_step() const;  ///< angle of one side of the polygon, in radians
  /// The point of the circle of an axis in a direction.
  [[nodiscard]] Corner on_circle(Corner corner, double angle) const;

  [[nodiscard]] Corner corner(const geometry::Ambient& v, double z, const std::array<double, 2>& uv) const;
  /// A corner that lies on an axis: `corner` with its axis and image.
  [[nodiscard]] Corner on_axis(Corner corner, Axis axis) const;
  /// The image of a corner as the end of an edge from `from`. The image of an axis is the point of its polygon in the direction of `from`.
  [[nodiscard]] geometry::Vector3 image_towards(const Corner& corner, const Corner& from) const;

  /// The corner at which an edge crosses an axis; nothing when it crosses none.
  [[nodiscard]] std::optional<Corner> axis_crossing(const Corner& a, const Corner& b) const;
  /// The corner at which an axis crosses a triangle; nothing when none crosses it.
  [[nodiscard]] std::optional<Corner> axis_crossing(const Corner& a, const Corner& b, const Corner& c) const;
  /// The parameter at which an edge has the direction, seen from the axis, that bisects the directions of its ends. An edge that passes an
  /// axis closely turns there and nowhere else. Nothing where the map has no axes.
  /// Exact: rounded to 8 bits, so that neighbours choose the same point although their matrices differ in the last bit.
  [[nodiscard]] std::optional<double> bisection(const Corner& a, const Corner& b) const;

 private:
  [[nodiscard]] Axis axis_of(const geometry::Ambient& eye_ambient) const;

  CopyMap map_;
  int circle_steps_ = 8;
};

}  // namespace orbc::bend
