// Volume and centroids: divergence theorem over tetrahedra to the middle of the bounding box (Zhang & Chen 2001).
// Crossings: a bounding volume hierarchy against itself, leaves compared edge by edge; of CGAL only parts under the GPL could do it.
#include "compiler/mesh/analyse.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compiler/mesh/weld.h"

namespace orbc::mesh {
namespace {

using geometry::Vector3;

struct EdgeUse {
  std::uint32_t low, high;
  bool forward;
};

void classify_edges(const Mesh& mesh, const std::vector<std::uint32_t>& weld, MeshReport& found) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  std::size_t vertices = 0, faces = 0, edges = 0;
  std::vector<char> used(mesh.positions.size(), 0);
  for (const auto& t : mesh.triangles) {
    const std::array<std::uint32_t, 3> v{weld[t[0]], weld[t[1]], weld[t[2]]};
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
    ++faces;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = v[k], b = v[(k + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), a < b});
      vertices += !used[a];
      used[a] = 1;
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  const auto middle = [&](const EdgeUse& e) { return 0.5 * (mesh.positions[e.low] + mesh.positions[e.high]); };
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t end = i, forward = 0;
    while (end < uses.size() && uses[end].low == uses[i].low && uses[end].high == uses[i].high) forward += uses[end++].forward;
    const auto count = end - i;
    if (count == 1 && found.open_edges++ == 0) found.open_at = middle(uses[i]);
    if (count == 2 && forward != 1 && found.inconsistent_edges++ == 0) found.inconsistent_at = middle(uses[i]);
    if (count > 2 && found.non_manifold_edges++ == 0) found.non_manifold_at = middle(uses[i]);
    ++edges;
    i = end;
  }
  found.closed = faces > 0 && found.open_edges + found.non_manifold_edges + found.inconsistent_edges == 0;
  found.euler = static_cast<int>(static_cast<std::int64_t>(vertices) - static_cast<std::int64_t>(edges) + static_cast<std::int64_t>(faces));
}

void measure(const Mesh& mesh, MeshReport& found) {
  const double inf = std::numeric_limits<double>::infinity();
  found.lowest = {inf, inf, inf};
  found.highest = {-inf, -inf, -inf};
  Vector3 vertex_sum;
  for (const auto& t : mesh.triangles) {
    for (const auto v : t) {
      const auto& p = mesh.positions[v];
      found.lowest = {std::min(found.lowest.x, p.x), std::min(found.lowest.y, p.y), std::min(found.lowest.z, p.z)};
      found.highest = {std::max(found.highest.x, p.x), std::max(found.highest.y, p.y), std::max(found.highest.z, p.z)};
      vertex_sum = vertex_sum + p;
    }
  }
  if (mesh.triangles.empty()) {
    found.lowest = found.highest = {};
    return;
  }
  const Vector3 middle = 0.5 * (found.lowest + found.highest);
  const double size = length(found.highest - found.lowest);
  Vector3 volume_moment, area_moment;
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.positions[t[0]] - middle, b = mesh.positions[t[1]] - middle, c = mesh.positions[t[2]] - middle;
    const double six = dot(a, cross(b, c)), area = length(cross(b - a, c - a)) / 2;
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    // Without area: the height is lost in the rounding of the coordinates.
    if (!(area > longest * size * 1e-15) && found.degenerate++ == 0) found.degenerate_at = mesh.positions[t[0]];
    volume += six / 6;
    volume_moment = volume_moment + six / 24 * (a + b + c);
    found.area += area;
    area_moment = area_moment + area / 3 * (a + b + c);
  }
  if (found.closed) found.volume = volume;
  found.inside_out = found.closed && volume < 0;
  if (found.closed && std::abs(volume) > 1e-9 * found.area * size) found.centroid = middle + 1 / volume * volume_moment;
  else if (found.area > 0) found.centroid = middle + 1 / found.area * area_moment;
  else found.centroid = 1.0 / (3.0 * static_cast<double>(mesh.triangles.size())) * vertex_sum;
}

// ---- crossings ------------------------------------------------------------------------------------------------------------------

struct Box {
  Vector3 low, high;
};

bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y && a.low.z <= b.high.z &&
         b.low.z <= a.high.z;
}
Box joined(const Box& a, const Box& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

/// A complete binary tree over triangles in Morton-like order: node i has children 2i+1 and 2i+2.
class CrossingSearch {
 public:
  CrossingSearch(const Mesh& mesh, const std::vector<std::uint32_t>& weld, const AnalyseOptions& options)
      : mesh_(mesh), weld_(weld), options_(options) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& v = mesh.triangles[t];
      const Box a{point(v[0]), point(v[0])}, b{point(v[1]), point(v[1])}, c{point(v[2]), point(v[2])};
      boxes_.push_back(joined(joined(a, b), c));
      order_.push_back(t);
    }
    build(0, order_.size());
  }

  void run(MeshReport& found) {
    if (!nodes_.empty()) compare_within(0, found);
    found.crossings_known = tests_ <= options_.max_pair_tests;
  }

 private:
  struct Node {
    Box box;
    std::uint32_t begin, end;           // into order_
    std::uint32_t left = 0, right = 0;  // 0: a leaf
  };
  const Vector3& point(std::uint32_t v) const { return mesh_.positions[v]; }

  std::uint32_t build(std::size_t begin, std::size_t end) {
    if (begin == end) return 0;
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({boxes_[order_[begin]], static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
    Box box = boxes_[order_[begin]];
    for (std::size_t i = begin; i < end; ++i) box = joined(box, boxes_[order_[i]]);
    nodes_[index].box = box;
    if (end - begin <= 4) return index;
    const Vector3 size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto key = [&](std::uint32_t t) {
      const Vector3 twice = boxes_[t].low + boxes_[t].high;
      return axis == 0 ? twice.x : axis == 1 ? twice.y : twice.z;
    };
    const auto middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
      const double ka = key(a), kb = key(b);
      return ka != kb ? ka < kb : a < b;
    });
    const auto left = build(begin, middle), right = build(middle, end);
    nodes_[index].left = left;
    nodes_[index].right = right;
    return index;
  }

  bool is_finished(const MeshReport& found) const { return found.crossings >= options_.max_crossings || tests_ > options_.max_pair_tests; }

  void compare_within(std::uint32_t n, MeshReport& found) {
    if (is_finished(found)) return;
    const auto node = nodes_[n];
    if (node.left == 0) {
      for (auto i = node.begin; i < node.end; ++i) {
        for (auto j = i + 1; j < node.end; ++j) compare(order_[i], order_[j], found);
      }
      return;
    }
    compare_within(node.left, found);
    compare_within(node.right, found);
    compare_between(node.left, node.right, found);
  }
  void compare_between(std::uint32_t a, std::uint32_t b, MeshReport& found) {
    ++tests_;
    if (is_finished(found) || !overlap(nodes_[a].box, nodes_[b].box)) return;
    const auto &na = nodes_[a], &nb = nodes_[b];
    if (na.left == 0 && nb.left == 0) {
      for (auto i = na.begin; i < na.end; ++i) {
        for (auto j = nb.begin; j < nb.end; ++j) compare(order_[i], order_[j], found);
      }
    } else if (nb.left == 0 || (na.left != 0 && na.end - na.begin >= nb.end - nb.begin)) {
      compare_between(na.left, b, found);
      compare_between(na.right, b, found);
    } else {
      compare_between(a, nb.left, found);
      compare_between(a, nb.right, found);
    }
  }

  void compare(std::uint32_t s, std::uint32_t t, MeshReport& found) {
    ++tests_;
    if (!overlap(boxes_[s], boxes_[t])) return;
    const auto &a = mesh_.triangles[s], &b = mesh_.triangles[t];
    for (const auto i : a) {
      for (const auto j : b) {
        if (weld_[i] == weld_[j]) return;
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (pierces(a[k], a[(k + 1) % 3], b) || pierces(b[k], b[(k + 1) % 3], a)) {
        if (found.crossings++ == 0) found.crossing_at = 0.5 * (point(a[0]) + point(b[0]));
        return;
      }
    }
  }
  /// Whether the segment goes through the inside of the triangle; touching does not count.
  bool pierces(std::uint32_t p, std::uint32_t q, const Triangle& t) const {
    const auto &a = point(t[0]), &b = point(t[1]), &c = point(t[2]), &o = point(p);
    const Vector3 d = point(q) - o, n = cross(b - a, c - a);
    const double above = dot(o - a, n), below = dot(point(q) - a, n);
    if (!(above * below < 0)) return false;
    const double x = dot(d, cross(a - o, b - o)), y = dot(d, cross(b - o, c - o)), z = dot(d, cross(c - o, a - o));
    return (x > 0 && y > 0 && z > 0) || (x < 0 && y < 0 && z < 0);
  }

  const Mesh& mesh_;
  const std::vector<std::uint32_t>& weld_;
  const AnalyseOptions& options_;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  std::uint64_t tests_ = 0;
};

std::string at(const Vector3& p) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x, p.y, p.z); }

}  // namespace

MeshReport analyse(const Mesh& mesh, const AnalyseOptions& options) {
  MeshReport found;
  const auto weld = weld_positions(mesh.positions);
  classify_edges(mesh, weld, found);
  measure(mesh, found);
  if (options.crossings) CrossingSearch(mesh, weld, options).run(found);
  return found;
}

Diagnostics report_warnings(const MeshReport& e, const std::string& name) {
  Diagnostics out;
  if (e.inside_out) {
    out.push_back(make_warning("mesh.inside-out", fmt::format("{}: is inside out (its signed volume is {:.4g})", name, e.volume),
                               "turn its normals around in the program that made it"));
  }
  if (e.inconsistent_edges > 0) {
    out.push_back(make_warning("mesh.turned-triangles",
                               fmt::format("{}: at {} edges the two triangles disagree which side is outside, one near {}", name,
                                           e.inconsistent_edges, at(e.inconsistent_at)),
                               "make the normals consistent in the program that made it"));
  }
  // What follows is drawn as it is, and looks right.
  if (e.non_manifold_edges > 0)
    out.push_back(make_note("mesh.not-manifold", fmt::format("{}: {} edges have three or more triangles, one near {}", name,
                                                             e.non_manifold_edges, at(e.non_manifold_at))));
  if (e.degenerate > 0)
    out.push_back(make_note("mesh.degenerate-triangles", fmt::format("{}: {} triangles have no area", name, e.degenerate)));
  if (e.crossings > 0)
    out.push_back(make_note("mesh.self-intersections", fmt::format("{}: {}{} pairs of triangles cross, one near {}", name,
                                                                   e.crossings_known ? "" : "at least ", e.crossings, at(e.crossing_at))));
  if (e.open_edges > 0)
    out.push_back(
        make_note("mesh.open", fmt::format("{}: is open ({} border edges), so it is centred by its surface", name, e.open_edges)));
  return out;
}

Mesh flip_orientation(Mesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace orbc::mesh
