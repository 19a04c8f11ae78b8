// Splitting by edges (red-green refinement with free patterns): an edge that is too far from its chord gets a vertex at b = ½; a triangle
// is cut by which of its edges have one. All new vertices are computed in room coordinates, where an edge of a shared wall is the same in
// both copies.
//
// S²: the log map tears the sphere at the antipode of the eye's foot, from sheet 1 on also at the foot itself. What comes closer than
// kSingular to such an axis is put on it. An edge that crosses an axis is split there; a triangle around an axis is split there into three;
// a corner on an axis has no image but a direction for every neighbour: cone (A, B, axis) becomes the quad A B B' A' with A'B' on the
// circle, drawn as a regular polygon that is the same for all parts and for both sheets that meet there.
#include "compiler/bend/tessellate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "compiler/base/elementary.h"

namespace orbc::bend {
namespace {

using geometry::Ambient;
using geometry::Space;
using geometry::Vector3;

constexpr double kSingular = 1e-9;  // radians; directions as seen from the axis are good to 1e-7 here
constexpr int kMaxHalvings = 60;        // halvings: down to kSingular and then the circle's steps
constexpr double kDiskRing = 100;   // View::disk: where the plane ends, the image of the antipode

enum class Axis : std::uint8_t { none, foot, antipode };

struct Corner {
  Ambient v;
  double z = 0;
  std::array<double, 2> uv{};
  Vector3 at;
  Axis axis = Axis::none;
  Ambient seen;         ///< eye_from_copy · v
  double distance = 0;  ///< from the eye's foot, on the floor
  double norm = 1;      ///< of v; 1 on the surface
};

struct Edge {
  std::uint32_t a = 0, b = 0;
  std::int32_t mid = -1, first = -1;  ///< children: first joins a and mid, first + 1 joins mid and b
  std::int32_t ring = -1;             ///< the vertex on the circle when one end lies on an axis
  bool tame = false;                  ///< far within the tolerance by distances alone; so is a triangle with three such edges
};

class Splitter {
 public:
  /// `known`: what was decided when this part was split before; null: all is judged.
  Splitter(const CopyMap& map, const Sight& sight, const PartNet& net, const Uv& uv, std::uint64_t most, const std::vector<bool>* known)
      : map_(map),
        sight_(sight),
        net_(net),
        uv_(uv),
        most_(most),
        known_(known),
        densest_(map.view == View::eye ? densest(sight) : 1) {
    double radius = 0;
    for (const Axis axis : {Axis::foot, Axis::antipode}) radius = std::max(radius, circle(axis));
    // Steps of the circle: its chords are judged like any other, at its own distance.
    const double share = map.view == View::disk ? radius / std::max(1.0, radius) / sight.tolerance : densest_ / sight.tolerance;
    steps_ = 8;
    while (steps_ < 65536 && share * (1 - math::cos(std::numbers::pi / steps_)) > 0.5) steps_ *= 2;
  }

  Tessellation run() {
    const auto& mesh = *net_.mesh;
    const std::size_t count = mesh.floor.size();
    corners_.reserve(count + 64);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& uv = uv_[i];
      corners_.push_back(corner(mesh.floor[i], mesh.z[i], {uv[0], uv[1]}));
    }
    edges_.reserve(net_.edges.size() + 64);
    for (const auto& [a, b] : net_.edges) edges_.push_back({a, b});
    for (std::size_t i = 0; i < net_.edges.size(); ++i) resolve(static_cast<std::uint32_t>(i), 0);
    for (std::size_t i = 0; i < mesh.triangles.size() && !out_.too_many; ++i) split(mesh.triangles[i], net_.triangle_edges[i], 0);
    out_.vertices.reserve(corners_.size() - count);
    for (std::size_t i = count; i < corners_.size(); ++i) {
      const Corner& c = corners_[i];
      out_.vertices.push_back({c.v, c.z, c.uv, c.at, c.axis != Axis::none});
    }
    if (known_ != nullptr) ORBC_CHECK(next_, ==, known_->size());
    return std::move(out_);
  }

 private:
  using Three = std::array<std::uint32_t, 3>;

