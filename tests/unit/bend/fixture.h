// Small rooms built by closed formulas, so that the tests of bending depend on nothing but geometry.
#pragma once
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <vector>

#include "compiler/bend/bend.h"
#include "compiler/geometry/chart.h"
#include "compiler/geometry/line.h"

namespace orbc::bend::test {

using geometry::Isometry;
using geometry::Line;
using geometry::Point;
using geometry::Space;
using geometry::Vector3;
using place::PartKind;
using place::PlacedMesh;
using place::Interior;

inline Point polar(Space space, double r, double phi) {
  return {geometry::cos_k(space, r), geometry::sin_k(space, r) * std::cos(phi), geometry::sin_k(space, r) * std::sin(phi)};
}

inline std::uint32_t add_vertex(PlacedMesh& mesh, const Point& p, double z) {
  mesh.floor.push_back(p);
  mesh.z.push_back(z);
  return static_cast<std::uint32_t>(mesh.floor.size() - 1);
}

/// A level fan from the room's centre, each sector `cells` × `cells` triangles in affine coordinates.
inline PlacedMesh level_part(Space space, const std::vector<Point>& corners, double z, PartKind kind, int cells) {
  PlacedMesh mesh;
  mesh.kind = kind;
  mesh.name = kind == PartKind::floor ? "floor" : "ceiling";
  const Point centre;
  std::map<std::tuple<double, double, double>, std::uint32_t> known;
  const auto vertex = [&](const geometry::Ambient& v) {
    const Point p = geometry::normalised_point(space, v);
    const auto key = std::make_tuple(p.w, p.x, p.y);
    const auto [at, is_new] = known.emplace(key, 0);
    if (is_new) at->second = add_vertex(mesh, p, z);
    return at->second;
  };
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point &a = corners[i], &b = corners[(i + 1) % n];
    const auto at = [&](int j, int k) {
      // Both sectors that meet in a spoke compute its points by the same expression.
      const double s = static_cast<double>(j - k) / cells, t = static_cast<double>(k) / cells, u = 1 - static_cast<double>(j) / cells;
      if (k == 0) return vertex(u * centre + s * a);
      if (k == j) return vertex(u * centre + t * b);
      return vertex(u * centre + (s * a + t * b));
    };
    for (int j = 0; j < cells; ++j) {
      for (int k = 0; k <= j; ++k) {
        mesh.triangles.push_back({at(j, k), at(j + 1, k), at(j + 1, k + 1)});
        if (k < j) mesh.triangles.push_back({at(j, k), at(j + 1, k + 1), at(j, k + 1)});
      }
    }
  }
  mesh.style.assign(mesh.triangles.size(), kind == PartKind::floor ? 0 : 1);
  return mesh;
}

inline PlacedMesh wall_part(Space space, const Point& a, const Point& b, double low, double high, int wall, int cells, std::uint16_t look) {
  PlacedMesh mesh;
  mesh.kind = PartKind::wall;
  mesh.wall = wall;
  mesh.name = "wall " + std::to_string(wall + 1);
  for (int i = 0; i <= cells; ++i) {
    const double t = static_cast<double>(i) / cells;
    const Point p = geometry::normalised_point(space, (1 - t) * a + t * b);
    const auto v = add_vertex(mesh, p, low);
    add_vertex(mesh, p, high);
    if (i == cells) break;
    mesh.triangles.push_back({v, v + 2, v + 3});
    mesh.triangles.push_back({v, v + 3, v + 1});
  }
  mesh.style.assign(mesh.triangles.size(), look);
  return mesh;
}

