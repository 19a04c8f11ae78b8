#pragma once
#include "compiler/bake/view_dependent.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/bend/bend.h"
#include "compiler/driver/open.h"

namespace orbc::driver {

struct PaintOptions {
  /// Of glossy surfaces, and what is seen in mirror, glass and metal objects, for this eye; false: diffuse light alone
  bool highlights = true;
  int max_side = 16384;       ///< pixels of the atlas
  bool with_image16 = false;  ///< 16 bits a channel as well
  bool lit = true;            ///< false: only what triangles and vertices become of it, in plain colours
};

/// The colours of a cover: the room in its atlas, and what copies have of their own.
struct Painted {
  bake::Atlas atlas;
  bool baked = false;                 ///< light was worked out: colours vary everywhere
  std::vector<bake::CopyUv> copy_uv;  ///< of copies that show highlights of their own
  bake::ViewBakeCounts view_counts;
};

/// Plain colours, or, in a scene with lamps, the light of the room, and highlights for the eye.
/// In:          the room to be painted: the opened one, perhaps with further parts (levels of detail), which cast no shadows; its copies,
///              and which parts they are drawn from.
/// Diagnostics: those of light.
[[nodiscard]] Result<Painted> paint(const Opened& opened, const place::Interior& room, const std::vector<cover::Copy>& copies,
                                    const bake::DrawnParts& drawn, const bake::BakeOptions& baking, const PaintOptions& options,
                                    const Executor& executor, const Progress& progress = {});

/// Gives copies with highlights of their own a model of their own: that of `model_of_copy`, with other places in the atlas for those of its
/// parts that are parts of `painted.atlas.room`. In: models that refer to it; it must outlive them.
void add_highlights(const Painted& painted, std::vector<bend::Model>& models, std::vector<std::uint32_t>& model_of_copy);

}  // namespace orbc::driver
