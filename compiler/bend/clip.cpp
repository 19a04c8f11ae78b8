// Sutherland–Hodgman at the two borders, one after the other. The borders meet only on the upright axes through the eye and its antipode.
#include "compiler/bend/clip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "compiler/base/elementary.h"

namespace orbc::bend {
namespace {

using cover::Wedge;
using geometry::Ambient;
using geometry::Space;

constexpr double kOnBorderRadians = 1e-12;  // as seen from the eye

/// Clips one part. Invariant: vertices on shared edges are computed once, from the ends of the edge alone.
class Clipper {
 public:
  Clipper(const Wedge& wedge, const LogMap& map, const EdgeMesh& part, const Uv& uv)
      : wedge_(wedge), map_(map), part_(part), result_(std::make_unique<ClippedPart>()) {
    const place::PlacedMesh& mesh = *part.mesh;
    result_->mesh.kind = mesh.kind;
    result_->mesh.name = mesh.name;
    result_->mesh.wall = mesh.wall;
    new_index_.assign(mesh.floor.size(), -1);
    for (std::size_t i = 0; i < mesh.floor.size(); ++i)
      given_.push_back(vertex(mesh.floor[i], mesh.z[i], uv[i], static_cast<std::int32_t>(i)));
  }

  std::unique_ptr<ClippedPart> run() {
    const place::PlacedMesh& mesh = *part_.mesh;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) clip(i);
    finish();
    return std::move(result_);
  }

 private:
  struct Vertex {
    Ambient v;
    double z = 0;
    std::array<float, 2> uv{};
    double value[2] = {0, 0};  // of the borders' covectors; ≥ 0 inside
    std::int32_t given = -1;   // a vertex of the part: its index
    std::int32_t edge = -1;    // on an edge of the part: its index, and the border that cuts it
    int cut = -1;
  };
  using Polygon = std::vector<Vertex>;

  [[nodiscard]] Vertex vertex(const Ambient& v, double z, const std::array<float, 2>& uv, std::int32_t given) const {
    Vertex made{v, z, uv, {0, 0}, given, -1, -1};
    Ambient eye_point = map_.eye_from_copy * v;
    if (map_.sheet % 2 == 1) eye_point = -1.0 * eye_point;
    const double on = kOnBorderRadians * math::hypot(eye_point.x, eye_point.y);
    made.value[0] = cover::cross(wedge_.from, eye_point);
    made.value[1] = -cover::cross(wedge_.to, eye_point);
    for (double& value : made.value)
      if (std::fabs(value) <= on) value = 0;
    return made;
  }

  [[nodiscard]] Vertex between(const Vertex& a, const Vertex& b, int border) const {
    const double t = a.value[border] / (a.value[border] - b.value[border]);
    std::array<float, 2> uv{};
    for (int k = 0; k < 2; ++k) uv[k] = static_cast<float>((1 - t) * a.uv[k] + t * b.uv[k]);
    Vertex made = vertex((1 - t) * a.v + t * b.v, (1 - t) * a.z + t * b.z, uv, -1);
    made.value[border] = 0;
    return made;
  }

  /// The edge of the part on which both lie, or −1.
  [[nodiscard]] std::int32_t shared_edge(const Vertex& a, const Vertex& b, std::size_t triangle) const {
    for (const std::uint32_t id : part_.triangle_edges[triangle]) {
      const auto lies_on = [&](const Vertex& p) {
        const auto& ends = part_.edges[id];
        return p.given >= 0 ? ends[0] == static_cast<std::uint32_t>(p.given) || ends[1] == static_cast<std::uint32_t>(p.given)
                            : p.edge == static_cast<std::int32_t>(id);
      };
      if (lies_on(a) && lies_on(b)) return static_cast<std::int32_t>(id);
    }
    return -1;
  }

  [[nodiscard]] Vertex cut(const Vertex& a, const Vertex& b, int border, std::size_t triangle) const {
    const std::int32_t edge = shared_edge(a, b, triangle);
    if (edge < 0) return between(a, b, border);
    const auto& ends = part_.edges[static_cast<std::size_t>(edge)];
    const Vertex &p = given_[ends[0]], &q = given_[ends[1]];
    // Rounding may cut an edge whose end is on the border.
    Vertex made = (p.value[border] < 0) != (q.value[border] < 0) ? between(p, q, border) : between(a, b, border);
    made.edge = edge;
    made.cut = border;
    return made;
  }

  [[nodiscard]] Polygon clipped_by(const Polygon& polygon, int border, std::size_t triangle) const {
    Polygon inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if (a.value[border] >= 0) inside.push_back(a);
      if ((a.value[border] < 0 && b.value[border] > 0) || (a.value[border] > 0 && b.value[border] < 0))
        inside.push_back(cut(a, b, border, triangle));
    }
    return inside;
  }

  void clip(std::size_t i) {
    const auto& t = part_.mesh->triangles[i];
    Polygon polygon{given_[t[0]], given_[t[1]], given_[t[2]]};
    for (int border = 0; border < 2; ++border) {
      const auto beyond = [&](const Vertex& p) { return p.value[border] <= 0; };
      if (std::all_of(polygon.begin(), polygon.end(), beyond)) return;
      const auto within = [&](const Vertex& p) { return p.value[border] >= 0; };
      if (!std::all_of(polygon.begin(), polygon.end(), within)) polygon = clipped_by(polygon, border, i);
      if (polygon.size() < 3) return;
    }
    std::vector<std::uint32_t> ids;
    for (const Vertex& p : polygon) ids.push_back(index_of(p));
    for (std::size_t k = 1; k + 1 < ids.size(); ++k) {
      if (ids[0] == ids[k] || ids[k] == ids[k + 1] || ids[k + 1] == ids[0]) continue;
      result_->mesh.triangles.push_back({ids[0], ids[k], ids[k + 1]});
    }
  }

