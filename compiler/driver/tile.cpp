#include "compiler/cover/unfold.h"
#include "compiler/driver/compile.h"
#include "compiler/driver/unit_of_length.h"
#include "compiler/notation/print.h"

namespace orbc::driver {

Result<Tiling> tile(const LoadedScene& scene, Tiling::Model model, Tiling::Coloring coloring) {
  auto copies = cover::unfold(*scene.interior, scene.eye, scene.scene.cover);
  if (!copies) return located(copies.error(), scene.scene.span);
  std::vector<cover::Copy> first_sheet;
  for (cover::Copy& copy : *copies)
    if (copy.sheet == 0 && copy.storey.number == 0) first_sheet.push_back(std::move(copy));
  Tiling tiling{
      notation::to_text(scene.scene.orbifold), scene.interior->polygon, std::move(first_sheet), model, coloring, scene.eye.room_from_eye};
  return in_author_unit(std::move(tiling), scene.unit_of_length);
}

}  // namespace orbc::driver
