#include "compiler/room/realise.h"

#include <fmt/format.h>

#include <numbers>

#include "compiler/notation/classify.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/print.h"
#include "compiler/room/certificate.h"
#include "compiler/room/polygon.h"
#include "compiler/room/round_to_doubles.h"

namespace orbc::room {
namespace {

using geometry::Space;
using scene::Shape;
using scene::ShapeKind;


bool all_right_angles(const std::vector<Rational>& orders) {
  for (const Rational& k : orders)
    if (k != 2) return false;
  return true;
}

Diagnostic unused(std::string_view what, std::string_view where) {
  return make_error("room.unused-setting", fmt::format("{} means something only {}", what, where), "leave it out");
}

// A setting that has no effect on this room is an error, as an unknown key is.
Diagnostics shape_faults(const Shape& shape, Space space, bool strip, bool rectangle) {
  Diagnostics faults;
  const auto good = [](double size) { return size >= kMinScale && size <= kMaxScale; };
  for (const auto& [name, size] : {std::pair{"scale", shape.scale}, {"aspect", shape.aspect}, {"strip_length", shape.strip_length}})
    if (!good(size))
      faults.push_back(make_error("room.bad-size", fmt::format("{} is {}", name, size),
                                  fmt::format("sizes lie between {} and {}", kMinScale, kMaxScale)));
  if (!faults.empty()) return faults;
  if (shape.scale != 1 && space != Space::euclidean)
    faults.push_back(unused("scale", "in the Euclidean plane: curved rooms are measured in curvature radii"));
  if (shape.aspect != 1 && !rectangle) faults.push_back(unused("aspect", "for *2222"));
  if (shape.strip_length != 4 && !strip) faults.push_back(unused("strip_length", "for the strips ** and *22∞"));
  if (!shape.cuts.empty() && shape.kind != ShapeKind::paper) faults.push_back(unused("cuts", "with shape: paper"));
  const bool has_lengths = !shape.lengths.empty() || !shape.relations.empty();
  if (has_lengths && shape.kind != ShapeKind::lengths) faults.push_back(unused("lengths", "with shape: lengths"));
  const bool chosen = !shape.cuts.empty() || (shape.kind == ShapeKind::lengths && has_lengths);
  if (chosen && space != Space::hyperbolic)
    faults.push_back(make_error(
        "room.shape-needs-hyperbolic", "cuts and side lengths shape hyperbolic rooms only",
        space == Space::euclidean ? "in the Euclidean plane there are scale and, for *2222, aspect" : "spherical rooms are rigid"));
  return faults;
}

Result<Polygon> hyperbolic_polygon(const std::vector<CornerAngle>& angles, const Shape& shape) {
  const int walls = static_cast<int>(angles.size());
  const auto tangential = tangential_polygon(Space::hyperbolic, angles, 1);
  ORBC_CHECK(tangential.has_value(), ==, true);
  if (shape.kind == ShapeKind::tangential) return *tangential;
  if (shape.kind == ShapeKind::paper) {
    auto cuts = complete_cuts(walls, shape.cuts, shape.cut);
    if (!cuts) return std::move(cuts).error();
    if (walls == 3) return *tangential;  // a triangle is rigid and has no cuts
    auto polygon = polygon_with_cuts(angles, *cuts);
    if (!polygon) return std::move(polygon).error();
    return centred(*polygon);
  }
  auto polygon = polygon_with_wanted_lengths(angles, shape, *tangential);
  if (polygon) return centred(*polygon);
  Diagnostics errors = std::move(polygon).error();
  std::string sides;
  for (int wall = 1; wall <= walls; ++wall)
    if (sides.size() < 200)
      sides += fmt::format("{}{}: {:.4f}", sides.empty() ? "" : ", ", wall,
                           static_cast<double>(side_length(*tangential, static_cast<std::size_t>(wall - 1))));
  for (Diagnostic& error : errors)
    if (error.code == "room.no-such-shape") error.hint = "the tangential room has {" + sides + "}; try lengths nearer to these";
  return errors;
}

Result<Polygon> polygon_of(Space space, const std::vector<Rational>& orders, const std::vector<CornerAngle>& angles, const Shape& shape) {
  if (orders.size() == 2) return lune(angles[0]);
  if (space == Space::hyperbolic) return hyperbolic_polygon(angles, shape);
  if (orders.size() == 4 && all_right_angles(orders)) {
    // The shorter side is 2·scale, so that `scale` is the radius of the largest inscribed circle for every aspect.
    const Real short_side = 2 * Real(shape.scale), ratio = shape.aspect;
    return shape.aspect >= 1 ? rectangle(short_side * ratio, short_side) : rectangle(short_side, short_side / ratio);
  }
  if (auto polygon = tangential_polygon(space, angles, shape.scale)) return *std::move(polygon);
  return make_error("room.no-such-shape", "no convex polygon of the sphere around a circle has these corners",
                    "corners wider than 90° cannot be combined at will");
}

double area_of(const Polygon& polygon, const Rational& chi) {
  if (polygon.space != Space::euclidean)
    return static_cast<double>(2 * real_pi() * real_of(abs(numerator(chi))) / real_of(denominator(chi)));
  Real area = 0;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const RealVector &p = polygon.corners[i], &q = polygon.corners[(i + 1) % polygon.corners.size()];
    area += (p.x * q.y - p.y * q.x) / 2;
  }
  return static_cast<double>(area);
}

Result<Room> certified(Room room, ShapeKind kind) {
  if (passes(room, room.certificate)) return room;
  const Certificate& c = room.certificate;
  if (room.space == Space::hyperbolic && room.circumradius > 12)
    return make_error(
        "room.no-certificate",
        fmt::format("the room reaches {:.1f} curvature radii from its centre, farther than double precision carries", room.circumradius),
        kind == ShapeKind::tangential ? "corners of smaller order reach less far"
                                      : "longer cuts, a decomposition with cuts on several walls, or the shape tangential reach less far");
  if (!c.convex && kind != ShapeKind::tangential)
    return make_error("room.no-such-shape", "walls of these lengths cross: the polygon is not convex",
                      "choose lengths nearer to those of the shape tangential");
  return make_error(
      "room.no-certificate",
      fmt::format("the realised room is not exact enough: {}angles to {:.1e}, corners to {:.1e}, sides to {:.1e}, area to {:.1e}",
                  c.convex ? "" : "not convex, ", c.angle_residual, c.closure_residual, c.side_residual, c.area_residual),
      "corners this narrow, or orders this near to those of another space, are beyond double precision");
}

}  // namespace

