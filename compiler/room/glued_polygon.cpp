#include "compiler/room/glued_polygon.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "compiler/room/real.h"

namespace orbc::room {
namespace {

using geometry::Space;
using notation::Symbol;

constexpr int kLargestOrder = 4000;

/// Adds sides and corners in their order. Names of cuts run a, b, …, z, a1, b1, ….
struct Builder {
  GluedPolygon polygon;
  int cuts = 0, mirrors = 0;

  std::string next_name() {
    const std::string name(1, static_cast<char>('a' + cuts % 26));
    return cuts++ < 26 ? name : name + std::to_string((cuts - 1) / 26);
  }
  int add(int fraction, const std::string& name, SideKind kind) {
    polygon.corner_fraction.push_back(fraction);
    polygon.sides.push_back({name, kind, static_cast<int>(polygon.sides.size()), 0, {}});
    return static_cast<int>(polygon.sides.size()) - 1;
  }
  void glue(int a, int b) {
    polygon.sides[static_cast<std::size_t>(a)].partner = b;
    polygon.sides[static_cast<std::size_t>(b)].partner = a;
  }
  /// The mirrors of a boundary: a right angle, then its corners.
  void add_mirrors(const std::vector<int>& corners) {
    add(4, fmt::format("m{}", mirrors++), SideKind::mirror);
    for (const int order : corners) add(2 * order, fmt::format("m{}", mirrors++), SideKind::mirror);
  }
};

GluedPolygon star(const Symbol& symbol, int free_corners) {
  Builder builder;
  for (const int order : symbol.cones) {
    const std::string name = builder.next_name();
    const int first = builder.add(free_corners, name, SideKind::pair);
    builder.glue(first, builder.add(order, name, SideKind::pair));
  }
  for (const std::vector<int>& corners : symbol.boundaries) {
    const std::string name = builder.next_name();
    const int first = builder.add(free_corners, name, SideKind::pair);
    builder.add_mirrors(corners);
    builder.glue(first, builder.add(4, name, SideKind::pair));
  }
  for (int i = 0; i < symbol.handles; ++i) {
    const std::string name = builder.next_name();
    const int a = builder.add(free_corners, name, SideKind::pair), b = builder.add(free_corners, name + "2", SideKind::pair);
    builder.glue(a, builder.add(free_corners, name, SideKind::pair));
    builder.glue(b, builder.add(free_corners, name + "2", SideKind::pair));
  }
  for (int i = 0; i < symbol.crosscaps; ++i) {
    const std::string name = builder.next_name();
    const int first = builder.add(free_corners, name, SideKind::glide);
    builder.glue(first, builder.add(free_corners, name, SideKind::glide));
  }
  return builder.polygon;
}

/// Mirrors alone.
GluedPolygon kaleidoscope(const std::vector<int>& corners) {
  Builder builder;
  for (const int order : corners) builder.add(2 * order, fmt::format("m{}", builder.mirrors++), SideKind::mirror);
  return builder.polygon;
}

/// One cut, from a cone point to a boundary or between two boundaries.
GluedPolygon chord(const Symbol& symbol) {
  Builder builder;
  if (symbol.cones.size() == 1) {
    const int first = builder.add(symbol.cones[0], "e", SideKind::pair);
    builder.add_mirrors(symbol.boundaries[0]);
    builder.glue(first, builder.add(4, "e", SideKind::pair));
    return builder.polygon;
  }
  builder.add_mirrors(symbol.boundaries[0]);
  const int first = builder.add(4, "e", SideKind::pair);
  builder.add_mirrors(symbol.boundaries[1]);
  builder.glue(first, builder.add(4, "e", SideKind::pair));
  return builder.polygon;
}

/// Two half great circles that are glued to each other: two equal cone points, or a cross-cap, on the sphere.
GluedPolygon digon(int fraction, SideKind kind) {
  Builder builder;
  builder.add(fraction, "a", kind);
  builder.glue(0, builder.add(fraction, "a", kind));
  return builder.polygon;
}

// ---- the tangential polygon -------------------------------------------------------------------------------------------------

Real cos_k(Space space, const Real& s) {
  return space == Space::spherical ? Real(cos(s)) : space == Space::hyperbolic ? Real(cosh(s)) : Real(1);
}
Real sin_k(Space space, const Real& s) { return space == Space::spherical ? Real(sin(s)) : space == Space::hyperbolic ? Real(sinh(s)) : s; }
Real asin_k(Space space, const Real& v) {
  return space == Space::spherical ? Real(asin(v)) : space == Space::hyperbolic ? Real(asinh(v)) : v;
}

struct Angles {
  std::vector<Real> half_cos, half_sin;  ///< of half the interior angles
};

Angles angles_of(const GluedPolygon& polygon) {
  Angles angles;
  for (const int fraction : polygon.corner_fraction) {
    const Real half = real_pi() / fraction;
    angles.half_cos.push_back(fraction == 2 ? Real(0) : Real(cos(half)));
    angles.half_sin.push_back(sin(half));
  }
  return angles;
}

/// Half the angle at the centre that a corner takes.
Real half_at_centre(Space space, const Angles& angles, std::size_t i, const Real& inradius) {
  if (angles.half_cos.size() == 2) return real_pi() / 2;  // a digon: the corners are opposite points
  const Real ratio = angles.half_cos[i] / cos_k(space, inradius);
  return asin(ratio > 1 ? Real(1) : ratio);
}

/// The inradius at which the angles at the centre add up to 2π; they fall (H²) or grow (S²) with it.
std::optional<Real> solved_inradius(Space space, const GluedPolygon& polygon) {
  if (space == Space::euclidean) return Real(1);
  if (polygon.sides.size() == 2) return real_pi() / polygon.corner_fraction[0];
  const Angles angles = angles_of(polygon);
  const auto excess = [&](const Real& r) {
    Real sum = 0;
    for (std::size_t i = 0; i < angles.half_cos.size(); ++i) sum += 2 * half_at_centre(space, angles, i, r);
    return Real(sum - 2 * real_pi());
  };
  Real low = 0, high = 0;
  if (space == Space::hyperbolic) {
    high = 1;
    while (excess(high) > 0 && high < 100) high *= 2;
  } else {
    // cos r may not fall below the largest cos(α/2).
    high = acos(*std::max_element(angles.half_cos.begin(), angles.half_cos.end()));
    // There it may be met, as by m*; the arc sine has half of the digits at 1.
    if (abs(excess(high)) < Real("1e-20")) return high;
    if (excess(high) < 0) return std::nullopt;
  }
  constexpr int kBisections = 36, kNewtonSteps = 5;  // 1e-10, then twice the digits each
  for (int i = 0; i < kBisections; ++i) {
    const Real middle = (low + high) / 2;
    ((excess(middle) > 0) == (space == Space::hyperbolic) ? low : high) = middle;
  }
  Real r = (low + high) / 2;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Real c = cos_k(space, r), s = sin_k(space, r);
    Real slope = 0;  // of asin(h/cosκ r): ±h·sinκ r/(cosκ² r·√(1 − h²/cosκ² r)), + on the sphere
    for (const Real& h : angles.half_cos) {
      const Real inside = 1 - h * h / (c * c);
      if (inside > 0) slope += 2 * h * s / (c * c * sqrt(inside));
    }
    if (slope == 0) break;
    r -= excess(r) / (space == Space::spherical ? slope : Real(-slope));
  }
  return r;
}

/// A 3×3 matrix of the ambient space (w, x, y).
using Matrix = std::array<std::array<Real, 3>, 3>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  return c;
}
Matrix rotation(const Real& angle) {
  const Real c = cos(angle), s = sin(angle);
  return {{{1, 0, 0}, {0, c, -s}, {0, s, c}}};
}
/// The translation by s along the x axis.
Matrix translation(Space space, const Real& s) {
  const Real c = cos_k(space, s), v = sin_k(space, s);
  const int k = space == Space::spherical ? 1 : space == Space::hyperbolic ? -1 : 0;
  return {{{c, -k * v, 0}, {v, c, 0}, {0, 0, 1}}};
}

