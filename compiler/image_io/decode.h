#pragma once
#include <string>
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/image/image.h"
#include "compiler/image_io/limits.h"

namespace orbc::image_io {

/// Reads a PNG, JPEG, WebP, TIFF, BMP or TGA file as 8-bit sRGB RGBA. The format is recognised by the first bytes, whatever the file is
/// called; only of an old TGA by its name.
/// Makes:        grey becomes RGB, a missing alpha 255; codes are sRGB whatever the file says of its gamma; 16 bits become 8.
/// Diagnostics:  mesh.missing-file, mesh.not-a-file, mesh.image-too-big, mesh.bad-image.
[[nodiscard]] Result<image::Image> load_image(const std::string& path, const ImageLimits& limits = {});

/// Decodes a picture in memory, as load_image does; `name` is what diagnostics call it.
/// Diagnostics:  mesh.image-too-big, mesh.bad-image.
[[nodiscard]] Result<image::Image> decode_image(std::string_view bytes, const std::string& name, const ImageLimits& limits = {});

}  // namespace orbc::image_io
