#pragma once
#include <cstdint>
#include <vector>
#include <string>
#include <optional>
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/bend/bend.h"
#include "compiler/cover/plan.h"
#include "compiler/driver/open.h"
#include "compiler/driver/paint.h"
#include "compiler/driver/product.h"

namespace orbc::driver {

struct CompileOptions {
  bend::BendOptions bend;
  PaintOptions paint;
  std::optional<std::uint64_t> budget;  ///< triangles: where more would come out, the picture's error is let grow until they suffice
  bool levels = true;                 ///< far copies are drawn coarser: what that displaces stays within the tolerance as well
  std::uint64_t max_memory = std::uint64_t{4} << 30;  ///< half of it for the product, half for the file that is made of it
};

/// The levels of a part, the part itself first.
struct ToldLevels {
  std::string part;
  std::vector<std::uint64_t> triangles;
  std::vector<double> error;          ///< intrinsic length
};

/// What was made, in numbers; for report.json and the summary.
struct Report {
  std::uint64_t copies = 0, vertices = 0, triangles = 0;
  std::uint64_t triangles_whole = 0;  ///< about what they would be without levels of detail
  std::uint64_t beams = 0, words = 0; ///< copies that are cut to a wedge; distinct words
  std::uint64_t left_out = 0;         ///< copies that a budget left out: smaller in the picture than the tolerance
  double error_bound_px = 0;
  double weight_lost = 0;             ///< of paths that are cut off, mean over the picture: what the tail stands for
  double tolerance_px = 0;            ///< of bending and of levels: what was asked for, or what a budget allowed
  int longest_word = 0;
  std::vector<ToldLevels> levels;     ///< of the parts that have some
  light::HighlightCounts highlights;
};

struct Compiled {
  Product product;
  Report report;
};

/// unfold → levels → atlas → plan → bend: the upper road of compiler/README.md.
/// Makes:       the same product for any executor.
/// Diagnostics: those of cover, light and bend.
[[nodiscard]] Result<Compiled> compile(const Opened& opened, const CompileOptions& options, const Executor& executor, const Progress& progress = {});

/// What compiling would make, within 20 % (copies exactly), and whether it fits into the memory allowed. Goes as far as bending some of the copies.
[[nodiscard]] Result<cover::Plan> plan(const Opened& opened, const CompileOptions& options, const Executor& executor = serial_executor());
[[nodiscard]] std::string plan_json(const cover::Plan& plan);

/// The flat picture of the tiling, without eye or meshes.
[[nodiscard]] Result<Tiling> tile(const Opened& opened, Tiling::Model model, Tiling::Colouring colouring);

/// The report as JSON text.
[[nodiscard]] std::string report_json(const Compiled& compiled);

}  // namespace orbc::driver