/// The isometries that carry the partner of each side onto it, and the polygon onto its neighbour behind that side.
std::vector<Matrix> crossings(const GluedPolygon& polygon, const std::vector<Real>& touch, const Real& inradius) {
  std::vector<Matrix> all;
  for (std::size_t i = 0; i < polygon.sides.size(); ++i) {
    const GluedSide& side = polygon.sides[i];
    const Matrix turn = side.kind == SideKind::pair ? rotation(real_pi()) : Matrix{{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}};
    Matrix map = product(rotation(touch[i]), translation(polygon.space, inradius));
    map = product(map, turn);
    map = product(map, translation(polygon.space, -inradius));
    all.push_back(product(map, rotation(-touch[static_cast<std::size_t>(side.partner)])));
  }
  return all;
}

// ---- relators ---------------------------------------------------------------------------------------------------------------

/// The sides that a walk around a corner crosses, until it has turned by 2π; marks the corners that it meets.
std::vector<int> walk_around(const GluedPolygon& polygon, int corner, std::set<int>& met) {
  const int n = static_cast<int>(polygon.sides.size());
  std::vector<int> word;
  Rational turned = 0;
  int side = corner, at = corner;  // the next side, and the corner of the polygon where the walk is
  bool at_start = true;            // of the side
  while (turned < 1) {
    met.insert(at);
    turned += Rational(1, polygon.corner_fraction[static_cast<std::size_t>(at)]);
    word.push_back(side);
    const GluedSide& crossed = polygon.sides[static_cast<std::size_t>(side)];
    // Pairs are glued start to end, mirrors and glides start to start.
    const bool arrives_at_start = crossed.kind == SideKind::pair ? !at_start : at_start;
    at = arrives_at_start ? crossed.partner : (crossed.partner + 1) % n;
    side = arrives_at_start ? (crossed.partner + n - 1) % n : at;
    at_start = !arrives_at_start;
  }
  return word;
}

