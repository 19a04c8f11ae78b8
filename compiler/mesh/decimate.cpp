// Edge collapse by OpenMesh's decimater with a module of our own: quadric errors (Garland & Heckbert 1997) with planes through feature
// edges as they propose for borders. Features are borders, uv seams and borders between looks: a vertex of two feature edges moves
// along them only, one of more (or one) stays.
// OpenMesh sees the welded surface; looks and the mesh's own (split) vertices are kept per face in `corners`. Only halfedges collapse, so
// every vertex of the result is one of the input and uv is never mixed.
#include "compiler/mesh/decimate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>

#include "compiler/mesh/nearest.h"
#include "compiler/mesh/weld.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
// clang-format off: QuadricT.hh needs the two before it
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>
#include <OpenMesh/Core/Geometry/QuadricT.hh>
// clang-format on
#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#pragma GCC diagnostic pop

namespace orbc::mesh {
namespace {

using geometry::Vector3;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
/// OpenMesh's own test of a collapse looks for a mark by its name at every edge: most of the time went there.
class Surface : public OpenMesh::TriMesh_ArrayKernelT<Traits> {
 public:
  /// Whether the two ends can become one without two surfaces touching there: their rings share the two corners opposite to the edge and
  /// nothing else (the link condition; Dey, Edelsbrunner, Guha & Nekhayev 1999), and borders stay borders.
  [[nodiscard]] bool is_collapse_ok(OpenMesh::HalfedgeHandle edge) const {
    const OpenMesh::HalfedgeHandle back = opposite_halfedge_handle(edge);
    const OpenMesh::VertexHandle from = to_vertex_handle(back), to = to_vertex_handle(edge);
    if (status(edge_handle(edge)).deleted() || status(from).deleted() || status(to).deleted()) return false;
    OpenMesh::VertexHandle third[2];
    const OpenMesh::HalfedgeHandle sides[2] = {edge, back};
    for (int k = 0; k < 2; ++k) {
      if (is_boundary(sides[k])) continue;
      const OpenMesh::HalfedgeHandle second = next_halfedge_handle(sides[k]);
      third[k] = to_vertex_handle(second);
      if (is_boundary(opposite_halfedge_handle(second)) && is_boundary(opposite_halfedge_handle(next_halfedge_handle(second))))
        return false;
    }
    if (third[0] == third[1]) return false;
    if (third[0].is_valid() && third[1].is_valid() && is_boundary(from) && is_boundary(to)) return false;
    for (OpenMesh::HalfedgeHandle a = edge;;) {
      a = opposite_halfedge_handle(prev_halfedge_handle(a));
      if (a == edge) return true;
      const OpenMesh::VertexHandle v = to_vertex_handle(a);
      if (v == third[0] || v == third[1]) continue;
      OpenMesh::HalfedgeHandle b = back;
      do {
        if (to_vertex_handle(b) == v) return false;
        b = opposite_halfedge_handle(prev_halfedge_handle(b));
      } while (b != back);
    }
  }
};
using Quadric = OpenMesh::Geometry::Quadricd;

OpenMesh::Vec3d vec(const Vector3& p) { return {p.x, p.y, p.z}; }

/// What the surface's faces stand for in the mesh.
struct Work {
  const Mesh& mesh;
  Surface surface;
  std::vector<OpenMesh::VertexHandle> handle;  // of each welded vertex
  std::vector<std::uint32_t> weld, face;       // face: triangle of the mesh, by face index
  std::vector<Triangle> corners;               // by face index: the mesh's own vertices
  std::vector<std::uint32_t> left_over;        // triangles that fit into no manifold
  std::vector<char> feature;                   // by edge index
  std::vector<char> locked;                    // by vertex index
  std::vector<Quadric> quadric;                // by vertex index
  std::vector<double> weight;                  // by vertex index: area behind the quadric
  double bound = 0;                            // square of the largest quadric error allowed
  double scale = 1;                            // priorities are floats: 1 / size²
  std::size_t alive = 0;                       // faces that are left
  bool done = false;                           // no further collapse is wanted

