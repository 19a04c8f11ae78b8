#pragma once
#include <cstddef>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/place/eye.h"
#include "compiler/place/placed.h"

namespace orbc::cover {

/// A copy that is looked at instead of many.
struct Sample {
  std::size_t copy = 0;
  double stands_for = 1;            ///< itself included
};

/// Picks about `most` copies that stand for all: a sum over all copies is about Σ stands_for · (value of the sample).
/// Makes:       the copies nearest to the eye one by one (they are bent the most), of the others some at every distance; what shows more
///              triangles of its parts is picked sooner. The same for the same copies: nothing is drawn by lot.
[[nodiscard]] std::vector<Sample> sample_of(const std::vector<Copy>& copies, const place::PlacedRoom& room, const place::Eye& eye,
                                            std::size_t most);

}  // namespace orbc::cover
