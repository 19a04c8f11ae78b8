#pragma once
#include <cstdint>
#include <vector>

#include "compiler/bend/bend.h"
#include "compiler/driver/open.h"

namespace orbc::driver {

/// What lies beyond the mirrors at which paths are cut off.
struct Beyond {
  double weight_lost = 0;   ///< largest channel of the weight at the cut-off, mean over the picture
  scene::Color color;       ///< radiance that is expected there; the scene's background where nothing is cut off
};

/// Looks beyond the cut-off: follows a fixed grid of rays of the picture through the real mirrors, those that are cut off much deeper.
/// Makes: color = Σ (radiance the deep paths bring to the eye) / Σ (their weights at the cut-off), channel by channel: with it in place of what is cut off
///        the grid's mean is right. The same for any executor. Without `with_color` only the weight.
/// Error: that of kColumns × kRows rays; light that surfaces pass on to each other is left out.
[[nodiscard]] Beyond look_beyond(const Opened& opened, bool with_color, const Executor& executor);

/// A panel of one look in each mirror (parallel to the room's): what is drawn where nothing lies behind it.
[[nodiscard]] std::vector<place::PlacedMesh> curtains(const place::PlacedRoom& room, std::uint16_t look);

/// Of each mirror of the room whether paths are cut off at it in a copy: where the tracer would not reflect. Walls that face the eye are
/// never drawn, and may be among them.
[[nodiscard]] std::vector<bool> cut_mirrors(const place::PlacedRoom& room, const scene::CoverSpec& spec, const cover::Copy& copy);

/// Adds the curtains to the models of the copies that need them. `curtain`: parallel to the mirrors.
void hang(const place::PlacedRoom& room, const scene::CoverSpec& spec, const std::vector<cover::Copy>& copies, const std::vector<bend::Model::Part>& curtain,
          std::vector<bend::Model>& models, std::vector<std::uint32_t>& model_of_copy);

}  // namespace orbc::driver
