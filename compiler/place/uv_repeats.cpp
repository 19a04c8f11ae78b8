#include "compiler/place/uv_repeats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "compiler/place/polygon_mesh.h"

namespace orbc::place {
namespace {

using Polygons = std::vector<PolygonMesh::Polygon>;

// Adds the vertex at (1−t)·a + t·b. Makes: its index.
std::uint32_t interpolated(geometry::Space space, PlacedMesh& mesh, std::uint32_t a, std::uint32_t b, double t) {
  mesh.floor.push_back(geometry::normalised_point(space, (1 - t) * mesh.floor[a] + t * mesh.floor[b]));
  mesh.z.push_back((1 - t) * mesh.z[a] + t * mesh.z[b]);
  if (!mesh.uv.empty()) {
    std::array<float, 2> uv;
    for (int i = 0; i < 2; ++i) uv[i] = static_cast<float>((1 - t) * mesh.uv[a][i] + t * mesh.uv[b][i]);
    mesh.uv.push_back(uv);
  }
  if (!mesh.color.empty()) {
    mesh::LinearColor color;
    for (std::size_t k = 0; k < 3; ++k) color[k] = static_cast<float>((1 - t) * mesh.color[a][k] + t * mesh.color[b][k]);
    mesh.color.push_back(color);
  }
  if (!mesh.pattern_position.empty()) mesh.pattern_position.push_back((1 - t) * mesh.pattern_position[a] + t * mesh.pattern_position[b]);
  return static_cast<std::uint32_t>(mesh.floor.size() - 1);
}

Polygons triangle_polygons(const PlacedMesh& mesh) {
  Polygons polygons;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const mesh::Triangle& t = mesh.triangles[i];
    polygons.push_back({{{t[0], 0}, {t[1], 1}, {t[2], 2}}, static_cast<int>(i)});
  }
  return polygons;
}

struct CutOptions {
  geometry::Space space = geometry::Space::euclidean;
  int axis = 0;                     ///< of uv or pattern_position; fixes the sides of the cuts
  std::size_t max_pieces = 0;
};

// Splits polygons where the function `at` of the vertices passes a whole number. `set(v, n)` sets it to exactly n at a new vertex. Stops
// when there are more than `max_pieces` polygons.
template <class At, class Set>
Polygons cut_at_whole_numbers(const CutOptions& options, PlacedMesh& mesh, Polygons polygons, const At& at, const Set& set) {
  // Polygons wait in the slab where they begin, so that a line splits only those that reach it from below.
  std::map<int, Polygons> waiting;
  for (PolygonMesh::Polygon& polygon : polygons) {
    double low = 1e300;
    for (const PolygonMesh::Edge& e : polygon.loop) low = std::fmin(low, at(e.vertex));
    waiting[static_cast<int>(std::floor(low))].push_back(std::move(polygon));
  }
  Polygons done, active;
  const auto append = [](Polygons& all, Polygons& more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  for (int line = waiting.empty() ? 0 : waiting.begin()->first + 1; !waiting.empty() || !active.empty(); ++line) {
    if (active.empty()) line = waiting.begin()->first + 1;
    const auto fresh = waiting.find(line - 1);
    if (fresh != waiting.end()) {
      append(active, fresh->second);
      waiting.erase(fresh);
    }
    const auto value = [&](std::uint32_t i) {
      const double v = at(i) - line;
      return std::fabs(v) <= 1e-6 * std::fmax(1, std::fabs(line)) ? 0.0 : v;
    };
    SplitResult split = split_by(active, -1 - 3 * (line & 0xffff) - options.axis, value, [&](std::uint32_t a, std::uint32_t b, double t) {
      const std::uint32_t made = interpolated(options.space, mesh, a, b, t);
      set(made, line);
      return made;
    });
    append(done, split.right);
    active = std::move(split.left);
    if (done.size() + active.size() > options.max_pieces) {
      append(done, active);
      return done;
    }
  }
  return done;
}

// Puts the parts of each triangle where the triangle was.
void sort_by_triangle(Polygons& polygons) {
  std::stable_sort(polygons.begin(), polygons.end(),
                   [](const PolygonMesh::Polygon& a, const PolygonMesh::Polygon& b) { return a.label < b.label; });
}

// The repeat that contains a polygon, by the middle of its uv.
std::array<int, 2> repeat_of(const PlacedMesh& mesh, const PolygonMesh::Polygon& polygon) {
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (const PolygonMesh::Edge& e : polygon.loop)
    for (int i = 0; i < 2; ++i) {
      low[i] = std::fmin(low[i], mesh.uv[e.vertex][i]);
      high[i] = std::fmax(high[i], mesh.uv[e.vertex][i]);
    }
  std::array<int, 2> repeat;
  for (int i = 0; i < 2; ++i) {
    const double middle = 0.5 * (low[i] + high[i]);
    // A polygon whose uv are one whole number everywhere (on the texture's edge) belongs to the repeat that ends there, except for 0.
    repeat[i] = static_cast<int>(high[i] - low[i] < 1e-6 && middle > 0.5 ? std::ceil(middle) - 1 : std::floor(middle));
  }
  return repeat;
}

}  // namespace

Result<PlacedMesh> cut_at_uv_repeats(geometry::Space space, PlacedMesh mesh, std::size_t max_triangles) {
  if (mesh.uv.empty()) return mesh;
  double low[2] = {0, 0}, high[2] = {1, 1};
  for (const auto& uv : mesh.uv)
    for (int i = 0; i < 2; ++i) {
      low[i] = std::fmin(low[i], uv[i]);
      high[i] = std::fmax(high[i], uv[i]);
    }
  if (!(high[0] - low[0] < 2000) || !(high[1] - low[1] < 2000))
    return make_error("place.too-many-repeats", fmt::format("the texture of {} repeats more than 2000 times", mesh.name),
                      "a larger `cell` fits");
  if (low[0] >= 0 && low[1] >= 0 && high[0] <= 1 && high[1] <= 1) return mesh;
  Polygons polygons = triangle_polygons(mesh);
  for (int axis = 0; axis < 2; ++axis) {
    polygons = cut_at_whole_numbers(
        {space, axis, max_triangles}, mesh, std::move(polygons), [&](std::uint32_t v) { return static_cast<double>(mesh.uv[v][axis]); },
        [&](std::uint32_t v, int line) { mesh.uv[v][axis] = static_cast<float>(line); });
    if (polygons.size() > max_triangles)
      return make_error("place.too-many-repeats",
                        fmt::format("the texture of {} cuts it into more than {} pieces", mesh.name, max_triangles),
                        "a larger `cell` fits");
  }
  PlacedMesh result;
  result.kind = mesh.kind;
  result.name = mesh.name;
  result.wall = mesh.wall;
  std::map<std::array<int, 3>, std::uint32_t> known;
  sort_by_triangle(polygons);
  for (PolygonMesh::Polygon& polygon : polygons) {
    const std::array<int, 2> repeat = repeat_of(mesh, polygon);
    for (PolygonMesh::Edge& e : polygon.loop) {
      const auto [at, is_new] =
          known.try_emplace({static_cast<int>(e.vertex), repeat[0], repeat[1]}, static_cast<std::uint32_t>(result.floor.size()));
      if (is_new) {
        result.floor.push_back(mesh.floor[e.vertex]);
        result.z.push_back(mesh.z[e.vertex]);
        std::array<float, 2> uv;
        for (int i = 0; i < 2; ++i) uv[i] = std::clamp(mesh.uv[e.vertex][i] - static_cast<float>(repeat[i]), 0.0f, 1.0f);
        result.uv.push_back(uv);
        if (!mesh.color.empty()) result.color.push_back(mesh.color[e.vertex]);
        if (!mesh.pattern_position.empty()) result.pattern_position.push_back(mesh.pattern_position[e.vertex]);
      }
      e.vertex = at->second;
    }
    for (const mesh::Triangle& t : fan(polygon, polygon.loop.front().vertex)) {
      result.triangles.push_back(t);
      result.style.push_back(mesh.style[polygon.label]);
    }
  }
  return result;
}

Result<PlacedMesh> checkered(geometry::Space space, PlacedMesh mesh, double cell, std::size_t max_triangles) {
  using geometry::Vector3;
  constexpr double Vector3::*kAxes[3] = {&Vector3::x, &Vector3::y, &Vector3::z};
  Polygons polygons = triangle_polygons(mesh);
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = [&](std::uint32_t v) { return mesh.pattern_position[v].*kAxes[axis] / cell; };
    double low = 0, high = 0;
    for (std::uint32_t v = 0; v < mesh.pattern_position.size(); ++v) {
      low = std::fmin(low, at(v));
      high = std::fmax(high, at(v));
    }
    if (high - low < 10'000)
      polygons = cut_at_whole_numbers({space, axis, max_triangles}, mesh, std::move(polygons), at,
                                    [&](std::uint32_t v, int line) { mesh.pattern_position[v].*kAxes[axis] = line * cell; });
    if (high - low >= 10'000 || polygons.size() > max_triangles)
      return make_error("place.too-many-cells",
                        fmt::format("cells of {:.4g} cut {} into more than {} pieces", cell, mesh.name, max_triangles),
                        "a larger `cell` fits");
  }
  sort_by_triangle(polygons);
  mesh.triangles.clear();
  mesh.style.clear();
  for (const PolygonMesh::Polygon& polygon : polygons) {
    Vector3 middle;
    for (const PolygonMesh::Edge& e : polygon.loop)
      middle = middle + (1.0 / static_cast<double>(polygon.loop.size())) * mesh.pattern_position[e.vertex];
    // A face in a plane of the grid belongs to the cell above, so that rounding cannot speckle it.
    const auto number = [cell](double x) { return std::floor(x / cell + 1e-6); };
    const double cells = number(middle.x) + number(middle.y) + number(middle.z);
    for (const mesh::Triangle& t : fan(polygon, polygon.loop.front().vertex)) {
      mesh.triangles.push_back(t);
      mesh.style.push_back(std::fmod(cells, 2) != 0 ? 1 : 0);
    }
  }
  return mesh;
}

}  // namespace orbc::place
