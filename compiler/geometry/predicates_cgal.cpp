// The only file that includes CGAL's kernel: filtered exact signs of 3×3 determinants (Brönnimann, Burnikel, Pion 2001).
#if defined(__EMSCRIPTEN__) && !defined(CGAL_ALWAYS_ROUND_TO_NEAREST)
#error "WebAssembly always rounds to nearest: without CGAL_ALWAYS_ROUND_TO_NEAREST, CGAL's filters give wrong signs and do not notice it"
#endif
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
  // If every vertex lies to the left of (or on) the line of every edge, and some vertex strictly to the left of each, then the edges bound
  // the intersection of their half planes. A curve that winds around twice leaves some half plane.
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
