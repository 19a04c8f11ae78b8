#pragma once
#include "compiler/bend/bend.h"
#include "compiler/bend/log_map.h"

namespace orbc::bend {

/// The curved map of one copy, for both views: room coordinates → eye coordinates (View::eye) or disk chart × height (View::disk).
struct CopyMap {
  View view = View::eye;
  LogMap log;
  double chart_scale = 1;  ///< View::disk
};

/// The image of a point, in double.
/// In: v a positive multiple of a point in room coordinates (H²: so that nothing cancels), and its height.
[[nodiscard]] geometry::Vector3 image_of(const CopyMap& map, const geometry::Ambient& v, double z);

/// View::eye: an upper bound of the acceleration of the image of a unit-speed geodesic on the floor, whose points lie at distances from …
/// to of the eye's foot. kUnbounded around the axes at which the map of S² is torn.
/// Formula: a geodesic parametrised by arc length, in polar coordinates r, φ of the log chart (sinκ²(r)φ' = const), has the acceleration
///   radial (sinκ cosκ − r)/sinκ² · sin²ψ,   transverse (sinκ − r cosκ)/sinκ² · sin 2ψ      (ψ = angle to the radius).
[[nodiscard]] double acceleration_bound(const CopyMap& map, double from, double to);

}  // namespace orbc::bend
