#pragma once
#include "compiler/driver/draw_list.h"
#include "compiler/native_lights/normals.h"

namespace orbc::driver {

/// All stages of a picture, before they become a product.
struct Drawing {
  Detail detail;
  cutoff::CutoffEstimate endings;
  Appearance appearance;
  DrawList list;         ///< refers to `appearance`
  bend::BentCover bent;  ///< of `list`
};

/// Puts the stages together. Scenes with native lights get lamps and normals; all products the scale that renderers need
/// (renderer_scale.h).
/// Diagnostics: driver.too-many-lamps; those of scale_for_renderers and place_native_lights, as notes.
[[nodiscard]] Result<Compiled> assemble(const Job& job, Drawing drawing);

}  // namespace orbc::driver
