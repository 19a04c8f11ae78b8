#pragma once
#include <string>
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/image/image.h"
#include "compiler/image_io/limits.h"

namespace orbc::image_io {

/// Whether the bytes begin as a TIFF file does.
[[nodiscard]] bool is_tiff(std::string_view bytes);
/// Decodes the first picture of a TIFF file as 8-bit RGBA. Diagnostics: as decode_image.
[[nodiscard]] Result<image::Image> decode_tiff(std::string_view bytes, const std::string& name, const ImageLimits& limits = {});

}  // namespace orbc::image_io
