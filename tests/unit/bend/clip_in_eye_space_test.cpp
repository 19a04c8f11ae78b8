#include "compiler/bend/clip_in_eye_space.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <thread>

#include "compiler/bend/clip.h"
#include "tests/unit/bend/fixture.h"

using namespace orbc;
using namespace orbc::bend;
using geometry::Space;

namespace {

constexpr double kEyeZ = 1;

place::Camera eye() {
  place::Camera eye;
  eye.room_from_eye = geometry::identity(Space::euclidean);
  eye.z = kEyeZ;
  eye.width = 800, eye.height = 600;
  return eye;
}

/// A wavy upright sheet before the eye, `cells` × `cells`, for each of the copies again.
BentCover sheets(std::size_t copies, int cells) {
  BentCover cover;
  for (std::size_t c = 0; c < copies; ++c) {
    const std::size_t first = cover.positions.size(), first_index = cover.indices.size();
    for (int i = 0; i <= cells; ++i)
      for (int j = 0; j <= cells; ++j) {
        const double y = 4.0 * i / cells - 2, z = 2.4 * j / cells - 0.2;
        cover.positions.push_back({static_cast<float>(2 + 0.3 * std::sin(3 * y + z)), static_cast<float>(y), static_cast<float>(z)});
        cover.uv.push_back({static_cast<float>(y), static_cast<float>(z)});
      }
    const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(first + static_cast<std::size_t>(i * (cells + 1) + j)); };
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j)
        cover.indices.insert(cover.indices.end(), {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    cover.copies.push_back({first, cover.positions.size() - first, first_index, cover.indices.size() - first_index});
  }
  return cover;
}

cover::Bearing bearing(double degrees) { return {std::cos(degrees * M_PI / 180), std::sin(degrees * M_PI / 180)}; }

cover::Copy copy_in(double from, double to) {
  cover::Copy copy;
  copy.wedge = cover::Wedge{bearing(from), bearing(to)};
  return copy;
}

using Key = std::array<float, 3>;

struct Open {
  int edges = 0;
  double length = 0;
};

/// Edges that are met in one direction only.
Open open_edges(const BentCover& cover) {
  std::map<std::pair<Key, Key>, int> directed;
  for (std::size_t i = 0; i < cover.indices.size(); ++i) {
    const Key &a = cover.positions[cover.indices[i]], &b = cover.positions[cover.indices[i - i % 3 + (i + 1) % 3]];
    ++directed[{a, b}];
  }
  Open open;
  for (const auto& [edge, count] : directed) {
    CHECK(count == 1);
    if (directed.count({edge.second, edge.first})) continue;
    const auto &a = edge.first, &b = edge.second;
    ++open.edges;
    open.length += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
  return open;
}

/// Solid angle seen from the eye, by each triangle's own plane (Van Oosterom & Strackee).
double seen(const BentCover& cover) {
  double sum = 0;
  for (std::size_t i = 0; i < cover.indices.size(); i += 3) {
    geometry::Vector3 v[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Key& p = cover.positions[cover.indices[i + k]];
      v[k] = geometry::normalised(geometry::Vector3{p[0], p[1], p[2] - kEyeZ});
    }
    sum += 2 * std::atan2(dot(v[0], cross(v[1], v[2])), 1 + dot(v[0], v[1]) + dot(v[1], v[2]) + dot(v[2], v[0]));
  }
  return std::fabs(sum);
}

/// Backwards, and on two threads.
Executor odd_executor() {
  return [](std::size_t count, const std::function<void(std::size_t)>& task) {
    std::thread other([&] {
      for (std::size_t i = 1; i < count; i += 2) task(i);
    });
    for (std::size_t i = count; i-- > 0;)
      if (i % 2 == 0) task(i);
    other.join();
  };
}

}  // namespace

TEST_CASE("neighbouring wedges cut what they share at the same vertices", "[bend]") {
  const std::vector<double> borders{-80, -31.7, -9, 0.123, 27, 80};
  std::vector<cover::Copy> copies;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) copies.push_back(copy_in(borders[i], borders[i + 1]));
  constexpr int cells = 9;
  const BentCover whole = sheets(1, cells);
  const BentCover cut = clip_in_eye_space(sheets(copies.size(), cells), copies, eye(), 0.25, serial_executor());
  REQUIRE(cut.copies.size() == copies.size());
  CHECK(seen(cut) == Approx(seen(whole)).epsilon(1e-6));
  // Nothing but the sheet's own border is open; each cut meets it twice.
  CHECK(open_edges(cut).edges == 4 * cells + 2 * (static_cast<int>(borders.size()) - 2));
  for (std::size_t c = 0; c < copies.size(); ++c)
    for (std::size_t i = 0; i < cut.copies[c].vertex_count; ++i) {
      const auto& p = cut.positions[cut.copies[c].first_vertex + i];
      const double far = std::hypot(p[0], p[1]);
      CHECK(cross(copies[c].wedge->from, cover::Bearing{p[0], p[1]}) > -1e-6 * far);
      CHECK(cross(copies[c].wedge->to, cover::Bearing{p[0], p[1]}) < 1e-6 * far);
      // Places in the atlas are cut along.
      CHECK(cut.uv[cut.copies[c].first_vertex + i][0] == Approx(p[1]).margin(1e-5));
    }
}

