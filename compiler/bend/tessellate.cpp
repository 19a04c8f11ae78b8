// Splitting by edges (red–green refinement with free patterns): an edge that is too far from its chord gets a vertex at b = ½, and a
// triangle is divided according to which of its edges have one. All new vertices are computed in room coordinates, where an edge of a
// shared wall is the same in both copies. torn_map.h tells where the map of S² is torn.
#include "compiler/bend/tessellate.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "compiler/bend/edge_error.h"
#include "compiler/bend/refinement.h"

namespace orbc::bend {
namespace {

constexpr int kMaxHalvings = 60;  // down to the radius around an axis that counts as the axis, and then to the steps of the circle

/// The decisions of a tessellation: recorded, or replayed when they are known.
class Decisions {
 public:
  explicit Decisions(const std::vector<bool>* known) : known_(known) {}

  template <class Judge>
  bool decide(const Judge& judge) {
    if (known_) return (*known_)[next_++];
    const bool decision = judge();
    recorded_.push_back(decision);
    return decision;
  }
  [[nodiscard]] bool are_replayed() const { return known_ != nullptr; }
  /// Makes: the recorded decisions; none when they were replayed.
  [[nodiscard]] std::vector<bool> finish() {
    if (known_) ORBC_CHECK(next_, ==, known_->size());
    return std::move(recorded_);
  }

 private:
  const std::vector<bool>* known_;
  std::size_t next_ = 0;
  std::vector<bool> recorded_;
};

/// Splits one part. Invariant: decisions come in an order that the part alone determines, so that they can be replayed.
class Splitter {
 public:
  Splitter(const TornMap& map, const ScreenMetric& metric, const EdgeMesh& part, Decisions decisions, std::uint64_t max_triangles)
      : map_(map), metric_(metric), part_(part), decisions_(std::move(decisions)), refinement_(max_triangles) {}

  Tessellation run(const Uv& uv) {
    const place::PlacedMesh& mesh = *part_.mesh;
    std::vector<Corner> corners;
    corners.reserve(mesh.floor.size() + 64);
    for (std::size_t i = 0; i < mesh.floor.size(); ++i) corners.push_back(corner(mesh.floor[i], mesh.z[i], {uv[i][0], uv[i][1]}));
    refinement_.begin(std::move(corners), part_.edges);
    for (std::size_t i = 0; i < part_.edges.size(); ++i) split_edge(static_cast<std::uint32_t>(i), 0);
    for (std::size_t i = 0; i < mesh.triangles.size() && !refinement_.is_full(); ++i)
      split_face({mesh.triangles[i], part_.triangle_edges[i]}, 0);
    Tessellation result;
    result.vertices.reserve(refinement_.corners().size() - mesh.floor.size());
    for (std::size_t i = mesh.floor.size(); i < refinement_.corners().size(); ++i) {
      const Corner& c = refinement_.corners()[i];
      result.vertices.push_back({c.v, c.z, c.uv, c.image, c.axis != Axis::none});
    }
    result.triangles = refinement_.take_triangles();
    result.too_many = refinement_.is_full();
    result.max_error = max_error_;
    result.decisions = decisions_.finish();
    return result;
  }

 private:
  /// A replay on a map without axes needs no images.
  [[nodiscard]] Corner corner(const geometry::Ambient& v, double z, const std::array<double, 2>& uv) const {
    if (decisions_.are_replayed() && !map_.has_axes()) return {v, z, uv, {}, Axis::none, {0, 0, 0}, 0, 1};
    return map_.corner(v, z, uv);
  }

  void split_edge(std::uint32_t id, int depth) {
    if (refinement_.is_full()) return;
    const std::optional<Corner> middle = split_point(id, depth);
    if (!middle) return;
    const std::uint32_t first = refinement_.split_edge(id, refinement_.add_corner(*middle));
    split_edge(first, depth + 1);
    split_edge(first + 1, depth + 1);
  }

