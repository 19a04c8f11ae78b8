#pragma once
// Internal to decimate: the rules of collapse as a module of OpenMesh's decimater.
#include <algorithm>
#include <functional>
#include <limits>

#include "compiler/mesh/decimation_state.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#pragma GCC diagnostic pop

namespace orbc::mesh {

/// Priorities of collapses by quadric error; what must not collapse; the bookkeeping of each collapse.
template <class MeshT>
class CollapseModule final : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(CollapseModule, MeshT, Orbc);
  explicit CollapseModule(MeshT& surface) : Base(surface, false) {}
  /// In: `on_collapse` is called before every collapse.
  void use(DecimationState& state, const std::function<void()>& on_collapse) {
    state_ = &state;
    on_collapse_ = &on_collapse;
  }

  float collapse_priority(const CollapseInfo& ci) override {
    const auto v0 = static_cast<std::size_t>(ci.v0.idx()), v1 = static_cast<std::size_t>(ci.v1.idx());
    if (state_->done || state_->locked[v0] || !features_allow(ci) || turns_over(ci)) return Base::ILLEGAL_COLLAPSE;
    Quadric q = state_->quadric[v0];
    q += state_->quadric[v1];
    const double error = std::max(q(ci.p1), 0.0), weight = state_->weight[v0] + state_->weight[v1];
    if (error > state_->bound * weight) return Base::ILLEGAL_COLLAPSE;
    // Ties (flat places) are broken by length, so that triangles stay compact.
    return static_cast<float>((error + 1e-12 * weight * (ci.p1 - ci.p0).sqrnorm()) * state_->scale);
  }

  void preprocess_collapse(const CollapseInfo& ci) override {
    (*on_collapse_)();
    state_->faces_left -= (ci.fl.is_valid() ? 1U : 0U) + (ci.fr.is_valid() ? 1U : 0U);
    auto& s = state_->surface;
    const auto v0 = static_cast<std::size_t>(ci.v0.idx()), v1 = static_cast<std::size_t>(ci.v1.idx());
    state_->quadric[v1] += state_->quadric[v0];
    state_->weight[v1] += state_->weight[v0];
    // Round v0, sector by sector between features: its faces get the corner that v1 has on that side of the collapsed edge.
    std::uint32_t corner[2] = {kNone, kNone};
    if (ci.fl.is_valid()) corner[0] = state_->corners[static_cast<std::size_t>(ci.fl.idx())][state_->corner_at(ci.fl, ci.v1)];
    if (ci.fr.is_valid()) corner[1] = state_->corners[static_cast<std::size_t>(ci.fr.idx())][state_->corner_at(ci.fr, ci.v1)];
    for (int side = 0; side < 2; ++side) {
      if (corner[side] == kNone) continue;
      auto h = ci.v0v1;
      while (true) {
        const auto f = side == 0 ? s.face_handle(h) : s.face_handle(s.opposite_halfedge_handle(h));
        if (!f.is_valid()) break;
        // Without features round v0 the first side has gone all the way round.
        const auto k = state_->corner_at(f, ci.v0);
        if (f != ci.fl && f != ci.fr && k < 3) state_->corners[static_cast<std::size_t>(f.idx())][k] = corner[side];
        h = side == 0 ? s.ccw_rotated_halfedge_handle(h) : s.cw_rotated_halfedge_handle(h);
        if (h == ci.v0v1 || state_->feature[static_cast<std::size_t>(s.edge_handle(h).idx())]) break;
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
    auto& one = state_->feature[static_cast<std::size_t>(state_->surface.edge_handle(a).idx())];
    auto& two = state_->feature[static_cast<std::size_t>(state_->surface.edge_handle(b).idx())];
    one = two = one || two;
  }
  bool features_allow(const CollapseInfo& ci) const {
    const auto& s = state_->surface;
    int count = 0;
    for (const auto h : s.voh_range(ci.v0)) count += state_->feature[static_cast<std::size_t>(s.edge_handle(h).idx())];
    const auto is_feature = [&](OpenMesh::HalfedgeHandle h) {
      return h.is_valid() && state_->feature[static_cast<std::size_t>(s.edge_handle(h).idx())];
    };
    // Two features must not fall together on one edge.
    if ((is_feature(ci.v0vl) && is_feature(ci.vlv1)) || (is_feature(ci.vrv0) && is_feature(ci.v1vr))) return false;
    if (count == 2 && is_feature(ci.v0v1)) return true;
    if (count != 0) return false;
    // All faces round v0 get one corner: v1 must have the same uv and colour on both sides, which it has not at a pole.
    if (!ci.fl.is_valid() || !ci.fr.is_valid()) return true;
    const auto left = state_->corners[static_cast<std::size_t>(ci.fl.idx())][state_->corner_at(ci.fl, ci.v1)];
    const auto right = state_->corners[static_cast<std::size_t>(ci.fr.idx())][state_->corner_at(ci.fr, ci.v1)];
    return !attributes_differ(state_->mesh, left, right);
  }
  /// Whether a face round v0 would turn by more than about 75°, or lose its area.
  bool turns_over(const CollapseInfo& ci) const {
    const auto& s = state_->surface;
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

  DecimationState* state_ = nullptr;
  const std::function<void()>* on_collapse_ = nullptr;
};

}  // namespace orbc::mesh
