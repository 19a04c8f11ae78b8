// PNG by libpng. Pictures of 8 bits go through its simplified interface (libpng-manual.txt, section V). That interface writes 16 bits as
// linear light (gAMA 1), which Blender ignores; so pictures of 16 bits go through the full interface, and their codes are sRGB as in 8
// bits.
#include "compiler/image_io/png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "compiler/base/check.h"

namespace orbc::image_io {
namespace {

struct PngImage {
  png_image state{};
  PngImage() { state.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&state); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

std::uint32_t big_endian_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

/// The file without the chunks that say how its codes are meant: gAMA, cHRM, iCCP. glTF asks for that (specification 2.0.1, section 3.8.3),
/// and modelling programs do it: the codes are sRGB.
std::string without_color_chunks(std::string_view bytes) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // of a chunk: length, name and checksum
  std::string kept(bytes.substr(0, kSignature));
  for (std::size_t at = kSignature; at < bytes.size();) {
    const std::size_t rest = bytes.size() - at;
    const std::size_t size = rest < kFrame ? rest : std::min<std::size_t>(rest, kFrame + big_endian_at(bytes, at));
    const auto name = rest < kFrame ? std::string_view{} : bytes.substr(at + 4, 4);
    if (name != "gAMA" && name != "cHRM" && name != "iCCP") kept += bytes.substr(at, size);
    at += size;
  }
  return kept;
}

void append(png_structp png, png_bytep data, png_size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), count);
}
void flush(png_structp) {}

/// Big-endian rows of RGB, or RGBA with the alpha of `alpha`.
std::vector<std::uint8_t> row_of(const image::Image16& image, const image::Image* alpha, int y) {
  std::vector<std::uint8_t> row;
  const auto add = [&](std::uint16_t v) {
    row.push_back(static_cast<std::uint8_t>(v >> 8));
    row.push_back(static_cast<std::uint8_t>(v & 255));
  };
  for (int x = 0; x < image.width; ++x) {
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
    for (std::size_t c = 0; c < 3; ++c) add(image.rgb[3 * at + c]);
    if (alpha) add(static_cast<std::uint16_t>(257 * alpha->rgba[4 * at + 3]));
  }
  return row;
}

// Errors of libpng leave by longjmp: nothing with a destructor is made between setjmp and it but the row, which stands outside.
bool write_rows(png_structp png, png_infop info, const image::Image16& image, const image::Image* alpha, std::vector<std::uint8_t>& row) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 16,
               alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) {
    row = row_of(image, alpha, y);
    png_write_row(png, row.data());
  }
  png_write_end(png, nullptr);
  return true;
}

/// What is left of a file that is read piece by piece.
struct ReadPosition {
  std::string_view rest;
};

void read_some(png_structp png, png_bytep data, png_size_t count) {
  auto& position = *static_cast<ReadPosition*>(png_get_io_ptr(png));
  if (count > position.rest.size()) png_error(png, "the file is truncated");
  std::copy_n(position.rest.begin(), count, data);
  position.rest.remove_prefix(count);
}

/// What libpng said when it gave up. It leaves by longjmp, so its text stands in a plain array.
struct PngComplaint {
  std::array<char, 128> text{};
};

void complain(png_structp png, png_const_charp message) {
  auto& complaint = *static_cast<PngComplaint*>(png_get_error_ptr(png));
  std::strncpy(complaint.text.data(), message, complaint.text.size() - 1);
  png_longjmp(png, 1);
}
void ignore_warning(png_structp, png_const_charp) {}

// Errors of libpng leave by longjmp, as in write_rows: what has a destructor stands outside.
bool read_header(png_structp png, png_infop info) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_info(png, info);
  return true;
}

bool read_codes(png_structp png, png_infop info, DeepImage& image, std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_expand_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER);
  if (std::endian::native == std::endian::little) png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const auto width = static_cast<std::size_t>(image.width);
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = reinterpret_cast<png_bytep>(image.rgba.data() + y * width * 4);
  png_read_image(png, rows.data());
  png_read_end(png, nullptr);
  return true;
}