  std::size_t corner_at(OpenMesh::FaceHandle f, OpenMesh::VertexHandle v) const {
    const auto& c = corners[static_cast<std::size_t>(f.idx())];
    for (std::size_t k = 0; k < 3; ++k) {
      if (handle[weld[c[k]]] == v) return k;
    }
    return 3;
  }
};

void build(Work& work) {
  const auto& mesh = work.mesh;
  work.weld = welded(mesh.positions);
  work.handle.resize(mesh.positions.size());
  std::vector<char> used(mesh.positions.size(), 0);
  for (const auto& t : mesh.triangles) {
    for (const auto v : t) used[work.weld[v]] = 1;
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) work.handle[v] = work.surface.add_vertex(vec(mesh.positions[v]));
  }
  work.locked.assign(work.surface.n_vertices(), 0);
  static std::once_flag quiet;  // it tells standard error of each face that it cannot add
  std::call_once(quiet, [] { omerr().disable(); });
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const auto a = work.handle[work.weld[v[0]]], b = work.handle[work.weld[v[1]]], c = work.handle[work.weld[v[2]]];
    OpenMesh::FaceHandle added;
    if (a != b && b != c && c != a) added = work.surface.add_face(a, b, c);
    if (added.is_valid()) {
      work.face.push_back(t);
      work.corners.push_back(v);
    } else {
      work.left_over.push_back(t);
      for (const auto h : {a, b, c}) work.locked[static_cast<std::size_t>(h.idx())] = 1;
    }
  }
}

/// Finds features, and the quadrics of faces and features.
void measure(Work& work) {
  auto& s = work.surface;
  work.quadric.resize(s.n_vertices());
  work.weight.assign(s.n_vertices(), 0);
  for (auto& q : work.quadric) q.clear();
  const auto add = [&](OpenMesh::VertexHandle v, const OpenMesh::Vec3d& normal, const OpenMesh::Vec3d& at, double weight) {
    Quadric q(normal, at);
    q *= weight;
    work.quadric[static_cast<std::size_t>(v.idx())] += q;
    work.weight[static_cast<std::size_t>(v.idx())] += weight;
  };
  const auto normal_of = [&](OpenMesh::FaceHandle f, double& area) {
    auto h = s.halfedge_handle(f);
    const auto p = s.point(s.to_vertex_handle(h)), q = s.point(s.to_vertex_handle(s.next_halfedge_handle(h))),
               r = s.point(s.from_vertex_handle(h));
    auto n = cross(q - p, r - p);
    const double size = n.norm();
    area = size / 2;
    return size > 0 ? n / size : n;
  };
  double area = 0;
  for (const auto f : s.faces()) {
    const auto n = normal_of(f, area);
    for (const auto v : s.fv_range(f)) add(v, n, s.point(v), area / 3);
  }
  work.feature.assign(s.n_edges(), 0);
  for (const auto e : s.edges()) {
    const auto h = s.halfedge_handle(e, 0), o = s.halfedge_handle(e, 1);
    const auto f = s.face_handle(h), g = s.face_handle(o);
    bool feature = !f.is_valid() || !g.is_valid();
    if (!feature) {
      const auto& mesh = work.mesh;
      if (!mesh.material.empty())
        feature =
            mesh.material[work.face[static_cast<std::size_t>(f.idx())]] != mesh.material[work.face[static_cast<std::size_t>(g.idx())]];
      const OpenMesh::VertexHandle ends[2] = {s.to_vertex_handle(h), s.from_vertex_handle(h)};
      bool torn[2] = {false, false};
      for (std::size_t k = 0; k < 2 && !mesh.uv.empty(); ++k) {
        const auto a = work.corners[static_cast<std::size_t>(f.idx())][work.corner_at(f, ends[k])];
        const auto b = work.corners[static_cast<std::size_t>(g.idx())][work.corner_at(g, ends[k])];
        torn[k] = mesh.uv[a] != mesh.uv[b];
      }
      // Torn at one end only: that end is the pole of a picture, or the end of a seam. It stays.
      for (std::size_t k = 0; k < 2; ++k) {
        if (torn[k] && !torn[1 - k] && !feature) work.locked[static_cast<std::size_t>(ends[k].idx())] = 1;
      }
      feature = feature || (torn[0] && torn[1]);
    }
    if (!feature) continue;
    work.feature[static_cast<std::size_t>(e.idx())] = 1;
    const auto p = s.point(s.from_vertex_handle(h)), q = s.point(s.to_vertex_handle(h));
    for (const auto side : {f, g}) {
      if (!side.is_valid()) continue;
      auto n = cross(q - p, normal_of(side, area));
      const double size = n.norm();
      if (!(size > 0)) continue;
      n /= size;
      for (const auto v : {s.to_vertex_handle(h), s.from_vertex_handle(h)}) add(v, n, p, (q - p).sqrnorm());
    }
  }
}

