// Pictures of more than 8 bits. libpng's simplified interface writes 16 bits as linear light (gAMA 1), which Blender ignores; so its full
// one, and the codes are sRGB, as in 8 bits. OpenEXR holds linear light in halves: 11 bits of each channel, wherever it is.
#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <png.h>

#include <cmath>
#include <csetjmp>
#include <stdexcept>

#include "compiler/base/check.h"
#include "compiler/base/elementary.h"
#include "compiler/mesh/exr_stream.h"
#include "compiler/mesh/image.h"

namespace orbc::mesh {
namespace {

void append(png_structp png, png_bytep data, png_size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), count);
}
void flush(png_structp) {}

/// Big-endian rows of RGB, or RGBA with the alpha of `alpha`.
std::vector<std::uint8_t> row_of(const DeepImage& image, const Image* alpha, int y) {
  std::vector<std::uint8_t> row;
  const auto add = [&](std::uint16_t v) {
    row.push_back(static_cast<std::uint8_t>(v >> 8)), row.push_back(static_cast<std::uint8_t>(v & 255));
  };
  for (int x = 0; x < image.width; ++x) {
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
    for (std::size_t c = 0; c < 3; ++c) add(image.rgb[3 * at + c]);
    if (alpha) add(static_cast<std::uint16_t>(257 * alpha->rgba[4 * at + 3]));
  }
  return row;
}

// Errors of libpng leave by longjmp: nothing with a destructor is made between setjmp and it but the row, which stands outside.
bool write_rows(png_structp png, png_infop info, const DeepImage& image, const Image* alpha, std::vector<std::uint8_t>& row) {
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

double decode(std::uint16_t code) {  // IEC 61966-2-1
  const double v = code / 65535.0;
  return v <= 0.04045 ? v / 12.92 : math::pow((v + 0.055) / 1.055, 2.4);
}

}  // namespace

std::string encode_deep_png(const DeepImage& image, const Image* alpha) {
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

std::string encode_exr(const DeepImage& image) {
  ORBC_CHECK(image.rgb.size(), ==, static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  std::vector<Imath::half> table(65536), pixels(image.rgb.size());
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = static_cast<float>(decode(static_cast<std::uint16_t>(i)));
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = table[image.rgb[i]];
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    header.channels().insert(names[c], Imf::Channel(Imf::HALF));
    frame.insert(names[c], Imf::Slice(Imf::HALF, reinterpret_cast<char*>(pixels.data() + c), 3 * sizeof(Imath::half),
                                      3 * sizeof(Imath::half) * static_cast<std::size_t>(image.width)));
  }
  std::string bytes;
  {
    MemoryStream stream(bytes);
    Imf::OutputFile file(stream, header, 1);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  }
  return bytes;
}

std::string encode_mask(const Image& image) {
  Image mask{image.width, image.height, image.rgba};
  for (std::size_t i = 0; i < mask.rgba.size(); i += 4) {
    const std::uint8_t opacity = mask.rgba[i + 3];
    mask.rgba[i] = mask.rgba[i + 1] = mask.rgba[i + 2] = opacity, mask.rgba[i + 3] = 255;
  }
  return encode_png(mask);
}

}  // namespace orbc::mesh