  /// Where an edge is split; nothing when it is not.
  std::optional<Corner> split_point(std::uint32_t id, int depth) {
    const Corner *a = &refinement_.corner(refinement_.edge(id).a), *b = &refinement_.corner(refinement_.edge(id).b);
    if (a->axis != Axis::none && b->axis != Axis::none) return std::nullopt;
    if (std::tie(b->v.w, b->v.x, b->v.y, b->z) < std::tie(a->v.w, a->v.x, a->v.y, a->z)) std::swap(a, b);
    if (const auto crossing = map_.axis_crossing(*a, *b)) return crossing;
    if (depth >= kMaxHalvings) return std::nullopt;
    EdgeVerdict verdict;  // stays empty in a replay
    const bool split = decisions_.decide([&] {
      verdict = judge_edge(map_, metric_, part_.color_tolerance, *a, *b);
      return verdict.split;
    });
    if (!split) {
      refinement_.edge(id).far_within_tolerance = verdict.far_within_tolerance;
      max_error_ = std::max(max_error_, verdict.error);
      return std::nullopt;
    }
    const auto bisection = map_.bisection(*a, *b);
    const Corner middle = lerp(*a, *b, bisection && decisions_.decide([&] { return verdict.at_bisector; }) ? *bisection : 0.5);
    return corner(middle.v, middle.z, middle.uv);
  }

  std::uint32_t add_edge(std::uint32_t a, std::uint32_t b, int depth) {
    const std::uint32_t id = refinement_.add_edge(a, b);
    split_edge(id, depth);
    return id;
  }

  [[nodiscard]] bool is_split(std::uint32_t edge) const { return refinement_.edge(edge).split.has_value(); }
  [[nodiscard]] std::uint32_t midpoint(std::uint32_t edge) const { return refinement_.midpoint(edge); }
  [[nodiscard]] std::uint32_t half(std::uint32_t edge, std::uint32_t end) const { return refinement_.half(edge, end); }
  [[nodiscard]] std::array<const Corner*, 3> corners_of(const Face& face) const {
    return {&refinement_.corner(face.corners[0]), &refinement_.corner(face.corners[1]), &refinement_.corner(face.corners[2])};
  }

  /// Divides a face according to which of its edges are split, and continues with the pieces.
  void split_face(const Face& face, int depth) {
    if (refinement_.is_full()) return;
    // An axis inside comes first: pieces around it would never become flat.
    const auto [a, b, c] = corners_of(face);
    if (const auto crossing = map_.axis_crossing(*a, *b, *c)) return split_at(face, refinement_.add_corner(*crossing), depth);
    switch (std::count_if(face.edges.begin(), face.edges.end(), [&](std::uint32_t e) { return is_split(e); })) {
      case 0:
        return finish_face(face, depth);
      case 1:
        return split_in_two(face, depth);
      case 2:
        return split_in_three(face, depth);
      default:
        return split_in_four(face, depth);
    }
  }

  void split_in_two(Face face, int depth) {
    while (!is_split(face.edges[0])) face = rotated(face);
    const auto& [t, e] = face;
    const std::uint32_t m = midpoint(e[0]), inner = add_edge(m, t[2], depth);
    split_face({{t[0], m, t[2]}, {half(e[0], t[0]), inner, e[2]}}, depth + 1);
    split_face({{m, t[1], t[2]}, {half(e[0], t[1]), e[1], inner}}, depth + 1);
  }

  /// Corner 1 is cut off, and the remaining quad is divided by its shorter diagonal.
  void split_in_three(Face face, int depth) {
    while (is_split(face.edges[2])) face = rotated(face);
    const auto& [t, e] = face;
    const std::uint32_t m0 = midpoint(e[0]), m1 = midpoint(e[1]), across = add_edge(m0, m1, depth);
    split_face({{m0, t[1], m1}, {half(e[0], t[1]), half(e[1], t[1]), across}}, depth + 1);
    if (refinement_.squared_distance(t[0], m1) <= refinement_.squared_distance(m0, t[2])) {
      const std::uint32_t inner = add_edge(t[0], m1, depth);
      split_face({{t[0], m0, m1}, {half(e[0], t[0]), across, inner}}, depth + 1);
      split_face({{t[0], m1, t[2]}, {inner, half(e[1], t[2]), e[2]}}, depth + 1);
    } else {
      const std::uint32_t inner = add_edge(m0, t[2], depth);
      split_face({{m0, m1, t[2]}, {across, half(e[1], t[2]), inner}}, depth + 1);
      split_face({{t[0], m0, t[2]}, {half(e[0], t[0]), inner, e[2]}}, depth + 1);
    }
  }

