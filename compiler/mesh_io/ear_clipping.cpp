// Ear clipping (Meisters, Polygons have ears, 1975). A corner is an ear when no reflex corner lies in its triangle; reflex corners are
// found in a tree of boxes. Clipping only turns reflex corners into convex ones, so the tree is built once.
#include "compiler/mesh_io/ear_clipping.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

namespace orbc::mesh_io {
namespace {

double orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// A box around some points.
struct Box {
  PlanePoint low, high;
};

/// Whether a box has points on the inner side of the line from a to b, to its left, or on the line.
bool reaches_left_of(const Box& box, const PlanePoint& a, const PlanePoint& b) {
  // The corner of the box that lies farthest to the left.
  const PlanePoint corner{b[1] < a[1] ? box.high[0] : box.low[0], b[0] > a[0] ? box.high[1] : box.low[1]};
  return orientation(a, b, corner) >= 0;
}

/// A balanced tree of boxes over the reflex corners. Node i has the children 2i + 1 and 2i + 2.
class CornerTree {
 public:
  CornerTree(const std::vector<PlanePoint>& ring, std::vector<std::uint32_t> corners) : corners_(std::move(corners)), place_(ring.size()) {
    if (corners_.empty()) return;
    build(ring, 0, 0, corners_.size(), 0);
    for (std::size_t i = 0; i < corners_.size(); ++i) place_[corners_[i]] = i;
  }

  /// Takes out a corner that has become convex.
  void remove(std::uint32_t corner) {
    const std::size_t place = place_[corner];
    std::size_t node = 0, first = 0, last = corners_.size();
    for (;;) {
      --nodes_[node].count;
      if (last - first <= kLeaf) return;
      const std::size_t middle = (first + last) / 2;
      node = 2 * node + (place < middle ? 1 : 2);
      (place < middle ? last : first) = middle;
    }
  }

  /// The first corner of those that may lie in the triangle for which `blocks` holds.
  template <class Blocks>
  std::optional<std::uint32_t> find(const std::array<PlanePoint, 3>& triangle, const Blocks& blocks, std::int64_t& steps) const {
    if (corners_.empty()) return std::nullopt;
    return find(0, 0, corners_.size(), triangle, blocks, steps);
  }

 private:
  static constexpr std::size_t kLeaf = 4;  ///< most corners of a node without children
  struct Node {
    Box box;
    std::uint32_t count = 0;  ///< of corners that were not taken out
  };

  void build(const std::vector<PlanePoint>& ring, std::size_t node, std::size_t first, std::size_t last, std::size_t axis) {
    if (nodes_.size() <= node) nodes_.resize(node + 1);
    Box box{ring[corners_[first]], ring[corners_[first]]};
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        box.low[k] = std::min(box.low[k], ring[corners_[i]][k]);
        box.high[k] = std::max(box.high[k], ring[corners_[i]][k]);
      }
    nodes_[node] = {box, static_cast<std::uint32_t>(last - first)};
    if (last - first <= kLeaf) return;
    const std::size_t middle = (first + last) / 2;
    const auto at = [&](std::size_t i) { return corners_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
      return ring[a][axis] != ring[b][axis] ? ring[a][axis] < ring[b][axis] : a < b;
    });
    build(ring, 2 * node + 1, first, middle, 1 - axis);
    build(ring, 2 * node + 2, middle, last, 1 - axis);
  }

  template <class Blocks>
  std::optional<std::uint32_t> find(std::size_t node, std::size_t first, std::size_t last, const std::array<PlanePoint, 3>& triangle,
                                    const Blocks& blocks, std::int64_t& steps) const {
    --steps;
    if (nodes_[node].count == 0) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i)
      if (!reaches_left_of(nodes_[node].box, triangle[i], triangle[(i + 1) % 3])) return std::nullopt;
    for (std::size_t k = 0; k < 2; ++k) {
      if (nodes_[node].box.low[k] > std::max({triangle[0][k], triangle[1][k], triangle[2][k]})) return std::nullopt;
      if (nodes_[node].box.high[k] < std::min({triangle[0][k], triangle[1][k], triangle[2][k]})) return std::nullopt;
    }
    if (last - first <= kLeaf) {
      for (std::size_t i = first; i < last; ++i)
        if (blocks(corners_[i])) return corners_[i];
      return std::nullopt;
    }
    const std::size_t middle = (first + last) / 2;
    if (const auto found = find(2 * node + 1, first, middle, triangle, blocks, steps)) return found;
    return find(2 * node + 2, middle, last, triangle, blocks, steps);
  }

  std::vector<std::uint32_t> corners_;  // in the order of the tree's leaves
  std::vector<std::size_t> place_;      // of a corner in that order
  std::vector<Node> nodes_;
};

/// What keeps a corner from being an ear.
enum class Blocking {
  touching,  ///< reflex corners in the triangle or on its border, unless they coincide with one of its corners
  inside,    ///< reflex corners strictly inside
  none,      ///< nothing: every convex corner is cut
};

