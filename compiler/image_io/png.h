#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/image/image.h"
#include "compiler/image_io/limits.h"

namespace orbc::image_io {

/// Whether the bytes begin as a PNG file does.
[[nodiscard]] bool is_png(std::string_view bytes);
/// Decodes a PNG picture. Diagnostics: as decode_image.
[[nodiscard]] Result<image::Image> decode_png(std::string_view bytes, const std::string& name, const ImageLimits& limits = {});

/// A picture of 16 bits a channel with alpha; width × height × 4 codes, rows from top to bottom. Codes of 8 bits are times 257.
struct DeepImage {
  int width = 0, height = 0;
  std::vector<std::uint16_t> rgba;
};
/// The codes of a PNG picture as they stand in the file, in as many bits as it has. Grey becomes RGB, a missing alpha 65535.
/// Diagnostics: as decode_image.
[[nodiscard]] Result<DeepImage> decode_deep_png(std::string_view bytes, const std::string& name, const ImageLimits& limits = {});

// Encoders. The same picture always gives the same bytes: no time stamp and no text is written. The picture must have pixels.

/// The picture as a PNG file of 8 bits a channel: RGB if it is opaque everywhere, RGBA otherwise.
[[nodiscard]] std::string encode_png(const image::Image& image);
/// The picture as a PNG file of 16 bits a channel, marked as sRGB: RGB, or RGBA with the alpha of `alpha`, a picture of the same size.
[[nodiscard]] std::string encode_png(const image::Image16& image, const image::Image* alpha = nullptr);
/// The alpha of the picture as a grey PNG file.
[[nodiscard]] std::string encode_alpha(const image::Image& image);

}  // namespace orbc::image_io
