// Fermi coordinates (s, d) along a line: P(s, d) = cosκ(d)·X(s) + sinκ(d)·N, with the line's vector N = (κ l_w, l_x, l_y), which is the
// unit normal at every point of the line (Thurston 1997, §2.4). Curves of constant d are equidistants of geodesic curvature tanκ(d).
#include "compiler/place/bars.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "compiler/base/elementary.h"
#include "compiler/place/locate.h"
#include "compiler/place/polygon_mesh.h"

namespace orbc::place {
namespace {

using geometry::Ambient;
using geometry::Line;
using geometry::Point;
using geometry::Position;
using geometry::Space;

/// Fermi coordinates along a line: arc length s from `start`, distance d to the left of the line.
struct FermiCoordinates {
  Space space;
  Point start;
  geometry::Tangent along;
  Line line;
  double period = 0;             ///< length of a whole great circle; 0 for other lines
  [[nodiscard]] Point at(double s, double d) const {
    const Ambient normal{geometry::curvature(space) * line.w, line.x, line.y};
    return geometry::normalised_point(
        space, geometry::cos_k(space, d) * geometry::point_along(space, start, along, s) + geometry::sin_k(space, d) * normal);
  }
  /// (s, d, z) of a position.
  [[nodiscard]] geometry::Vector3 coordinates_of_position(const Position& p) const {
    const double k = geometry::curvature(space);
    const auto form = [k](const Ambient& a, const Ambient& b) { return k * a.w * b.w + a.x * b.x + a.y * b.y; };
    // ⟨X, along⟩ = cosκ(d) sinκ(s) and κ⟨X, start⟩ = cosκ(d) cosκ(s).
    const double sine = form(along, k == 0 ? p.floor - start : static_cast<const Ambient&>(p.floor)),
                 cosine = k == 0 ? 1 : k * form(start, p.floor);
    const double s = space == Space::spherical ? math::atan2(sine, cosine) : geometry::atan_k(space, sine / cosine);
    return {s, geometry::signed_distance(space, line, p.floor), p.z};
  }
};

/// Builds a surface of quads with shared vertices. Invariant: one vertex per coordinates (s, d, z).
class Quads {
 public:
  explicit Quads(const FermiCoordinates& coordinates) : coordinates_(coordinates) {}
  using Coordinates = std::array<double, 3>;  // s, d, z
  void add(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& d) {
    const std::array<std::uint32_t, 4> v{vertex(a), vertex(b), vertex(c), vertex(d)};
    // Two triangles: a sloping quad is not planar, and splitting it as one polygon would open a gap to its neighbours.
    surface.polygons.push_back({{{v[0], 0}, {v[1], 1}, {v[2], 2}}, 0});
    surface.polygons.push_back({{{v[0], 2}, {v[2], 3}, {v[3], 4}}, 0});
  }
  PolygonMesh surface;

