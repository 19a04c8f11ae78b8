#include "compiler/bend/refinement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"

namespace orbc::bend {
namespace {

constexpr double kSameVertex = 1e-12;  // eye coordinates

bool is_on_axis(const Refinement& refinement, std::uint32_t corner) { return refinement.corner(corner).axis != Axis::none; }

/// The vertex on the circle at the end of an edge from corner `from` to the corner `end` on the axis.
std::uint32_t circle_vertex(Refinement& refinement, const TornMap& map, std::uint32_t edge, std::uint32_t from, std::uint32_t end) {
  if (const auto known = refinement.circle_vertex(edge)) return *known;
  Corner c = refinement.corner(end);
  c.image = map.image_towards(c, refinement.corner(from));
  const std::uint32_t vertex = refinement.add_corner(c);
  refinement.set_circle_vertex(edge, vertex);
  return vertex;
}

/// Joins corner `a` to the polygon of the circle, from the vertex `from` to the vertex `to`. In: `end`, the corner on the axis, and the
/// directions of both vertices in radians.
void add_fan(Refinement& refinement, const TornMap& map, std::uint32_t a, std::uint32_t end, const std::array<std::uint32_t, 2>& vertices,
             const std::array<double, 2>& directions) {
  const double turn = std::remainder(directions[1] - directions[0], 2 * std::numbers::pi), step = map.circle_step();
  const double low = std::min(directions[0], directions[0] + turn), high = std::max(directions[0], directions[0] + turn);
  const auto first = static_cast<long>(std::floor(low / step)) + 1, last = static_cast<long>(std::ceil(high / step));
  std::uint32_t before = vertices[0];
  for (long i = 0; i < last - first; ++i) {
    const double angle = static_cast<double>(turn > 0 ? first + i : last - 1 - i) * step;
    const std::uint32_t next = refinement.add_corner(map.on_circle(refinement.corner(end), angle));
    refinement.add_triangle(a, before, next);
    before = next;
  }
  if (vertices[1] != before) refinement.add_triangle(a, before, vertices[1]);
}

double direction_of(const Corner& corner) { return math::atan2(corner.image.y, corner.image.x); }

}  // namespace

Face rotated(const Face& face) {
  const auto &c = face.corners, &e = face.edges;
  return {{c[1], c[2], c[0]}, {e[1], e[2], e[0]}};
}

void Refinement::begin(std::vector<Corner> corners, const std::vector<std::array<std::uint32_t, 2>>& edges) {
  corners_ = std::move(corners);
  edges_.reserve(edges.size() + 64);
  for (const auto& [a, b] : edges) add_edge(a, b);
}

std::uint32_t Refinement::add_corner(const Corner& corner) {
  corners_.push_back(corner);
  is_full_ |= corners_.size() > 2 * max_triangles_ + 1000;
  return static_cast<std::uint32_t>(corners_.size() - 1);
}

std::uint32_t Refinement::add_edge(std::uint32_t a, std::uint32_t b) {
  edges_.push_back({a, b, {}, false});
  return static_cast<std::uint32_t>(edges_.size() - 1);
}

std::uint32_t Refinement::split_edge(std::uint32_t edge, std::uint32_t midpoint) {
  const std::uint32_t first = add_edge(edges_[edge].a, midpoint);
  add_edge(midpoint, edges_[edge].b);
  edges_[edge].split = {midpoint, first};
  return first;
}

void Refinement::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  triangles_.push_back({a, b, c});
  is_full_ |= triangles_.size() > max_triangles_;
}

std::optional<std::uint32_t> Refinement::circle_vertex(std::uint32_t edge) const {
  const auto known = circle_vertices_.find(edge);
  if (known == circle_vertices_.end()) return std::nullopt;
  return known->second;
}

std::uint32_t Refinement::half(std::uint32_t edge, std::uint32_t end) const {
  return edges_[edge].split->first_half + (edges_[edge].a == end ? 0 : 1);
}

double Refinement::squared_distance(std::uint32_t a, std::uint32_t b) const {
  const geometry::Ambient d = corners_[a].v - corners_[b].v;
  const double dz = corners_[a].z - corners_[b].z;
  return d.w * d.w + d.x * d.x + d.y * d.y + dz * dz;
}

void add_face_at_axis(Refinement& refinement, const TornMap& map, const Face& given) {
  Face face = given;
  const auto on_axis = std::count_if(face.corners.begin(), face.corners.end(), [&](std::uint32_t c) { return is_on_axis(refinement, c); });
  if (on_axis == 3) return;  // a piece of the axis itself
  if (on_axis == 2) {
    while (is_on_axis(refinement, face.corners[0])) face = rotated(face);
    const auto& [a, p, q] = face.corners;
    const std::uint32_t first = circle_vertex(refinement, map, face.edges[0], a, p);
    const std::uint32_t second = circle_vertex(refinement, map, face.edges[2], a, q);
    return refinement.add_triangle(a, first, second);
  }
  while (!is_on_axis(refinement, face.corners[2])) face = rotated(face);
  const auto& [a, b, end] = face.corners;
  const std::uint32_t b_end = circle_vertex(refinement, map, face.edges[1], b, end);
  if (!refinement.circle_vertex(face.edges[2])) {
    // Of an upright face, or nearly, both edges end in one vertex.
    const auto off = map.image_towards(refinement.corner(end), refinement.corner(a)) - refinement.corner(b_end).image;
    if (length(off) < kSameVertex) refinement.set_circle_vertex(face.edges[2], b_end);
  }
  const std::uint32_t a_end = circle_vertex(refinement, map, face.edges[2], a, end);
  refinement.add_triangle(a, b, b_end);
  if (a_end == b_end) return;
  add_fan(refinement, map, a, end, {b_end, a_end}, {direction_of(refinement.corner(b)), direction_of(refinement.corner(a))});
}

}  // namespace orbc::bend
