// Edge collapse by OpenMesh's decimater with a module of our own: quadric errors (Garland & Heckbert 1997) with planes through feature
// edges as they propose for borders. Features are borders, seams of uv or colour and borders between materials. A vertex of two feature
// edges moves along them only; one of more (or one) stays.
// OpenMesh sees the welded surface; materials and the mesh's own (split) vertices are kept per face in `corners`. Only halfedges collapse,
// so every vertex of the result is one of the input and uv is never mixed.
#include "compiler/mesh/decimate.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "compiler/mesh/closest_point_tree.h"
#include "compiler/mesh/collapse_module.h"
#include "compiler/mesh/decimation_state.h"
#include "compiler/mesh/weld.h"

namespace orbc::mesh {
namespace {

using geometry::Vector3;

Decimated result(const DecimationState& state) {
  Decimated made;
  Mesh& mesh = made.mesh;
  mesh.positions = state.mesh.positions;
  mesh.uv = state.mesh.uv;
  mesh.colors = state.mesh.colors;
  mesh.materials = state.mesh.materials;
  mesh.textures = state.mesh.textures;
  std::vector<std::pair<std::uint32_t, Triangle>> kept;  // in the order of the input
  for (const auto f : state.surface.all_faces()) {
    if (!state.surface.status(f).deleted())
      kept.push_back({state.face[static_cast<std::size_t>(f.idx())], state.corners[static_cast<std::size_t>(f.idx())]});
  }
  for (const auto t : state.rejected) kept.push_back({t, state.mesh.triangles[t]});
  std::sort(kept.begin(), kept.end());
  for (const auto& [t, corners] : kept) {
    mesh.triangles.push_back(corners);
    if (!state.mesh.triangle_material.empty()) mesh.triangle_material.push_back(state.mesh.triangle_material[t]);
  }
  CompactMesh compact = remove_unused_vertices(std::move(mesh));
  made.mesh = std::move(compact.mesh);
  made.origin = std::move(compact.origin);
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

/// Fills the state. In: the size of the mesh, for priorities; the largest quadric error, 0 = no bound.
void prepare(DecimationState& state, double size, double quadric_bound) {
  build_surface(state);
  compute_quadrics(state);
  state.bound = quadric_bound > 0 ? quadric_bound * quadric_bound : std::numeric_limits<double>::infinity();
  state.scale = 1 / (size * size * size * size);
  state.surface.request_face_status();  // to be kept when the decimater is gone
}

/// Simplifies the surface to ever fewer triangles in one go.
/// In: numbers of triangles, decreasing; `on_reached` is called at each of them and returns whether to go on. The last one is reached or as
///     nearly as possible.
void simplify(DecimationState& state, const std::vector<std::size_t>& numbers, const std::function<bool()>& on_reached) {
  OpenMesh::Decimater::DecimaterT<HalfedgeSurface> decimater(state.surface);
  CollapseModule<HalfedgeSurface>::Handle module;
  decimater.add(module);
  std::size_t next = 0;
  state.faces_left = state.surface.n_faces();
  const std::function<void()> report_reached = [&] {
    while (next < numbers.size() && !state.done &&
           state.faces_left + state.rejected.size() <= std::max(numbers[next], state.rejected.size())) {
      state.done = !on_reached();
      ++next;
    }
  };
  decimater.module(module).use(state, report_reached);
  decimater.initialize();
  if (numbers.empty()) return;
  decimater.decimate_to_faces(0, numbers.back() - std::min(numbers.back(), state.rejected.size()));
  report_reached();
  // A number that cannot be reached is reported once, with the triangles that are left.
  if (next < numbers.size() && !state.done) on_reached();
}

Decimated decimate_once(const Mesh& mesh, std::size_t triangles, double quadric_bound) {
  DecimationState state(mesh);
  const double size = size_of(mesh);
  prepare(state, size, quadric_bound);
  simplify(state, {triangles}, [] { return true; });
  Decimated done = result(state);
  // Measured: each old vertex that is no vertex any more.
  const ClosestPointTree nearest(done.mesh);
  std::vector<char> stays(mesh.positions.size(), 0);
  for (const auto f : state.surface.all_faces()) {
    if (state.surface.status(f).deleted()) continue;
    for (const auto v : state.corners[static_cast<std::size_t>(f.idx())]) stays[state.weld[v]] = 1;
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (state.weld[v] == v && state.handle[v].is_valid() && !stays[v])
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
    auto done = decimate_once(mesh, options.triangles, bound);
    if (options.max_error <= 0 || done.error <= options.max_error) return done;
  }
  return unchanged(mesh);
}

std::vector<Decimated> decimate_in_steps(const Mesh& mesh, const std::vector<std::size_t>& triangles) {
  std::vector<Decimated> chain;
  DecimationState state(mesh);
  prepare(state, size_of(mesh), 0);
  std::size_t last = mesh.triangles.size();
  simplify(state, triangles, [&] {
    Decimated step = result(state);
    // What no longer becomes much coarser is not worth a step.
    if (step.mesh.triangles.empty() || 10 * step.mesh.triangles.size() > 9 * last) return false;
    last = step.mesh.triangles.size();
    chain.push_back(std::move(step));
    return true;
  });
  return chain;
}

}  // namespace orbc::mesh