  std::uint32_t index_of(const Vertex& p) {
    if (p.given >= 0) {
      std::int32_t& index = new_index_[static_cast<std::size_t>(p.given)];
      if (index < 0) index = static_cast<std::int32_t>(add(p));
      return static_cast<std::uint32_t>(index);
    }
    if (p.edge < 0) return add(p);
    const auto [known, is_new] = cut_index_.try_emplace({p.edge, p.cut}, 0);
    if (is_new) known->second = add(p);
    return known->second;
  }

  std::uint32_t add(const Vertex& p) {
    result_->mesh.floor.emplace_back(p.v.w, p.v.x, p.v.y);
    result_->mesh.z.push_back(p.z);
    result_->uv.push_back(p.uv);
    return static_cast<std::uint32_t>(result_->mesh.floor.size() - 1);
  }

  void finish() {
    // The edge mesh is measured on the surface; splitting starts from the affine vertices.
    const std::vector<geometry::Point> affine = result_->mesh.floor;
    for (geometry::Point& p : result_->mesh.floor) p = geometry::normalised_point(map_.space, p);
    result_->part = edge_mesh(map_.space, result_->mesh, part_.color_tolerance);
    result_->mesh.floor = affine;
  }

  const Wedge& wedge_;
  const LogMap& map_;
  const EdgeMesh& part_;
  std::unique_ptr<ClippedPart> result_;
  std::vector<Vertex> given_;
  std::vector<std::int32_t> new_index_;
  std::map<std::pair<std::int32_t, int>, std::uint32_t> cut_index_;
};

}  // namespace

WedgeOverlap wedge_overlap(const Wedge& wedge, const LogMap& map, const EdgeMesh& part, double margin) {
  Ambient eye_point = map.eye_from_copy * part.circle.centre;
  if (map.sheet % 2 == 1) eye_point = -1.0 * eye_point;
  const double first = geometry::asin_k(map.space, cover::cross(wedge.from, eye_point)),
               second = geometry::asin_k(map.space, -cover::cross(wedge.to, eye_point));
  const double across = geometry::asin_k(map.space, margin * math::hypot(eye_point.x, eye_point.y));
  const double radius = part.circle.radius * (1 + margin + 1e-9) + across + 1e-9;
  if (radius > std::numbers::pi / 2 && map.space == Space::spherical) return WedgeOverlap::partial;
  if (first < -radius || second < -radius) return WedgeOverlap::outside;
  return first > radius && second > radius ? WedgeOverlap::inside : WedgeOverlap::partial;
}

std::unique_ptr<ClippedPart> triangles_touching(const Wedge& wedge, const LogMap& map, const EdgeMesh& part, const Uv& uv, double margin) {
  const place::PlacedMesh& mesh = *part.mesh;
  // Bit b: beyond border b. Over a triangle, the sine of the angle to a border is smallest at a corner.
  std::vector<std::uint8_t> beyond(mesh.floor.size());
  for (std::size_t i = 0; i < beyond.size(); ++i) {
    Ambient eye_point = map.eye_from_copy * mesh.floor[i];
    if (map.sheet % 2 == 1) eye_point = -1.0 * eye_point;
    const double near = margin * math::hypot(eye_point.x, eye_point.y);
    beyond[i] = static_cast<std::uint8_t>((cover::cross(wedge.from, eye_point) < -near ? 1 : 0) |
                                          (-cover::cross(wedge.to, eye_point) < -near ? 2 : 0));
  }
  auto result = std::make_unique<ClippedPart>();
  result->mesh.kind = mesh.kind;
  result->mesh.name = mesh.name;
  result->mesh.wall = mesh.wall;
  std::vector<std::int32_t> index(mesh.floor.size(), -1);
  for (const mesh::Triangle& t : mesh.triangles) {
    if (beyond[t[0]] & beyond[t[1]] & beyond[t[2]]) continue;
    result->mesh.triangles.push_back(t);
    for (const std::uint32_t corner : t) index[corner] = 0;
  }
  // Vertices keep their order, so that edges keep their direction.
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] < 0) continue;
    index[i] = static_cast<std::int32_t>(result->mesh.floor.size());
    result->mesh.floor.push_back(mesh.floor[i]);
    result->mesh.z.push_back(mesh.z[i]);
    result->uv.push_back(uv[i]);
  }
  for (mesh::Triangle& t : result->mesh.triangles)
    for (auto& corner : t) corner = static_cast<std::uint32_t>(index[corner]);
  result->part = edge_mesh(map.space, result->mesh, part.color_tolerance);
  return result;
}

std::unique_ptr<ClippedPart> clipped(const Wedge& wedge, const LogMap& map, const EdgeMesh& part, const Uv& uv) {
  return Clipper(wedge, map, part, uv).run();
}

std::unique_ptr<ClippedPart> on_storey(const cover::Storey& storey, geometry::Space space, const EdgeMesh& part) {
  auto result = std::make_unique<ClippedPart>();
  result->mesh = *part.mesh;
  for (double& z : result->mesh.z) z = storey.sign * z + storey.offset;
  result->part = edge_mesh(space, result->mesh, part.color_tolerance);
  return result;
}

}  // namespace orbc::bend
