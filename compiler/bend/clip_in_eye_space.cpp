// Clipping comes after splitting: an edge of a wall that two copies share must be split alike in both, even if one of them is clipped there
// and the other is not.
//
// After bending, rays from the eye are straight, and the rays through a polyline fill planes. (Before bending, the rays through the points
// of a wall at one height form no plane except in E²: they are neither a geodesic surface nor linear in barycentric coordinates.)
//
// No new vertex depends on the order of the cuts: it is determined by an edge and one plane, or by a triangle and the ray in which two
// planes meet. So neighbouring triangles, and the copies on both sides of a height bound, make the same vertices.
#include "compiler/bend/clip_in_eye_space.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "compiler/cover/height_bounds.h"

namespace orbc::bend {
namespace {

using cover::Bearing;
using geometry::Vector3;

constexpr double kOnPlaneRadians = 4e-7;   // positions are floats
constexpr double kMinSegmentCosine = 0.5;  // of the angle of one segment of a polyline
constexpr int kMaxSegmentHalvings = 12;
constexpr std::size_t kBatch = 512;  // copies that are stored twice at a time

/// A plane through the eye: upright, or inclined and through one segment of a polyline.
struct Plane {
  Vector3 normal;  // inclined: upwards; upright: to the left
  int bound = -1;  // index of the height bound; −1: a border of the wedge
  int vertex = 0;  // of the polyline: the one on the upright plane, or the first of the segment
  bool upright = false;
};

/// The borders of a copy's wedge, and its height bounds as polylines.
class CutPlanes {
 public:
  CutPlanes(const cover::Copy& copy, geometry::Space space, const place::Camera& eye, double tolerance_px)
      : space_(space), eye_z_(eye.z), tolerance_(tolerance_px / place::pixels_per_radian(eye)) {
    for (const Bearing& b : {copy.wedge->from, copy.wedge->to}) planes.push_back({{-b.y, b.x, 0}, -1, 0, true});
    for (std::size_t i = 0; i < copy.height_bounds.size(); ++i) {
      rays_.emplace_back();
      bound_ = &copy.height_bounds[i];
      add(copy.wedge->from);
      refine(copy.wedge->from, copy.wedge->to, 0);
      const auto& rays = rays_.back();
      first_.push_back(static_cast<int>(planes.size()));
      for (std::size_t k = 0; k + 1 < rays.size(); ++k) {
        planes.push_back({normalised(cross(rays[k], rays[k + 1])), static_cast<int>(i), static_cast<int>(k), false});
        planes.push_back({{-rays[k + 1].y, rays[k + 1].x, 0}, static_cast<int>(i), static_cast<int>(k) + 1, true});
      }
    }
  }

  static constexpr int kFrom = 0, kTo = 1;  // the borders of the wedge
  [[nodiscard]] int segment_count(std::size_t bound) const { return static_cast<int>(rays_[bound].size()) - 1; }
  [[nodiscard]] int slope_plane(std::size_t bound, int segment) const { return first_[bound] + 2 * segment; }
  /// Between a segment and the next one.
  [[nodiscard]] int upright_plane(std::size_t bound, int segment) const { return first_[bound] + 2 * segment + 1; }

  /// The direction in which two planes meet.
  [[nodiscard]] Vector3 ray(int a, int b) const {
    const Plane *p = &planes[static_cast<std::size_t>(a)], *q = &planes[static_cast<std::size_t>(b)];
    if (p->bound >= 0 && p->bound == q->bound && p->upright != q->upright)
      return rays_[static_cast<std::size_t>(p->bound)][static_cast<std::size_t>(p->upright ? p->vertex : q->vertex)];
    const auto key = [](const Plane& plane) { return std::tie(plane.normal.x, plane.normal.y, plane.normal.z); };
    if (key(*q) < key(*p)) std::swap(p, q);
    return cross(p->normal, q->normal);
  }

  std::vector<Plane> planes;

 private:
  void add(const Bearing& b) { rays_.back().push_back({b.x, b.y, cover::slope_of(space_, *bound_, b, eye_z_)}); }

  void refine(const Bearing& from, const Bearing& to, int depth) {
    const Bearing middle = cover::sample_bearings({from, to}, 3)[1];
    if (depth < kMaxSegmentHalvings && !is_straight(from, to)) {
      refine(from, middle, depth + 1);
      refine(middle, to, depth + 1);
      return;
    }
    add(to);
  }

