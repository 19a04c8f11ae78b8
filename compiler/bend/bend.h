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

/// Places in the atlas, one for each vertex of a part.
using Uv = std::vector<std::array<float, 2>>;

/// What copies are drawn from: parts of the room with their places in the atlas. Copies may share a model, models may share meshes and uv
/// (what is prepared for a mesh is prepared once); so a copy may have coarser parts (level of detail) or colours of its own (what depends
/// on the eye).
struct Model {
  struct Part {
    const place::PlacedMesh* mesh = nullptr;
    const Uv* uv = nullptr;
    /// Its triangles are drawn as they are, with straight edges between their vertices' true images: for what only hides
    bool flat = false;
  };
  std::vector<Part> parts;
};
/// All parts of a room. In: uv parallel to its parts; both must outlive the model.
[[nodiscard]] Model whole_model(const place::PlacedRoom& room, const std::vector<Uv>& uv);

struct BendOptions {
  View view = View::eye;
  /// Largest distance of a bent chord from the true curve, sideways or in depth, as the eye sees it: pixels of its picture; > 0
  double tolerance_px = 0.25;
  double disk_tolerance = 1e-3;     ///< the same for View::disk, in chart length
  /// Colours change inside triangles everywhere (baked light), not only where a part has a texture or a pattern
  bool colours_vary = false;
  double colour_tolerance = 4;      ///< how far such colours may shift within their surface, in units of the tolerance; > 0
  std::uint64_t max_triangles = 200'000'000;
  bool advise = true;               ///< when that is exceeded, look for a tolerance that fits
  double message_factor = 1;        ///< messages name tolerances times this: the caller's own tolerance, of which this is a share
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
  /// Largest chord error in the picture (View::disk: in chart length), found or bounded edge by edge
  double error_bound_px = 0;
  std::uint64_t split_parts = 0;            ///< how many parts of copies had to be split, for the report
};

/// Bends every copy of the room for the eye: splits edges until every chord lies within the tolerance of the true image, each edge judged
/// by itself so that neighbours agree, then maps the vertices by the log map. Copies on other storeys are lifted there first. Copies with a
/// wedge are cut to it: for the eye last (cut_as_seen.h), for View::disk first (clip.h).
/// In:          the room for its space and looks; models, and which one each copy is drawn from (empty: all from the first); uv parallel to
///              their mesh's vertices; copies; the eye.
/// Makes:       the same bytes whatever the executor; walls that face the eye (`Copy::nearer_walls`) are left out, neighbours draw them.
/// Diagnostics: bend.too-dense when more than `max_triangles` would be needed; the hint names a tolerance that fits.
/// Not promised: a minimal triangle count.
[[nodiscard]] Result<BentCover> bend(const place::PlacedRoom& room, const std::vector<Model>& models,
                                     const std::vector<std::uint32_t>& model_of_copy, const std::vector<cover::Copy>& copies,
                                     const place::Eye& eye, const BendOptions& options, const Executor& executor,
                                     const Progress& progress = {});
/// All copies from one model: the room itself.
[[nodiscard]] Result<BentCover> bend(const place::PlacedRoom& room, const std::vector<Uv>& atlas_uv, const std::vector<cover::Copy>& copies,
                                     const place::Eye& eye, const BendOptions& options, const Executor& executor,
                                     const Progress& progress = {});

}  // namespace orbc::bend
