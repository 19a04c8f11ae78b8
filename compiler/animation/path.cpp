#include "compiler/animation/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "compiler/geometry/chart.h"
#include "compiler/place/locate.h"

namespace orbc::animation {
namespace {

using geometry::Point;
using geometry::Space;

constexpr int kPiecesPerPlace = 128;

/// The arc length on the wall of the foot of the perpendicular from X: tanκ(s) = ⟨X, along⟩ / ⟨X, start⟩ in the form w² + κ(x² + y²),
/// which for the tangent is divided by κ.
double foot_on_wall(Space space, const room::Wall& wall, const Point& x) {
  if (space == Space::euclidean) return (x.x - wall.start.x) * wall.along.x + (x.y - wall.start.y) * wall.along.y;
  const double k = geometry::curvature(space);
  const double cosine = x.w * wall.start.w + k * (x.x * wall.start.x + x.y * wall.start.y);
  const double sine = k * x.w * wall.along.w + x.x * wall.along.x + x.y * wall.along.y;
  return space == Space::spherical ? math::atan2(sine, cosine) : math::atanh(sine / cosine);
}

/// The point at the distance d to the left of a wall, over its arc length s.
Point beside_wall(Space space, const room::Wall& wall, double s, double d) {
  const Point foot = geometry::point_along(space, wall.start, wall.along, s);
  // The line's covector, raised by the form: the unit normal at every point of the line.
  const double k = geometry::curvature(space);
  const geometry::Tangent normal(space == Space::euclidean ? 0 : k * wall.line.w, wall.line.x, wall.line.y);
  return geometry::point_along(space, foot, normal, d);
}

Point bezier(Space space, std::array<Point, 4> p, double s) {
  const auto between = [&](const Point& a, const Point& b) {
    const double d = geometry::distance(space, a, b);
    return d < 1e-15 ? a : geometry::point_along(space, a, geometry::direction_to(space, a, b), s * d);
  };
  for (std::size_t left = 3; left > 0; --left)
    for (std::size_t i = 0; i < left; ++i) p[i] = between(p[i], p[i + 1]);
  return p[0];
}

/// The control points beside a place, backwards and forwards. Three places on a circle give that circle's tangent: an inversion about the
/// middle one maps the circle to the line through d/|d|² of the steps d. Handles are those of the cubic that replaces an arc whose chord
/// makes the angle θ with its tangent: chord / (3 cos²(θ/2)). Source: Goldapp, Approximation of circular arcs by cubic polynomials (1991).
std::array<Point, 2> controls(Space space, const Point& before, const Point& at, const Point& after) {
  const geometry::Isometry room_from_place = geometry::translation_to(space, at), place_from_room = geometry::inverse(room_from_place);
  const std::complex<double> in = -geometry::log_from_point(space, place_from_room * before),
                             out = geometry::log_from_point(space, place_from_room * after);
  if (std::norm(in) < 1e-24 || std::norm(out) < 1e-24) return {at, at};  // a place that is given twice is a corner
  const std::complex<double> sum = in / std::norm(in) + out / std::norm(out);
  if (std::norm(sum) < 1e-24) return {at, at};  // there and back
  const std::complex<double> tangent = sum / math::abs(sum);
  const auto handle = [&](const std::complex<double>& step) {
    const double chord = math::abs(step), cosine = (step.real() * tangent.real() + step.imag() * tangent.imag()) / chord;
    return chord * std::fmin(1, 1 / (1.5 * (1 + cosine)));  // cos²(θ/2) = (1 + cos θ)/2
  };
  return {room_from_place * geometry::point_from_log(space, -handle(in) * tangent),
          room_from_place * geometry::point_from_log(space, handle(out) * tangent)};
}

double hermite(double before, double a, double b, double after, double s) {
  const double ma = (b - before) / 2, mb = (after - a) / 2;
  return ((2 * a - 2 * b + ma + mb) * s + (3 * b - 3 * a - 2 * ma - mb)) * s * s + ma * s + a;
}

}  // namespace

Result<Path> wall_path(const room::Room& room, const scene::WallWalk& walk, const SourceSpan& span) {
  const std::size_t n = room.walls.size();
  if (room.corners.size() != n)
    return make_error("animation.no-walk", "this room has no corners between which a walk could lead", "give a path of places instead",
                      span);
  Path path;
  path.space = room.space;
  path.walls = room.walls;
  path.distance = walk.distance;
  path.has_height = walk.z.has_value();
  // The corners of the curve: as far from both walls of a corner of the room.
  std::vector<Point> corners;
  for (std::size_t i = 0; i < n; ++i) {
    scene::Place place;
    place.floor = scene::AtWalls{{static_cast<int>((i + n - 1) % n) + 1, static_cast<int>(i) + 1}, {walk.distance, walk.distance}};
    place.span = span;
    const auto corner = place::locate(place, room);
    if (!corner)
      return make_error("animation.no-walk",
                        fmt::format("corner {} leaves no room for a walk at the distance {}", i + 1, place::to_text(walk.distance)),
                        fmt::format("the circle inside this room has the radius {}", place::to_text(room.inradius)), span);
    corners.push_back(*corner);
  }
  for (std::size_t step = 0; step < n; ++step) {
    const std::size_t i = (static_cast<std::size_t>(walk.start - 1) + step) % n;
    const double begin = foot_on_wall(room.space, room.walls[i], corners[i]),
                 end = foot_on_wall(room.space, room.walls[i], corners[(i + 1) % n]);
    if (!(end > begin))
      return make_error(
          "animation.no-walk", fmt::format("at the distance {} nothing is left of wall {}", place::to_text(walk.distance), i + 1),
          fmt::format("walk nearer to the walls: the circle inside this room has the radius {}", place::to_text(room.inradius)), span);
    path.pieces.push_back({corners[i], path.length, walk.z.value_or(0), static_cast<int>(i), begin});
    path.length += (end - begin) * geometry::cos_k(room.space, walk.distance);
  }
  return path;
}

Result<Path> place_path(const room::Room& room, const scene::PlacePath& spline) {
  Path path;
  path.space = room.space;
  std::vector<Point> places;
  std::vector<double> heights;
  for (const scene::Place& place : spline.places) {
    const auto at = place::locate(place, room);
    if (!at) return at.error();
    places.push_back(*at);
    heights.push_back(place.z.value_or(0));
    path.has_height = path.has_height || place.z.has_value();
  }
  const std::size_t n = places.size();
  const auto around = [n](std::size_t i) { return i % n; };
  for (std::size_t i = 0; i < n; ++i) {
    const std::array<std::size_t, 4> at = {around(i + n - 1), i, around(i + 1), around(i + 2)};
    const std::array<Point, 4> curve = {places[at[1]], controls(room.space, places[at[0]], places[at[1]], places[at[2]])[1],
                                        controls(room.space, places[at[1]], places[at[2]], places[at[3]])[0], places[at[2]]};
    for (int k = 0; k < kPiecesPerPlace; ++k) {
      const double s = static_cast<double>(k) / kPiecesPerPlace;
      const Point here = bezier(room.space, curve, s);
      if (!path.pieces.empty()) path.length += geometry::distance(room.space, path.pieces.back().at, here);
      // A height that overshot those of its places could lead through the floor.
      const auto [low, high] = std::minmax(heights[at[1]], heights[at[2]]);
      const double z = std::clamp(hermite(heights[at[0]], heights[at[1]], heights[at[2]], heights[at[3]], s), low, high);
      path.pieces.push_back({here, path.length, z, -1, 0});
    }
  }
  path.length += geometry::distance(room.space, path.pieces.back().at, path.pieces.front().at);
  return path;
}

PathPoint point_at(const Path& path, double s) {
  double along = s - path.length * std::floor(s / path.length);
  if (!(along >= 0) || along >= path.length) along = 0;  // rounding of a whole number of rounds
  const auto next =
      std::upper_bound(path.pieces.begin(), path.pieces.end(), along, [](double at, const Path::Piece& piece) { return at < piece.begin; });
  const Path::Piece& piece = *(next - 1);
  const double rest = along - piece.begin;
  if (piece.wall >= 0) {
    const room::Wall& wall = path.walls[static_cast<std::size_t>(piece.wall)];
    return {beside_wall(path.space, wall, piece.foot + rest / geometry::cos_k(path.space, path.distance), path.distance), piece.z};
  }
  const Path::Piece& end = next == path.pieces.end() ? path.pieces.front() : *next;
  const double whole = geometry::distance(path.space, piece.at, end.at);
  if (whole < 1e-15) return {piece.at, piece.z};
  return {geometry::point_along(path.space, piece.at, geometry::direction_to(path.space, piece.at, end.at), rest),
          piece.z + rest / whole * (end.z - piece.z)};
}

}  // namespace orbc::animation
