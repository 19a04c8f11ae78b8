#pragma once
#include <map>
#include <vector>

#include "compiler/place/panels.h"
#include "compiler/place/polygon_mesh.h"

namespace orbc::place {

/// The points on one wall's foot that neighbouring panels share, so that vertices on common edges are equal bit by bit. A point is known by
/// its key, an arc length along the wall. Invariant: there is one point per arc length; lengths closer than 1e-9 of the room's size count
/// as equal. The keys 0 and `length` are the wall's ends as the outline stores them.
class SharedWallPoints {
 public:
  SharedWallPoints(const room::Room& room, int wall);
  /// The key of the point at arc length s. A new point is computed from the wall's formula.
  double key(double s);
  /// The key of the point at X's arc length. A new point is X itself. At the start of a wall without corners the key is 0.
  double key(const geometry::Point& x);
  /// In: a key that `key` has returned.
  [[nodiscard]] const geometry::Point& at(double key) const { return points_.at(key); }
  /// The keys of the outline's own points on the wall.
  [[nodiscard]] const std::vector<double>& outline_keys() const { return outline_keys_; }

 private:
  [[nodiscard]] const double* known_key(double s) const;
  const room::Room& room_;
  int wall_;
  double tolerance_;
  std::map<double, geometry::Point> points_;
  std::vector<double> outline_keys_;
};

/// The shared points of each wall, in the order of the walls.
[[nodiscard]] std::vector<SharedWallPoints> shared_wall_points(const room::Room& room);

}  // namespace orbc::place
