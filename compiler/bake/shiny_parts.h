#pragma once
#include <vector>

#include "compiler/bake/highlight_bake.h"

namespace orbc::bake {

/// A ball around a part: its nearest and farthest point tell how large it is in the picture.
struct Ball {
  geometry::Position centre;
  double radius = 0;
};

/// A part whose light depends on the eye.
struct ShinyPart {
  std::size_t part = 0;
  Ball ball;
  double smallest_px = 0;      ///< smaller in the picture it is not worth light of its own
  surface::PartNormals own;    ///< of parts that the field does not know
  std::vector<bool> in_model;  ///< which models have it; empty: all
};

/// Whether a material shows highlights of lamps over its diffuse light. Metals show them with the room, as a whole.
[[nodiscard]] bool shines(const scene::Material& material);

/// In: whether one can ask what is seen in mirrors, glass and metals.
[[nodiscard]] std::vector<ShinyPart> shiny_parts(const place::PlacedRoom& room, const light::LightingContext& lighting,
                                                 const DrawnParts& drawn, bool seen_in);

}  // namespace orbc::bake
