#pragma once
#include <string>
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/image/image.h"

namespace orbc::image_io {

/// Whether the bytes begin as an OpenEXR file does.
[[nodiscard]] bool is_exr(std::string_view bytes);
/// Decodes all channels of an OpenEXR file as floats.
/// Diagnostics: mesh.bad-image when the file is not OpenEXR, damaged, subsampled or deep, or has more than 16384 pixels a side or 2 GiB of
///              values. Its message is the reason alone: the caller names the file.
[[nodiscard]] Result<image::FloatImage> decode_exr(std::string_view bytes);

/// The channels as an OpenEXR file of 32-bit floats. Makes: the same bytes for the same picture.
[[nodiscard]] std::string encode_exr(const image::FloatImage& image);
/// The picture in linear light as an OpenEXR file of half floats, which keep 11 bits of every channel. Makes: the same bytes for the same
/// picture.
[[nodiscard]] std::string encode_exr(const image::Image16& image);

}  // namespace orbc::image_io