Result<Room> realise_uncertified(const notation::Orbifold& orbifold, const Shape& shape, bool allow_non_orbifold) {
  const Result<Space> classified = notation::classify(orbifold, shape.span);
  if (!classified) return classified.error();
  if (!allow_non_orbifold && !notation::is_orbifold(orbifold))
    return make_error("notation.non-orbifold-corner",
                      notation::to_text(orbifold) + " has corners that are no integers: its images do not agree",
                      "allow_non_orbifold: true makes a room of it all the same");
  const std::vector<Rational>& orders = orbifold.corners;
  const Rational chi = notation::euler_characteristic(orbifold);
  const Space space = *classified;
  const bool is_rectangle = orders.size() == 4 && all_right_angles(orders);
  if (Diagnostics faults = shape_faults(shape, space, orbifold.strip, is_rectangle); !faults.empty()) return faults;

  Room room;
  if (orbifold.strip) {
    const std::vector<CornerAngle> angles = corner_angles(std::vector<Rational>(4, 2));
    const bool half = notation::is_half_strip(orbifold);
    const Real width = 2 * Real(shape.scale), length = Real(shape.strip_length) * shape.scale;
    const Polygon polygon = half ? rectangle(width, length) : rectangle(length, width);
    room = round_to_doubles(polygon, angles);
    for (const std::size_t end : half ? std::vector<std::size_t>{2} : std::vector<std::size_t>{1, 3}) room.walls[end].reflects = false;
    room.area = area_of(polygon, chi);
  } else if (orders.empty()) {
    room = hemisphere();
    room.area = 2 * std::numbers::pi;
  } else {
    const std::vector<CornerAngle> angles = corner_angles(orders);
    Result<Polygon> polygon = polygon_of(space, orders, angles, shape);
    if (!polygon) return std::move(polygon).error();
    room = round_to_doubles(*polygon, angles);
    room.area = area_of(*polygon, chi);
  }
  room.orbifold = orbifold;
  room.certificate = certify(room);
  return room;
}

Result<Room> realise(const notation::Orbifold& orbifold, const Shape& shape, bool allow_non_orbifold) {
  Result<Room> room = realise_uncertified(orbifold, shape, allow_non_orbifold);
  if (room) room = certified(*std::move(room), shape.kind);
  if (!room) return located(std::move(room).error(), shape.span);
  return room;
}

}  // namespace orbc::room
