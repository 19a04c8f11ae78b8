#pragma once
#include <string>

#include "exporters/gltf/json.h"
#include "exporters/gltf/layout.h"

namespace orbc::gltf {

/// Writes a primitive of a mesh: the accessors of a part, and its material. In: the part's index in the layout; the material's number.
void write_primitive(Json& json, const Layout& layout, std::size_t part, std::size_t material);

/// Writes the member `accessors`, part by part: position, then normal, uv and colour where the layout has them, then indices.
void write_accessors(Json& json, const Layout& layout);

/// Writes the members `bufferViews` and `buffers`. In: the name of the file of the one buffer; empty: it is in the GLB.
void write_buffers(Json& json, const Layout& layout, const std::string& bin_uri);

/// The number of the bufferView that holds the atlas, in a layout with one.
[[nodiscard]] int atlas_view(const Layout& layout);

}  // namespace orbc::gltf