template <class MeshT>
class Module final : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(Module, MeshT, Orbc);
  explicit Module(MeshT& surface) : Base(surface, false) {}
  /// `before` is called before every collapse.
  void use(Work& work, const std::function<void()>& before) { work_ = &work, before_ = &before; }

  float collapse_priority(const CollapseInfo& ci) override {
    const auto v0 = static_cast<std::size_t>(ci.v0.idx()), v1 = static_cast<std::size_t>(ci.v1.idx());
    if (work_->done || work_->locked[v0] || !features_allow(ci) || turns_over(ci)) return Base::ILLEGAL_COLLAPSE;
    Quadric q = work_->quadric[v0];
    q += work_->quadric[v1];
    const double error = std::max(q(ci.p1), 0.0), weight = work_->weight[v0] + work_->weight[v1];
    if (error > work_->bound * weight) return Base::ILLEGAL_COLLAPSE;
    // Ties (flat places) are broken by length, so that triangles stay compact.
    return static_cast<float>((error + 1e-12 * weight * (ci.p1 - ci.p0).sqrnorm()) * work_->scale);
  }

  void preprocess_collapse(const CollapseInfo& ci) override {
    (*before_)();
    work_->alive -= (ci.fl.is_valid() ? 1U : 0U) + (ci.fr.is_valid() ? 1U : 0U);
    auto& s = work_->surface;
    const auto v0 = static_cast<std::size_t>(ci.v0.idx()), v1 = static_cast<std::size_t>(ci.v1.idx());
    work_->quadric[v1] += work_->quadric[v0];
    work_->weight[v1] += work_->weight[v0];
    // Round v0, sector by sector between features: its faces get the corner that v1 has on that side of the collapsed edge.
    std::uint32_t corner[2] = {kNone, kNone};
    if (ci.fl.is_valid()) corner[0] = work_->corners[static_cast<std::size_t>(ci.fl.idx())][work_->corner_at(ci.fl, ci.v1)];
    if (ci.fr.is_valid()) corner[1] = work_->corners[static_cast<std::size_t>(ci.fr.idx())][work_->corner_at(ci.fr, ci.v1)];
    for (int side = 0; side < 2; ++side) {
      if (corner[side] == kNone) continue;
      auto h = ci.v0v1;
      while (true) {
        const auto f = side == 0 ? s.face_handle(h) : s.face_handle(s.opposite_halfedge_handle(h));
        if (!f.is_valid()) break;
        // Without features round v0 the first side has gone all the way round.
        const auto k = work_->corner_at(f, ci.v0);
        if (f != ci.fl && f != ci.fr && k < 3) work_->corners[static_cast<std::size_t>(f.idx())][k] = corner[side];
        h = side == 0 ? s.ccw_rotated_halfedge_handle(h) : s.cw_rotated_halfedge_handle(h);
        if (h == ci.v0v1 || work_->feature[static_cast<std::size_t>(s.edge_handle(h).idx())]) break;
      }
    }
    // The two edges of a removed triangle become one; it is a feature if one of them was.
    merge_feature(ci.v0vl, ci.vlv1);
    merge_feature(ci.vrv0, ci.v1vr);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  void merge_feature(OpenMesh::HalfedgeHandle a, OpenMesh::HalfedgeHandle b) {
    if (!a.is_valid() || !b.is_valid()) return;
    auto& one = work_->feature[static_cast<std::size_t>(work_->surface.edge_handle(a).idx())];
    auto& two = work_->feature[static_cast<std::size_t>(work_->surface.edge_handle(b).idx())];
    one = two = one || two;
  }
  bool features_allow(const CollapseInfo& ci) const {
    const auto& s = work_->surface;
    int count = 0;
    for (const auto h : s.voh_range(ci.v0)) count += work_->feature[static_cast<std::size_t>(s.edge_handle(h).idx())];
    const auto is_feature = [&](OpenMesh::HalfedgeHandle h) {
      return h.is_valid() && work_->feature[static_cast<std::size_t>(s.edge_handle(h).idx())];
    };
    // Two features must not fall together on one edge.
    if ((is_feature(ci.v0vl) && is_feature(ci.vlv1)) || (is_feature(ci.vrv0) && is_feature(ci.v1vr))) return false;
    if (count == 2 && is_feature(ci.v0v1)) return true;
    if (count != 0) return false;
    // All faces round v0 get one corner: v1 must have the same uv on both sides, which it has not at a pole.
    if (!ci.fl.is_valid() || !ci.fr.is_valid() || work_->mesh.uv.empty()) return true;
    const auto left = work_->corners[static_cast<std::size_t>(ci.fl.idx())][work_->corner_at(ci.fl, ci.v1)];
    const auto right = work_->corners[static_cast<std::size_t>(ci.fr.idx())][work_->corner_at(ci.fr, ci.v1)];
    return work_->mesh.uv[left] == work_->mesh.uv[right];
  }
  /// Whether a face round v0 would turn by more than about 75°, or lose its area.
  bool turns_over(const CollapseInfo& ci) const {
    const auto& s = work_->surface;
    for (const auto h : s.voh_range(ci.v0)) {
      const auto f = s.face_handle(h);
      if (!f.is_valid() || f == ci.fl || f == ci.fr) continue;
      const auto a = s.point(s.to_vertex_handle(h)), b = s.point(s.to_vertex_handle(s.next_halfedge_handle(h)));
      const auto before = cross(a - ci.p0, b - ci.p0), after = cross(a - ci.p1, b - ci.p1);
      const double lengths = before.norm() * after.norm(), edge = std::max((a - b).sqrnorm(), (a - ci.p1).sqrnorm());
      if (!(after.norm() > 1e-3 * edge)) {
        // A needle may only become a better triangle.
        if (!(after.norm() * std::max((a - b).sqrnorm(), (a - ci.p0).sqrnorm()) > before.norm() * edge)) return true;
      }
      if (!(dot(before, after) > 0.25 * lengths)) return true;
    }
    return false;
  }

  Work* work_ = nullptr;
  const std::function<void()>* before_ = nullptr;
};