  /// Whether the plane through the rays at both ends is the surface of the bound between them, within the tolerance.
  [[nodiscard]] bool is_straight(const Bearing& from, const Bearing& to) const {
    if (from.x * to.x + from.y * to.y < kMinSegmentCosine) return false;
    if (space_ == geometry::Space::euclidean) return true;
    const double s0 = cover::slope_of(space_, *bound_, from, eye_z_), s1 = cover::slope_of(space_, *bound_, to, eye_z_),
                 all = cross(from, to);
    for (const Bearing& b : cover::sample_bearings({from, to}, 5)) {
      const double s = cover::slope_of(space_, *bound_, b, eye_z_), flat = (s0 * cross(b, to) + s1 * cross(from, b)) / all;
      if (std::fabs(s - flat) > tolerance_ * (1 + s * s)) return false;
    }
    return true;
  }

  geometry::Space space_;
  double eye_z_, tolerance_;
  const cover::HeightBound* bound_ = nullptr;
  std::vector<std::vector<Vector3>> rays_;  // by bound: the vertices of its polyline
  std::vector<int> first_;                  // by bound: its first plane
};

struct Vertex {
  Vector3 p;  // from the eye
  std::array<double, 2> uv{};
  int corner = -1;       // a corner of the triangle
  int edge = -1;         // on the edge between the corners `edge` and edge + 1
  int on[2] = {-1, -1};  // planes on which it lies
};
using Polygon = std::vector<Vertex>;

/// Clips the triangles of one copy. Invariant: a vertex that several triangles share is written once.
class Cutter {
 public:
  Cutter(const BentCover& from, const cover::Copy& copy, const CutPlanes& planes, double eye_z)
      : from_(from), copy_(copy), planes_(planes), eye_{0, 0, eye_z} {}

  /// Makes: a cover of this copy alone.
  BentCover run(const BentRange& range) {
    first_vertex_ = range.first_vertex;
    given_.assign(range.vertex_count, -1);
    for (std::size_t i = 0; i < range.index_count; i += 3) cut(&from_.indices[range.first_index + i]);
    to_.copies.push_back({0, to_.positions.size(), 0, to_.indices.size()});
    return std::move(to_);
  }

 private:
  void cut(const std::uint32_t* triangle) {
    triangle_ = triangle;
    Polygon whole;
    for (int k = 0; k < 3; ++k) {
      const auto& p = from_.positions[triangle[k]];
      const auto& uv = from_.uv[triangle[k]];
      corners_[k] = {Vector3{p[0], p[1], p[2]} - eye_, {uv[0], uv[1]}, k, -1, {-1, -1}};
      whole.push_back(corners_[k]);
    }
    for (const auto& [border, side] : {std::pair(CutPlanes::kFrom, 1.0), std::pair(CutPlanes::kTo, -1.0)}) {
      if (is_outside(whole, border, side)) return;
      if (is_outside(whole, border, -side)) continue;
      whole = clipped(whole, border, side);
      if (whole.size() < 3) return;
    }
    std::vector<Polygon> pieces{std::move(whole)};
    for (std::size_t bound = 0; bound < copy_.height_bounds.size(); ++bound) {
      std::vector<Polygon> next;
      for (const Polygon& piece : pieces)
        for (Polygon& part : within_bound(piece, bound)) next.push_back(std::move(part));
      pieces = std::move(next);
    }
    of_triangle_.clear();
    for (const Polygon& piece : pieces) write(piece);
  }

  /// What a height bound leaves of a polygon, segment by segment.
  [[nodiscard]] std::vector<Polygon> within_bound(Polygon rest, std::size_t bound) const {
    std::vector<Polygon> pieces;
    const double side = copy_.height_bounds[bound].above ? 1 : -1;
    for (int segment = 0; segment < planes_.segment_count(bound) && rest.size() > 2; ++segment) {
      const bool last = segment + 1 == planes_.segment_count(bound);
      Polygon here = last ? rest : clipped(rest, planes_.upright_plane(bound, segment), -1);
      if (!last) rest = clipped(rest, planes_.upright_plane(bound, segment), 1);
      if (here.size() > 2) here = clipped(here, planes_.slope_plane(bound, segment), side);
      if (here.size() > 2) pieces.push_back(std::move(here));
    }
    return pieces;
  }

