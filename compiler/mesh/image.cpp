// Pictures by libpng (its simplified interface, libpng-manual.txt section V) and libjpeg-turbo. Sizes are checked against the header
// before pixels are read; a JPEG of very many scans, which can keep a decoder busy for hours, is refused.
#include "compiler/mesh/image.h"

#include <fmt/core.h>
#include <jpeglib.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <stdexcept>

#include "compiler/mesh/sieve.h"

namespace orbc::mesh {
namespace {

Diagnostic bad_image(const std::string& name, const std::string& what) {
  return make_error("mesh.bad-image", fmt::format("{}: {}", name, what), "PNG and JPEG pictures are read");
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

struct PngImage {
  png_image state{};
  PngImage() { state.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&state); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

Result<Image> decode_as_png(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  PngImage png;
  if (!png_image_begin_read_from_memory(&png.state, bytes.data(), bytes.size())) return bad_image(name, png.state.message);
  if (auto wrong = check_size(png.state.width, png.state.height, name, limits); !wrong.empty()) return wrong;
  png.state.format = PNG_FORMAT_RGBA;
  Image image{static_cast<int>(png.state.width), static_cast<int>(png.state.height), std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png.state))};
  if (!png_image_finish_read(&png.state, nullptr, image.rgba.data(), 0, nullptr)) return bad_image(name, png.state.message);
  return image;
}

// ---- JPEG: errors of the library leave by longjmp, so nothing with a destructor lives between setjmp and it. -----------------------

struct JpegState {
  jpeg_decompress_struct info;
  jpeg_error_mgr errors;
  jpeg_progress_mgr progress;
  std::jmp_buf escape;
  char message[JMSG_LENGTH_MAX];
};

void jpeg_fail(j_common_ptr info) {
  auto* state = static_cast<JpegState*>(info->client_data);
  info->err->format_message(info, state->message);
  std::longjmp(state->escape, 1);
}
void jpeg_quiet(j_common_ptr, int) {}
void jpeg_watch(j_common_ptr info) {
  constexpr int kMaxScans = 200;  // encoders write about ten
  auto* state = static_cast<JpegState*>(info->client_data);
  if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number <= kMaxScans) return;
  std::strcpy(state->message, "too many scans");
  std::longjmp(state->escape, 1);
}

bool jpeg_begin(JpegState& state, std::string_view bytes) {
  state.info.err = jpeg_std_error(&state.errors);
  state.errors.error_exit = jpeg_fail;
  state.errors.emit_message = jpeg_quiet;
  state.info.client_data = &state;
  if (setjmp(state.escape)) return false;
  jpeg_create_decompress(&state.info);
  state.info.client_data = &state;
  state.progress.progress_monitor = jpeg_watch;
  state.info.progress = &state.progress;
  jpeg_mem_src(&state.info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  return jpeg_read_header(&state.info, TRUE) == JPEG_HEADER_OK;
}

bool jpeg_pixels(JpegState& state, std::uint8_t* rgba, std::uint8_t* row) {
  if (setjmp(state.escape)) return false;
  auto& info = state.info;
  const bool cmyk = info.num_components == 4;
  info.out_color_space = cmyk ? JCS_CMYK : JCS_RGB;
  info.mem->max_memory_to_use = 1L << 30;
  jpeg_start_decompress(&info);
  while (info.output_scanline < info.output_height) {
    auto* out = rgba + std::size_t{4} * info.output_width * info.output_scanline;
    JSAMPROW rows[] = {row};
    jpeg_read_scanlines(&info, rows, 1);
    for (JDIMENSION i = 0; i < info.output_width; ++i) {
      const auto* in = row + (cmyk ? 4 : 3) * static_cast<std::size_t>(i);
      for (int c = 0; c < 3; ++c) {
        // Adobe stores the inks of CMYK inverted.
        const int ink = cmyk && !info.saw_Adobe_marker ? (255 - in[c]) * (255 - in[3]) / 255 : cmyk ? in[c] * in[3] / 255 : in[c];
        out[4 * std::size_t{i} + static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(ink);
      }
    }
  }
  // A picture that is cut off is filled up with grey by the library, with a warning.
  const bool whole = state.errors.num_warnings == 0;
  if (!whole) std::strcpy(state.message, "the picture is cut off or damaged");
  return whole;
}

Result<Image> decode_as_jpeg(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  JpegState state{};
  struct Ending {
    JpegState& state;
    ~Ending() { jpeg_destroy_decompress(&state.info); }
  } ending{state};
  if (!jpeg_begin(state, bytes)) return bad_image(name, state.message);
  if (auto wrong = check_size(state.info.image_width, state.info.image_height, name, limits); !wrong.empty()) return wrong;
  Image image{static_cast<int>(state.info.image_width), static_cast<int>(state.info.image_height), {}};
  image.rgba.assign(std::size_t{4} * state.info.image_width * state.info.image_height, 255);
  std::vector<std::uint8_t> row(std::size_t{4} * state.info.image_width);
  if (!jpeg_pixels(state, image.rgba.data(), row.data())) return bad_image(name, state.message);
  return image;
}

}  // namespace

Result<Image> load_image(const std::string& path, const ImageLimits& limits) {
  auto bytes = read_file(path, std::uint64_t{1} << 30);
  if (!bytes) return std::move(bytes).error();
  return decode_image(*bytes, path, limits);
}

Result<Image> decode_image(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  // The kind is told by the first bytes, whatever the name says.
  if (bytes.substr(0, 4) == "\x89PNG") return decode_as_png(bytes, name, limits);
  if (bytes.substr(0, 2) == "\xff\xd8") return decode_as_jpeg(bytes, name, limits);
  return bad_image(name, bytes.empty() ? "the picture is empty" : "it is neither a PNG nor a JPEG picture");
}

std::string encode_png(const Image& image) {
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

Result<Image> decode_png(std::string_view bytes, const ImageLimits& limits) { return decode_image(bytes, "PNG", limits); }

}  // namespace orbc::mesh
