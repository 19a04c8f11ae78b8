#pragma once
#include <cstdint>
#include <vector>

#include "compiler/cutoff/estimate.h"
#include "compiler/cutoff/impostor.h"
#include "compiler/driver/compile.h"
#include "compiler/lod/select.h"

namespace orbc::driver {

/// One picture that is being compiled.
struct Job {
  const PreparedScene& scene;      ///< as exports draw it: without light where renderers light it (PreparedScene::drawn_scene)
  const PreparedScene& lit_scene;  ///< as it is seen
  const place::Camera& eye;
  scene::CoverSpec cover;  ///< that of the scene, perhaps with fewer bounces
  const CompileOptions& options;
  Run run;
};

/// Unfolds the scene, if its copies fit into half of the memory allowed.
/// Diagnostics: those of cover; cover.stacked-mirrors for View::disk.
[[nodiscard]] Result<std::vector<cover::Copy>> unfold_within_memory(const Job& job);

/// Which copies are drawn, and in how much detail.
struct Detail {
  std::vector<cover::Copy> copies;
  lod::LodSelection selection;  ///< of `copies`
  lod::LodStats stats;
  bend::BendOptions bending;
  std::uint64_t culled = 0;  ///< copies that a budget leaves out
  double cull_px = 0;        ///< they are smaller in the picture; 0: none is left out
  bool has_impostors = false;
  bool impostors_dropped = false;  ///< some were needed, and a budget had no room for them
};

/// Selects levels of detail within the tolerance or, with a budget, the smallest tolerance that meets it.
/// Diagnostics: those of lod::fit_to_budget; light.atlas-too-large, of plain scenes.
[[nodiscard]] Result<Detail> choose_detail(const Job& job, std::vector<cover::Copy> copies);

/// Whether a copy is left out for its size. Empty: none is.
[[nodiscard]] cutoff::CullTest cull_test(const Job& job, const Detail& detail);

/// The impostors of a picture.
struct PicturePanels {
  std::vector<place::PlacedMesh> depth;  ///< where paths end by bounces or weight, parallel to the mirrors; empty: nothing is shown there
  std::vector<place::PlacedMesh> size;   ///< before copies that are left out; empty: none is
  bool size_unsplit = false;             ///< those of `size` are drawn without splitting
};
[[nodiscard]] PicturePanels picture_panels(const Job& job, const Detail& detail);

/// Estimates the light behind impostors. Radiance is that of `job.scene`; weights are estimated even where nothing is shown.
[[nodiscard]] cutoff::CutoffEstimate estimate_endings(const Job& job, const Detail& detail);

/// Impostors as they are drawn: panels of baked scenes have vertices of their own for every patch.
struct DrawnPanels {
  std::vector<place::PlacedMesh> meshes;
  std::vector<std::vector<bake::TexelPatch>> patches;  ///< of baked scenes, per mesh
};
[[nodiscard]] DrawnPanels drawn_panels(const PreparedScene& scene, std::vector<place::PlacedMesh> panels);

}  // namespace orbc::driver
