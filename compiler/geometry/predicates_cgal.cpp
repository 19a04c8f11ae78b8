// The one file that knows CGAL's kernel: filtered exact signs of 3×3 determinants (Brönnimann, Burnikel, Pion 2001).
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "compiler/geometry/predicates.h"

namespace orbc::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Vector_3 vector(const Ambient& p) { return {p.w, p.x, p.y}; }

}  // namespace

Side side_of(const Ambient& p, const Ambient& q, const Ambient& x) {
  return static_cast<Side>(CGAL::orientation(vector(p), vector(q), vector(x)));
}

Containment contains(const std::vector<Point>& outline, const Point& x) {
  Containment result = Containment::inside;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Side side = side_of(outline[i], outline[(i + 1) % outline.size()], x);
    if (side == Side::right) return Containment::outside;
    if (side == Side::on) result = Containment::on_border;
  }
  return result;
}

bool is_convex(const std::vector<Point>& outline) {
  // Every vertex on the left of (or on) every edge's line, and some vertex strictly left of each: then the edges bound the
  // intersection of their half planes. Turning once around follows, since a curve that winds twice leaves some half plane.
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    bool strict = false;
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i || j == (i + 1) % n) continue;
      const Side side = side_of(outline[i], outline[(i + 1) % n], outline[j]);
      if (side == Side::right) return false;
      strict = strict || side == Side::left;
    }
    if (!strict) return false;
  }
  return true;
}

}  // namespace orbc::geometry
