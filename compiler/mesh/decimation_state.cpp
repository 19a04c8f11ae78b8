// What edge collapse needs to know of a mesh: the link condition, features, quadrics.
#include "compiler/mesh/decimation_state.h"

#include <mutex>

#include "compiler/mesh/weld.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <OpenMesh/Core/System/omstream.hh>
#pragma GCC diagnostic pop

namespace orbc::mesh {
namespace {

OpenMesh::Vec3d vec(const geometry::Vector3& p) { return {p.x, p.y, p.z}; }

struct FaceShape {
  OpenMesh::Vec3d normal;
  double area = 0;
};

FaceShape shape_of(const HalfedgeSurface& s, OpenMesh::FaceHandle f) {
  const auto h = s.halfedge_handle(f);
  const auto p = s.point(s.to_vertex_handle(h)), q = s.point(s.to_vertex_handle(s.next_halfedge_handle(h))),
             r = s.point(s.from_vertex_handle(h));
  const auto n = cross(q - p, r - p);
  const double size = n.norm();
  return {size > 0 ? n / size : n, size / 2};
}

/// Adds the plane through `at` to the quadric of a vertex.
void add_plane(DecimationState& state, OpenMesh::VertexHandle v, const OpenMesh::Vec3d& normal, const OpenMesh::Vec3d& at, double weight) {
  Quadric q(normal, at);
  q *= weight;
  state.quadric[static_cast<std::size_t>(v.idx())] += q;
  state.weight[static_cast<std::size_t>(v.idx())] += weight;
}

/// Whether the edge between two faces is a seam of uv or colour. One that is torn at one end only is none: that end is the pole of a
/// picture, or the end of a seam, and gets locked.
bool is_seam(DecimationState& state, OpenMesh::FaceHandle f, OpenMesh::FaceHandle g, const OpenMesh::VertexHandle (&ends)[2]) {
  bool torn[2] = {false, false};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto a = state.corners[static_cast<std::size_t>(f.idx())][state.corner_at(f, ends[k])];
    const auto b = state.corners[static_cast<std::size_t>(g.idx())][state.corner_at(g, ends[k])];
    torn[k] = attributes_differ(state.mesh, a, b);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    if (torn[k] && !torn[1 - k]) state.locked[static_cast<std::size_t>(ends[k].idx())] = 1;
  }
  return torn[0] && torn[1];
}

/// Whether the edge is a border of the surface or between materials, or a seam.
bool is_feature(DecimationState& state, OpenMesh::EdgeHandle e) {
  const auto& s = state.surface;
  const auto h = s.halfedge_handle(e, 0);
  const auto f = s.face_handle(h), g = s.face_handle(s.halfedge_handle(e, 1));
  if (!f.is_valid() || !g.is_valid()) return true;
  const auto& material = state.mesh.triangle_material;
  if (!material.empty() &&
      material[state.face[static_cast<std::size_t>(f.idx())]] != material[state.face[static_cast<std::size_t>(g.idx())]])
    return true;
  if (state.mesh.uv.empty() && state.mesh.colors.empty()) return false;
  return is_seam(state, f, g, {s.to_vertex_handle(h), s.from_vertex_handle(h)});
}

/// Planes through a feature edge, orthogonal to its faces, hold its vertices on it.
void add_feature_planes(DecimationState& state, OpenMesh::EdgeHandle e) {
  const auto& s = state.surface;
  const auto h = s.halfedge_handle(e, 0), o = s.halfedge_handle(e, 1);
  const auto p = s.point(s.from_vertex_handle(h)), q = s.point(s.to_vertex_handle(h));
  for (const auto side : {s.face_handle(h), s.face_handle(o)}) {
    if (!side.is_valid()) continue;
    auto n = cross(q - p, shape_of(s, side).normal);
    const double size = n.norm();
    if (!(size > 0)) continue;
    n /= size;
    for (const auto v : {s.to_vertex_handle(h), s.from_vertex_handle(h)}) add_plane(state, v, n, p, (q - p).sqrnorm());
  }
}

}  // namespace

bool HalfedgeSurface::is_collapse_ok(OpenMesh::HalfedgeHandle edge) const {
  const OpenMesh::HalfedgeHandle back = opposite_halfedge_handle(edge);
  const OpenMesh::VertexHandle from = to_vertex_handle(back), to = to_vertex_handle(edge);
  if (status(edge_handle(edge)).deleted() || status(from).deleted() || status(to).deleted()) return false;
  OpenMesh::VertexHandle third[2];
  const OpenMesh::HalfedgeHandle sides[2] = {edge, back};
  for (int k = 0; k < 2; ++k) {
    if (is_boundary(sides[k])) continue;
    const OpenMesh::HalfedgeHandle second = next_halfedge_handle(sides[k]);
    third[k] = to_vertex_handle(second);
    if (is_boundary(opposite_halfedge_handle(second)) && is_boundary(opposite_halfedge_handle(next_halfedge_handle(second)))) return false;
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

bool attributes_differ(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  return (!mesh.uv.empty() && mesh.uv[a] != mesh.uv[b]) || (!mesh.colors.empty() && mesh.colors[a] != mesh.colors[b]);
}

void build_surface(DecimationState& state) {
  const auto& mesh = state.mesh;
  state.weld = weld_positions(mesh.positions);
  state.handle.resize(mesh.positions.size());
  std::vector<char> used(mesh.positions.size(), 0);
  for (const auto& t : mesh.triangles) {
    for (const auto v : t) used[state.weld[v]] = 1;
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) state.handle[v] = state.surface.add_vertex(vec(mesh.positions[v]));
  }
  state.locked.assign(state.surface.n_vertices(), 0);
  static std::once_flag quiet;  // it tells standard error of each face that it cannot add
  std::call_once(quiet, [] { omerr().disable(); });
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const auto a = state.handle[state.weld[v[0]]], b = state.handle[state.weld[v[1]]], c = state.handle[state.weld[v[2]]];
    OpenMesh::FaceHandle added;
    if (a != b && b != c && c != a) added = state.surface.add_face(a, b, c);
    if (added.is_valid()) {
      state.face.push_back(t);
      state.corners.push_back(v);
    } else {
      state.rejected.push_back(t);
      for (const auto h : {a, b, c}) state.locked[static_cast<std::size_t>(h.idx())] = 1;
    }
  }
}

void compute_quadrics(DecimationState& state) {
  const auto& s = state.surface;
  state.quadric.resize(s.n_vertices());
  state.weight.assign(s.n_vertices(), 0);
  for (auto& q : state.quadric) q.clear();
  for (const auto f : s.faces()) {
    const FaceShape shape = shape_of(s, f);
    for (const auto v : s.fv_range(f)) add_plane(state, v, shape.normal, s.point(v), shape.area / 3);
  }
  state.feature.assign(s.n_edges(), 0);
  for (const auto e : s.edges()) {
    if (!is_feature(state, e)) continue;
    state.feature[static_cast<std::size_t>(e.idx())] = 1;
    add_feature_planes(state, e);
  }
}

}  // namespace orbc::mesh
