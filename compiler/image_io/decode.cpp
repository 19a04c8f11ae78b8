#include "compiler/image_io/decode.h"

#include <fmt/core.h>

#include "compiler/files/files.h"
#include "compiler/image_io/bmp_tga.h"
#include "compiler/image_io/jpeg.h"
#include "compiler/image_io/png.h"
#include "compiler/image_io/tiff.h"
#include "compiler/image_io/webp.h"

namespace orbc::image_io {

namespace {

/// What a picture of a kind that is not read is called.
std::string format_name(std::string_view bytes) {
  const auto starts_at = [&](std::size_t at, std::string_view mark) { return bytes.size() > at && bytes.substr(at, mark.size()) == mark; };
  if (starts_at(0, "GIF")) return "a GIF";
  if (starts_at(0, "DDS ")) return "a DDS picture";
  if (starts_at(1, "KTX ")) return "a KTX picture";
  if (starts_at(0, "8BPS")) return "a Photoshop document";
  if (starts_at(0, "#?RADIANCE")) return "a Radiance HDR picture";
  if (starts_at(4, "ftypavif")) return "an AVIF picture";
  return "neither a PNG nor a JPEG picture";
}

}  // namespace

Diagnostic bad_image(const std::string& name, const std::string& what) {
  return make_error("mesh.bad-image", fmt::format("{}: {}", name, what), "PNG, JPEG, WebP, TIFF, BMP and TGA pictures are read");
}

Diagnostics check_size(std::uint64_t width, std::uint64_t height, const std::string& name, const ImageLimits& limits) {
  const auto side = static_cast<std::uint64_t>(limits.max_side);
  if (width > 0 && height > 0 && width <= side && height <= side && width * height * 4 <= limits.max_bytes) return {};
  if (width == 0 || height == 0) return {bad_image(name, "the picture is empty")};
  return {make_error(
      "mesh.image-too-big",
      fmt::format("{}: {} × {} pixels; at most {} a side and {} MB in all are read", name, width, height, side, limits.max_bytes >> 20),
      "make the picture smaller")};
}

Result<image::Image> load_image(const std::string& path, const ImageLimits& limits) {
  auto bytes = files::read_file(path, std::uint64_t{1} << 30);
  if (!bytes) return std::move(bytes).error();
  return decode_image(*bytes, path, limits);
}

Result<image::Image> decode_image(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  if (is_png(bytes)) return decode_png(bytes, name, limits);
  if (is_jpeg(bytes)) return decode_jpeg(bytes, name, limits);
  if (is_webp(bytes)) return decode_webp(bytes, name, limits);
  if (is_tiff(bytes)) return decode_tiff(bytes, name, limits);
  if (is_bmp_or_tga(bytes, name)) return decode_bmp_or_tga(bytes, name, limits);
  return bad_image(name, bytes.empty() ? "the picture is empty" : "it is " + format_name(bytes));
}

}  // namespace orbc::image_io
