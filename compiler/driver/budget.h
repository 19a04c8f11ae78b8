#pragma once
#include "compiler/base/progress.h"
#include "compiler/base/result.h"
#include "compiler/driver/levels.h"

namespace orbc::driver {

/// What is drawn when there may only be so many triangles.
struct Fitted {
  std::vector<cover::Copy> copies;      ///< those that are left
  Choice choice;                        ///< for them
  double tolerance_px = 0.25;           ///< of bending and of levels alike
  std::uint64_t triangles = 0;          ///< what bending makes of it
  std::uint64_t left_out = 0;           ///< copies that are smaller than the tolerance
};

/// Meets a budget of triangles with the smallest error that does: one tolerance for all, so that no copy is wrong by more than another need be. Coarser
/// levels, longer chords, and where both are not enough copies that are smaller in the picture than the tolerance are left out.
/// In:          `options.tolerance_px`: what is good enough, also when more would fit; `options.max_triangles` is not looked at.
/// Makes:       at most `budget` triangles, counted after splitting and cutting. The tolerance is within 1/16 of the smallest one that fits, where the
///              number of triangles falls with it.
/// Diagnostics: bend.too-dense when even the room itself at its coarsest is too much; the hint says how much that takes.
[[nodiscard]] Result<Fitted> fit_to_budget(const place::PlacedRoom& room, const Levels& levels, const std::vector<cover::Copy>& copies, const place::Eye& eye,
                                           std::uint64_t budget, const bend::BendOptions& options, const Executor& executor, const Progress& progress = {});

}  // namespace orbc::driver
