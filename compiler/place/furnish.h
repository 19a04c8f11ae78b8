#pragma once
#include "compiler/mesh/asset_source.h"
#include "compiler/place/panels.h"
#include "compiler/place/embed.h"

namespace orbc::place {

struct FurnishOptions {
  EmbedOptions embed;
  PanelOptions panels;
};

/// A furnished room, and warnings to its author.
struct Furnished {
  Interior interior;
  Diagnostics warnings;
};

/// Furnishes a realised room with mirrors, panels, frames and objects; `assets` loads the meshes and images that the scene names.
/// Makes:       parts in the order floor, ceiling, walls, frames, objects (as the scene lists them). Mirrors in the order of the walls and,
///              on one wall, of the scene; where two overlap the first counts. End walls of a strip have no mirrors. Textured triangles
///              have their uv in [0, 1]².
/// Diagnostics: all errors of all objects together: those of `locate`, `place_object`, `make_panels`, `make_bar`, `cut_at_uv_repeats`, of
/// mesh
///              loading and images; place.too-many-looks. Warnings: place.mirror-outside-wall, place.no-uv, and the mesh's own.
[[nodiscard]] Result<Furnished> furnish(const scene::Scene& scene, const room::Room& room,
                                        const mesh::AssetSource& assets = mesh::no_assets(), const FurnishOptions& options = {});

/// The mirrors of all walls, clipped to their walls, and those of floor and ceiling. Mirrors outside of their wall are left out with a
/// warning.
struct ClippedMirrors {
  std::vector<PlacedMirror> mirrors;
  std::vector<const scene::Mirror*> sources;    ///< parallel to `mirrors`; pointers into the scene
  Diagnostics warnings;
};
[[nodiscard]] ClippedMirrors clipped_mirrors(const scene::RoomSpec& spec, const room::Room& room);

}  // namespace orbc::place
