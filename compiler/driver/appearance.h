#pragma once
#include <vector>

#include "compiler/bake/view_dependent.h"
#include "compiler/driver/detail.h"

namespace orbc::driver {

/// The colors of a picture's copies: one atlas, and places in it.
struct Appearance {
  image::Image image;
  image::Image16 image16;                 ///< where the scene asks for 16 bits a channel
  std::vector<bend::Uv> uv;               ///< per mesh of DrawnSurfaces; those of levels that are not drawn may be empty
  std::vector<place::PlacedMesh> panels;  ///< the impostors of PicturePanels, those of `depth` first
  std::vector<bend::Uv> panel_uv;         ///< parallel
  std::vector<bake::CopyUv> copy_uv;      ///< places of single copies, instead of those in `uv`; by copy, then by part
  bake::ViewBakeCounts view_counts;
  double first_dimmed_v = 2;  ///< as in bake::ViewBake
};

/// Gathers the atlas of a picture: the diffuse bake of what is drawn, or plain colors; the colors of impostors; highlights for the eye.
/// Diagnostics: light.atlas-too-large.
[[nodiscard]] Result<Appearance> make_appearance(const Job& job, const Detail& detail, const cutoff::CutoffEstimate& endings);

/// Meshes without colors, on which no triangle depends: for plans.
[[nodiscard]] Result<Appearance> without_colors(const Job& job, const Detail& detail);

}  // namespace orbc::driver
