#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/rational.h"
#include "compiler/base/result.h"
#include "compiler/place/eye.h"
#include "compiler/place/placed.h"

namespace orbc::cover {

struct PlanOptions {
  std::uint64_t max_bytes = std::uint64_t{4} << 30;
};

/// What unfolding a scene will make, before it is made; what bending adds by splitting is not in it: bend.too-dense guards that.
struct Plan {
  Integer copies;                           ///< exact
  std::vector<Integer> copies_per_bounces;  ///< 0 … the last bounce that has copies
  int sheets = 1;
  std::uint64_t room_triangles = 0, room_vertices = 0;    ///< of one copy
  std::uint64_t triangles = 0, vertices = 0, bytes = 0;   ///< of all copies unsplit, walls that neighbours share counted twice
};

/// Plans a scene: how many copies, triangles, bytes.
/// Makes:       the number of copies from the growth series, or counted one by one where sizes or plain walls cut the group; copies that need beams are unfolded once.
/// Exact:       copies. Bytes: 20 a vertex, 12 a triangle, 200 a copy, before any split.
/// Diagnostics: those of `unfold`; cover.too-much when the product would exceed `max_bytes`: the hint names the largest max_bounces that fits.
[[nodiscard]] Result<Plan> plan(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec, const PlanOptions& options = {});

/// The error of a cover with more than `most` copies.
[[nodiscard]] Diagnostic too_many_copies(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec, std::uint64_t most);

}  // namespace orbc::cover
