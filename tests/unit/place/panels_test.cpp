#include "compiler/place/panels.h"

#include <catch2/catch.hpp>
#include <cstring>

#include "compiler/place/furnish.h"
#include "compiler/place/locate.h"
#include "rooms.h"

using namespace orbc;
using namespace orbc::place;
using namespace orbc::place::test;
using geometry::Point;
using geometry::Space;

namespace {

scene::Material checker(double cell) {
  scene::Material material;
  material.pattern = scene::Pattern::checker;
  material.cell = cell;
  return material;
}

Shell plain_shell(const room::Room& room, double floor_cell, double wall_cell) {
  Shell shell;
  shell.floor = floor_cell > 0 ? checker(floor_cell) : scene::Material{};
  shell.ceiling = scene::Material{};
  for (std::size_t i = 0; i < room.walls.size(); ++i)
    shell.walls.push_back(wall_cell > 0 && i % 2 == 0 ? checker(wall_cell) : scene::Material{});
  return shell;
}

double floor_area(const room::Room& room, const PlacedMesh& mesh) {
  double sum = 0;
  for (const mesh::Triangle& t : mesh.triangles) sum += area(room.space, mesh.floor[t[0]], mesh.floor[t[1]], mesh.floor[t[2]]);
  return sum;
}

// Walls are flat: area in (s, z), counted positive when seen from inside.
double wall_area(const room::Room& room, const PlacedMesh& mesh, double* smallest = nullptr) {
  double sum = 0;
  for (const mesh::Triangle& t : mesh.triangles) {
    double s[3];
    for (int i = 0; i < 3; ++i) s[i] = arc_on_wall(room, mesh.wall, mesh.floor[t[i]]);
    // A closed wall's seam is both its start and its end.
    for (double& a : s)
      if (room.corners.empty() && std::fabs(a - s[0]) > 3.2) a += a < s[0] ? room.walls[mesh.wall].length : -room.walls[mesh.wall].length;
    const double twice = (s[2] - s[0]) * (mesh.z[t[1]] - mesh.z[t[0]]) - (s[1] - s[0]) * (mesh.z[t[2]] - mesh.z[t[0]]);
    if (smallest) *smallest = std::fmin(*smallest, twice / 2);
    sum += twice / 2;
  }
  return sum;
}

PlacedMirror mirror(int wall, double s0, double s1, double z0, double z1) {
  PlacedMirror m;
  m.wall = wall;
  m.span[0] = s0, m.span[1] = s1, m.height[0] = z0, m.height[1] = z1;
  return m;
}

}  // namespace

TEST_CASE("panels cover floor, ceiling and walls exactly", "[place]") {
  for (const std::string& notation : notations()) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    for (const double cell : {0.0, 0.25, 0.07}) {
      CAPTURE(cell);
      const auto parts = make_panels(room, 1.25, plain_shell(room, cell, cell * 1.1), {}).value();
      REQUIRE(parts.size() == 2 + room.walls.size());
      CHECK(floor_area(room, parts[0]) == Approx(room.area).epsilon(1e-9));
      CHECK(floor_area(room, parts[1]) == Approx(-room.area).epsilon(1e-9));
      for (std::size_t i = 0; i < room.walls.size(); ++i) {
        double smallest = 1;
        CHECK(wall_area(room, parts[2 + i], &smallest) == Approx(1.25 * room.walls[i].length).epsilon(1e-9));
        CHECK(smallest > 0);
      }
    }
  }
}

TEST_CASE("the shell is closed: panels share every vertex of a common edge bit by bit", "[place]") {
  for (const std::string& notation : notations()) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    for (const double cell : {0.0, 0.3, 0.11})
      CHECK(open_edges(make_panels(room, 1.0, plain_shell(room, cell, 0.7 * cell), {}).value()).empty());
  }
}

TEST_CASE("a wall opens exactly where its mirrors are", "[place]") {
  for (const std::string& notation : notations()) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    const double l = room.walls[0].length;
    // Two that overlap, one to the wall's end, one that shares an edge with another.
    const std::vector<PlacedMirror> mirrors = {mirror(0, 0.1 * l, 0.4 * l, 0.2, 0.7), mirror(0, 0.3 * l, 0.5 * l, 0.5, 0.9),
                                               mirror(0, 0.8 * l, l, 0, 0.6), mirror(0, 0.5 * l, 0.6 * l, 0.5, 0.9)};
    const double open = (0.3 * 0.5 + 0.2 * 0.4 - 0.1 * 0.2 + 0.2 * 0.6 + 0.1 * 0.4) * l;
    const auto parts = make_panels(room, 1.0, plain_shell(room, 0.2, 0.13), mirrors).value();
    CHECK(wall_area(room, parts[2]) == Approx(l - open).epsilon(1e-9));
    for (const auto& [a, b] : open_edges(parts)) {
      // What is open lies on a border of a mirror.
      const double s = arc_on_wall(room, 0, geometry::normalised_point(room.space, Point{a[0], a[1], a[2]} + Point{b[0], b[1], b[2]})),
                   z = 0.5 * (a[3] + b[3]);
      bool on_border = false;
      for (const PlacedMirror& m : mirrors) {
        const bool upright =
            std::fabs(s - m.span[0]) < 1e-9 || std::fabs(s - m.span[1]) < 1e-9 || (room.corners.empty() && m.span[1] == l && s < 1e-9);
        const bool level = std::fabs(z - m.height[0]) < 1e-9 || std::fabs(z - m.height[1]) < 1e-9;
        on_border = on_border || (upright && m.height[0] < z && z < m.height[1]) || (level && m.span[0] < s && s < m.span[1]);
      }
      // The corner next to a mirror that ends there: the neighbouring wall's edge.
      CHECK(on_border);
    }
  }
}

