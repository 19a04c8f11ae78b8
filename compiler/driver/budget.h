#pragma once
#include "compiler/base/progress.h"
#include "compiler/base/result.h"
#include "compiler/driver/levels.h"
#include "compiler/driver/tail.h"

namespace orbc::driver {

/// What is drawn when there may only be so many triangles.
struct Fitted {
  std::vector<cover::Copy> copies;      ///< those that are left
  Choice choice;                        ///< for them
  double tolerance_px = 0.25;           ///< of bending and of levels alike
  std::uint64_t triangles = 0;          ///< what bending makes of it, panels in mirrors (tail.h) included
  std::uint64_t left_out = 0;           ///< copies that are smaller than the tolerance
  double left_out_px = 0;               ///< that tolerance; 0 when none is left out
  bool curtains = true;                 ///< whether there is room for the panels that hide what is left out
};

/// Meets a budget of triangles with the smallest error that does: one tolerance for all, so that no copy is wrong by more than another need
/// be. First come coarser levels and longer chords, up to a pixel; where that is not enough, copies that are smaller in the picture than
/// the tolerance are left out as well, and panels hide the hole; what cannot be had with panels is tried without.
/// In:          `options.tolerance_px`: what is good enough, also when more would fit; `options.max_triangles` is not looked at; whether
///              there are panels where paths are cut off (`expected`).
/// Makes:       at most `budget` triangles, counted after splitting and cutting. The tolerance is within 1/16 of the smallest one that
///              fits, where the number of triangles falls with it.
/// Diagnostics: bend.too-dense when even the room itself at its coarsest is too much; the hint says how much that takes.
[[nodiscard]] Result<Fitted> fit_to_budget(const Opened& opened, const Levels& levels, const std::vector<cover::Copy>& copies,
                                           std::uint64_t budget, const bend::BendOptions& options, bool expected, const Executor& executor,
                                           const Progress& progress = {});

/// As many triangles as bending may make on its way to a budget: cutting takes back much of it.
[[nodiscard]] std::uint64_t bending_limit(std::uint64_t budget);

}  // namespace orbc::driver
