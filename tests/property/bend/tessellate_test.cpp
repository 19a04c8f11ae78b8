// What splitting promises, measured by other means: chords within the tolerance, no cracks in a part, none between neighbours.
#include "compiler/bend/tessellate.h"

#include <catch2/catch.hpp>
#include <map>
#include <random>

#include "tests/unit/bend/fixture.h"

using namespace orbc;
using namespace orbc::bend;
using namespace orbc::bend::test;

namespace {

struct Case {
  const char* name;
  int corners, order, length, sheets;
};
const Case kCases[] = {
    {"*22222", 5, 2, 3, 0}, {"*222", 3, 2, 3, 2}, {"*666", 3, 6, 4, 0}, {"*(20)(20)(20)", 3, 20, 2, 0}, {"*4^8", 8, 4, 2, 0}};

std::vector<cover::Copy> copies_for(const Case& of, const Interior& room) {
  auto copies = copies_of(room, of.length);
  return of.sheets > 0 ? with_sheets(copies, 3, of.sheets) : copies;
}

CopyMap map_for(const place::Camera& eye, const cover::Copy& copy) {
  return {View::eye, {eye.room_from_eye.space, geometry::matrix(inverse(eye.room_from_eye) * copy.cover_from_room), copy.sheet}};
}

/// Whether two tessellations have the same bits: vertices as they are in the room, or on a circle of S²; triangles.
bool same(const Tessellation& a, const Tessellation& b) {
  const auto alike = [](const NewVertex& p, const NewVertex& q) {
    const bool at = !p.on_circle || (p.image.x == q.image.x && p.image.y == q.image.y && p.image.z == q.image.z);
    return p.v.w == q.v.w && p.v.x == q.v.x && p.v.y == q.v.y && p.z == q.z && p.uv == q.uv && p.on_circle == q.on_circle && at;
  };
  return a.triangles == b.triangles && std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), alike);
}

/// A tessellation as plain arrays: homogeneous room vectors and images of all vertices.
struct Flat {
  std::vector<geometry::Ambient> v;
  std::vector<double> z;
  std::vector<Vector3> at;
  std::vector<bool> fixed;
  std::vector<mesh::Triangle> triangles;
  double worst = 0;
};

Flat flat_of(const CopyMap& map, const ScreenMetric& metric, const EdgeMesh& part) {
  const Tessellation fine = tessellate(map, metric, part, Uv(part.mesh->floor.size()), 1'000'000);
  REQUIRE(!fine.too_many);
  CHECK(same(fine, replay_tessellation(map, metric, part, Uv(part.mesh->floor.size()), fine.decisions)));
  Flat flat;
  for (std::size_t i = 0; i < part.mesh->floor.size(); ++i) {
    flat.v.push_back(part.mesh->floor[i]);
    flat.z.push_back(part.mesh->z[i]);
    flat.at.push_back(image_of(map, part.mesh->floor[i], part.mesh->z[i]));
    flat.fixed.push_back(false);
  }
  for (const NewVertex& n : fine.vertices) {
    flat.v.push_back(n.v);
    flat.z.push_back(n.z);
    flat.at.push_back(n.image);
    flat.fixed.push_back(n.on_circle);
  }
  flat.triangles = fine.triangles;
  flat.worst = fine.max_error;
  return flat;
}

/// In pixels of the perspective picture, y downwards does not matter here; depth along the axis.
struct Pixel {
  double x = 0, y = 0, depth = 0;
};
Pixel project(const place::Camera& eye, const Vector3& p) {
  const Vector3 d = p - Vector3{0, 0, eye.z};
  const double focal = eye.width / 2 / std::tan(eye.fov.radians / 2), depth = dot(d, eye.forward);
  return {focal * dot(d, eye.right) / depth, focal * dot(d, eye.up) / depth, depth};
}
bool in_picture(const place::Camera& eye, const Pixel& p) {
  return p.depth > 0 && std::fabs(p.x) < eye.width / 2.0 && std::fabs(p.y) < eye.height / 2.0;
}
double pixel_distance(const Pixel& p, const Pixel& a, const Pixel& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, l2 = dx * dx + dy * dy;
  const double t = l2 > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / l2, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}
/// Distance in the picture of a point from the drawn segment, as far as it lies before the camera.
double seen_distance(const place::Camera& eye, const Vector3& p, Vector3 a, Vector3 b) {
  const Vector3 e{0, 0, eye.z};
  const double near = 1e-3, da = dot(a - e, eye.forward), db = dot(b - e, eye.forward);
  if (da < near && db < near) return 1e9;
  if (da < near) a = a + ((near - da) / (db - da)) * (b - a);
  if (db < near) b = b + ((near - db) / (da - db)) * (a - b);
  return pixel_distance(project(eye, p), project(eye, a), project(eye, b));
}
double seen_distance(const place::Camera& eye, const Vector3& p, const Vector3 (&t)[3]) {
  const Vector3 e{0, 0, eye.z}, d = p - e;
  const double s0 = dot(cross(t[0] - e, t[1] - e), d), s1 = dot(cross(t[1] - e, t[2] - e), d), s2 = dot(cross(t[2] - e, t[0] - e), d);
  if ((s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0)) return 0;
  return std::min({seen_distance(eye, p, t[0], t[1]), seen_distance(eye, p, t[1], t[2]), seen_distance(eye, p, t[2], t[0])});
}

