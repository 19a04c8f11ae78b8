#pragma once
#include <map>
#include <vector>

#include "compiler/place/net.h"
#include "compiler/place/panels.h"

namespace orbc::place {

/// The points that panels share along the foot of one wall, by arc length: each place has one point, whoever asked for it first.
/// Arc lengths closer than 1e-9 of the room's size are one place. Keys 0 and `length` are the wall's ends as the outline stores them.
class Rail {
 public:
  Rail(const room::Room& room, int wall);
  /// The key of the place at arc length s, made from the wall's formula if it is new.
  double key(double s);
  /// The key of a point on the wall; the point is kept if the place is new. At the seam of a closed wall: 0.
  double key(const geometry::Point& x);
  [[nodiscard]] const geometry::Point& at(double key) const { return points_.at(key); }
  /// The outline's own points.
  [[nodiscard]] const std::vector<double>& given() const { return given_; }

 private:
  [[nodiscard]] const double* near(double s) const;
  const room::Room& room_;
  int wall_;
  double same_;
  std::map<double, geometry::Point> points_;
  std::vector<double> given_;
};

/// One rail for each wall.
[[nodiscard]] std::vector<Rail> make_rails(const room::Room& room);

}  // namespace orbc::place
