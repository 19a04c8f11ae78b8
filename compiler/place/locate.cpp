// A point at given distances from two walls. Walls are covectors l whose value at X is sinκ(distance). Their vectors L = (κ l_w, l_x, l_y)
// span a plane with respect to the form B(U, V) = κ U_w V_w + U_x V_x + U_y V_y, so X = αL_a + βL_b + tN with N orthogonal to both. α and β
// follow from the two distances, and t from B(X, X) = κ. Both signs of t give points of the space; the result is the one in the room.
#include "compiler/place/locate.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "compiler/geometry/predicates.h"

namespace orbc::place {
namespace {

using geometry::Ambient;
using geometry::Containment;
using geometry::Line;
using geometry::Point;
using geometry::Space;

/// A length rounded down to four digits, so that the value in a hint is allowed.
std::string rounded_down(double length) {
  if (!(length > 0) || !std::isfinite(length)) return to_text(length);
  const double unit = math::pow(10, std::floor(math::log10(length)) - 3);
  return to_text(std::floor(length / unit) * unit);
}

Diagnostic outside_room(const room::Room& room, const Point& x, const SourceSpan& span) {
  const Overhang over = overhang(room, x);
  const double azimuth = math::atan2(x.y, x.x), r = math::abs(geometry::log_from_point(room.space, x));
  return make_error("place.outside-room", fmt::format("this place lies {} beyond wall {}", to_text(over.distance), over.wall + 1),
                    fmt::format("it is {} from the centre; in that direction ({:.4g}deg) the room ends at {}", to_text(r),
                                azimuth * 180 / std::numbers::pi, rounded_down(distance_to_boundary(room, azimuth))),
                    span);
}

Diagnostic not_finite(const SourceSpan& span) {
  return make_error("place.outside-room", "this place has a coordinate that is no number", "", span);
}

Result<Point> polar(const room::Room& room, double r, double radians, const SourceSpan& span) {
  if (!std::isfinite(r) || !std::isfinite(radians)) return not_finite(span);
  if (room.space == Space::hyperbolic && std::fabs(r) > 300)
    return make_error("place.outside-room", fmt::format("this place is {} from the centre, far outside the room", to_text(r)),
                      fmt::format("in that direction the room ends at {}", rounded_down(distance_to_boundary(room, radians))), span);
  return geometry::point_from_log(room.space, math::polar(std::fabs(r), r < 0 ? radians + std::numbers::pi : radians));
}

// T_x(x)·T_y(y) applied to the centre: longitude and latitude on S², Lobachevsky coordinates in H².
Result<Point> from_xy(const room::Room& room, const scene::AtXy& at, const SourceSpan& span) {
  if (!std::isfinite(at.x) || !std::isfinite(at.y)) return not_finite(span);
  const Space space = room.space;
  if (space == Space::euclidean) return Point{1, at.x, at.y};
  if (space == Space::hyperbolic && (std::fabs(at.x) > 150 || std::fabs(at.y) > 150))
    return make_error("place.outside-room", fmt::format("this place is {} and {} from the centre, far outside the room", to_text(at.x),
                                                        to_text(at.y)), "", span);
  const double across = geometry::cos_k(space, at.y);
  return Point{geometry::cos_k(space, at.x) * across, geometry::sin_k(space, at.x) * across, geometry::sin_k(space, at.y)};
}

Result<Point> from_disk(const room::Room& room, std::complex<double> z, const SourceSpan& span) {
  if (!std::isfinite(z.real()) || !std::isfinite(z.imag())) return not_finite(span);
  if (room.space == Space::hyperbolic && std::norm(z) >= 1 - 1e-12)
    return make_error("place.outside-disk", fmt::format("the point ({:.6g}, {:.6g}) is not inside the unit disk", z.real(), z.imag()),
                      "places in the disk chart of the hyperbolic plane satisfy x² + y² < 1", span);
  return geometry::point_from_disk(room.space, z);
}

Result<Point> toward(const room::Room& room, const scene::AtToward& at, const SourceSpan& span) {
  const int count = static_cast<int>(at.corner ? room.corners.size() : room.walls.size());
  if (at.number < 1 || at.number > count) {
    const char* what = at.corner ? "corner" : "wall";
    return make_error(
        at.corner ? "place.no-such-corner" : "place.no-such-wall", fmt::format("there is no {} {} in this room", what, at.number),
        count == 0 ? fmt::format("this room has no {}s", what) : fmt::format("{}s are numbered from 1 to {}", what, count), span);
  }
  const int i = at.number - 1;
  const Point goal = at.corner ? room.corners[i].at : room::point_on_wall(room, i, room.walls[i].length / 2);
  return polar(room, at.distance, math::atan2(goal.y, goal.x), span);
}

// The points at signed distances (da, db) from the lines a and b: none, one or two.
std::vector<Point> at_distances(Space space, const Line& a, const Line& b, double da, double db) {
  const double k = geometry::curvature(space), va = geometry::sin_k(space, da), vb = geometry::sin_k(space, db);
  if (space == Space::euclidean) {
    const double det = a.x * b.y - a.y * b.x, p = va - a.w, q = vb - b.w;
    if (std::fabs(det) < 1e-14) return {};
    return {Point{1, (p * b.y - q * a.y) / det, (q * a.x - p * b.x) / det}};
  }
  const double c = k * a.w * b.w + a.x * b.x + a.y * b.y, det = 1 - c * c;
  if (std::fabs(det) < 1e-14) return {};
  const double alpha = (va - c * vb) / det, beta = (vb - c * va) / det;
  const Ambient base{k * (alpha * a.w + beta * b.w), alpha * a.x + beta * b.x, alpha * a.y + beta * b.y};
  const Ambient n{a.x * b.y - a.y * b.x, a.y * b.w - a.w * b.y, a.w * b.x - a.x * b.w};
  const auto form = [k](const Ambient& v) { return k * v.w * v.w + v.x * v.x + v.y * v.y; };
  const double t2 = (k - form(base)) / form(n);
  if (!(t2 >= -1e-14)) return {};
  const double t = std::sqrt(std::fmax(0, t2));
  std::vector<Point> points;
  for (const double sign : {1.0, -1.0}) {
    const Ambient v = base + (sign * t) * n;
    if (space == Space::spherical || v.w > 0) points.push_back(geometry::normalised_point(space, v));
  }
  return points;
}

Result<Point> between_walls(const room::Room& room, const scene::AtWalls& at, const SourceSpan& span) {
  const int count = static_cast<int>(room.walls.size());
  for (const int wall : at.walls)
    if (wall < 1 || wall > count)
      return make_error("place.no-such-wall", fmt::format("there is no wall {} in this room", wall),
                        fmt::format("walls are numbered from 1 to {}", count), span);
  const auto none = [&](const char* why) {
    return make_error("place.no-such-point",
                      fmt::format("no point is {} from wall {} and {} from wall {}", to_text(at.distances[0]), at.walls[0],
                                  to_text(at.distances[1]), at.walls[1]),
                      why, span);
  };
  if (at.walls[0] == at.walls[1]) return none("name two different walls");
  if (!std::isfinite(at.distances[0]) || !std::isfinite(at.distances[1])) return not_finite(span);
  const int i = at.walls[0] - 1, j = at.walls[1] - 1;
  if (at.distances[0] == 0 && at.distances[1] == 0 && !room.corners.empty()) {
    // The corner as it is stored, so that it is on the boundary by exact predicates.
    if (count == 2 || (i + 1) % count == j) return room.corners[j].at;
    if ((j + 1) % count == i) return room.corners[i].at;
  }
  const std::vector<Point> points = at_distances(room.space, room.walls[i].line, room.walls[j].line, at.distances[0], at.distances[1]);
  if (points.empty()) return none("walls that do not meet leave room only for some pairs of distances");
  // Of two such points in the room the one nearer to the centre counts; of two equally near ones the one on the side of corner 1.
  const auto better = [&](const Point& p, const Point& q) {
    const bool p_inside = overhang(room, p).distance <= 1e-12, q_inside = overhang(room, q).distance <= 1e-12;
    if (p_inside != q_inside) return p_inside;
    const double farther = geometry::distance(room.space, Point{}, p) - geometry::distance(room.space, Point{}, q);
    return std::fabs(farther) > 1e-9 ? farther < 0 : p.x > q.x;
  };
  const Point* best = &points.front();
  for (const Point& p : points)
    if (better(p, *best)) best = &p;
  return *best;
}

Result<Point> locate_unchecked(const scene::Place& place, const room::Room& room) {
  if (const auto* at = std::get_if<scene::AtDisk>(&place.floor)) return from_disk(room, at->z, place.span);
  if (const auto* at = std::get_if<scene::AtPolar>(&place.floor)) return polar(room, at->r, at->angle.radians, place.span);
  if (const auto* at = std::get_if<scene::AtXy>(&place.floor)) return from_xy(room, *at, place.span);
  if (const auto* at = std::get_if<scene::AtToward>(&place.floor)) return toward(room, *at, place.span);
  if (const auto* at = std::get_if<scene::AtWalls>(&place.floor)) return between_walls(room, *at, place.span);
  return Point{};
}

}  // namespace

std::string to_text(double length) { return fmt::format("{:.4g}", length); }

double distance_to_boundary(const room::Room& room, double azimuth) {
  // On the ray cosκ(r)·O + sinκ(r)·(0, d) the wall's value vanishes at tanκ(r) = −l_w/(l·d).
  double nearest = std::numeric_limits<double>::infinity();
  for (const room::Wall& wall : room.walls) {
    const double outward = -(wall.line.x * math::cos(azimuth) + wall.line.y * math::sin(azimuth));
    double r = std::numeric_limits<double>::infinity();
    if (room.space == Space::spherical) r = math::atan2(wall.line.w, outward);
    else if (outward > 0 && (room.space == Space::euclidean || wall.line.w < outward))
      r = geometry::atan_k(room.space, wall.line.w / outward);
    if (r >= 0) nearest = std::fmin(nearest, r);
  }
  return nearest;
}

Overhang overhang(const room::Room& room, const Point& x) {
  Overhang worst{0, -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < room.walls.size(); ++i) {
    const double beyond = -geometry::signed_distance(room.space, room.walls[i].line, x);
    if (beyond > worst.distance) worst = {static_cast<int>(i), beyond};
  }
  return worst;
}

Point snap_into_room(const room::Room& room, const Point& x) {
  if (geometry::contains(room.outline, x) != Containment::outside) return x;
  // Steps towards the centre, which lies inside, of 2⁻⁵³ to 2⁻⁴⁶ of the coordinates: the rounding error of a constructed point.
  for (double step = 0x1p-53; step <= 0x1p-46; step *= 2) {
    const Point p = geometry::normalised_point(room.space, {x.w + step, x.x - step * x.x, x.y - step * x.y});
    if (geometry::contains(room.outline, p) != Containment::outside) return p;
  }
  return x;
}

Result<Point> locate(const scene::Place& place, const room::Room& room) {
  Result<Point> point = locate_unchecked(place, room);
  if (!point) return point;
  const Point p = snap_into_room(room, *point);
  if (geometry::contains(room.outline, p) == Containment::outside) return outside_room(room, p, place.span);
  return p;
}

Result<geometry::Position> locate(const scene::Place& place, const room::Room& room, double height, double default_z) {
  Result<Point> point = locate(place, room);
  if (!point) return std::move(point).error();
  const double z = place.z.value_or(default_z);
  if (!(z >= 0) || !(z <= height)) {
    const bool low = z < 0;
    return make_error("place.outside-room",
                      fmt::format("this place lies {} {}", to_text(low ? -z : z - height), low ? "under the floor" : "above the ceiling"),
                      fmt::format("the room is {} high", to_text(height)), place.span);
  }
  return geometry::Position{*point, z};
}

}  // namespace orbc::place
