#pragma once
#include <vector>

#include "compiler/bake/patch_texels.h"
#include "compiler/bake/unfolded_eye.h"
#include "compiler/bake/view_dependent.h"

namespace orbc::bake {

/// A part of a copy as the eye sees it.
struct ViewPart {
  const ViewBakeInput& input;
  const ViewBakeOptions& options;
  const surface::PartNormals& normals;
  const cover::Copy& copy;
  std::size_t part = 0;
  UnfoldedEye eye;  ///< of the copy
  double pixels_per_radian = 0;
  double surface_offset = 0;  ///< see DrawnParts
};

/// The texels of a patch in one copy.
struct ViewPatch {
  std::size_t patch = 0;  ///< index among the patches of the part
  PatchTexels texels;
};

/// Bakes those patches of a part in a copy in which the eye sees a highlight or specular material.
[[nodiscard]] std::vector<ViewPatch> bake_view_part(const ViewPart& part, const Progress& progress);

}  // namespace orbc::bake
