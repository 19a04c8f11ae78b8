#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/driver/appearance.h"

namespace orbc::driver {

/// What bending draws: copies, and the meshes and places in the atlas of each. Refers to the prepared scene and to the appearance.
/// Copies may stand in it several times, for some of their triangles each.
struct DrawList {
  std::vector<cover::Copy> copies;
  std::vector<bend::Model> models;
  std::vector<std::uint32_t> model_of_copy;
  std::vector<int> level_of_copy;               ///< the coarsest level of detail among its parts
  std::vector<native_lights::Shading> shading;  ///< per copy
  std::vector<std::string> objects;             ///< lists by object: "floor", "wall 3", the scene's names, in the order of parts
  std::vector<std::uint32_t> object_of_copy;    ///< lists by object: index into `objects`; the copies of an object follow one another
  std::vector<std::uint32_t> original_of_copy;  ///< lists by object: the first entry for the same copy, which may be the entry itself
  std::uint64_t impostors = 0;
};

/// The copies of a picture, each with its levels of detail, its highlights and its impostors. In: `copies` are those of `detail`.
[[nodiscard]] DrawList draw_list(const Job& job, std::vector<cover::Copy> copies, const Detail& detail, const Appearance& appearance);

/// Draws emissive triangles as copies of their own, behind the others: the renderer's lamps add nothing to them.
/// In: a list of the unlit copy of a scene.
[[nodiscard]] DrawList split_emissive_copies(const place::Interior& interior, DrawList list);

/// Draws the copies object by object. The same triangles in another order; a copy stands in the list once for each of its objects.
/// In: the interior and the panels for the order of objects.
[[nodiscard]] DrawList split_by_object(const place::Interior& interior, const std::vector<place::PlacedMesh>& panels, DrawList list);

}  // namespace orbc::driver