/// A tube around the torus knot (p, q) = (2, 3), `around` × `along` × 2 triangles, at `at`.
inline PlacedMesh knot_part(Space space, const Point& at, double size, double z, int along, int around) {
  PlacedMesh mesh;
  mesh.name = "knot";
  const Isometry room_from_object = geometry::translation_to(space, at);
  const auto curve = [&](double t) {
    const double r = size * (0.6 + 0.25 * std::cos(3 * t));
    return Vector3{r * std::cos(2 * t), r * std::sin(2 * t), z + 0.3 * size * std::sin(3 * t)};
  };
  for (int i = 0; i < along; ++i) {
    const double t = 2 * std::numbers::pi * i / along;
    const Vector3 c = curve(t), d = normalised(curve(t + 1e-4) - curve(t - 1e-4));
    const Vector3 u = normalised(cross(d, {0, 0, 1})), v = cross(u, d);
    for (int j = 0; j < around; ++j) {
      const double s = 2 * std::numbers::pi * j / around;
      const Vector3 p = c + (0.12 * size * std::cos(s)) * u + (0.12 * size * std::sin(s)) * v;
      add_vertex(mesh, room_from_object * geometry::point_from_log(space, {p.x, p.y}), p.z);
    }
  }
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      const auto at_grid = [&](int a, int b) { return static_cast<std::uint32_t>((a % along) * around + b % around); };
      mesh.triangles.push_back({at_grid(i, j), at_grid(i, j + 1), at_grid(i + 1, j + 1)});
      mesh.triangles.push_back({at_grid(i, j), at_grid(i + 1, j + 1), at_grid(i + 1, j)});
    }
  }
  mesh.style.assign(mesh.triangles.size(), 2);
  return mesh;
}

struct Furnishing {
  int floor_cells = 2;
  bool walls = false;
  bool beams = true;  ///< plain strips on top and bottom of the walls
  int knot_along = 0, knot_around = 8;
  double height = 1;
};

/// The regular room with `n` corners of angle π/k (E²: of inradius 0.6).
inline Interior regular_room(int n, int k, const Furnishing& with = {}) {
  const double alpha = std::numbers::pi / (2 * k), beta = std::numbers::pi / n, excess = alpha + beta - std::numbers::pi / 2;
  Interior placed;
  auto& room = placed.polygon;
  room.space = std::fabs(excess) < 1e-9 ? Space::euclidean : excess > 0 ? Space::spherical : Space::hyperbolic;
  const double c = std::cos(alpha) / std::sin(beta), d = 1 / (std::tan(alpha) * std::tan(beta));
  room.inradius = room.space == Space::euclidean ? 0.6 : room.space == Space::spherical ? std::acos(c) : std::acosh(c);
  room.circumradius = room.space == Space::euclidean ? 0.6 / std::cos(beta) : room.space == Space::spherical ? std::acos(d) : std::acosh(d);
  std::vector<Point> corners;
  for (int i = 0; i < n; ++i) corners.push_back(polar(room.space, room.circumradius, 2 * beta * i));
  for (int i = 0; i < n; ++i) {
    room.corners.push_back({corners[i], 2 * alpha});
    room::Wall wall;
    wall.line = geometry::line_through(room.space, corners[i], corners[(i + 1) % n]);
    wall.start = corners[i];
    wall.along = geometry::direction_to(room.space, corners[i], corners[(i + 1) % n]);
    wall.length = geometry::distance(room.space, corners[i], corners[(i + 1) % n]);
    room.walls.push_back(wall);
    placed.mirrors.push_back({i, {0, wall.length}, {0, with.height}, {0.9, 0.9, 0.9}});
  }
  placed.height = with.height;
  placed.parts.push_back(level_part(room.space, corners, 0, PartKind::floor, with.floor_cells));
  placed.parts.push_back(level_part(room.space, corners, with.height, PartKind::ceiling, with.floor_cells));
  for (int i = 0; i < n; ++i) {
    const Point &a = corners[i], &b = corners[(i + 1) % n];
    if (with.walls) placed.parts.push_back(wall_part(room.space, a, b, 0, with.height, i, 1, 3));
    if (with.beams && !with.walls) {
      placed.parts.push_back(wall_part(room.space, a, b, 0, 0.04, i, 1, 3));
      placed.parts.push_back(wall_part(room.space, a, b, with.height - 0.04, with.height, i, 1, 3));
    }
  }
  if (with.knot_along > 0)
    placed.parts.push_back(knot_part(room.space, polar(room.space, 0.2, 0.4), 0.25, 0.5, with.knot_along, with.knot_around));
  placed.styles.resize(4);
  return placed;
}

