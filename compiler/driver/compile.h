#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/bend/bend.h"
#include "compiler/cover/plan.h"
#include "compiler/driver/open.h"
#include "compiler/driver/paint.h"
#include "compiler/driver/product.h"

namespace orbc::driver {

/// Bent edges and coarser levels of detail displace things by up to `bend.tolerance_px` each: together by so many times that.
inline constexpr double kToleranceShares = 2;

struct CompileOptions {
  bend::BendOptions bend;
  PaintOptions paint;
  std::optional<std::uint64_t> budget;  ///< triangles: where more would come out, the picture's error is let grow until they suffice
  bool by_object = false;               ///< copies stand in the product object by object, for exporters that give each a node of its own
  bool levels = true;                   ///< far copies are drawn coarser: what that displaces stays within `bend.tolerance_px`, too
  std::uint64_t max_memory = std::uint64_t{4} << 30;  ///< half of it for the product, half for the file that is made of it
  /// Told before light is baked what will come of it, where that is much; may be called more than once; or nothing
  std::function<void(const cover::Plan&)> foresee;
};

/// The levels of a part, the part itself first.
struct ToldLevels {
  std::string part;
  std::vector<std::uint64_t> triangles;
  std::vector<double> error;  ///< intrinsic length
};

/// What was made, in numbers; for report.json and the summary.
struct Report {
  std::uint64_t copies = 0, vertices = 0, triangles = 0;
  std::uint64_t triangles_whole = 0;   ///< about what they would be without levels of detail
  std::uint64_t beams = 0, words = 0;  ///< copies that are cut to a wedge; distinct words
  std::uint64_t left_out = 0;          ///< copies that a budget left out: smaller in the picture than `left_out_px`
  double left_out_px = 0;              ///< 0 when a budget left out none
  std::uint64_t curtains = 0;          ///< panels in mirrors of copies, in the colour expected behind them (tail.h)
  bool curtains_dropped = false;       ///< a budget had no room for them
  double error_bound_px = 0;           ///< nothing is displaced by more, at most `tolerance_px`
  double weight_lost = 0;              ///< of paths that are cut off by bounces or weight, mean over the picture: what the tail stands for
  /// The same of paths into copies left out for their size: what curtains stand for whatever the background
  double weight_merged = 0;
  double tolerance_px = 0;  ///< of bending and of levels together: what was asked for, or what a budget allowed
  int longest_word = 0;
  std::vector<ToldLevels> levels;  ///< of the parts that have some
  bake::ViewBakeCounts highlights;
};

struct Compiled {
  Product product;
  Report report;
  Diagnostics notes;  ///< what the author should know of it
};

/// unfold → levels → atlas → plan → bend: the upper road of compiler/README.md.
/// Makes:       the same product for any executor; with a budget at most so many triangles. Copies left out for their size in the picture
///              (`min_pixels`, or a budget) are hidden by panels in the mirrors through which they are seen, in the colour expected there.
/// Diagnostics: those of cover, light and bend. Notes: driver.copies-left-out, driver.no-curtains, driver.no-lens.
[[nodiscard]] Result<Compiled> compile(const Opened& opened, const CompileOptions& options, const Executor& executor,
                                       const Progress& progress = {});

/// What compiling would make, within 20 % (copies exactly), and whether it fits into the memory allowed. Goes as far as bending some of the
/// copies.
[[nodiscard]] Result<cover::Plan> plan(const Opened& opened, const CompileOptions& options, const Executor& executor = serial_executor());
[[nodiscard]] std::string plan_json(const cover::Plan& plan);

/// The flat picture of the tiling, without eye or meshes.
[[nodiscard]] Result<Tiling> tile(const Opened& opened, Tiling::Model model, Tiling::Colouring colouring);

/// The report as JSON text.
[[nodiscard]] std::string report_json(const Compiled& compiled);

}  // namespace orbc::driver