/// Owns libpng's state while a picture is read.
struct PngReader {
  PngComplaint complaint;
  png_structp png;
  png_infop info;
  PngReader()
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &complaint, complain, ignore_warning)), info(png_create_info_struct(png)) {}
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
};

}  // namespace

bool is_png(std::string_view bytes) { return bytes.substr(0, 4) == "\x89PNG"; }

Result<image::Image> decode_png(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  PngImage png;
  const std::string codes = without_color_chunks(bytes);
  if (!png_image_begin_read_from_memory(&png.state, codes.data(), codes.size())) return bad_image(name, png.state.message);
  if (auto wrong = check_size(png.state.width, png.state.height, name, limits); !wrong.empty()) return wrong;
  png.state.format = PNG_FORMAT_RGBA;
  png.state.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // without it libpng takes 16 bits for linear light
  image::Image image{static_cast<int>(png.state.width), static_cast<int>(png.state.height),
                     std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png.state))};
  if (!png_image_finish_read(&png.state, nullptr, image.rgba.data(), 0, nullptr)) return bad_image(name, png.state.message);
  return image;
}

Result<DeepImage> decode_deep_png(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  PngReader reader;
  ReadPosition position{bytes};
  png_set_read_fn(reader.png, &position, read_some);
  if (!read_header(reader.png, reader.info)) return bad_image(name, reader.complaint.text.data());
  const auto width = png_get_image_width(reader.png, reader.info), height = png_get_image_height(reader.png, reader.info);
  if (auto wrong = check_size(width, height, name, limits); !wrong.empty()) return wrong;
  DeepImage image{static_cast<int>(width), static_cast<int>(height), std::vector<std::uint16_t>(std::size_t{4} * width * height)};
  std::vector<png_bytep> rows(height);
  if (!read_codes(reader.png, reader.info, image, rows)) return bad_image(name, reader.complaint.text.data());
  return image;
}

std::string encode_png(const image::Image& image) {
  ORBC_CHECK(image.rgba.size(), ==, static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4);
  ORBC_CHECK(image.rgba.empty(), ==, false);
  bool opaque = true;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) opaque = opaque && image.rgba[i] == 255;
  std::vector<std::uint8_t> rgb;
  if (opaque) {
    rgb.reserve(image.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) rgb.insert(rgb.end(), {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
  }
  PngImage png;
  png.state.width = static_cast<png_uint_32>(image.width);
  png.state.height = static_cast<png_uint_32>(image.height);
  png.state.format = opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  const auto* pixels = opaque ? rgb.data() : image.rgba.data();
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.state);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&png.state, bytes.data(), &size, 0, pixels, 0, nullptr)) {
    throw std::runtime_error(std::string("cannot encode a PNG: ") + png.state.message);
  }
  bytes.resize(size);
  return bytes;
}

std::string encode_png(const image::Image16& image, const image::Image* alpha) {
  ORBC_CHECK(image.rgb.size(), ==, static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  ORBC_CHECK(image.rgb.empty(), ==, false);
  std::string bytes;
  std::vector<std::uint8_t> row;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  bool written = false;
  if (info) {
    png_set_write_fn(png, &bytes, append, flush);
    written = write_rows(png, info, image, alpha, row);
  }
  png_destroy_write_struct(&png, &info);
  if (!written) throw std::runtime_error("cannot encode a PNG of 16 bits");
  return bytes;
}

std::string encode_alpha(const image::Image& image) {
  image::Image mask{image.width, image.height, image.rgba};
  for (std::size_t i = 0; i < mask.rgba.size(); i += 4) {
    const std::uint8_t opacity = mask.rgba[i + 3];
    mask.rgba[i] = mask.rgba[i + 1] = mask.rgba[i + 2] = opacity;
    mask.rgba[i + 3] = 255;
  }
  return encode_png(mask);
}

}  // namespace orbc::image_io
