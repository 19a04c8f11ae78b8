#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/base/result.h"
#include "compiler/cover/copy.h"
#include "compiler/place/eye.h"
#include "compiler/place/placed.h"

namespace orbc::bend {

enum class View { eye, disk };

struct BendOptions {
  View view = View::eye;
  double tolerance_px = 0.25;       ///< largest distance of a bent chord from the true curve, in pixels of the eye's picture; > 0
  double disk_tolerance = 1e-3;     ///< the same for View::disk, in chart length
  bool colours_vary = false;        ///< colours change inside triangles everywhere (baked light), not only where a part has a texture or a pattern
  double colour_tolerance = 4;      ///< how far such colours may shift within their surface, in units of the tolerance; > 0
  std::uint64_t max_triangles = 200'000'000;
};

/// Where one copy's vertices and triangles lie in the arrays of `BentCover`.
struct BentRange {
  std::size_t first_vertex = 0, vertex_count = 0;
  std::size_t first_index = 0, index_count = 0;
};

/// All copies, bent: eye coordinates (z up; the eye at (0, 0, z)), or chart × height for View::disk.
struct BentCover {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 2>> uv;
  std::vector<std::uint32_t> indices;       ///< absolute, three a triangle
  std::vector<BentRange> copies;            ///< parallel to the copies given
  double error_bound_px = 0;                ///< largest chord error in the picture (View::disk: in chart length), found or bounded edge by edge
  std::uint64_t split_parts = 0;            ///< how many parts of copies had to be split, for the report
};

/// Bends every copy of the room for the eye: splits edges until every chord lies within the tolerance of the true image, each edge judged
/// by itself so that neighbours agree, then maps the vertices by the log map.
/// Copies with a wedge are cut to it first, copies on other storeys lifted there (clip.h).
/// In:          parts of one room, with uv per vertex into the atlas (parallel to parts[i].floor); copies; the eye.
/// Makes:       the same bytes whatever the executor; walls that face the eye (`Copy::nearer_walls`) are left out, neighbours draw them.
/// Diagnostics: bend.too-dense when more than `max_triangles` would be needed; the hint names a tolerance that fits.
/// Not promised: a minimal triangle count.
[[nodiscard]] Result<BentCover> bend(const place::PlacedRoom& room, const std::vector<std::vector<std::array<float, 2>>>& atlas_uv,
                                     const std::vector<cover::Copy>& copies, const place::Eye& eye, const BendOptions& options,
                                     const Executor& executor, const Progress& progress = {});

}  // namespace orbc::bend