/// How far a point lies from the flat triangle, as the eye would see it from aside: depth and all, in pixels.
double off_surface(const ScreenMetric& metric, const Vector3& p, const Vector3 (&t)[3]) {
  const Vector3 normal = cross(t[1] - t[0], t[2] - t[0]), d = p - metric.eye;
  if (!(length(normal) > 0)) return 0;
  return std::fabs(dot(p - t[0], normal)) / length(normal) / length(d) * pixels_per_radian_at(metric, normalised(d));
}

std::vector<EdgeMesh> edge_meshes_of(const Interior& room) {
  std::vector<EdgeMesh> parts;
  for (std::size_t i = 0; i < room.parts.size(); ++i) parts.push_back(edge_mesh(room.polygon.space, room.parts[i], 0));
  return parts;
}

}  // namespace

TEST_CASE("every chord and every triangle lies within the tolerance, seen in the picture and in depth", "[bend]") {
  const Case& of = GENERATE(from_range(std::begin(kCases), std::end(kCases)));
  CAPTURE(of.name);
  Furnishing with;
  with.floor_cells = 1;
  with.walls = true;
  with.knot_along = 24;
  const auto room = regular_room(of.corners, of.order, with);
  const auto parts = edge_meshes_of(room);
  double worst = 0, deepest = 0;
  for (int view = 0; view < 2; ++view) {
    const auto eye = eye_at(room.polygon.space, 0.1 + 0.15 * view, 1.0 + 2 * view, 0.3 + 0.2 * view, 1.7 * view, 0.2 - 0.2 * view);
    const ScreenMetric metric = screen_metric(eye, {});
    for (const auto& copy : copies_for(of, room)) {
      const CopyMap map = map_for(eye, copy);
      for (const EdgeMesh& part : parts) {
        const Flat flat = flat_of(map, metric, part);
        CHECK(flat.worst <= 1);
        // What the cheap bound lets pass must need no split.
        if (error_bound(map, metric, part) <= 1) CHECK(flat.triangles.size() == part.mesh->triangles.size());
        for (const auto& t : flat.triangles) {
          if (flat.fixed[t[0]] || flat.fixed[t[1]] || flat.fixed[t[2]]) continue;
          const Vector3 drawn[3] = {flat.at[t[0]], flat.at[t[1]], flat.at[t[2]]};
          for (int s = 0; s < 3 * 9 + 6; ++s) {
            double b[3] = {0, 0, 0};
            if (s < 27) {
              const double along = (s % 9 + 1) / 10.0;
              b[s / 9] = 1 - along, b[(s / 9 + 1) % 3] = along;
            } else {
              const double inside[6][3] = {{.6, .2, .2}, {.2, .6, .2}, {.2, .2, .6}, {.4, .4, .2}, {.2, .4, .4}, {.4, .2, .4}};
              std::copy(inside[s - 27], inside[s - 27] + 3, b);
            }
            geometry::Ambient v{0, 0, 0};
            double z = 0;
            for (int k = 0; k < 3; ++k) v = v + b[k] * flat.v[t[k]], z += b[k] * flat.z[t[k]];
            const Vector3 p = image_of(map, v, z);
            if (!in_picture(eye, project(eye, p))) continue;
            const double off = s < 27 ? seen_distance(eye, p, drawn[s / 9], drawn[(s / 9 + 1) % 3]) : seen_distance(eye, p, drawn);
            worst = std::max(worst, off);
            deepest = std::max(deepest, off_surface(metric, p, drawn));
          }
        }
      }
    }
  }
  CHECK(worst <= 0.25);
  CHECK(worst > 0.1);
  CHECK(deepest <= 0.25);   // where surfaces meet, and what hides what, is as true as what is seen
}

