#pragma once
#include "compiler/mesh/asset_source.h"
#include "compiler/place/panels.h"
#include "compiler/place/place.h"

namespace orbc::place {

struct FurnishOptions {
  EmbedOptions embed;
  PanelOptions panels;
};

/// A furnished room and what its author should know about it.
struct Furnished {
  PlacedRoom room;
  Diagnostics warnings;
};

/// Furnishes a realised room: mirrors, panels, frames, objects; asks `assets` for the meshes and pictures that the scene names.
/// Makes:       parts in the order floor, ceiling, walls, frames, objects (as the scene lists them). Mirrors in the order of the walls and,
///              on one wall, of the scene; where two overlap the first listed counts. End walls of a strip carry no mirrors. Looks of
///              textured triangles have their uv in [0, 1]².
/// Diagnostics: all errors of all objects together: those of `locate`, `place_object`, `make_panels`, `make_beam`, `wrapped`, of mesh
///              loading and pictures; place.too-many-looks. Warnings: place.mirror-outside-wall, place.no-uv, and the mesh's own.
[[nodiscard]] Result<Furnished> furnish(const scene::Scene& scene, const room::Room& room,
                                        const mesh::AssetSource& assets = mesh::no_assets(), const FurnishOptions& options = {});

/// The mirrors of all surfaces, clipped to their walls; what has nothing left of it is left out with a warning.
struct ClippedMirrors {
  std::vector<PlacedMirror> mirrors;
  std::vector<const scene::Mirror*> sources;    ///< parallel to `mirrors`: the author's words, in the scene given
  Diagnostics warnings;
};
[[nodiscard]] ClippedMirrors clipped_mirrors(const scene::RoomSpec& spec, const room::Room& room);

}  // namespace orbc::place
