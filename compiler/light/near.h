#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/geometry/point.h"

namespace orbc::light {

struct LightField;

/// Which images matter where: a grid of cells over the room. In H² and E² most images give most points nothing that shows.
struct NearImages {
  double reach = 0, height = 0;     ///< of the room: in the disk chart, and upwards
  int across = 0, up = 0;           ///< cells; none: there is one list for all of the room
  std::vector<std::vector<std::uint32_t>> images = std::vector<std::vector<std::uint32_t>>(1);   ///< per cell
};
[[nodiscard]] NearImages near_images(const LightField& field, const Executor& executor);

/// The images that can give anything at a position: light of LightOptions::cut or a highlight of it.
[[nodiscard]] const std::vector<std::uint32_t>& images_at(const LightField& field, const geometry::Position& at);

}  // namespace orbc::light