TEST_CASE("a part has no cracks inside: every edge has two sides or lies on the part's own border", "[bend]") {
  const Case& of = GENERATE(from_range(std::begin(kCases), std::end(kCases)));
  CAPTURE(of.name);
  Furnishing with;
  with.knot_along = 24;
  const auto room = regular_room(of.corners, of.order, with);
  const auto parts = edge_meshes_of(room);
  const auto eye = eye_at(room.polygon.space, 0.17, 1.0, 0.37, 0.4, -0.2);
  for (const auto& copy : copies_for(of, room)) {
    const CopyMap map = map_for(eye, copy);
    for (const EdgeMesh& part : parts) {
      const Flat flat = flat_of(map, screen_metric(eye, {}), part);
      std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
      for (const auto& t : flat.triangles) {
        for (int k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
      }
      for (const auto& [edge, count] : sides) {
        if (count != 1) FAIL("an edge is run through twice in one direction");
        if (sides.count({edge.second, edge.first})) continue;
        if (flat.fixed[edge.first] && flat.fixed[edge.second]) continue;  // the circle around a torn axis
        if (part.mesh->kind == PartKind::object) FAIL("a closed mesh has got a hole");
        bool on_border = false;
        for (const auto& wall : room.polygon.walls) {
          on_border |=
              std::fabs(value_at(wall.line, flat.v[edge.first])) < 1e-12 && std::fabs(value_at(wall.line, flat.v[edge.second])) < 1e-12;
        }
        if (!on_border) FAIL("an inner edge has only one side");
      }
    }
  }
}

TEST_CASE("neighbouring copies split their common wall alike and meet there", "[bend]") {
  const Case& of = GENERATE(from_range(std::begin(kCases), std::end(kCases)));
  CAPTURE(of.name);
  const auto room = regular_room(of.corners, of.order);
  const auto parts = edge_meshes_of(room);
  const auto eye = eye_at(room.polygon.space, 0.17, 1.0, 0.37, 0.4, -0.2);
  double worst = 0;
  std::size_t points = 0;
  for (const auto& copy : copies_for(of, room)) {
    for (std::size_t w = 0; w < room.polygon.walls.size(); ++w) {
      cover::Copy other = copy;
      other.cover_from_room = copy.cover_from_room * geometry::reflection(room.polygon.space, room.polygon.walls[w].line);
      const CopyMap maps[2] = {map_for(eye, copy), map_for(eye, other)};
      for (const EdgeMesh& part : {parts[0], parts[1]}) {
        std::map<std::pair<double, double>, Vector3> met[2];
        for (int side = 0; side < 2; ++side) {
          const Flat flat = flat_of(maps[side], screen_metric(eye, {}), part);
          for (std::size_t i = 0; i < flat.v.size(); ++i) {
            if (std::fabs(value_at(room.polygon.walls[w].line, flat.v[i])) < 1e-13 && !flat.fixed[i])
              met[side][{flat.v[i].x, flat.v[i].y}] = flat.at[i];
          }
        }
        REQUIRE(met[0].size() == met[1].size());
        auto there = met[1].begin();
        for (const auto& [v, at] : met[0]) {
          REQUIRE(v == there->first);
          worst = std::max(worst, length(at - there->second) / length(at));
          ++there, ++points;
        }
      }
    }
  }
  CHECK(points > 100);
  CHECK(worst <= 1e-12);
}

TEST_CASE("an axis may hit a face, an edge or a corner", "[bend]") {
  // The eye stands so that its antipode lies exactly on a corner, on a wall, on a spoke and inside of triangles of the far copy's floor.
  Furnishing with;
  with.walls = true;
  const auto room = regular_room(3, 2, with);
  const auto parts = edge_meshes_of(room);
  auto copies = with_sheets(copies_of(room, 3), 3, 3);
  const double middle = room.polygon.circumradius / 2;
  const struct {
    double r, phi;
  } eyes[] = {{0, 0},
              {1e-10, 0.3},
              {1e-7, 0.2},
              {middle, 0},
              {middle, 1e-9},
              {middle, 1e-5},
              {middle, std::numbers::pi},
              {room.polygon.inradius * 0.999999, std::numbers::pi},
              {room.polygon.circumradius * 0.9999999, 0},
              {0.2, 0.35}};
  for (const auto& [r, phi] : eyes) {
    auto eye = eye_at(room.polygon.space, r, phi, 0.4, 0.3, -0.1);
    eye.projection = scene::Projection::panorama;
    BendOptions fine;
    fine.tolerance_px = 0.04;
    const ScreenMetric metric = screen_metric(eye, fine);
    double area[4] = {0, 0, 0, 0}, turned = 0;
    for (const auto& copy : copies) {
      const CopyMap map = map_for(eye, copy);
      const double sign = copy.cover_from_room.reversing != (copy.sheet % 2 == 1) ? -1 : 1;
      for (const EdgeMesh& part : parts) {
        const Flat flat = flat_of(map, metric, part);
        for (const auto& t : flat.triangles) {
          const Vector3 n = cross(flat.at[t[1]] - flat.at[t[0]], flat.at[t[2]] - flat.at[t[0]]);
          if (!std::isfinite(n.x + n.y + n.z)) FAIL("a triangle without place");
          if (part.mesh->kind != PartKind::floor) continue;
          turned += std::max(0.0, -sign * n.z / 2);
          area[copy.sheet] += sign * n.z / 2;
        }
      }
    }
    // Slivers along the torn circles may turn over, because depth along the line of sight may err a little; the signed sum knows no such
    // leave.
    CHECK(turned < 15);
    // The floors fill the disk of radius π, then the rings to 2π, 3π, 4π. Their circles are polygons of 128 or more corners.
    for (int sheet = 0; sheet < 4; ++sheet) {
      CAPTURE(r, phi, sheet);
      CHECK(area[sheet] == Approx(std::pow(std::numbers::pi, 3) * (2 * sheet + 1)).epsilon(2e-4));
    }
  }
}