  /// Radius of the circle that is the image of an axis; 0 where the map is not torn.
  [[nodiscard]] double circle(Axis axis) const {
    if (map_.log.space != Space::spherical || axis == Axis::none) return 0;
    if (map_.view == View::disk) return axis == Axis::antipode ? kDiskRing : 0;
    const int half_turns = axis == Axis::antipode ? map_.log.sheet | 1 : (map_.log.sheet + 1) & ~1;
    return axis == Axis::foot && map_.log.sheet == 0 ? 0 : half_turns * std::numbers::pi;
  }

  [[nodiscard]] Axis axis_of(const Ambient& p) const {
    if (map_.log.space != Space::spherical) return Axis::none;
    if (math::hypot(p.x, p.y) > kSingular * std::fabs(p.w)) return Axis::none;
    const Axis axis = p.w < 0 ? Axis::antipode : Axis::foot;
    return circle(axis) > 0 ? axis : Axis::none;
  }

  [[nodiscard]] Corner corner(const Ambient& v, double z, std::array<double, 2> uv) const {
    Corner c{v, z, uv, {}, Axis::none, {0, 0, 0}, 0, 1};
    if (known_ != nullptr && map_.log.space != Space::spherical) return c;  // no more is asked of it
    c.seen = map_.log.eye_from_copy * v;
    c.axis = axis_of(c.seen);
    c.at = c.axis == Axis::none ? image_of(map_, v, z) : Vector3{circle(c.axis), 0, z};
    c.norm = std::sqrt(std::fabs(v.w * v.w + geometry::curvature(map_.log.space) * (v.x * v.x + v.y * v.y)));
    // The log map keeps distances, up to the half turns of the sheet.
    c.distance = std::sqrt(c.at.x * c.at.x + c.at.y * c.at.y);
    const int turns = map_.log.sheet;
    if (turns > 0) c.distance = turns % 2 == 1 ? (turns + 1) * std::numbers::pi - c.distance : c.distance - turns * std::numbers::pi;
    return c;
  }

  /// Where a corner lies as a neighbour of `from`: a corner on an axis is on the circle, in the direction of the neighbour.
  [[nodiscard]] Vector3 seen_with(const Corner& c, const Corner& from) const {
    if (c.axis == Axis::none) return c.at;
    const double rho = math::hypot(from.at.x, from.at.y), phi = math::atan2(from.at.y, from.at.x);
    if (rho == 0) return c.at;
    const double step = 2 * std::numbers::pi / steps_, middle = (std::floor(phi / step) + 0.5) * step;
    const double radius = circle(c.axis) * math::cos(step / 2) / math::cos(phi - middle);
    return {radius * from.at.x / rho, radius * from.at.y / rho, c.z};
  }

  [[nodiscard]] static Corner mixed(const Corner& a, const Corner& b, double t) {
    Corner c;
    c.v = (1 - t) * a.v + t * b.v;
    c.z = (1 - t) * a.z + t * b.z;
    c.uv = {(1 - t) * a.uv[0] + t * b.uv[0], (1 - t) * a.uv[1] + t * b.uv[1]};
    return c;
  }

  /// Where (as parameter) the edge crosses an axis at which the map is torn; negative: it does not.
  [[nodiscard]] double crossing(const Corner& a, const Corner& b) const {
    if (map_.log.space != Space::spherical || a.axis != Axis::none || b.axis != Axis::none) return -1;
    const Ambient &p = a.seen, &q = b.seen;
    if (p.x * q.x + p.y * q.y >= 0) return -1;
    const double nw = p.x * q.y - p.y * q.x, nx = p.y * q.w - p.w * q.y, ny = p.w * q.x - p.x * q.w;
    if (std::fabs(nw) > kSingular * std::sqrt(nw * nw + nx * nx + ny * ny)) return -1;
    const double pr = math::hypot(p.x, p.y), qr = math::hypot(q.x, q.y), t = pr / (pr + qr);
    return circle((1 - t) * p.w + t * q.w < 0 ? Axis::antipode : Axis::foot) > 0 ? t : -1;
  }

