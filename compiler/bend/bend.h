#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/base/result.h"
#include "compiler/cover/copy.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"

namespace orbc::bend {

/// How the curved space is mapped: eye coordinates of the log map, or the conformal disk chart times the height.
enum class View { eye, disk };

/// Texture coordinates in the atlas, one pair for each vertex of a part.
using Uv = std::vector<std::array<float, 2>>;

/// The meshes that a copy is drawn from. Models may share meshes, each of which is prepared once. So copies may have levels of detail of
/// their own, or texture coordinates of their own where colours depend on the eye.
struct Model {
  struct Part {
    const place::PlacedMesh* mesh = nullptr;
    const Uv* uv = nullptr;  ///< parallel to the mesh's vertices
    bool unsplit = false;    ///< triangles are not split: their edges are straight between the vertices' true images
  };
  std::vector<Part> parts;
};
/// All parts of a room. In: uv parallel to its parts; both must outlive the model.
[[nodiscard]] Model whole_model(const place::Interior& room, const std::vector<Uv>& uv);

/// The input of bend(): copies, and the model that each is drawn from.
struct DrawList {
  std::span<const cover::Copy> copies;
  std::span<const Model> models;
  std::span<const std::uint32_t> model_of_copy;  ///< parallel to copies; empty: all are drawn from the first model
};

struct BendOptions {
  View view = View::eye;
  /// View::eye: the largest distance of a chord from the true curve, sideways or in depth, in pixels of the eye's picture; > 0
  double tolerance_px = 0.25;
  double disk_tolerance = 1e-3;  ///< View::disk: the same, in chart length; > 0
  double chart_scale = 1;        ///< View::disk: what the chart is multiplied by, but not the height
  /// View::disk: an eye in the scaled chart, for whose straight rays `tolerance_px` holds instead of `disk_tolerance`
  std::optional<geometry::Vector3> chart_eye = std::nullopt;
  /// Whether colours change inside of all triangles (baked light), not only where a part has a texture or a pattern
  bool colors_vary = false;
  double color_tolerance = 4;  ///< how far such colours may shift within their surface, in units of the tolerance; > 0
  std::uint64_t max_triangles = 200'000'000;
  bool advise = true;         ///< beyond that, search for a tolerance that fits
  double message_factor = 1;  ///< messages give tolerances times this: the caller's tolerance, of which this one is a part
};

/// Where the vertices and triangles of one copy are in the arrays of `BentCover`.
struct BentRange {
  std::size_t first_vertex = 0, vertex_count = 0;
  std::size_t first_index = 0, index_count = 0;
};

/// All copies, bent: eye coordinates (z up; the eye at (0, 0, z)), or chart × height for View::disk.
struct BentCover {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 2>> uv;
  std::vector<std::uint32_t> indices;  ///< absolute, three for a triangle
  std::vector<BentRange> copies;       ///< parallel to the given copies
  double error_bound_px = 0;           ///< an upper bound of the chord errors in the picture (View::disk: in chart length)
  std::uint64_t split_parts = 0;       ///< number of parts of copies that had to be split
};

/// Bends every copy of a room: moves it to its storey, splits edges until every chord is within the tolerance of the true image, and maps
/// the vertices. Each edge is judged by itself, so that neighbours agree. Copies with a wedge are clipped to it: for View::eye at last
/// (clip_in_eye_space.h), for View::disk at first (clip.h).
/// In:          the room for its space and its looks.
/// Makes:       the same bytes for every executor. Walls that face the eye (Copy::eye_facing_walls) are left out: the copies across draw
///              them.
/// Diagnostics: bend.too-dense when more than `max_triangles` would be needed; the hint names a tolerance that fits.
/// Not promised: a minimal triangle count.
[[nodiscard]] Result<BentCover> bend(const place::Interior& room, const DrawList& list, const place::Camera& eye,
                                     const BendOptions& options, const Executor& executor, const Progress& progress = {});

}  // namespace orbc::bend
