#pragma once
#include <array>
#include <complex>
#include <string>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/geometry/isometry.h"
#include "compiler/notation/symbol.h"

namespace orbc::room {

/// How a side of a fundamental polygon is glued: it is a mirror, or it is glued to its partner, with orientation kept or reversed.
enum class SideKind { mirror, pair, glide };

struct GluedSide {
  std::string name;  ///< of both sides of a pair; mirrors are m0, m1, …
  SideKind kind = SideKind::mirror;
  int partner = 0;  ///< counts from 0; mirrors are their own
  double length = 0;
  std::string decimal;  ///< the length to 18 digits
};

/// A convex polygon around a circle whose sides, glued in pairs or reflecting, make an orbifold. Sides and corners count from 0 and run
/// counter-clockwise; corner i is where side i starts. The last side touches the circle in the direction of +x.
struct GluedPolygon {
  geometry::Space space{};
  std::vector<GluedSide> sides;
  std::vector<int> corner_fraction;           ///< the interior angle of corner i is 2π/corner_fraction[i]
  std::vector<std::complex<double>> corners;  ///< in the disk chart; E²: plane coordinates
  std::vector<double> touch_angles;           ///< the direction from the centre to where side i touches the circle
  double inradius = 0;
  std::string inradius_decimal;            ///< to 20 digits
  std::vector<std::vector<int>> relators;  ///< one for each class of corners: the sides that a walk around it crosses
  double relator_residual = 0;             ///< largest entry by which a relator's isometry differs from the identity
};

/// The star-or-chord polygon of a symbol: cuts from one free point to every feature; where there are two features, one cut between them.
/// Formula: a tangential polygon with these angles: Σ 2·asin(cos(α/2)/cosκ r) = 2π fixes the inradius r; the tangent at a corner has the
///          length t with sinκ t = tanκ r · cot(α/2). Corners that are glued together have equal angles, so glued sides have equal lengths;
///          by Poincaré's polygon theorem the gluing makes the orbifold. In E² the inradius is 1.
/// Exact:   angles are fractions of 2π; the relators are found from the gluing alone. Error: lengths to 1e-40.
///          Two equal cone points are a digon whose sides are glued, a cross-cap alone is a hemisphere whose rim is.
/// Diagnostics: notation.bad-orbifold; room.no-such-shape for orders above 4,000 and for *, which has one side.
[[nodiscard]] Result<GluedPolygon> glued_polygon(const notation::Symbol& symbol);

/// A linear map of the ambient space (w, x, y), by rows.
using AmbientMap = std::array<std::array<double, 3>, 3>;

/// For each side the isometry that carries the polygon onto its neighbour behind that side, and the side's partner onto the side.
/// Error: 1e-16 of the entries.
[[nodiscard]] std::vector<AmbientMap> crossing_maps(const GluedPolygon& polygon);

/// The same as Möbius maps.
[[nodiscard]] std::vector<geometry::Isometry> crossing_isometries(const GluedPolygon& polygon);

}  // namespace orbc::room
