#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "compiler/bake/diffuse_patch.h"
#include "compiler/bake/patch_locator.h"

namespace orbc::bake {

/// The light of lamps on the surfaces of a room, looked up where rays end. A patch is sampled when the first ray ends on it, and never
/// again. It refers to the room and to the lighting.
/// Invariant: what is found at a point does not depend on which rays came before, nor on threads.
class IrradianceCache {
 public:
  /// In: the lighting that prepare_light made for this room.
  IrradianceCache(const place::Interior& interior, const light::LightingContext& lighting, const BakeOptions& options);
  /// The irradiance of lamps at a point where a ray has ended, interpolated between samples. At borders of shadows that are finer than the
  /// samples, and where there is no patch, lamps are asked for at the point itself.
  /// In:    the point as it is lit (light::shading_point).
  /// Error: that of bake_direct, and at borders that of light::irradiance for expected images.
  [[nodiscard]] scene::Color at(const trace::SurfacePoint& point, const trace::Hit& hit, const surface::ShadingPoint& lit,
                                const light::SampleStratum& stratum = {}) const;
  /// Points at which shadow rays were traced so far.
  [[nodiscard]] std::uint64_t lit_points() const { return lit_points_; }

 private:
  struct Patch {
    std::once_flag once;
    DirectLight light;
  };
  struct Vertex {
    std::once_flag once;
    GridSample light;
    SeenImages seen;
  };
  [[nodiscard]] const DirectLight& light_of(std::size_t patch) const;
  [[nodiscard]] CornerSample light_at(std::size_t part, const PatchCorner& corner) const;
  [[nodiscard]] BakePart part_at(std::size_t part) const;

  const place::Interior& interior_;
  const light::LightingContext& lighting_;
  BakeOptions options_;
  std::vector<std::vector<TexelPatch>> patches_;  ///< per part
  PatchLocator locator_;
  std::vector<std::size_t> first_vertex_;  ///< per part: its first vertex among all
  std::vector<const TexelPatch*> patch_;   ///< all patches, in the order of the parts
  std::vector<PatchCorner> corner_;        ///< per vertex: the corner at which it is lit
  std::unique_ptr<Patch[]> light_;         ///< per patch
  std::unique_ptr<Vertex[]> vertices_;
  mutable std::atomic<std::uint64_t> lit_points_{0};
};

}  // namespace orbc::bake