  [[nodiscard]] double value(const Vertex& v, int plane) const {
    if (v.on[0] == plane || v.on[1] == plane) return 0;
    const Plane& p = planes_.planes[static_cast<std::size_t>(plane)];
    const double value = dot(p.normal, v.p);
    return p.upright && std::fabs(value) <= kOnPlaneRadians * (std::fabs(v.p.x) + std::fabs(v.p.y)) ? 0 : value;
  }

  /// Whether no corner lies on this side of the plane.
  [[nodiscard]] bool is_outside(const Polygon& polygon, int plane, double side) const {
    return std::none_of(polygon.begin(), polygon.end(), [&](const Vertex& v) { return side * value(v, plane) > 0; });
  }

  /// Sutherland–Hodgman. A polygon that only touches the plane from the other side becomes empty.
  [[nodiscard]] Polygon clipped(const Polygon& polygon, int plane, double side) const {
    Polygon inside;
    bool any = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double va = side * value(a, plane), vb = side * value(b, plane);
      any = any || va > 0;
      if (va >= 0) inside.push_back(a);
      if ((va < 0 && vb > 0) || (va > 0 && vb < 0)) inside.push_back(between(a, b, plane));
    }
    if (!any) inside.clear();
    return inside;
  }

  static bool lies_on_edge(const Vertex& v, int edge) {
    return v.edge == edge || (v.corner >= 0 && (v.corner == edge || v.corner == (edge + 1) % 3));
  }

  [[nodiscard]] Vertex between(const Vertex& a, const Vertex& b, int plane) const {
    for (int edge = 0; edge < 3; ++edge)
      if (lies_on_edge(a, edge) && lies_on_edge(b, edge)) return on_edge(edge, plane);
    for (const int other : a.on)
      if (other >= 0 && (other == b.on[0] || other == b.on[1])) return on_ray(a, b, plane, other);
    return lerp(a, b, value(a, plane) / (value(a, plane) - value(b, plane)));
  }

  static Vertex lerp(const Vertex& a, const Vertex& b, double t) {
    Vertex v;
    v.p = a.p + t * (b.p - a.p);
    for (int k = 0; k < 2; ++k) v.uv[k] = a.uv[k] + t * (b.uv[k] - a.uv[k]);
    return v;
  }

  /// Computed from the ends of the edge, in an order that does not depend on the triangle.
  [[nodiscard]] Vertex on_edge(int edge, int plane) const {
    const Vertex *a = &corners_[edge], *b = &corners_[(edge + 1) % 3];
    if (std::tie(b->p.x, b->p.y, b->p.z) < std::tie(a->p.x, a->p.y, a->p.z)) std::swap(a, b);
    const double va = value(*a, plane), vb = value(*b, plane);
    Vertex v = lerp(*a, *b, va / (va - vb));
    v.edge = edge;
    v.on[0] = plane;
    return v;
  }

  [[nodiscard]] Vertex on_ray(const Vertex& a, const Vertex& b, int plane, int other) const {
    const Vector3 &p = corners_[0].p, &q = corners_[1].p, &r = corners_[2].p;
    const Vector3 normal = cross(q - p, r - p), ray = planes_.ray(plane, other);
    const double t = dot(normal, p) / dot(normal, ray), scale = std::max(length(a.p), length(b.p));
    Vertex v = lerp(a, b, value(a, plane) / (value(a, plane) - value(b, plane)));
    // A triangle that the eye sees edge-on meets no ray in one point.
    if (std::isfinite(t) && length(t * ray - v.p) < 1e-4 * scale) v.p = t * ray;
    v.on[0] = std::min(plane, other);
    v.on[1] = std::max(plane, other);
    return v;
  }

  void write(const Polygon& polygon) {
    std::vector<std::uint32_t> ids;
    for (const Vertex& v : polygon) ids.push_back(index_of(v));
    for (std::size_t k = 1; k + 1 < ids.size(); ++k) {
      if (ids[0] == ids[k] || ids[k] == ids[k + 1] || ids[k + 1] == ids[0]) continue;
      to_.indices.insert(to_.indices.end(), {ids[0], ids[k], ids[k + 1]});
    }
  }

