#pragma once
#include "compiler/base/progress.h"
#include "compiler/base/result.h"
#include "compiler/cutoff/impostor.h"
#include "compiler/lod/select.h"

namespace orbc::lod {

/// What is to be drawn with a budget of triangles.
struct BudgetScene {
  const InteriorWithLods& lods;
  std::vector<const place::PlacedMesh*>
      drawn;  ///< parallel to lods.interior.parts: the meshes as they are bent, perhaps with more vertices
  const place::Camera& eye;
  const scene::CoverSpec& cover;
  const cutoff::ImpostorPanels& panels;  ///< as they are bent; `depth` empty: paths that end by depth show nothing
};

/// What fits into a budget of triangles.
struct BudgetFit {
  std::vector<cover::Copy> copies;  ///< without the culled ones
  LodSelection selection;           ///< of `copies`
  double tolerance_px = 0.25;       ///< of bending and, apart, of levels of detail
  std::uint64_t triangles = 0;      ///< counted after bending, impostors included
  std::uint64_t culled = 0;         ///< copies that are smaller than `cull_px`
  double cull_px = 0;               ///< 0: none is culled
  bool has_impostors = true;        ///< false: there is no room for impostors
};

/// Meets a budget of triangles with the smallest tolerance that does. All copies share one tolerance, so that none is wrong by more than
/// another has to be. Levels become coarser and chords longer up to a tolerance of one pixel. Beyond that, copies smaller than the
/// tolerance are culled as well, and impostors stand for them. What does not fit with impostors is tried without. In:
/// `options.tolerance_px`: the tolerance that is good enough even where a smaller one would fit; `options.max_triangles` is not
///              used.
/// Makes:       at most `budget` triangles, after splitting and cutting. The tolerance is within 1/16 of the smallest that fits, as far as
///              the number of triangles falls with the tolerance.
/// Diagnostics: bend.too-dense when the room itself at its coarsest exceeds the budget; the hint says how many triangles it needs.
[[nodiscard]] Result<BudgetFit> fit_to_budget(const BudgetScene& scene, const std::vector<cover::Copy>& copies, std::uint64_t budget,
                                              const bend::BendOptions& options, const Executor& executor, const Progress& progress = {});

/// The limit for bending on the way to a budget: cutting takes back many of the triangles that splitting makes.
[[nodiscard]] std::uint64_t bending_limit(std::uint64_t budget);

}  // namespace orbc::lod