  void resolve(std::uint32_t id, int depth) {
    if (out_.too_many) return;
    Corner a = corners_[edges_[id].a], b = corners_[edges_[id].b];
    if (a.axis != Axis::none && b.axis != Axis::none) return;
    const bool turned = std::tie(b.v.w, b.v.x, b.v.y, b.z) < std::tie(a.v.w, a.v.x, a.v.y, a.z);
    if (turned) std::swap(a, b);
    double t = crossing(a, b);
    Corner mid;
    if (t >= 0) {
      mid = mixed(a, b, t);
      mid.seen = map_.log.eye_from_copy * mid.v;
      mid.axis = mid.seen.w < 0 ? Axis::antipode : Axis::foot;
      mid.at = {circle(mid.axis), 0, mid.z};
    } else {
      if (depth >= kMaxHalvings) return;
      bool at_bisector = false;
      if (!decided([&] { return is_split(id, a, b, at_bisector); })) return;
      const double bisector = bisection(a, b);
      mid = mixed(a, b, bisector > 0 && decided([&] { return at_bisector; }) ? bisector : 0.5);
      const Corner placed = corner(mid.v, mid.z, mid.uv);
      mid = placed;
    }
    const auto vertex = add(mid);
    const auto first = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back({edges_[id].a, vertex});
    edges_.push_back({vertex, edges_[id].b});
    edges_[id].mid = static_cast<std::int32_t>(vertex);
    edges_[id].first = static_cast<std::int32_t>(first);
    resolve(first, depth + 1);
    resolve(first + 1, depth + 1);
  }

  /// What `judge` says, or what it said when this was split before.
  template <typename Judge>
  bool decided(const Judge& judge) {
    if (known_ != nullptr) return (*known_)[next_++];
    const bool is = judge();
    out_.decisions.push_back(is);
    return is;
  }

  /// Whether an edge is too far from its chord, and then whether most where it is seen halfway around an axis.
  bool is_split(std::uint32_t id, const Corner& a, const Corner& b, bool& at_bisector) {
    const double bound = quick_bound(a, b);
    if (bound <= 0.5) {
      out_.worst = std::max(out_.worst, bound);
      edges_[id].tame = true;
      return false;
    }
    const Ambient d = a.v - b.v;
    const int samples = d.w * d.w + d.x * d.x + d.y * d.y > 0.9 ? 7 : 3;
    const Judgement judgement = judge(a, b, samples, bisection(a, b));
    if (!(judgement.share > 1)) {
      if (judgement.in_picture) out_.worst = std::max(out_.worst, judgement.share);
      return false;
    }
    at_bisector = judgement.worst == samples;
    return true;
  }

  /// A bound of the chord's error from the two ends alone, in tolerances; half of it is enough for a triangle as well (Kℓ²/6 against
  /// Kℓ²/8).
  [[nodiscard]] double quick_bound(const Corner& a, const Corner& b) const {
    constexpr double kNoBound = 1e9;
    if (map_.view == View::disk || a.axis != Axis::none || b.axis != Axis::none) return kNoBound;
    const Ambient d = a.v - b.v;
    // Not scaled back, v may be a little short (S²); H²: the Euclidean length is the larger one.
    const double l = 1.1 * std::sqrt(d.w * d.w + d.x * d.x + d.y * d.y), l2 = l * l;
    if (l > 0.5) return kNoBound;
    const double from = std::max(0.0, (a.distance + b.distance - l) / 2), to = (a.distance + b.distance + l) / 2;
    const double k = acceleration(map_, from, to), rise = std::fabs(a.z - b.z);
    // How far the parameter runs ahead of the arc: by the curvature, and by unequal norms q: at most (√q − 1)/(√q + 1) ≤ (q − 1)/4.
    const double ahead = l2 / 50 + (std::max(a.norm, b.norm) / std::min(a.norm, b.norm) - 1) / 4;
    double off = k * l2 / 8 + ahead * rise;
    const Vector3 p = a.at - sight_.eye, q = b.at - sight_.eye;
    const double near = std::min(length(p), length(q)) - length(p - q) - off;
    if (!(near > 1e-6)) return kNoBound;
    if (net_.along > 0) off = std::max(off, (k * l2 / 8 + ahead * (rise + l)) / net_.along);
    return off / near * densest_ / sight_.tolerance;
  }

  /// Where the edge is seen from the torn axis in the middle of its ends' directions: passing an axis closely, it turns there and nowhere
  /// else. 0 when there is no torn axis to pass.
  [[nodiscard]] double bisection(const Corner& a, const Corner& b) const {
    if (map_.log.space != Space::spherical || a.axis != Axis::none || b.axis != Axis::none) return 0;
    const double p = math::hypot(a.seen.x, a.seen.y), q = math::hypot(b.seen.x, b.seen.y);
    // Rounded to 8 bits, so that neighbours choose the same point although their matrices differ in the last bit.
    int exponent = 0;
    const double digits = std::frexp(std::min(p, q) / (p + q), &exponent), share = std::ldexp(std::round(digits * 256), exponent - 8);
    return p < q ? share : 1 - share;
  }

