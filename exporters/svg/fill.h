#pragma once
#include <vector>

#include "compiler/base/diagnostic.h"
#include "compiler/cover/copy.h"
#include "exporters/svg/page.h"

namespace orbc::svg {

struct FillOptions {
  double smallest = 1;  ///< page units: narrower copies are left out
  std::size_t max_copies = 100'000;
};

struct Filled {
  std::vector<cover::Copy> copies;  ///< by word length, then as they come
  Diagnostics notes;                ///< svg.copies-left-out, when max_copies are not enough
};

/// The copies of a room that are seen on a page.
/// In:    an orbifold's room.
/// Makes: all copies of at least `smallest` units. In E² and H² what lies behind a mirror is passed over when all of it is too small or
///        outside the window; in H² the half-plane behind a line (w, l) spans 2/√(1 + w²) of the disk.
[[nodiscard]] Filled fill(const room::Room& room, const Page& page, const FillOptions& options = {});

}  // namespace orbc::svg