TEST_CASE("a height bound divides what is seen above it from what is seen below", "[bend]") {
  // The line x = 1, or the geodesic through (1, 0) across it.
  const Space space = GENERATE(Space::euclidean, Space::hyperbolic);
  auto looking = eye();
  looking.room_from_eye = geometry::identity(space);
  cover::HeightBound bound{space == Space::euclidean ? geometry::Line{-1, 1, 0} : geometry::Line{-std::sinh(1.0), std::cosh(1.0), 0}, 0,
                           0.7, true};
  std::vector<cover::Copy> copies(2, copy_in(-40, 40));
  copies[0].height_bounds = {bound};
  bound.above = false;
  copies[1].height_bounds = {bound};
  const std::vector<cover::Copy> one{copy_in(-40, 40)};
  const auto whole = clip_in_eye_space(sheets(1, 8), one, looking, 0.25, serial_executor());
  const auto cut = clip_in_eye_space(sheets(2, 8), copies, looking, 0.25, serial_executor());
  CHECK(seen(cut) == Approx(seen(whole)).epsilon(1e-6));
  // The same vertices on both sides: nothing is open but the border of the whole.
  CHECK(open_edges(cut).length == Approx(open_edges(whole).length).epsilon(1e-6));
  for (std::size_t c = 0; c < 2; ++c)
    for (std::size_t i = 0; i < cut.copies[c].vertex_count; ++i) {
      const auto& p = cut.positions[cut.copies[c].first_vertex + i];
      const double far = std::hypot(p[0], p[1]), slope = slope_of(space, bound, {p[0] / far, p[1] / far}, kEyeZ);
      CHECK((c == 0 ? 1 : -1) * ((p[2] - kEyeZ) / far - slope) > -1e-3);
    }
}

TEST_CASE("who cuts when changes nothing", "[bend]") {
  std::vector<cover::Copy> copies;
  for (int i = 0; i < 1200; ++i) {
    copies.push_back(copy_in(-60 + 0.05 * i, -50 + 0.07 * i));
    if (i % 3 == 0) copies.back().wedge.reset();
  }
  const auto one = clip_in_eye_space(sheets(copies.size(), 2), copies, eye(), 0.25, serial_executor());
  const auto two = clip_in_eye_space(sheets(copies.size(), 2), copies, eye(), 0.25, odd_executor());
  CHECK(one.positions == two.positions);
  CHECK(one.uv == two.uv);
  CHECK(one.indices == two.indices);
  REQUIRE(one.copies.size() == copies.size());
  for (std::size_t i = 0; i < copies.size(); i += 3) CHECK(one.copies[i].index_count == 24);
}

TEST_CASE("what reaches into a wedge is whole, and nothing that does is missing", "[bend]") {
  const Space space = GENERATE(Space::spherical, Space::euclidean, Space::hyperbolic);
  const int sheet = GENERATE(0, 1);
  if (sheet == 1 && space != Space::spherical) return;
  place::PlacedMesh mesh;
  constexpr int cells = 7;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      mesh.floor.push_back(geometry::translation_by(space, 0.8, 0) *
                           geometry::translation_by(space, 0.9 * i / cells - 0.4, 0.9 * j / cells - 0.47) * geometry::Point());
      mesh.z.push_back(0.1 * i - 0.05 * j);
    }
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const auto id = [&](int k, int l) { return static_cast<std::uint32_t>((i + k) * (cells + 1) + j + l); };
      mesh.triangles.push_back({id(0, 0), id(1, 0), id(1, 1)});
      mesh.triangles.push_back({id(0, 0), id(1, 1), id(0, 1)});
    }
  const Uv uv(mesh.floor.size());
  const EdgeMesh net = edge_mesh(space, mesh, 0);
  const LogMap map{space, geometry::matrix(geometry::rotation(space, 0.4)), sheet};
  for (const double from : {-20.0, 3.0, 20.0, 31.0}) {
    const cover::Wedge wedge{bearing(from + (sheet == 1 ? 180 : 0)), bearing(from + 8 + (sheet == 1 ? 180 : 0))};
    const auto part = triangles_touching(wedge, map, net, uv, 0.01);
    CHECK(part->mesh.triangles.size() < mesh.triangles.size());
    CHECK(part->uv.size() == part->mesh.floor.size());
    // Cut to the wedge both give the same, corner by corner.
    const auto corners = [](const ClippedPart& of) {
      std::vector<std::array<double, 4>> all;
      for (const auto& t : of.mesh.triangles)
        for (const auto v : t) all.push_back({of.mesh.floor[v].w, of.mesh.floor[v].x, of.mesh.floor[v].y, of.mesh.z[v]});
      return all;
    };
    CHECK(corners(*clipped(wedge, map, part->part, part->uv)) == corners(*clipped(wedge, map, net, uv)));
    // A wider margin keeps more.
    CHECK(triangles_touching(wedge, map, net, uv, 0.2)->mesh.triangles.size() > part->mesh.triangles.size());
  }
}
