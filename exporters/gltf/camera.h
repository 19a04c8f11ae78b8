#pragma once
#include "compiler/driver/product.h"
#include "exporters/gltf/json.h"

namespace orbc::gltf {

/// Writes the member `cameras`: the product's one. What glTF has no camera for gets the nearest perspective one; its extras
/// (`orbc_projection`, `orbc_width`, `orbc_height`, `orbc_fov_deg`, `orbc_background`, `orbc_scale`) are exact.
void write_camera(Json& json, const driver::Product& product);

/// Writes the node of the camera, an element of `nodes`. The camera looks along its −z.
void write_camera_node(Json& json, const driver::Product& product);

}  // namespace orbc::gltf
