#pragma once
#include <cstddef>
#include <cstdint>
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

/// What copies are drawn from: a room, and which meshes stand for its parts.
struct Contents {
  const place::PlacedRoom* room = nullptr;
  std::vector<std::vector<const place::PlacedMesh*>> models;
  std::vector<std::uint32_t> model_of_copy;   ///< empty: all are drawn from the first
};
/// Every copy with all parts of the room as they are.
[[nodiscard]] Contents contents_of(const place::PlacedRoom& room);

/// Picks about `most` copies that stand for all: a sum over all copies is about Σ stands_for · (value of the sample).
/// Makes:       the copies nearest to the eye one by one (they are bent the most), of the others some at every distance; what shows more
///              triangles of its model is picked sooner. The same for the same copies: nothing is drawn by lot.
[[nodiscard]] std::vector<Sample> sample_of(const std::vector<Copy>& copies, const Contents& contents, const place::Eye& eye,
                                            std::size_t most);

}  // namespace orbc::cover