  [[nodiscard]] Judgement judge(const Corner& a, const Corner& b, int samples, double bisector) const {
    Vector3 curve[8];
    double parameter[8];
    const int count = samples + (bisector > 0 ? 1 : 0);
    for (int i = 0; i < count; ++i) {
      parameter[i] = i == samples ? bisector : (i + 1.0) / (samples + 1);
      curve[i] = image_of(map_, (1 - parameter[i]) * a.v + parameter[i] * b.v, (1 - parameter[i]) * a.z + parameter[i] * b.z);
    }
    return judge_chord(sight_, seen_with(a, b), seen_with(b, a), curve, parameter, count, net_.along);
  }

  std::uint32_t add(const Corner& c) {
    corners_.push_back(c);
    if (corners_.size() > 2 * most_ + 1000) out_.too_many = true;
    return static_cast<std::uint32_t>(corners_.size() - 1);
  }

  std::uint32_t add_edge(std::uint32_t a, std::uint32_t b, int depth) {
    edges_.push_back({a, b});
    const auto id = static_cast<std::uint32_t>(edges_.size() - 1);
    resolve(id, depth);
    return id;
  }

  [[nodiscard]] std::uint32_t half(std::uint32_t edge, std::uint32_t end) const {
    return static_cast<std::uint32_t>(edges_[edge].first + (edges_[edge].a == end ? 0 : 1));
  }
  [[nodiscard]] std::uint32_t mid(std::uint32_t edge) const { return static_cast<std::uint32_t>(edges_[edge].mid); }

  /// Cuts a triangle by which of its edges are split, and goes on with the pieces.
  void split(Three t, Three e, int depth) {
    if (out_.too_many) return;
    // First of all: pieces around an axis would never become flat, however small.
    Corner inside;
    if (around_axis(t, inside)) return split_at(t, e, add(inside), depth);
    int cut = 0;
    for (int k = 0; k < 3; ++k) cut += edges_[e[k]].mid >= 0;
    if (cut == 0) return settle(t, e, depth);
    if (cut == 3) {
      const Three m = {mid(e[0]), mid(e[1]), mid(e[2])};
      const Three inner = {add_edge(m[0], m[1], depth), add_edge(m[1], m[2], depth), add_edge(m[2], m[0], depth)};
      for (int k = 0; k < 3; ++k) {
        const int before = (k + 2) % 3;
        split({t[k], m[k], m[before]}, {half(e[k], t[k]), inner[before], half(e[before], t[k])}, depth + 1);
      }
      return split(m, inner, depth + 1);
    }
    if (cut == 1) {
      // Turn the split edge to the front.
      while (edges_[e[0]].mid < 0) std::rotate(t.begin(), t.begin() + 1, t.end()), std::rotate(e.begin(), e.begin() + 1, e.end());
      const std::uint32_t m = mid(e[0]), inner = add_edge(m, t[2], depth);
      split({t[0], m, t[2]}, {half(e[0], t[0]), inner, e[2]}, depth + 1);
      return split({m, t[1], t[2]}, {half(e[0], t[1]), e[1], inner}, depth + 1);
    }
    // Two: turn the whole edge to the back (t[2], t[0]); corner t[1] is cut off, the quad t[0] m0 m1 t[2] halved by its shorter diagonal.
    while (edges_[e[2]].mid >= 0) std::rotate(t.begin(), t.begin() + 1, t.end()), std::rotate(e.begin(), e.begin() + 1, e.end());
    const std::uint32_t m0 = mid(e[0]), m1 = mid(e[1]), across = add_edge(m0, m1, depth);
    split({m0, t[1], m1}, {half(e[0], t[1]), half(e[1], t[1]), across}, depth + 1);
    if (room_distance(t[0], m1) <= room_distance(m0, t[2])) {
      const std::uint32_t inner = add_edge(t[0], m1, depth);
      split({t[0], m0, m1}, {half(e[0], t[0]), across, inner}, depth + 1);
      split({t[0], m1, t[2]}, {inner, half(e[1], t[2]), e[2]}, depth + 1);
    } else {
      const std::uint32_t inner = add_edge(m0, t[2], depth);
      split({m0, m1, t[2]}, {across, half(e[1], t[2]), inner}, depth + 1);
      split({t[0], m0, t[2]}, {half(e[0], t[0]), inner, e[2]}, depth + 1);
    }
  }

