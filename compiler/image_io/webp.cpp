// WebP by libwebp.
#include "compiler/image_io/webp.h"

#include <webp/decode.h>

#include <cstdint>

namespace orbc::image_io {

bool is_webp(std::string_view bytes) { return bytes.substr(0, 4) == "RIFF" && bytes.size() >= 12 && bytes.substr(8, 4) == "WEBP"; }

Result<image::Image> decode_webp(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK) return bad_image(name, "the WebP picture is damaged");
  if (features.has_animation) return bad_image(name, "it is an animated WebP");
  const auto width = static_cast<std::uint64_t>(features.width), height = static_cast<std::uint64_t>(features.height);
  if (auto wrong = check_size(width, height, name, limits); !wrong.empty()) return wrong;
  image::Image image{features.width, features.height, std::vector<std::uint8_t>(4 * width * height)};
  if (!WebPDecodeRGBAInto(data, bytes.size(), image.rgba.data(), image.rgba.size(), 4 * features.width))
    return bad_image(name, "the WebP picture is damaged");
  return image;
}

}  // namespace orbc::image_io
