#pragma once
#include <vector>

#include "compiler/driver/product.h"
#include "exporters/gltf/json.h"

namespace orbc::gltf {

/// The lamps of the product that are no image of another copy's.
[[nodiscard]] std::vector<native_lights::NativeLamp> own_lamps(const driver::Product& product);

/// Writes the root's extension KHR_lights_punctual: points and cones, in candela. A white surface, face on at distance r, is to show
/// intensity/r²: that is I/(π r²) of a radiant intensity I, and at 683 lm/W, as Blender takes it, 683·π candela for each. Plates become the
/// widest cones there are.
void write_lights(Json& json, const std::vector<native_lights::NativeLamp>& lamps);

/// Writes the node of a lamp, an element of `nodes`. In: its number among those of `write_lights`. A lamp shines along its −z.
void write_lamp_node(Json& json, const native_lights::NativeLamp& lamp, std::size_t number);

}  // namespace orbc::gltf
