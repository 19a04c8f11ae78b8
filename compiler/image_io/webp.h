#pragma once
#include <string>
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/image/image.h"
#include "compiler/image_io/limits.h"

namespace orbc::image_io {

/// Whether the bytes begin as a WebP file does.
[[nodiscard]] bool is_webp(std::string_view bytes);
/// Decodes a WebP picture; of an animation nothing. Diagnostics: as decode_image.
[[nodiscard]] Result<image::Image> decode_webp(std::string_view bytes, const std::string& name, const ImageLimits& limits = {});

}  // namespace orbc::image_io