 private:
  std::uint32_t vertex(Coordinates p) {
    if (coordinates_.period > 0 && p[0] == coordinates_.period) p[0] = 0;
    const auto [at, is_new] = known_.try_emplace(p, static_cast<std::uint32_t>(surface.vertices.size()));
    if (is_new) surface.vertices.push_back({coordinates_.at(p[0], p[1]), p[2]});
    return at->second;
  }
  const FermiCoordinates& coordinates_;
  std::map<Coordinates, std::uint32_t> known_;
};

// Chord h of an equidistant at depth d: sagitta tanκ(d)·h²/8 ≤ width/250 at d = width/2 gives h = 0.253. That is a quarter of a pixel for a
// bar 62 pixels wide; every copy repeats the triangles, so there should be few.
int step_count(Space space, double length) {
  return space == Space::euclidean ? 1 : std::max(1, static_cast<int>(std::ceil(length / 0.253)));
}

std::vector<double> steps(Space space, double from, double to) {
  const int n = step_count(space, to - from);
  std::vector<double> s(n + 1);
  for (int i = 0; i <= n; ++i) s[i] = i == n ? to : from + (to - from) * i / n;
  return s;
}

void clip(Space space, PolygonMesh& surface, const Line& line, int side) {
  surface.polygons = split_by_line(space, surface, surface.polygons, line, side).left;
}

PlacedMesh to_mesh(const FermiCoordinates& coordinates, PolygonMesh surface) {
  const Space space = coordinates.space;
  PlacedMesh mesh;
  for (const PolygonMesh::Polygon& polygon : surface.polygons)
    for (const mesh::Triangle& t : triangulate(space, surface, polygon)) mesh.triangles.push_back(t);
  // Clipping leaves unused vertices behind.
  std::vector<std::uint32_t> new_index(surface.vertices.size(), ~0u);
  for (mesh::Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) {
      if (new_index[v] == ~0u) {
        new_index[v] = static_cast<std::uint32_t>(mesh.floor.size());
        mesh.floor.push_back(surface.vertices[v].floor);
        mesh.z.push_back(surface.vertices[v].z);
        mesh.pattern_position.push_back(coordinates.coordinates_of_position(surface.vertices[v]));
      }
      v = new_index[v];
    }
  mesh.style.assign(mesh.triangles.size(), 0);
  return mesh;
}

bool reaches_start(const FrameSpec& f) { return f.span[0] - f.width / 2 <= 0; }
bool reaches_end(const room::Room& room, const FrameSpec& f) { return f.span[1] + f.width / 2 >= room.walls[f.wall].length; }

// Whether a frame of the same width meets this one in the corner at the wall's start (or end).
bool has_neighbour_frame(const room::Room& room, const std::vector<FrameSpec>& frames, const FrameSpec& f, bool at_start) {
  const int n = static_cast<int>(room.walls.size()), other = (f.wall + (at_start ? n - 1 : 1)) % n;
  return std::any_of(frames.begin(), frames.end(), [&](const FrameSpec& g) {
    return g.wall == other && g.width == f.width && (at_start ? reaches_end(room, g) : reaches_start(g)) && g.height[0] <= f.height[1] &&
           f.height[0] <= g.height[1];
  });
}

bool is_closed(const room::Room& room, const FrameSpec& f) {
  return room.corners.empty() && f.span[0] <= 0 && f.span[1] >= room.walls[f.wall].length;  // a whole great circle has no ends
}

FermiCoordinates coordinates_of(const room::Room& room, const FrameSpec& f) {
  const room::Wall& wall = room.walls[f.wall];
  return {room.space, wall.start, wall.along, wall.line, is_closed(room, f) ? wall.length : 0};
}

// The front and the inner and outer sides of one frame, before it is clipped to the room.
PolygonMesh unclipped_frame(const room::Room& room, double height, const FrameSpec& f) {
  const room::Wall& wall = room.walls[f.wall];
  const double half = f.width / 2;
  const bool closed = is_closed(room, f);
  const FermiCoordinates coordinates = coordinates_of(room, f);
  const bool has_no_opening = (!closed && f.span[1] - f.span[0] <= f.width) || f.height[1] - f.height[0] <= f.width;
  double s0 = f.span[0] - half, s1 = f.span[0] + half, s2 = f.span[1] - half, s3 = f.span[1] + half;
  if (closed) {
    s0 = s1 = 0;
    s2 = s3 = wall.length;
  }
  if (s1 > s2) s1 = s2 = 0.5 * (s1 + s2);
  const double z0 = std::fmax(0, f.height[0] - half), z3 = std::fmin(height, f.height[1] + half);
  double z1 = std::fmin(height, f.height[0] + half), z2 = std::fmax(0, f.height[1] - half);
  if (z1 > z2) z1 = z2 = 0.5 * (z1 + z2);
  Quads quads(coordinates);
  std::vector<double> s = steps(room.space, s1, s2);
  const std::size_t first = s0 < s1 ? 1 : 0, last = s.size() - 1 + first;   // s[first]…s[last] run over the opening
  if (s0 < s1) s.insert(s.begin(), s0);
  if (s2 < s3) s.push_back(s3);
  const std::array<double, 4> z{z0, z1, z2, z3};
  for (std::size_t i = 0; i + 1 < s.size(); ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const bool opening = !has_no_opening && j == 1 && i >= first && i < last;
      if (!opening && z[j] < z[j + 1] && s[i] < s[i + 1])
        quads.add({s[i], half, z[j]}, {s[i], half, z[j + 1]}, {s[i + 1], half, z[j + 1]}, {s[i + 1], half, z[j]});
    }
  // The side of the frame over the edge (s, z) → (s', z'), facing to its right in (−s, z), which is how the wall appears from the room.
  const auto add_side = [&](double sa, double za, double sb, double zb) {
    quads.add({sa, 0, za}, {sa, half, za}, {sb, half, zb}, {sb, 0, zb});
  };
  for (std::size_t i = 0; i + 1 < s.size(); ++i) {
    if (f.height[0] - half > 0) add_side(s[i], z0, s[i + 1], z0);
    if (f.height[1] + half < height) add_side(s[i + 1], z3, s[i], z3);
    if (!has_no_opening && i >= first && i < last) {
      add_side(s[i + 1], z1, s[i], z1);
      add_side(s[i], z2, s[i + 1], z2);
    }
  }
  for (std::size_t j = 0; j < 3 && !closed; ++j) {
    if (!(z[j] < z[j + 1])) continue;
    add_side(s0, z[j + 1], s0, z[j]);
    add_side(s3, z[j], s3, z[j + 1]);
    if (!has_no_opening && j == 1) {
      add_side(s1, z1, s1, z2);
      add_side(s2, z2, s2, z1);
    }
  }
  return std::move(quads.surface);
}

}  // namespace

Line bisector(const room::Room& room, int corner) {
  const int n = static_cast<int>(room.walls.size());
  // Points equally far from both walls: value before = value after. Points to the left are nearer to the wall that starts here.
  const Line &before = room.walls[(corner + n - 1) % n].line, &after = room.walls[corner].line;
  return geometry::normalised_line(room.space, {before.w - after.w, before.x - after.x, before.y - after.y});
}

std::vector<PlacedMesh> make_frames(const room::Room& room, double height, const std::vector<FrameSpec>& frames) {
  const int n = static_cast<int>(room.walls.size());
  std::vector<PlacedMesh> meshes;
  for (const FrameSpec& f : frames) {
    PolygonMesh surface = unclipped_frame(room, height, f);
    int side = 10;
    for (int j = 0; j < n; ++j)
      if (j != f.wall) clip(room.space, surface, room.walls[j].line, side++);
    if (!room.corners.empty() && reaches_start(f) && has_neighbour_frame(room, frames, f, true))
      clip(room.space, surface, bisector(room, f.wall), side++);
    if (!room.corners.empty() && reaches_end(room, f) && has_neighbour_frame(room, frames, f, false))
      clip(room.space, surface, geometry::reversed(bisector(room, (f.wall + 1) % n)), side++);
    PlacedMesh mesh = to_mesh(coordinates_of(room, f), std::move(surface));
    mesh.kind = PartKind::frame;
    mesh.wall = f.wall;
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

Result<PlacedMesh> make_bar(const room::Room& room, double height, const Position& from, const Position& to, double width) {
  const Space space = room.space;
  const double run = geometry::distance(space, from.floor, to.floor), rise = to.z - from.z, length = math::hypot(run, rise),
               half = width / 2;
  if (!(length > 1e-12)) return make_error("place.no-beam", "this beam begins where it ends", "give it two different positions");
  FermiCoordinates coordinates{space, from.floor, {}, {}, 0};
  // A vertical bar has no horizontal direction; its section is aligned with the room's x axis.
  const geometry::Isometry room_from_foot = geometry::translation_to(space, from.floor);
  coordinates.along = run > 1e-12 ? geometry::direction_to(space, from.floor, to.floor) : room_from_foot * geometry::Tangent{0, 1, 0};
  coordinates.line = geometry::line_along(space, from.floor, coordinates.along);
  const double c = run / length, m = rise / length;
  Quads quads(coordinates);
  // Corners of the section, counter-clockwise seen against the direction of the bar: (distance to the left, upwards).
  const std::array<std::array<double, 2>, 4> section{{{half, -half}, {half, half}, {-half, half}, {-half, -half}}};
  const auto corner_at = [&](double t, const std::array<double, 2>& q) {
    return Quads::Coordinates{c * t - m * q[1], q[0], from.z + m * t + c * q[1]};
  };
  const std::vector<double> t = steps(space, 0, length);
  for (std::size_t i = 0; i + 1 < t.size(); ++i)
    for (int k = 0; k < 4; ++k)
      quads.add(corner_at(t[i], section[k]), corner_at(t[i], section[(k + 1) % 4]), corner_at(t[i + 1], section[(k + 1) % 4]),
                corner_at(t[i + 1], section[k]));
  quads.add(corner_at(0, section[3]), corner_at(0, section[2]), corner_at(0, section[1]), corner_at(0, section[0]));
  quads.add(corner_at(length, section[0]), corner_at(length, section[1]), corner_at(length, section[2]), corner_at(length, section[3]));
  PolygonMesh surface = std::move(quads.surface);
  int side = 10;
  for (const room::Wall& wall : room.walls) clip(space, surface, wall.line, side++);
  // An end exactly on the floor or ceiling is not cut off, so that a column is a closed body.
  const auto beyond = [&surface](double sign, double z) {
    return std::any_of(surface.vertices.begin(), surface.vertices.end(), [=](const Position& v) { return sign * (v.z - z) > 0; });
  };
  if (beyond(-1, 0)) surface.polygons = split_at_height(space, surface, surface.polygons, 0, side++).left;
  if (beyond(1, height)) surface.polygons = split_at_height(space, surface, surface.polygons, height, side++).right;
  PlacedMesh mesh = to_mesh(coordinates, std::move(surface));
  mesh.kind = PartKind::object;
  return mesh;
}

}  // namespace orbc::place
