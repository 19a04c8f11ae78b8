#pragma once
#include <string>
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/image/image.h"
#include "compiler/image_io/limits.h"

namespace orbc::image_io {

/// Whether it is a BMP by its first bytes, or a TGA by its last bytes or the ending of its name: older ones have no mark.
[[nodiscard]] bool is_bmp_or_tga(std::string_view bytes, const std::string& name);
/// Decodes a BMP or TGA picture. Diagnostics: as decode_image.
[[nodiscard]] Result<image::Image> decode_bmp_or_tga(std::string_view bytes, const std::string& name, const ImageLimits& limits = {});

}  // namespace orbc::image_io
