// Pictures by stb_image, in place of the libraries of compiler/image_io, which the page is built without. PNG, JPEG, BMP and TGA are read;
// of JPEG, codes may differ by a few steps from libjpeg's. PNG is written with other bytes than libpng's, which mean the same pixels.
#ifdef __EMSCRIPTEN__
#include <memory>
#include <stdexcept>

#include "compiler/base/check.h"
#include "compiler/image_io/bmp_tga.h"
#include "compiler/image_io/exr.h"
#include "compiler/image_io/jpeg.h"
#include "compiler/image_io/png.h"
#include "compiler/image_io/tiff.h"
#include "compiler/image_io/webp.h"

#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Weverything"
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace orbc::image_io {
namespace {

constexpr int kCompression = 8;  // of stb's deflate, which searches so many earlier places

Result<image::Image> decode(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels) || width < 0 || height < 0)
    return bad_image(name, "the picture is damaged");
  if (auto wrong = check_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), name, limits); !wrong.empty())
    return wrong;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(stbi_load_from_memory(data, size, &width, &height, &channels, 4),
                                                                    &stbi_image_free);
  if (!pixels) return bad_image(name, "the picture is damaged");
  const std::size_t count = std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return image::Image{width, height, std::vector<std::uint8_t>(pixels.get(), pixels.get() + count)};
}

void put_big_endian(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 255);
}

void put_chunk(std::string& out, const std::string& name_and_data) {
  put_big_endian(out, static_cast<std::uint32_t>(name_and_data.size() - 4));
  out += name_and_data;
  auto* data = reinterpret_cast<unsigned char*>(const_cast<char*>(name_and_data.data()));
  put_big_endian(out, stbiw__crc32(data, static_cast<int>(name_and_data.size())));
}

/// Rows of samples, each after the filter "Sub": the difference from the pixel to the left.
struct Rows {
  std::uint32_t width = 0, height = 0;
  int depth = 8;  ///< bits a channel
  std::size_t channels = 3;
  std::vector<std::uint8_t> bytes;  ///< without the filter
};

/// Source: Portable Network Graphics (ISO/IEC 15948), §5, §9 and §11.
std::string png_of(const Rows& rows) {
  const std::size_t pixel = rows.channels * static_cast<std::size_t>(rows.depth) / 8, line = pixel * rows.width;
  std::vector<std::uint8_t> filtered;
  filtered.reserve((line + 1) * rows.height);
  for (std::size_t y = 0; y < rows.height; ++y) {
    const std::uint8_t* row = rows.bytes.data() + y * line;
    filtered.push_back(1);
    for (std::size_t i = 0; i < line; ++i) filtered.push_back(static_cast<std::uint8_t>(row[i] - (i < pixel ? 0 : row[i - pixel])));
  }
  int size = 0;
  const std::unique_ptr<unsigned char, decltype(&free)> packed(
      stbi_zlib_compress(filtered.data(), static_cast<int>(filtered.size()), &size, kCompression), &free);
  if (!packed) throw std::runtime_error("cannot encode a PNG: no memory");
  std::string out("\x89PNG\r\n\x1a\n", 8), header = "IHDR";
  put_big_endian(header, rows.width);
  put_big_endian(header, rows.height);
  header += static_cast<char>(rows.depth);
  header += static_cast<char>(rows.channels == 4 ? 6 : 2);
  header.append(3, '\0');
  put_chunk(out, header);
  put_chunk(out, std::string("sRGB\0", 5));
  put_chunk(out, "IDAT" + std::string(reinterpret_cast<const char*>(packed.get()), static_cast<std::size_t>(size)));
  put_chunk(out, "IEND");
  return out;
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.substr(0, 4) == "\x89PNG"; }
bool is_jpeg(std::string_view bytes) { return bytes.substr(0, 2) == "\xff\xd8"; }
bool is_webp(std::string_view bytes) { return bytes.size() > 12 && bytes.substr(0, 4) == "RIFF" && bytes.substr(8, 4) == "WEBP"; }
bool is_tiff(std::string_view bytes) {
  return bytes.substr(0, 4) == std::string_view("II*\0", 4) || bytes.substr(0, 4) == std::string_view("MM\0*", 4);
}
bool is_bmp_or_tga(std::string_view bytes, const std::string& name) {
  return bytes.substr(0, 2) == "BM" || (name.size() >= 4 && name.substr(name.size() - 4) == ".tga");
}

Result<image::Image> decode_png(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  return decode(bytes, name, limits);
}
Result<image::Image> decode_jpeg(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  return decode(bytes, name, limits);
}
Result<image::Image> decode_bmp_or_tga(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  return decode(bytes, name, limits);
}
Result<image::Image> decode_webp(std::string_view, const std::string& name, const ImageLimits&) {
  return bad_image(name, "the page reads no WebP pictures");
}
Result<image::Image> decode_tiff(std::string_view, const std::string& name, const ImageLimits&) {
  return bad_image(name, "the page reads no TIFF pictures");
}

std::string encode_png(const image::Image& image) {
  Rows rows{static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), 8, 3, {}};
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    if (image.rgba[i] != 255) rows.channels = 4;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    rows.bytes.insert(rows.bytes.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                      image.rgba.begin() + static_cast<std::ptrdiff_t>(i + rows.channels));
  return png_of(rows);
}

std::string encode_png(const image::Image16& image, const image::Image* alpha) {
  Rows rows{static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), 16, alpha ? 4u : 3u, {}};
  const auto add = [&](std::uint32_t v) {
    rows.bytes.push_back(static_cast<std::uint8_t>(v >> 8));
    rows.bytes.push_back(static_cast<std::uint8_t>(v & 255));
  };
  for (std::size_t at = 0; 3 * at < image.rgb.size(); ++at) {
    for (std::size_t c = 0; c < 3; ++c) add(image.rgb[3 * at + c]);
    if (alpha) add(257u * alpha->rgba[4 * at + 3]);
  }
  return png_of(rows);
}

std::string encode_alpha(const image::Image& image) {
  image::Image mask{image.width, image.height, image.rgba};
  for (std::size_t i = 0; i < mask.rgba.size(); i += 4) {
    mask.rgba[i] = mask.rgba[i + 1] = mask.rgba[i + 2] = mask.rgba[i + 3];
    mask.rgba[i + 3] = 255;
  }
  return encode_png(mask);
}

std::string encode_exr(const image::Image16&) { throw std::logic_error("the page writes no EXR"); }

}  // namespace orbc::image_io
#endif