  std::uint32_t index_of(const Vertex& v) {
    if (v.corner >= 0) {
      std::int64_t& index = given_[triangle_[v.corner] - first_vertex_];
      if (index < 0) {
        index = static_cast<std::int64_t>(to_.positions.size());
        to_.positions.push_back(from_.positions[triangle_[v.corner]]);
        to_.uv.push_back(from_.uv[triangle_[v.corner]]);
      }
      return static_cast<std::uint32_t>(index);
    }
    const std::array<int, 2> planes{v.on[0], v.on[1]};
    if (v.edge >= 0) {
      const auto [a, b] = std::minmax(triangle_[v.edge], triangle_[(v.edge + 1) % 3]);
      const auto [known, is_new] = of_edges_.try_emplace({a, b, planes[0]}, 0);
      if (is_new) known->second = add(v);
      return known->second;
    }
    if (planes[0] < 0) return add(v);
    const auto [known, is_new] = of_triangle_.try_emplace(planes, 0);
    if (is_new) known->second = add(v);
    return known->second;
  }

  std::uint32_t add(const Vertex& v) {
    const Vector3 p = v.p + eye_;
    to_.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    to_.uv.push_back({static_cast<float>(v.uv[0]), static_cast<float>(v.uv[1])});
    return static_cast<std::uint32_t>(to_.positions.size() - 1);
  }

  const BentCover& from_;
  const cover::Copy& copy_;
  const CutPlanes& planes_;
  Vector3 eye_;
  BentCover to_;
  std::size_t first_vertex_ = 0;
  const std::uint32_t* triangle_ = nullptr;
  Vertex corners_[3];
  std::vector<std::int64_t> given_;  // by vertex of the copy: its new index, or −1
  std::map<std::tuple<std::uint32_t, std::uint32_t, int>, std::uint32_t> of_edges_;
  std::map<std::array<int, 2>, std::uint32_t> of_triangle_;  // by planes, of this triangle
};

/// Adds one copy of a cover to another cover.
void append(const BentCover& from, const BentRange& range, BentCover& to) {
  const std::size_t first_vertex = to.positions.size(), first_index = to.indices.size();
  const auto piece = [](const auto& all, std::size_t first, std::size_t count) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return std::pair(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  const auto [p, p_end] = piece(from.positions, range.first_vertex, range.vertex_count);
  to.positions.insert(to.positions.end(), p, p_end);
  const auto [uv, uv_end] = piece(from.uv, range.first_vertex, range.vertex_count);
  to.uv.insert(to.uv.end(), uv, uv_end);
  for (std::size_t i = 0; i < range.index_count; ++i)
    to.indices.push_back(static_cast<std::uint32_t>(from.indices[range.first_index + i] - range.first_vertex + first_vertex));
  to.copies.push_back({first_vertex, range.vertex_count, first_index, range.index_count});
}

}  // namespace

BentCover clip_in_eye_space(BentCover cover, std::span<const cover::Copy> copies, const place::Camera& eye, double tolerance_px,
                            const Executor& executor) {
  if (std::none_of(copies.begin(), copies.end(), [](const cover::Copy& copy) { return copy.wedge.has_value(); })) return cover;
  BentCover cut;
  cut.error_bound_px = cover.error_bound_px;
  cut.split_parts = cover.split_parts;
  cut.positions.reserve(cover.positions.size());
  cut.uv.reserve(cover.uv.size());
  cut.indices.reserve(cover.indices.size());
  cut.copies.reserve(copies.size());
  for (std::size_t from = 0; from < copies.size(); from += kBatch) {
    std::vector<BentCover> pieces(std::min(kBatch, copies.size() - from));
    executor(pieces.size(), [&](std::size_t i) {
      const cover::Copy& copy = copies[from + i];
      if (!copy.wedge) return;
      const CutPlanes planes(copy, eye.room_from_eye.space, eye, tolerance_px);
      pieces[i] = Cutter(cover, copy, planes, eye.z).run(cover.copies[from + i]);
    });
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (copies[from + i].wedge) append(pieces[i], pieces[i].copies.front(), cut);
      else append(cover, cover.copies[from + i], cut);
  }
  return cut;
}

}  // namespace orbc::bend