/// All copies up to a word length, by breadth first and rounded matrices: slow and simple, what the real enumeration is not.
inline std::vector<cover::Copy> copies_of(const Interior& placed, int length) {
  const Space space = placed.polygon.space;
  std::vector<Isometry> mirrors;
  for (const auto& wall : placed.polygon.walls) mirrors.push_back(geometry::reflection(space, wall.line));
  const auto key = [](const Isometry& m) {
    const auto matrix = geometry::matrix(m);
    std::array<long long, 9> rounded{};
    for (int i = 0; i < 9; ++i) rounded[static_cast<std::size_t>(i)] = std::llround(matrix[i / 3][i % 3] * 1e4);
    return rounded;
  };
  std::vector<cover::Copy> all(1);
  all[0].cover_from_room = geometry::identity(space);
  std::map<std::array<long long, 9>, int> lengths{{key(all[0].cover_from_room), 0}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const cover::Copy from = all[i];
    for (std::size_t w = 0; w < mirrors.size(); ++w) {
      const Isometry next = geometry::renormalised(from.cover_from_room * mirrors[w]);
      const auto found = lengths.find(key(next));
      if (found != lengths.end()) {
        if (found->second < static_cast<int>(from.word.size())) all[i].eye_facing_walls |= std::uint64_t{1} << w;
        continue;
      }
      if (static_cast<int>(from.word.size()) == length) continue;
      lengths.emplace(key(next), static_cast<int>(from.word.size()) + 1);
      cover::Copy copy = from;
      copy.eye_facing_walls = 0;
      copy.cover_from_room = next;
      copy.word.push_back(static_cast<std::uint8_t>(w));
      copy.bounces = static_cast<int>(copy.word.size());
      all.push_back(copy);
    }
  }
  return all;
}

/// The copies of S² again, seen around the sphere: sheets 0 … last. `longest` is the length of the longest element.
inline std::vector<cover::Copy> with_sheets(const std::vector<cover::Copy>& copies, int longest, int last) {
  std::vector<cover::Copy> all;
  for (int sheet = 0; sheet <= last; ++sheet) {
    for (cover::Copy copy : copies) {
      const int length = static_cast<int>(copy.word.size());
      copy.sheet = sheet;
      copy.bounces = sheet % 2 == 0 ? sheet * longest + length : (sheet + 1) * longest - length;
      if (sheet % 2 == 1) copy.eye_facing_walls = ~copy.eye_facing_walls;
      all.push_back(copy);
    }
  }
  return all;
}

inline place::Camera eye_at(Space space, double r, double phi, double z, double azimuth, double elevation) {
  place::Camera eye;
  eye.room_from_eye = geometry::translation_to(space, polar(space, r, phi));
  eye.z = z;
  eye.forward = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  eye.right = normalised(cross(eye.forward, {0, 0, 1}));
  eye.up = cross(eye.right, eye.forward);
  return eye;
}

inline std::vector<std::vector<std::array<float, 2>>> plain_uv(const Interior& room) {
  std::vector<std::vector<std::array<float, 2>>> uv;
  for (const auto& part : room.parts) {
    uv.emplace_back();
    for (std::size_t i = 0; i < part.floor.size(); ++i)
      uv.back().push_back({static_cast<float>(part.floor[i].x), static_cast<float>(part.floor[i].y)});
  }
  return uv;
}

/// Bends copies that are all drawn from the room itself.
inline Result<BentCover> bend_whole(const Interior& room, const std::vector<Uv>& uv, const std::vector<cover::Copy>& copies,
                                    const place::Camera& eye, const BendOptions& options = {},
                                    const Executor& executor = serial_executor()) {
  const std::array models{whole_model(room, uv)};
  return bend::bend(room, {copies, models, {}}, eye, options, executor);
}

}  // namespace orbc::bend::test
