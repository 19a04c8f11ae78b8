// Distance from a point to a triangle by the regions of its Voronoi diagram: Ericson, Real-Time Collision Detection, 5.1.5.
#include "compiler/mesh/closest_point_tree.h"

#include <algorithm>
#include <cmath>

namespace orbc::mesh {
namespace {

using geometry::Vector3;

double square(const Vector3& v) { return dot(v, v); }

double square_distance_to_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return square(ap);
  const Vector3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return square(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return square(ap - d1 / (d1 - d3) * ab);
  const Vector3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return square(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return square(ap - d2 / (d2 - d6) * ac);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return square(bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b));
  const double whole = va + vb + vc;
  return square(ap - vb / whole * ab - vc / whole * ac);
}

double square_distance_to_box(const Vector3& p, const Vector3& low, const Vector3& high) {
  const Vector3 d{std::max({low.x - p.x, 0.0, p.x - high.x}), std::max({low.y - p.y, 0.0, p.y - high.y}),
                  std::max({low.z - p.z, 0.0, p.z - high.z})};
  return square(d);
}

}  // namespace

ClosestPointTree::ClosestPointTree(const Mesh& mesh) : mesh_(mesh) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    order_.push_back(t);
    middle_.push_back(mesh.positions[v[0]] + mesh.positions[v[1]] + mesh.positions[v[2]]);
  }
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

std::uint32_t ClosestPointTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node{mesh_.positions[mesh_.triangles[order_[begin]][0]], {}, begin, end, 0, 0};
  node.high = node.low;
  for (auto i = begin; i < end; ++i) {
    for (const auto v : mesh_.triangles[order_[i]]) {
      const auto& p = mesh_.positions[v];
      node.low = {std::min(node.low.x, p.x), std::min(node.low.y, p.y), std::min(node.low.z, p.z)};
      node.high = {std::max(node.high.x, p.x), std::max(node.high.y, p.y), std::max(node.high.z, p.z)};
    }
  }
  nodes_.push_back(node);
  if (end - begin <= 4) return index;
  const Vector3 size = node.high - node.low;
  double Vector3::*axis = size.x >= size.y && size.x >= size.z ? &Vector3::x : size.y >= size.z ? &Vector3::y : &Vector3::z;
  const auto half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end, [&](std::uint32_t a, std::uint32_t b) {
    return middle_[a].*axis != middle_[b].*axis ? middle_[a].*axis < middle_[b].*axis : a < b;
  });
  const auto left = build(begin, half), right = build(half, end);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

double ClosestPointTree::distance(const Vector3& p, double upper_bound, double good_enough) const {
  double best_square = upper_bound * upper_bound;
  if (!nodes_.empty()) search(0, p, best_square, good_enough * good_enough);
  return std::sqrt(best_square);
}

void ClosestPointTree::search(std::uint32_t index, const Vector3& p, double& best_square, double good_enough_square) const {
  const auto& node = nodes_[index];
  if (node.left == 0) {
    for (auto i = node.begin; i < node.end; ++i) {
      const auto& t = mesh_.triangles[order_[i]];
      best_square =
          std::min(best_square, square_distance_to_triangle(p, mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]));
    }
    return;
  }
  const auto &left = nodes_[node.left], &right = nodes_[node.right];
  const double l = square_distance_to_box(p, left.low, left.high), r = square_distance_to_box(p, right.low, right.high);
  const bool left_first = l <= r;
  if (std::min(l, r) < best_square) search(left_first ? node.left : node.right, p, best_square, good_enough_square);
  if (std::max(l, r) < best_square && best_square > good_enough_square)
    search(left_first ? node.right : node.left, p, best_square, good_enough_square);
}

}  // namespace orbc::mesh