  void split_in_four(const Face& face, int depth) {
    const auto& [t, e] = face;
    const std::array<std::uint32_t, 3> m = {midpoint(e[0]), midpoint(e[1]), midpoint(e[2])};
    const std::array<std::uint32_t, 3> inner = {add_edge(m[0], m[1], depth), add_edge(m[1], m[2], depth), add_edge(m[2], m[0], depth)};
    for (int k = 0; k < 3; ++k) {
      const int before = (k + 2) % 3;
      split_face({{t[k], m[k], m[before]}, {half(e[k], t[k]), inner[before], half(e[before], t[k])}}, depth + 1);
    }
    split_face({m, inner}, depth + 1);
  }

  /// Divides a face into three at an inner point.
  void split_at(const Face& face, std::uint32_t point, int depth) {
    const auto& [t, e] = face;
    const std::array<std::uint32_t, 3> spokes = {add_edge(t[0], point, depth), add_edge(t[1], point, depth), add_edge(t[2], point, depth)};
    for (int k = 0; k < 3; ++k) split_face({{t[k], t[(k + 1) % 3], point}, {e[k], spokes[(k + 1) % 3], spokes[k]}}, depth + 1);
  }

  /// A face whose edges are not split becomes a triangle, unless its inside is too far from flat.
  void finish_face(const Face& face, int depth) {
    const auto [a, b, c] = corners_of(face);
    if (a->axis != Axis::none || b->axis != Axis::none || c->axis != Axis::none) return add_face_at_axis(refinement_, map_, face);
    if (depth < kMaxHalvings && decisions_.decide([&] { return exceeds_tolerance(face); })) {
      std::array<double, 2> uv{};
      for (int k = 0; k < 2; ++k) uv[k] = (a->uv[k] + b->uv[k] + c->uv[k]) / 3;
      const Corner centre = corner((1.0 / 3) * (a->v + b->v + c->v), (a->z + b->z + c->z) / 3, uv);
      return split_at(face, refinement_.add_corner(centre), depth);
    }
    refinement_.add_triangle(face.corners[0], face.corners[1], face.corners[2]);
  }

  bool exceeds_tolerance(const Face& face) {
    const auto is_fine = [&](std::uint32_t edge) { return refinement_.edge(edge).far_within_tolerance; };
    if (std::all_of(face.edges.begin(), face.edges.end(), is_fine)) return false;
    const ChordError error = triangle_error(map_, metric_, part_.color_tolerance, corners_of(face));
    if (error.tolerances > 1) return true;
    if (error.in_picture) max_error_ = std::max(max_error_, error.tolerances);
    return false;
  }

  TornMap map_;
  const ScreenMetric& metric_;
  const EdgeMesh& part_;
  Decisions decisions_;
  Refinement refinement_;
  double max_error_ = 0;
};

}  // namespace

Tessellation tessellate(const CopyMap& map, const ScreenMetric& metric, const EdgeMesh& part, const Uv& uv, std::uint64_t max_triangles) {
  return Splitter(TornMap(map, metric), metric, part, Decisions(nullptr), max_triangles).run(uv);
}

Tessellation replay_tessellation(const CopyMap& map, const ScreenMetric& metric, const EdgeMesh& part, const Uv& uv,
                                 const std::vector<bool>& decisions) {
  constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max() / 4;
  return Splitter(TornMap(map, metric), metric, part, Decisions(&decisions), kNoLimit).run(uv);
}

}  // namespace orbc::bend
