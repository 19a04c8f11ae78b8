#pragma once
#include <string>
#include <vector>

#include "compiler/bake/atlas.h"
#include "compiler/bake/bake_options.h"
#include "compiler/bake/diffuse_texels.h"
#include "compiler/bake/patches.h"
#include "compiler/bake/rect_packing.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/base/result.h"

namespace orbc::bake {

/// Baked parts in one picture.
struct DiffuseBake {
  Atlas atlas;
  BakeCounts counts;
  std::vector<std::vector<TexelPatch>> patches;  ///< per part
  std::vector<std::vector<TexelRect>> rects;     ///< of each patch: its place in the atlas
  std::vector<std::map<std::size_t, PatchTexels>> above_white;  ///< per part, as in PartTexels
};

/// A part whose patches share no vertices. Its vertices stand patch by patch: corners 00, 10, 01 and, of pairs, 11.
[[nodiscard]] place::PlacedMesh split_by_patch(const place::PlacedMesh& part, const std::vector<TexelPatch>& patches);

/// A part that may get a place in an atlas.
struct PartToPack {
  const std::string* name = nullptr;
  const std::vector<TexelPatch>* patches = nullptr;  ///< null: it gets none
  const PartTexels* texels = nullptr;
};

/// Packs the texels of parts into one picture.
/// Makes:       lists parallel to `parts`; those of parts without a place are empty. Atlas::uv are the places of the vertices of
///              split_by_patch; Atlas::room stays empty.
/// Diagnostics: light.atlas-too-large; the hint names what makes it smaller.
[[nodiscard]] Result<DiffuseBake> pack_texels(const std::vector<PartToPack>& parts, const BakeOptions& options);

/// Bakes a room, as bake_texels does, and packs all of its parts. Makes: an atlas with the room, its parts split by patch.
/// Diagnostics: light.atlas-too-large.
[[nodiscard]] Result<DiffuseBake> bake_diffuse(const place::Interior& interior, const light::LightingContext& lighting,
                                               const BakeOptions& options, const Executor& executor, const Progress& progress = {});

}  // namespace orbc::bake