double residual_of(const std::vector<int>& word, const std::vector<Matrix>& maps) {
  Matrix all = rotation(0);
  for (const int side : word) all = product(all, maps[static_cast<std::size_t>(side)]);
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) worst = std::max(worst, std::fabs(static_cast<double>(all[i][j] - (i == j ? 1 : 0))));
  return worst;
}

std::string decimal(const Real& value, int digits) { return value.str(digits, std::ios_base::fmtflags(0)); }

std::vector<Real> touch_angles(const GluedPolygon& polygon, const Angles& angles, const Real& inradius) {
  std::vector<Real> touch;
  Real at = 0;
  for (std::size_t i = 0; i < polygon.sides.size(); ++i) {
    at += 2 * half_at_centre(polygon.space, angles, i, inradius);
    touch.push_back(at);
  }
  return touch;
}

void lay_out(GluedPolygon& polygon, const Real& r) {
  const Angles angles = angles_of(polygon);
  const Space space = polygon.space;
  const std::size_t n = polygon.sides.size();
  const std::vector<Real> touch = touch_angles(polygon, angles, r);
  for (const Real& angle : touch) polygon.touch_angles.push_back(static_cast<double>(angle));
  std::vector<Real> tangents;
  for (std::size_t i = 0; i < n; ++i)
    tangents.push_back(n == 2 ? Real(real_pi() / 2)
                              : asin_k(space, sin_k(space, r) / cos_k(space, r) * angles.half_cos[i] / angles.half_sin[i]));
  for (std::size_t i = 0; i < n; ++i) {
    const Real length = tangents[i] + tangents[(i + 1) % n];
    polygon.sides[i].length = static_cast<double>(length);
    polygon.sides[i].decimal = decimal(length, 18);
    // The corner lies at the tangent's end: cosκ d = cosκ r · cosκ t (Pythagoras).
    const Real direction = touch[i] - half_at_centre(space, angles, i, r);
    Real distance = 0;
    if (space == Space::euclidean) distance = sqrt(r * r + tangents[i] * tangents[i]);
    else distance = space == Space::spherical ? Real(acos(cos(r) * cos(tangents[i]))) : Real(acosh(cosh(r) * cosh(tangents[i])));
    const Real radius = space == Space::euclidean ? distance : Real(sin_k(space, distance) / (1 + cos_k(space, distance)));
    polygon.corners.emplace_back(static_cast<double>(radius * cos(direction)), static_cast<double>(radius * sin(direction)));
  }
  const std::vector<Matrix> maps = crossings(polygon, touch, r);
  std::set<int> met;
  for (int corner = 0; corner < static_cast<int>(n); ++corner) {
    if (met.count(corner)) continue;
    polygon.relators.push_back(walk_around(polygon, corner, met));
    polygon.relator_residual = std::max(polygon.relator_residual, residual_of(polygon.relators.back(), maps));
  }
}

}  // namespace

