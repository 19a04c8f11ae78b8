#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/rational.h"
#include "compiler/base/result.h"
#include "compiler/cover/copy.h"
#include "compiler/place/eye.h"
#include "compiler/place/placed.h"

namespace orbc::cover {

struct PlanOptions {
  /// Each copy takes kBytesPerCopy at least; its triangles are foreseen by driver/estimate.h
  std::uint64_t max_bytes = std::uint64_t{4} << 30;
};

/// What a product takes, without the pictures.
constexpr double kBytesPerVertex = 20, kBytesPerTriangle = 12, kBytesPerCopy = 200;

/// What a beam takes while copies are unfolded by beams: the beam, what it sees, the copy it becomes (measured: 480).
constexpr double kBytesPerBeam = 500;

/// What compiling a scene will make. Of the cover alone (here) every copy counts with all triangles of the room, unsplit; what bending
/// really makes of the copies is foreseen by driver/estimate.h.
struct Plan {
  Integer copies;                           ///< exact
  std::vector<Integer> copies_per_bounces;  ///< 0 … the last bounce that has copies
  int sheets = 1;
  std::uint64_t room_triangles = 0, room_vertices = 0;    ///< of one copy
  std::uint64_t triangles = 0, vertices = 0, bytes = 0;   ///< of all copies; bytes are those of memory
  std::vector<std::uint64_t> triangles_per_bounces, vertices_per_bounces;   ///< as far as they are foreseen
};

/// Plans a scene before it is unfolded: how many copies.
/// Makes:       the number of copies from the growth series, or counted one by one where sizes or plain walls cut the group; copies that
///              need beams are unfolded once.
/// Exact:       copies.
/// Diagnostics: those of `unfold`; cover.too-much when the copies alone would exceed `max_bytes`: the hint names
///              the largest max_bounces that fits.
[[nodiscard]] Result<Plan> plan(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec,
                                const PlanOptions& options = {});

/// The same of copies that are unfolded already.
[[nodiscard]] Plan plan_of(const std::vector<Copy>& copies, const place::PlacedRoom& room);

/// The error of a cover with more than `most` copies.
[[nodiscard]] Diagnostic too_many_copies(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec,
                                         std::uint64_t most);

}  // namespace orbc::cover
