#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compiler/bake/view_dependent.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/bend/bend.h"
#include "compiler/cover/plan.h"
#include "compiler/driver/prepare.h"
#include "compiler/driver/product.h"

namespace orbc::driver {

/// Bent edges and coarser levels of detail displace surfaces by up to `bend.tolerance_px` each: together by so many times that.
inline constexpr double kToleranceShares = 2;

struct CompileOptions {
  bend::BendOptions bend;
  bool highlights = true;  ///< bake what depends on the eye: highlights, and the reflections of mirror, glass and metal objects
  std::optional<std::uint64_t> budget;                ///< triangles: where more would be made, the tolerance grows until they fit
  bool by_object = false;                             ///< order copies object by object, for exporters that give each object a node
  std::uint64_t max_memory = std::uint64_t{4} << 30;  ///< bytes; half of it for the product, half for the file that is made of it
  /// Called with the plan of a large product before light is baked for it; may be empty
  std::function<void(const cover::Plan&)> on_large_plan;
};

/// A part and its levels of detail, level 0 first.
struct LodSummary {
  std::string part;
  std::vector<std::uint64_t> triangles;
  std::vector<double> surface_offset;  ///< intrinsic length
};

/// The numbers of a product, for report.json and the summary.
struct Report {
  std::uint64_t copies = 0, vertices = 0, triangles = 0;
  std::uint64_t triangles_at_full_detail = 0;  ///< an estimate: triangles, and those that levels of detail save before bending
  std::uint64_t beams = 0;                     ///< copies that are cut to a wedge
  std::uint64_t words = 0;                     ///< distinct words
  int longest_word = 0;
  double error_bound_px = 0;       ///< no surface is displaced by more; at most `tolerance_px`
  double tolerance_px = 0;         ///< of bending and levels together: as asked for, or as a budget allowed
  std::uint64_t culled = 0;        ///< copies that a budget left out: smaller in the picture than `cull_px`
  double cull_px = 0;              ///< 0: a budget left out none
  std::uint64_t impostors = 0;     ///< panels in mirrors of copies at which paths end (cutoff/impostor.h)
  bool impostors_dropped = false;  ///< a budget had no room for them
  double weight_lost = 0;          ///< of paths that end by bounces or weight, mean over the picture
  double weight_culled = 0;        ///< the same of paths into copies that are left out for their size
  std::vector<LodSummary> lods;    ///< of the parts that have some
  bake::ViewBakeCounts highlights;
};

struct Compiled {
  Product product;
  Report report;
  Diagnostics notes;  ///< what the author should know
};

/// Unfolds, bends and lights a scene for one eye: the upper road of compiler/README.md.
/// Makes:       the same product for any executor; with a budget at most so many triangles. Copies left out for their size in the picture
///              (`min_pixels`, or a budget) are replaced by impostors in the mirrors through which they are seen.
/// Diagnostics: those of cover, bend, bake, lod and native_lights; driver.glowing-mirror, driver.native-view, driver.stereo-export. Notes:
/// driver.copies-left-out,
///              driver.no-curtains, driver.no-lens, driver.eye-too-near.
[[nodiscard]] Result<Compiled> compile(const PreparedScene& scene, const place::Camera& eye, const CompileOptions& options,
                                       const Executor& executor, const Progress& progress = {});
/// The same for the scene's own camera and nothing else.
[[nodiscard]] Result<Compiled> compile(const LoadedScene& scene, const CompileOptions& options, const Executor& executor,
                                       const Progress& progress = {});

/// What compiling would make, within 20 % (copies exactly), and whether it fits into the memory allowed. Bends some of the copies; bakes
/// nothing.
[[nodiscard]] Result<cover::Plan> plan(const PreparedScene& scene, const place::Camera& eye, const CompileOptions& options,
                                       const Executor& executor = serial_executor());
[[nodiscard]] Result<cover::Plan> plan(const LoadedScene& scene, const CompileOptions& options,
                                       const Executor& executor = serial_executor());
[[nodiscard]] std::string plan_json(const cover::Plan& plan);

/// The flat picture of the tiling, without eye or meshes.
[[nodiscard]] Result<Tiling> tile(const LoadedScene& scene, Tiling::Model model, Tiling::Coloring coloring);

/// The report as JSON text.
[[nodiscard]] std::string report_json(const Compiled& compiled);

}  // namespace orbc::driver