Decimated result(const Work& work) {
  Decimated made;
  Mesh& mesh = made.mesh;
  mesh.positions = work.mesh.positions;
  mesh.uv = work.mesh.uv;
  mesh.looks = work.mesh.looks;
  mesh.textures = work.mesh.textures;
  std::vector<std::pair<std::uint32_t, Triangle>> kept;  // in the order of the input
  for (const auto f : work.surface.all_faces()) {
    if (!work.surface.status(f).deleted())
      kept.push_back({work.face[static_cast<std::size_t>(f.idx())], work.corners[static_cast<std::size_t>(f.idx())]});
  }
  for (const auto t : work.left_over) kept.push_back({t, work.mesh.triangles[t]});
  std::sort(kept.begin(), kept.end());
  for (const auto& [t, corners] : kept) {
    mesh.triangles.push_back(corners);
    if (!work.mesh.material.empty()) mesh.material.push_back(work.mesh.material[t]);
  }
  made.origin = leave_out_unused(mesh);
  return made;
}

double size_of(const Mesh& mesh) {
  if (mesh.positions.empty()) return 1;
  Vector3 low = mesh.positions[0], high = low;
  for (const auto& p : mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double size = length(high - low);
  return size > 0 ? size : 1;
}

/// Made ready to be simplified. `size`: of the mesh, for priorities.
void prepare(Work& work, double size, double quadric_bound) {
  build(work);
  measure(work);
  work.bound = quadric_bound > 0 ? quadric_bound * quadric_bound : std::numeric_limits<double>::infinity();
  work.scale = 1 / (size * size * size * size);
  work.surface.request_face_status();  // to be kept when the decimater is gone
}

/// The surface simplified to ever fewer triangles in one go, told at each number; the last of them is reached or as near as it gets.
template <class Told>
void simplify(Work& work, const std::vector<std::size_t>& numbers, const Told& told) {
  OpenMesh::Decimater::DecimaterT<Surface> decimater(work.surface);
  typename Module<Surface>::Handle module;
  decimater.add(module);
  std::size_t next = 0;
  work.alive = work.surface.n_faces();
  const auto tell = [&] {
    while (next < numbers.size() && !work.done && work.alive + work.left_over.size() <= std::max(numbers[next], work.left_over.size()))
      work.done = !told(), ++next;
  };
  const std::function<void()> before = tell;
  decimater.module(module).use(work, before);
  decimater.initialize();
  if (numbers.empty()) return;
  decimater.decimate_to_faces(0, numbers.back() - std::min(numbers.back(), work.left_over.size()));
  tell();
  // What cannot be reached is told once, as it is.
  if (next < numbers.size() && !work.done) told();
}

Decimated once(const Mesh& mesh, std::size_t triangles, double quadric_bound) {
  Work work{mesh, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, 0, 1, 0, false};
  const double size = size_of(mesh);
  prepare(work, size, quadric_bound);
  simplify(work, {triangles}, [] { return true; });
  Decimated done = result(work);
  // Measured: each old vertex that is no vertex any more.
  const Nearest nearest(done.mesh);
  std::vector<char> stays(mesh.positions.size(), 0);
  for (const auto f : work.surface.all_faces()) {
    if (work.surface.status(f).deleted()) continue;
    for (const auto v : work.corners[static_cast<std::size_t>(f.idx())]) stays[work.weld[v]] = 1;
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (work.weld[v] == v && work.handle[v].is_valid() && !stays[v])
      done.error = std::max(done.error, nearest.distance(mesh.positions[v], 2 * size));
  }
  return done;
}

Decimated unchanged(const Mesh& mesh) {
  Decimated same{mesh, std::vector<std::uint32_t>(mesh.positions.size()), 0};
  std::iota(same.origin.begin(), same.origin.end(), 0U);
  return same;
}

}  // namespace