TEST_CASE("a full mirror leaves no panel, a floor mirror no floor", "[place]") {
  const room::Room room = make_room("*2222");
  Shell shell = plain_shell(room, 0, 0);
  shell.floor.reset();
  const auto parts = make_panels(room, 1.0, shell, {mirror(1, 0, room.walls[1].length, 0, 1)}).value();
  REQUIRE(parts.size() == 4);
  CHECK(parts[0].kind == PartKind::ceiling);
  CHECK(parts[1].wall == 0);
  CHECK(parts[2].wall == 2);
}

TEST_CASE("every triangle of a chequered panel lies in one cell and has its colour", "[place]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const std::string& notation : notations()) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    const double cell = 0.17;
    const auto parts = make_panels(room, 1.0, plain_shell(room, cell, cell), {}).value();
    for (const PlacedMesh& part : {parts[0], parts[2]})
      for (std::size_t i = 0; i < part.triangles.size(); ++i) {
        const mesh::Triangle& t = part.triangles[i];
        double b[3] = {unit(random) + 0.01, unit(random) + 0.01, unit(random) + 0.01};
        const double sum = b[0] + b[1] + b[2];
        geometry::Ambient x{0, 0, 0};
        double z = 0;
        for (int k = 0; k < 3; ++k) x = x + (b[k] / sum) * part.floor[t[k]], z += b[k] / sum * part.z[t[k]];
        const Point p = geometry::normalised_point(room.space, x);
        double u, v;
        if (part.kind == PartKind::floor) {
          const auto uv = geometry::axial_from_point(room.space, p);
          u = uv.real(), v = uv.imag();
        } else {
          u = arc_on_wall(room, 0, p), v = z;
        }
        const double cells = std::floor(u / cell) + std::floor(v / cell);
        REQUIRE(part.style[i] == (std::fmod(cells, 2) != 0 ? 1 : 0));
      }
  }
}

TEST_CASE("cells that are too small are refused with one that fits", "[place]") {
  const room::Room room = make_room("*22222");
  Shell shell = plain_shell(room, 1e-4, 0);
  auto refused = make_panels(room, 1.0, shell, {});
  REQUIRE(!refused);
  CHECK(refused.error()[0].code == "place.too-many-cells");
  const std::string hint = refused.error()[0].hint;
  const double fits = std::stod(hint.substr(hint.find("of ") + 3));
  CHECK(make_panels(room, 1.0, plain_shell(room, fits, 0), {}).has_value());
  shell = plain_shell(room, 0, 1e-4);
  refused = make_panels(room, 1.0, shell, {});
  REQUIRE(!refused);
  CHECK(refused.error()[0].message.find("wall 1") != std::string::npos);
}

TEST_CASE("a texture lies on the floor by the disk chart to a quarter texel", "[place]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const char* notation : {"*", "*222", "*333", "*22222"}) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    Shell shell = plain_shell(room, 0, 0);
    shell.floor->pattern = shell.walls[0].pattern = scene::Pattern::texture;
    shell.floor->cell = shell.walls[0].cell = 0.5;
    PanelOptions options;
    options.texture_size = 256;
    const auto parts = make_panels(room, 1.0, shell, {}, options).value();
    CHECK(open_edges(parts).empty());
    double worst = 0;
    for (const PlacedMesh& part : {parts[0], parts[2]}) {
      REQUIRE(part.uv.size() == part.floor.size());
      for (const mesh::Triangle& t : part.triangles) {
        const double a = unit(random), c = unit(random) * (1 - a), b[3] = {a, c, 1 - a - c};
        geometry::Ambient x{0, 0, 0};
        double u = 0, v = 0, z = 0;
        for (int k = 0; k < 3; ++k)
          x = x + b[k] * part.floor[t[k]], u += b[k] * part.uv[t[k]][0], v += b[k] * part.uv[t[k]][1], z += b[k] * part.z[t[k]];
        const Point p = geometry::normalised_point(room.space, x);
        std::complex<double> place = (room.space == Space::euclidean ? 2.0 : 4.0) * geometry::disk_from_point(room.space, p);
        if (part.kind == PartKind::wall) place = {arc_on_wall(room, 0, p) / 0.5, z / 0.5};
        worst = std::fmax(worst, std::abs(std::complex<double>(u, -v) - place) * 256);
      }
    }
    CHECK(worst < 0.5);
  }
}