struct Clipper {
  const std::vector<PlanePoint>& ring;
  std::vector<std::uint32_t> next, previous;
  std::vector<bool> reflex;
  CornerTree tree;

  double turn_at(std::uint32_t i) const { return orientation(ring[previous[i]], ring[i], ring[next[i]]); }

  bool blocks(std::uint32_t i, const std::array<PlanePoint, 3>& t, Blocking blocking) const {
    const PlanePoint& p = ring[i];
    if (!reflex[i] || p == t[0] || p == t[1] || p == t[2]) return false;
    const double ab = orientation(t[0], t[1], p), bc = orientation(t[1], t[2], p), ca = orientation(t[2], t[0], p);
    return blocking == Blocking::touching ? ab >= 0 && bc >= 0 && ca >= 0 : ab > 0 && bc > 0 && ca > 0;
  }

  /// The first corner that keeps `b` from being an ear, `b` itself where it is not convex, or nothing.
  std::optional<std::uint32_t> find_blocker(std::uint32_t b, Blocking blocking, std::int64_t& steps) const {
    --steps;
    const std::array<PlanePoint, 3> t{ring[previous[b]], ring[b], ring[next[b]]};
    const double turn = orientation(t[0], t[1], t[2]);
    const bool degenerate = turn == 0 && (t[0] == t[1] || t[1] == t[2]);
    if (degenerate || (turn >= 0 && blocking == Blocking::none)) return std::nullopt;
    if (turn < 0 || (turn == 0 && blocking == Blocking::touching)) return b;
    return tree.find(
        t, [&](std::uint32_t i) { return blocks(i, t, blocking); }, steps);
  }
};

Clipper make_clipper(const std::vector<PlanePoint>& ring) {
  const auto n = static_cast<std::uint32_t>(ring.size());
  std::vector<std::uint32_t> next(n), previous(n), reflex_corners;
  std::vector<bool> reflex(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    next[i] = (i + 1) % n;
    previous[i] = (i + n - 1) % n;
    reflex[i] = orientation(ring[previous[i]], ring[i], ring[next[i]]) <= 0;
    if (reflex[i]) reflex_corners.push_back(i);
  }
  return {ring, std::move(next), std::move(previous), std::move(reflex), CornerTree(ring, std::move(reflex_corners))};
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> clip_ears(const std::vector<PlanePoint>& ring, std::int64_t& steps) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Clipper clipper = make_clipper(ring);
  std::vector<bool> is_cut(ring.size(), false);
  std::vector<std::vector<std::uint32_t>> blocked_by(ring.size());  // corners to test again when this one blocks no more
  std::deque<std::uint32_t> candidates;
  std::vector<bool> is_candidate(ring.size(), false);
  const auto add_candidate = [&](std::uint32_t corner) {
    if (is_candidate[corner]) return;
    is_candidate[corner] = true;
    candidates.push_back(corner);
  };
  for (std::uint32_t i = 0; i < ring.size(); ++i) add_candidate(i);
  const auto stop_blocking = [&](std::uint32_t corner) {
    clipper.reflex[corner] = false;
    clipper.tree.remove(corner);
    for (const std::uint32_t blocked : blocked_by[corner]) add_candidate(blocked);
    blocked_by[corner].clear();
  };
  std::size_t left = ring.size();
  std::uint32_t any = 0;  // a corner that is not cut
  Blocking blocking = Blocking::touching;
  while (left > 3 && steps > 0) {
    if (candidates.empty()) {  // no ear is left
      if (blocking == Blocking::none) break;
      blocking = blocking == Blocking::touching ? Blocking::inside : Blocking::none;
      for (std::uint32_t i = clipper.next[any];; i = clipper.next[i]) {
        add_candidate(i);
        if (i == any) break;
      }
    }
    const std::uint32_t at = candidates.front();
    candidates.pop_front();
    is_candidate[at] = false;
    if (is_cut[at]) continue;
    if (const std::optional<std::uint32_t> blocker = clipper.find_blocker(at, blocking, steps)) {
      if (*blocker != at) blocked_by[*blocker].push_back(at);
      continue;
    }
    const std::uint32_t before = clipper.previous[at], after = clipper.next[at];
    triangles.push_back({before, at, after});
    clipper.next[before] = any = after;
    clipper.previous[after] = before;
    is_cut[at] = true;
    --left;
    if (clipper.reflex[at]) stop_blocking(at);
    for (const std::uint32_t neighbour : {before, after}) {
      add_candidate(neighbour);
      if (clipper.reflex[neighbour] && clipper.turn_at(neighbour) > 0) stop_blocking(neighbour);
    }
    blocking = Blocking::touching;
  }
  for (std::uint32_t i = clipper.next[any]; clipper.next[i] != any; i = clipper.next[i]) triangles.push_back({any, i, clipper.next[i]});
  return triangles;
}

}  // namespace orbc::mesh_io