  [[nodiscard]] double room_distance(std::uint32_t a, std::uint32_t b) const {
    const Ambient d = corners_[a].v - corners_[b].v;
    const double dz = corners_[a].z - corners_[b].z;
    return d.w * d.w + d.x * d.x + d.y * d.y + dz * dz;
  }

  /// A triangle with whole edges: drawn, unless its inside is too far from flat.
  void settle(const Three& t, const Three& e, int depth) {
    int on_axis = 0;
    for (const std::uint32_t i : t) on_axis += corners_[i].axis != Axis::none;
    if (on_axis > 0) return draw_on_axis(t, e, on_axis);
    if (depth < kMaxHalvings) {
      if (decided([&] { return is_bent(t, e); })) {
        const Corner &a = corners_[t[0]], &b = corners_[t[1]], &c = corners_[t[2]];
        std::array<double, 2> uv{};
        for (int k = 0; k < 2; ++k) uv[k] = (a.uv[k] + b.uv[k] + c.uv[k]) / 3;
        return split_at(t, e, add(corner((1.0 / 3) * (a.v + b.v + c.v), (a.z + b.z + c.z) / 3, uv)), depth);
      }
    }
    draw(t[0], t[1], t[2]);
  }

  /// Whether the inside of a triangle is too far from flat.
  bool is_bent(const Three& t, const Three& e) {
    if (edges_[e[0]].tame && edges_[e[1]].tame && edges_[e[2]].tame) return false;
    const Judgement judgement = judge_inside(t);
    if (judgement.share > 1) return true;
    if (judgement.in_picture) out_.worst = std::max(out_.worst, judgement.share);
    return false;
  }

  void split_at(const Three& t, const Three& e, std::uint32_t point, int depth) {
    const Three spokes = {add_edge(t[0], point, depth), add_edge(t[1], point, depth), add_edge(t[2], point, depth)};
    for (int k = 0; k < 3; ++k) split({t[k], t[(k + 1) % 3], point}, {e[k], spokes[(k + 1) % 3], spokes[k]}, depth + 1);
  }

  /// Whether an axis at which the map is torn passes through the triangle; then `point` becomes the corner there.
  [[nodiscard]] bool around_axis(const Three& t, Corner& point) const {
    if (map_.log.space != Space::spherical) return false;
    const Ambient* p[3];
    for (int k = 0; k < 3; ++k) {
      if (corners_[t[k]].axis != Axis::none) return false;
      p[k] = &corners_[t[k]].seen;
    }
    double b[3], sum = 0, w = 0;
    for (int k = 0; k < 3; ++k) {
      const Ambient &q = *p[(k + 1) % 3], &r = *p[(k + 2) % 3];
      b[k] = q.x * r.y - q.y * r.x;
    }
    if (!((b[0] > 0 && b[1] > 0 && b[2] > 0) || (b[0] < 0 && b[1] < 0 && b[2] < 0))) return false;
    for (int k = 0; k < 3; ++k) sum += b[k], w += b[k] * p[k]->w;
    const Axis axis = w * sum < 0 ? Axis::antipode : Axis::foot;
    if (circle(axis) == 0) return false;
    point = Corner{};
    point.v = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      const Corner& c = corners_[t[k]];
      const double share = b[k] / sum;
      point.v = point.v + share * c.v;
      point.z += share * c.z;
      for (int j = 0; j < 2; ++j) point.uv[j] += share * c.uv[j];
    }
    point.axis = axis;
    point.at = {circle(axis), 0, point.z};
    return true;
  }

  [[nodiscard]] Judgement judge_inside(const Three& t) const {
    const Corner &a = corners_[t[0]], &b = corners_[t[1]], &c = corners_[t[2]];
    // A level triangle stays level: nothing but its edges can be wrong, unless colours matter.
    if (map_.log.space == Space::euclidean || (a.z == b.z && b.z == c.z && net_.along == 0)) return {0, false, 0};
    const Vector3 centre = image_of(map_, (1.0 / 3) * (a.v + b.v + c.v), (a.z + b.z + c.z) / 3);
    return judge_centre(sight_, {a.at, b.at, c.at}, centre, net_.along);
  }