Decimated decimate(const Mesh& mesh, const DecimateOptions& options) {
  if (mesh.triangles.size() <= std::max<std::size_t>(options.triangles, 4) || (options.triangles == 0 && options.max_error <= 0))
    return unchanged(mesh);
  // The quadric error is a mean over planes, the measured one a maximum: when that is too large, less is tried.
  double bound = options.max_error;
  for (int attempt = 0; attempt < 8; ++attempt, bound *= 0.6) {
    auto done = once(mesh, options.triangles, bound);
    if (options.max_error <= 0 || done.error <= options.max_error) return done;
  }
  return unchanged(mesh);
}

std::vector<Decimated> decimate_in_steps(const Mesh& mesh, const std::vector<std::size_t>& triangles) {
  std::vector<Decimated> chain;
  Work work{mesh, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, 0, 1, 0, false};
  prepare(work, size_of(mesh), 0);
  std::size_t last = mesh.triangles.size();
  simplify(work, triangles, [&] {
    Decimated step = result(work);
    // What no longer becomes much coarser is not worth a step.
    if (step.mesh.triangles.empty() || 10 * step.mesh.triangles.size() > 9 * last) return false;
    last = step.mesh.triangles.size();
    chain.push_back(std::move(step));
    return true;
  });
  return chain;
}

}  // namespace orbc::mesh
