#pragma once
#include <string>
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/image/image.h"
#include "compiler/image_io/limits.h"

namespace orbc::image_io {

/// Whether the bytes begin as a JPEG file does.
[[nodiscard]] bool is_jpeg(std::string_view bytes);
/// Decodes a JPEG picture: grey, RGB or CMYK. Diagnostics: as decode_image.
[[nodiscard]] Result<image::Image> decode_jpeg(std::string_view bytes, const std::string& name, const ImageLimits& limits = {});

/// The picture as a baseline JPEG file without alpha, its colours not subsampled. In: a quality of 1 to 100.
/// Makes: the same bytes for the same picture.
[[nodiscard]] std::string encode_jpeg(const image::Image& image, int quality = 92);

}  // namespace orbc::image_io