  void draw(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    out_.triangles.push_back({a, b, c});
    if (out_.triangles.size() > most_) out_.too_many = true;
  }

  /// The vertex on the circle at the end of the edge from corner `from` to corner `axis`.
  std::uint32_t ring_vertex(std::uint32_t edge, std::uint32_t from, std::uint32_t axis) {
    if (edges_[edge].ring < 0) {
      Corner c = corners_[axis];
      c.at = seen_with(c, corners_[from]);
      edges_[edge].ring = static_cast<std::int32_t>(add(c));
    }
    return static_cast<std::uint32_t>(edges_[edge].ring);
  }

  void draw_on_axis(Three t, Three e, int on_axis) {
    if (on_axis == 3) return;  // nothing but a piece of the axis itself
    if (on_axis == 2) {
      while (corners_[t[0]].axis != Axis::none)
        std::rotate(t.begin(), t.begin() + 1, t.end()), std::rotate(e.begin(), e.begin() + 1, e.end());
      return draw(t[0], ring_vertex(e[0], t[0], t[1]), ring_vertex(e[2], t[0], t[2]));
    }
    while (corners_[t[2]].axis == Axis::none)
      std::rotate(t.begin(), t.begin() + 1, t.end()), std::rotate(e.begin(), e.begin() + 1, e.end());
    const std::uint32_t a = t[0], b = t[1], b_end = ring_vertex(e[1], b, t[2]);
    if (edges_[e[2]].ring < 0) {
      // Upright, or nearly: both spokes end in one vertex.
      const Vector3 off = seen_with(corners_[t[2]], corners_[a]) - corners_[b_end].at;
      if (length(off) < 1e-12) edges_[e[2]].ring = static_cast<std::int32_t>(b_end);
    }
    const std::uint32_t a_end = ring_vertex(e[2], a, t[2]);
    draw(a, b, b_end);
    if (a_end == b_end) return;
    // From B' back to A' along the polygon.
    const double from = math::atan2(corners_[b].at.y, corners_[b].at.x), to = math::atan2(corners_[a].at.y, corners_[a].at.x);
    const double turn = std::remainder(to - from, 2 * std::numbers::pi), step = 2 * std::numbers::pi / steps_;
    std::uint32_t last = b_end;
    const double low = std::min(from, from + turn), high = std::max(from, from + turn);
    const auto first = static_cast<long>(std::floor(low / step)) + 1, end = static_cast<long>(std::ceil(high / step));
    for (long i = 0; i < end - first; ++i) {
      const double angle = static_cast<double>(turn > 0 ? first + i : end - 1 - i) * step;
      Corner c = corners_[t[2]];
      const double radius = circle(c.axis);
      c.at = {radius * math::cos(angle), radius * math::sin(angle), c.z};
      const std::uint32_t next = add(c);
      draw(a, last, next);
      last = next;
    }
    if (a_end != last) draw(a, last, a_end);
  }

  const CopyMap& map_;
  const Sight& sight_;
  const PartNet& net_;
  const Uv& uv_;
  std::uint64_t most_;
  const std::vector<bool>* known_;
  std::size_t next_ = 0;              ///< in `known_`
  double densest_;
  int steps_ = 8;
  std::vector<Corner> corners_;
  std::vector<Edge> edges_;
  Tessellation out_;
};

}  // namespace

geometry::Vector3 image_of(const CopyMap& map, const Ambient& v, double z) {
  const geometry::Point p = geometry::normalised_point(map.log.space, v);
  if (map.view == View::eye) return bent_position(map.log, p, z);
  const Ambient q = map.log.eye_from_copy * p;
  if (map.log.space == Space::euclidean) return {q.x, q.y, z};
  const double scale = 1 / std::max(1 + q.w, 1e-12);
  return {q.x * scale, q.y * scale, z};
}

Tessellation tessellate(const CopyMap& map, const Sight& sight, const PartNet& net, const Uv& uv, std::uint64_t most) {
  return Splitter(map, sight, net, uv, most, nullptr).run();
}

Tessellation tessellate_again(const CopyMap& map, const Sight& sight, const PartNet& net, const Uv& uv,
                              const std::vector<bool>& decisions) {
  return Splitter(map, sight, net, uv, std::numeric_limits<std::uint64_t>::max() / 4, &decisions).run();
}

}  // namespace orbc::bend
