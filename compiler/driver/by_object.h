#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/bend/bend.h"

namespace orbc::driver {

/// A cover whose copies are drawn object by object: each stands once for every object of which it shows something.
struct ByObject {
  std::vector<std::string> names;               ///< "floor", "wall 3", the scene's names, in the order of the room's parts
  std::vector<std::uint32_t> copy_of_entry;     ///< the entries of one object follow one another; those of the first object are all copies
  std::vector<std::uint32_t> object_of_entry;   ///< indices into `names`
};

/// Parts models by the objects that their meshes belong to.
/// In:    the room for the order of its parts; models, and which one each copy is drawn from.
/// Makes: the models parted, `model_of_copy` for every entry. What is drawn is the same triangles in another order.
[[nodiscard]] ByObject part_by_object(const place::Interior& room, std::vector<bend::Model>& models,
                                      std::vector<std::uint32_t>& model_of_copy);

}  // namespace orbc::driver
