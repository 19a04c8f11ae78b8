// Cutting convex polygons by lines in homogeneous coordinates (Sutherland, Hodgman 1974): a line is a linear form on ambient vectors, so
// points at infinity of the gnomonic chart (the border of a hemisphere, w = 0) need no division and no special case.
#include "compiler/place/net.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace orbc::place {
namespace {

using geometry::Position;

std::uint32_t between(geometry::Space space, Net& net, std::uint32_t a, std::uint32_t b, double t) {
  const Position p = net.vertices[a], q = net.vertices[b];
  net.vertices.push_back({geometry::normalised_point(space, (1 - t) * p.floor + t * q.floor), (1 - t) * p.z + t * q.z});
  return static_cast<std::uint32_t>(net.vertices.size() - 1);
}

std::uint32_t middle_of(geometry::Space space, Net& net, const Net::Piece& piece) {
  geometry::Ambient sum{0, 0, 0};
  double z = 0;
  for (const Net::Edge& edge : piece.loop) {
    sum = sum + net.vertices[edge.vertex].floor;
    z += net.vertices[edge.vertex].z;
  }
  net.vertices.push_back({geometry::normalised_point(space, sum), z / static_cast<double>(piece.loop.size())});
  return static_cast<std::uint32_t>(net.vertices.size() - 1);
}

}  // namespace

Halves cut_by(const std::vector<Net::Piece>& pieces, int side, const std::function<double(std::uint32_t)>& value,
              const std::function<std::uint32_t(std::uint32_t, std::uint32_t, double)>& make) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings;
  const auto crossing = [&](std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto known = crossings.find({a, b});
    if (known != crossings.end()) return known->second;
    const double p = value(a), q = value(b);
    return crossings[{a, b}] = make(a, b, p / (p - q));
  };
  Halves halves;
  for (const Net::Piece& piece : pieces) {
    const std::size_t n = piece.loop.size();
    std::vector<double> values(n);
    bool any_left = false, any_right = false;
    for (std::size_t i = 0; i < n; ++i) {
      values[i] = value(piece.loop[i].vertex);
      any_left = any_left || values[i] > 0;
      any_right = any_right || values[i] < 0;
    }
    if (!any_right) {
      halves.left.push_back(piece);
      continue;
    }
    if (!any_left) {
      halves.right.push_back(piece);
      continue;
    }
    Net::Piece left{{}, piece.tag}, right{{}, piece.tag};
    for (std::size_t i = 0; i < n; ++i) {
      const Net::Edge& edge = piece.loop[i];
      const double here = values[i], next = values[(i + 1) % n];
      // The vertex itself: where a half is left for the other one, its border goes on along the cut.
      if (here >= 0) left.loop.push_back({edge.vertex, here == 0 && next < 0 ? side : edge.side});
      if (here <= 0) right.loop.push_back({edge.vertex, here == 0 && next > 0 ? side : edge.side});
      if (here * next < 0) {
        const std::uint32_t middle = crossing(edge.vertex, piece.loop[(i + 1) % n].vertex);
        left.loop.push_back({middle, here > 0 ? side : edge.side});
        right.loop.push_back({middle, here > 0 ? edge.side : side});
      }
    }
    halves.left.push_back(std::move(left));
    halves.right.push_back(std::move(right));
  }
  return halves;
}

Halves cut(geometry::Space space, Net& net, const std::vector<Net::Piece>& pieces, const geometry::Line& line, int side) {
  const auto value = [&](std::uint32_t i) {
    const geometry::Ambient& x = net.vertices[i].floor;
    const double size = std::fmax(std::fabs(line.w * x.w), std::fmax(std::fabs(x.x), std::fabs(x.y))), v = geometry::value_at(line, x);
    return std::fabs(v) <= 1e-12 * size ? 0 : v;
  };
  return cut_by(pieces, side, value, [&](std::uint32_t a, std::uint32_t b, double t) { return between(space, net, a, b, t); });
}

Halves cut_at_height(geometry::Space space, Net& net, const std::vector<Net::Piece>& pieces, double z, int side) {
  const auto value = [&](std::uint32_t i) {
    const double v = net.vertices[i].z - z;
    return std::fabs(v) <= 1e-12 * (std::fabs(net.vertices[i].z) + std::fabs(z)) ? 0 : v;
  };
  return cut_by(pieces, side, value, [&](std::uint32_t a, std::uint32_t b, double t) { return between(space, net, a, b, t); });
}

std::vector<mesh::Triangle> fan(const Net::Piece& piece, std::uint32_t hub) {
  std::vector<mesh::Triangle> triangles;
  const std::size_t n = piece.loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t a = piece.loop[i].vertex, b = piece.loop[(i + 1) % n].vertex;
    if (a != hub && b != hub) triangles.push_back({hub, a, b});
  }
  return triangles;
}

std::vector<mesh::Triangle> triangulate(geometry::Space space, Net& net, const Net::Piece& piece) {
  const std::vector<Net::Edge>& loop = piece.loop;
  const std::size_t n = loop.size();
  std::map<int, int> edges_of_side;
  for (const Net::Edge& edge : loop) ++edges_of_side[edge.side];
  // A triangle of the fan is flat when its edge lies on a side that the hub lies on too: the hub's sides may hold no other edges than its
  // own two.
  for (std::size_t i = 0; i < n; ++i) {
    const int before = loop[(i + n - 1) % n].side, after = loop[i].side;
    const int own = before == after ? 2 : 1;
    if (edges_of_side[before] == own && edges_of_side[after] == own) return fan(piece, loop[i].vertex);
  }
  return fan(piece, middle_of(space, net, piece));
}

}  // namespace orbc::place
