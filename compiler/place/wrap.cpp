#include "compiler/place/wrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "compiler/place/net.h"

namespace orbc::place {
namespace {

using Pieces = std::vector<Net::Piece>;

std::uint32_t between(geometry::Space space, PlacedMesh& mesh, std::uint32_t a, std::uint32_t b, double t) {
  mesh.floor.push_back(geometry::normalised_point(space, (1 - t) * mesh.floor[a] + t * mesh.floor[b]));
  mesh.z.push_back((1 - t) * mesh.z[a] + t * mesh.z[b]);
  if (!mesh.uv.empty()) {
    std::array<float, 2> uv;
    for (int i = 0; i < 2; ++i) uv[i] = static_cast<float>((1 - t) * mesh.uv[a][i] + t * mesh.uv[b][i]);
    mesh.uv.push_back(uv);
  }
  if (!mesh.pattern_position.empty()) mesh.pattern_position.push_back((1 - t) * mesh.pattern_position[a] + t * mesh.pattern_position[b]);
  return static_cast<std::uint32_t>(mesh.floor.size() - 1);
}

Pieces pieces_of(const PlacedMesh& mesh) {
  Pieces pieces;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const mesh::Triangle& t = mesh.triangles[i];
    pieces.push_back({{{t[0], 0}, {t[1], 1}, {t[2], 2}}, static_cast<int>(i)});
  }
  return pieces;
}

// Cuts where the function `at` of the vertices passes a whole number. `set(v, n)` makes it exactly n at a new vertex. Stops when there are
// too many pieces.
template <class At, class Set>
Pieces cut_at_whole_numbers(geometry::Space space, PlacedMesh& mesh, Pieces pieces, int axis, std::size_t max_pieces, const At& at,
                            const Set& set) {
  // Pieces wait in the slab where they begin, so that a line touches only those that reach it from below.
  std::map<int, Pieces> waiting;
  for (Net::Piece& piece : pieces) {
    double low = 1e300;
    for (const Net::Edge& e : piece.loop) low = std::fmin(low, at(e.vertex));
    waiting[static_cast<int>(std::floor(low))].push_back(std::move(piece));
  }
  Pieces done, active;
  const auto take = [](Pieces& all, Pieces& more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  for (int line = waiting.empty() ? 0 : waiting.begin()->first + 1; !waiting.empty() || !active.empty(); ++line) {
    if (active.empty()) line = waiting.begin()->first + 1;
    const auto fresh = waiting.find(line - 1);
    if (fresh != waiting.end()) {
      take(active, fresh->second);
      waiting.erase(fresh);
    }
    const auto value = [&](std::uint32_t i) {
      const double v = at(i) - line;
      return std::fabs(v) <= 1e-6 * std::fmax(1, std::fabs(line)) ? 0.0 : v;
    };
    Halves halves = cut_by(active, -1 - 3 * (line & 0xffff) - axis, value, [&](std::uint32_t a, std::uint32_t b, double t) {
      const std::uint32_t made = between(space, mesh, a, b, t);
      set(made, line);
      return made;
    });
    take(done, halves.right);
    active = std::move(halves.left);
    if (done.size() + active.size() > max_pieces) {
      take(done, active);
      return done;
    }
  }
  return done;
}

// The parts of one triangle stay together, in the triangle's place.
void sort_by_triangle(Pieces& pieces) {
  std::stable_sort(pieces.begin(), pieces.end(), [](const Net::Piece& a, const Net::Piece& b) { return a.tag < b.tag; });
}

// The repeat that a piece lies in, by the middle of its uv.
std::array<int, 2> repeat_of(const PlacedMesh& mesh, const Net::Piece& piece) {
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (const Net::Edge& e : piece.loop)
    for (int i = 0; i < 2; ++i) low[i] = std::fmin(low[i], mesh.uv[e.vertex][i]), high[i] = std::fmax(high[i], mesh.uv[e.vertex][i]);
  std::array<int, 2> repeat;
  for (int i = 0; i < 2; ++i) {
    const double middle = 0.5 * (low[i] + high[i]);
    // uv that are one whole number everywhere (a flat patch of the texture's edge) belong to the repeat that ends there, if that is not 0.
    repeat[i] = static_cast<int>(high[i] - low[i] < 1e-6 && middle > 0.5 ? std::ceil(middle) - 1 : std::floor(middle));
  }
  return repeat;
}

}  // namespace

Result<PlacedMesh> wrapped(geometry::Space space, PlacedMesh mesh, std::size_t max_triangles) {
  if (mesh.uv.empty()) return mesh;
  double low[2] = {0, 0}, high[2] = {1, 1};
  for (const auto& uv : mesh.uv)
    for (int i = 0; i < 2; ++i) low[i] = std::fmin(low[i], uv[i]), high[i] = std::fmax(high[i], uv[i]);
  if (!(high[0] - low[0] < 2000) || !(high[1] - low[1] < 2000))
    return make_error("place.too-many-repeats", fmt::format("the texture of {} repeats more than 2000 times", mesh.name),
                      "a larger `cell` fits");
  if (low[0] >= 0 && low[1] >= 0 && high[0] <= 1 && high[1] <= 1) return mesh;
  Pieces pieces = pieces_of(mesh);
  for (int axis = 0; axis < 2; ++axis) {
    pieces = cut_at_whole_numbers(
        space, mesh, std::move(pieces), axis, max_triangles, [&](std::uint32_t v) { return static_cast<double>(mesh.uv[v][axis]); },
        [&](std::uint32_t v, int line) { mesh.uv[v][axis] = static_cast<float>(line); });
    if (pieces.size() > max_triangles)
      return make_error("place.too-many-repeats",
                        fmt::format("the texture of {} cuts it into more than {} pieces", mesh.name, max_triangles),
                        "a larger `cell` fits");
  }
  PlacedMesh result;
  result.kind = mesh.kind, result.name = mesh.name, result.wall = mesh.wall;
  std::map<std::array<int, 3>, std::uint32_t> known;
  sort_by_triangle(pieces);
  for (Net::Piece& piece : pieces) {
    const std::array<int, 2> repeat = repeat_of(mesh, piece);
    for (Net::Edge& e : piece.loop) {
      const auto [at, is_new] =
          known.try_emplace({static_cast<int>(e.vertex), repeat[0], repeat[1]}, static_cast<std::uint32_t>(result.floor.size()));
      if (is_new) {
        result.floor.push_back(mesh.floor[e.vertex]);
        result.z.push_back(mesh.z[e.vertex]);
        std::array<float, 2> uv;
        for (int i = 0; i < 2; ++i) uv[i] = std::clamp(mesh.uv[e.vertex][i] - static_cast<float>(repeat[i]), 0.0f, 1.0f);
        result.uv.push_back(uv);
        if (!mesh.pattern_position.empty()) result.pattern_position.push_back(mesh.pattern_position[e.vertex]);
      }
      e.vertex = at->second;
    }
    for (const mesh::Triangle& t : fan(piece, piece.loop.front().vertex)) {
      result.triangles.push_back(t);
      result.look.push_back(mesh.look[piece.tag]);
    }
  }
  return result;
}

Result<PlacedMesh> checkered(geometry::Space space, PlacedMesh mesh, double cell, std::size_t max_triangles) {
  using geometry::Vector3;
  constexpr double Vector3::*kAxes[3] = {&Vector3::x, &Vector3::y, &Vector3::z};
  Pieces pieces = pieces_of(mesh);
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = [&](std::uint32_t v) { return mesh.pattern_position[v].*kAxes[axis] / cell; };
    double low = 0, high = 0;
    for (std::uint32_t v = 0; v < mesh.pattern_position.size(); ++v) low = std::fmin(low, at(v)), high = std::fmax(high, at(v));
    if (high - low < 10'000)
      pieces = cut_at_whole_numbers(space, mesh, std::move(pieces), axis, max_triangles, at,
                                    [&](std::uint32_t v, int line) { mesh.pattern_position[v].*kAxes[axis] = line * cell; });
    if (high - low >= 10'000 || pieces.size() > max_triangles)
      return make_error("place.too-many-cells",
                        fmt::format("cells of {:.4g} cut {} into more than {} pieces", cell, mesh.name, max_triangles),
                        "a larger `cell` fits");
  }
  sort_by_triangle(pieces);
  mesh.triangles.clear();
  mesh.look.clear();
  for (const Net::Piece& piece : pieces) {
    Vector3 middle;
    for (const Net::Edge& e : piece.loop)
      middle = middle + (1.0 / static_cast<double>(piece.loop.size())) * mesh.pattern_position[e.vertex];
    // A face that lies in a plane of the grid belongs to the cell above: rounding must not speckle it.
    const auto number = [cell](double x) { return std::floor(x / cell + 1e-6); };
    const double cells = number(middle.x) + number(middle.y) + number(middle.z);
    for (const mesh::Triangle& t : fan(piece, piece.loop.front().vertex)) {
      mesh.triangles.push_back(t);
      mesh.look.push_back(std::fmod(cells, 2) != 0 ? 1 : 0);
    }
  }
  return mesh;
}

}  // namespace orbc::place
