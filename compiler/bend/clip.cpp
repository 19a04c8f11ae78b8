// Sutherland-Hodgman by the two borders, one after the other; they meet nowhere but on the upright axes through the eye and its antipode.
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

constexpr double kOn = 1e-12;   // radians as seen from the eye

class Clipper {
 public:
  Clipper(const Wedge& wedge, const LogMap& map, const PartNet& net, const Uv& uv)
      : wedge_(wedge), map_(map), net_(net), own_(std::make_unique<OwnPart>()) {
    const place::PlacedMesh& mesh = *net.mesh;
    own_->mesh.kind = mesh.kind;
    own_->mesh.name = mesh.name;
    own_->mesh.wall = mesh.wall;
    new_index_.assign(mesh.floor.size(), -1);
    for (std::size_t i = 0; i < mesh.floor.size(); ++i)
      given_.push_back(vertex(mesh.floor[i], mesh.z[i], uv[i], static_cast<std::int32_t>(i)));
  }

  std::unique_ptr<OwnPart> run() {
    const place::PlacedMesh& mesh = *net_.mesh;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) clip(i);
    finish();
    return std::move(own_);
  }

 private:
  struct Vertex {
    Ambient v;
    double z = 0;
    std::array<float, 2> uv{};
    double value[2] = {0, 0};           // of the borders, ≥ 0 inside
    std::int32_t given = -1;            // index in the part
    std::int32_t edge = -1;             // on this edge of the part, cut by border `cut`
    int cut = -1;
  };
  using Polygon = std::vector<Vertex>;

  [[nodiscard]] Vertex vertex(const Ambient& v, double z, const std::array<float, 2>& uv, std::int32_t given) const {
    Vertex made{v, z, uv, {0, 0}, given, -1, -1};
    Ambient seen = map_.eye_from_copy * v;
    if (map_.sheet % 2 == 1) seen = -1.0 * seen;
    const double on = kOn * math::hypot(seen.x, seen.y);
    made.value[0] = cover::turn(wedge_.from, seen);
    made.value[1] = -cover::turn(wedge_.to, seen);
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
    for (const std::uint32_t id : net_.triangle_edges[triangle]) {
      const auto lies_on = [&](const Vertex& p) {
        const auto& ends = net_.edges[id];
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
    const auto& ends = net_.edges[static_cast<std::size_t>(edge)];
    const Vertex &p = given_[ends[0]], &q = given_[ends[1]];
    // An end on the border would not have been cut; after rounding it may have been.
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
    const auto& t = net_.mesh->triangles[i];
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
      own_->mesh.triangles.push_back({ids[0], ids[k], ids[k + 1]});
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
    own_->mesh.floor.emplace_back(p.v.w, p.v.x, p.v.y);
    own_->mesh.z.push_back(p.z);
    own_->uv.push_back(p.uv);
    return static_cast<std::uint32_t>(own_->mesh.floor.size() - 1);
  }

  void finish() {
    // The net is measured on the surface; splitting starts from the affine vertices.
    const std::vector<geometry::Point> affine = own_->mesh.floor;
    for (geometry::Point& p : own_->mesh.floor) p = geometry::normalised_point(map_.space, p);
    own_->net = part_net(map_.space, own_->mesh, net_.along);
    own_->mesh.floor = affine;
  }

  const Wedge& wedge_;
  const LogMap& map_;
  const PartNet& net_;
  std::unique_ptr<OwnPart> own_;
  std::vector<Vertex> given_;
  std::vector<std::int32_t> new_index_;
  std::map<std::pair<std::int32_t, int>, std::uint32_t> cut_index_;
};

}  // namespace

InWedge place_in(const Wedge& wedge, const LogMap& map, const PartNet& net, double margin) {
  Ambient seen = map.eye_from_copy * net.centre;
  if (map.sheet % 2 == 1) seen = -1.0 * seen;
  const double first = geometry::asin_k(map.space, cover::turn(wedge.from, seen)),
               second = geometry::asin_k(map.space, -cover::turn(wedge.to, seen));
  const double across = geometry::asin_k(map.space, margin * math::hypot(seen.x, seen.y));
  const double radius = net.radius * (1 + margin + 1e-9) + across + 1e-9;
  if (radius > std::numbers::pi / 2 && map.space == Space::spherical) return InWedge::some;
  if (first < -radius || second < -radius) return InWedge::none;
  return first > radius && second > radius ? InWedge::all : InWedge::some;
}

std::unique_ptr<OwnPart> reaching(const Wedge& wedge, const LogMap& map, const PartNet& net, const Uv& uv, double margin) {
  const place::PlacedMesh& mesh = *net.mesh;
  // Bit b: beyond border b. The sine of the angle to a border is least at a corner of a triangle.
  std::vector<std::uint8_t> beyond(mesh.floor.size());
  for (std::size_t i = 0; i < beyond.size(); ++i) {
    Ambient seen = map.eye_from_copy * mesh.floor[i];
    if (map.sheet % 2 == 1) seen = -1.0 * seen;
    const double near = margin * math::hypot(seen.x, seen.y);
    beyond[i] = static_cast<std::uint8_t>((cover::turn(wedge.from, seen) < -near ? 1 : 0) | (-cover::turn(wedge.to, seen) < -near ? 2 : 0));
  }
  auto own = std::make_unique<OwnPart>();
  own->mesh.kind = mesh.kind;
  own->mesh.name = mesh.name;
  own->mesh.wall = mesh.wall;
  std::vector<std::int32_t> index(mesh.floor.size(), -1);
  for (const mesh::Triangle& t : mesh.triangles) {
    if (beyond[t[0]] & beyond[t[1]] & beyond[t[2]]) continue;
    own->mesh.triangles.push_back(t);
    for (const std::uint32_t corner : t) index[corner] = 0;
  }
  // In the order of the part, so that edges run the same way.
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] < 0) continue;
    index[i] = static_cast<std::int32_t>(own->mesh.floor.size());
    own->mesh.floor.push_back(mesh.floor[i]);
    own->mesh.z.push_back(mesh.z[i]);
    own->uv.push_back(uv[i]);
  }
  for (mesh::Triangle& t : own->mesh.triangles)
    for (auto& corner : t) corner = static_cast<std::uint32_t>(index[corner]);
  own->net = part_net(map.space, own->mesh, net.along);
  return own;
}

std::unique_ptr<OwnPart> clipped(const Wedge& wedge, const LogMap& map, const PartNet& net, const Uv& uv) {
  return Clipper(wedge, map, net, uv).run();
}

std::unique_ptr<OwnPart> lifted(const cover::Storey& storey, geometry::Space space, const PartNet& net) {
  auto own = std::make_unique<OwnPart>();
  own->mesh = *net.mesh;
  for (double& z : own->mesh.z) z = storey.sign * z + storey.offset;
  own->net = part_net(space, own->mesh, net.along);
  return own;
}

}  // namespace orbc::bend