Result<GluedPolygon> glued_polygon(const Symbol& symbol) {
  if (const std::string why = notation::why_bad(symbol); !why.empty())
    return make_error("notation.bad-orbifold", fmt::format("{} is a bad orbifold: {}", notation::to_text(symbol), why));
  const auto too_large = [](const std::vector<int>& orders) {
    return std::any_of(orders.begin(), orders.end(), [](int order) { return order > kLargestOrder; });
  };
  if (too_large(symbol.cones) || std::any_of(symbol.boundaries.begin(), symbol.boundaries.end(), too_large))
    return make_error("room.no-such-shape", fmt::format("polygons are made for orders up to {}", kLargestOrder));
  const int boundaries = static_cast<int>(symbol.boundaries.size());
  const int features = static_cast<int>(symbol.cones.size()) + boundaries + 4 * symbol.handles + 2 * symbol.crosscaps;
  GluedPolygon polygon;
  if (features >= 3) polygon = star(symbol, features);
  else if (features == 2 && boundaries > 0) polygon = chord(symbol);
  else if (features == 1 && boundaries == 1) polygon = kaleidoscope(symbol.boundaries[0]);
  else if (symbol.cones.size() == 2) polygon = digon(symbol.cones[0], SideKind::pair);
  else if (symbol.crosscaps == 1) polygon = digon(2, SideKind::glide);
  if (polygon.sides.size() < 2)
    return make_error("room.no-such-shape", fmt::format("the polygon of {} has fewer than two sides", notation::to_text(symbol)));
  const Rational chi = notation::euler_characteristic(symbol);
  polygon.space = chi > 0 ? Space::spherical : chi < 0 ? Space::hyperbolic : Space::euclidean;
  const auto inradius = solved_inradius(polygon.space, polygon);
  if (!inradius)
    return make_error("room.no-such-shape", fmt::format("no circle touches all sides of the polygon of {}", notation::to_text(symbol)));
  polygon.inradius = static_cast<double>(*inradius);
  polygon.inradius_decimal = decimal(*inradius, 20);
  lay_out(polygon, *inradius);
  return polygon;
}

std::vector<AmbientMap> crossing_maps(const GluedPolygon& polygon) {
  const Angles angles = angles_of(polygon);
  const Real r(polygon.inradius_decimal);
  std::vector<AmbientMap> maps;
  for (const Matrix& exact : crossings(polygon, touch_angles(polygon, angles, r), r)) {
    AmbientMap map{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) map[i][j] = static_cast<double>(exact[i][j]);
    maps.push_back(map);
  }
  return maps;
}

std::vector<geometry::Isometry> crossing_isometries(const GluedPolygon& polygon) {
  const Space space = polygon.space;
  std::vector<geometry::Isometry> all;
  for (std::size_t i = 0; i < polygon.sides.size(); ++i) {
    const GluedSide& side = polygon.sides[i];
    const geometry::Isometry turn =
        side.kind == SideKind::pair ? geometry::rotation(space, std::numbers::pi) : geometry::reflection(space, {0, 1, 0});
    all.push_back(geometry::rotation(space, polygon.touch_angles[i]) * geometry::translation_by(space, polygon.inradius, 0) * turn *
                  geometry::translation_by(space, -polygon.inradius, 0) *
                  geometry::rotation(space, -polygon.touch_angles[static_cast<std::size_t>(side.partner)]));
  }
  return all;
}

}  // namespace orbc::room
