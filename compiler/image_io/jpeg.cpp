// JPEG by libjpeg-turbo. A picture of very many scans, which can keep a decoder busy for hours, is refused. Encoding uses the slow integer
// transform, which gives the same bits with and without SIMD, so the bytes are the same on every machine.
// Errors of the library leave by longjmp: nothing with a destructor is made between setjmp and the jump.
#include "compiler/image_io/jpeg.h"

#include <jpeglib.h>

#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "compiler/base/check.h"

namespace orbc::image_io {
namespace {

struct JpegReader {
  jpeg_decompress_struct info;
  jpeg_error_mgr errors;
  jpeg_progress_mgr progress;
  std::jmp_buf escape;
  char message[JMSG_LENGTH_MAX];
};

void fail_reading(j_common_ptr info) {
  auto* state = static_cast<JpegReader*>(info->client_data);
  info->err->format_message(info, state->message);
  std::longjmp(state->escape, 1);
}
void no_message(j_common_ptr, int) {}
void check_scan_count(j_common_ptr info) {
  constexpr int kMaxScans = 200;  // encoders write about ten
  auto* state = static_cast<JpegReader*>(info->client_data);
  if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number <= kMaxScans) return;
  std::strcpy(state->message, "too many scans");
  std::longjmp(state->escape, 1);
}

bool begin_reading(JpegReader& state, std::string_view bytes) {
  state.info.err = jpeg_std_error(&state.errors);
  state.errors.error_exit = fail_reading;
  state.errors.emit_message = no_message;
  state.info.client_data = &state;
  if (setjmp(state.escape)) return false;
  jpeg_create_decompress(&state.info);
  state.info.client_data = &state;
  state.progress.progress_monitor = check_scan_count;
  state.info.progress = &state.progress;
  jpeg_mem_src(&state.info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  return jpeg_read_header(&state.info, TRUE) == JPEG_HEADER_OK;
}

bool read_pixels(JpegReader& state, std::uint8_t* rgba, std::uint8_t* row) {
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

struct JpegWriter {
  jpeg_compress_struct info;
  jpeg_error_mgr errors;
  std::jmp_buf escape;
  char message[JMSG_LENGTH_MAX];
  unsigned char* bytes;
  unsigned long size;
};

void fail_writing(j_common_ptr info) {
  auto* writer = static_cast<JpegWriter*>(info->client_data);
  info->err->format_message(info, writer->message);
  std::longjmp(writer->escape, 1);
}
// `row` is made by the caller, outside of setjmp.
bool write_jpeg(JpegWriter& writer, const image::Image& image, int quality, std::vector<std::uint8_t>& row) {
  jpeg_compress_struct& info = writer.info;
  info.err = jpeg_std_error(&writer.errors);
  writer.errors.error_exit = fail_writing;
  writer.errors.emit_message = no_message;
  info.client_data = &writer;
  if (setjmp(writer.escape)) return false;
  jpeg_create_compress(&info);
  info.client_data = &writer;
  jpeg_mem_dest(&info, &writer.bytes, &writer.size);
  info.image_width = static_cast<JDIMENSION>(image.width);
  info.image_height = static_cast<JDIMENSION>(image.height);
  info.input_components = 3;
  info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, quality, TRUE);
  info.dct_method = JDCT_ISLOW;
  info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;  // thin coloured frames stay sharp
  jpeg_start_compress(&info, TRUE);
  while (info.next_scanline < info.image_height) {
    const std::uint8_t* in = image.rgba.data() + std::size_t{4} * info.image_width * info.next_scanline;
    for (std::size_t i = 0; i < row.size() / 3; ++i)
      for (std::size_t c = 0; c < 3; ++c) row[3 * i + c] = in[4 * i + c];
    JSAMPROW rows[] = {row.data()};
    jpeg_write_scanlines(&info, rows, 1);
  }
  jpeg_finish_compress(&info);
  return true;
}

}  // namespace

bool is_jpeg(std::string_view bytes) { return bytes.substr(0, 2) == "\xff\xd8"; }

Result<image::Image> decode_jpeg(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  JpegReader state{};
  struct Cleanup {
    JpegReader& state;
    ~Cleanup() { jpeg_destroy_decompress(&state.info); }
  } cleanup{state};
  if (!begin_reading(state, bytes)) return bad_image(name, state.message);
  if (auto wrong = check_size(state.info.image_width, state.info.image_height, name, limits); !wrong.empty()) return wrong;
  image::Image image{static_cast<int>(state.info.image_width), static_cast<int>(state.info.image_height), {}};
  image.rgba.assign(std::size_t{4} * state.info.image_width * state.info.image_height, 255);
  std::vector<std::uint8_t> row(std::size_t{4} * state.info.image_width);
  if (!read_pixels(state, image.rgba.data(), row.data())) return bad_image(name, state.message);
  return image;
}

std::string encode_jpeg(const image::Image& image, int quality) {
  ORBC_CHECK(image.rgba.size(), ==, static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4);
  ORBC_CHECK(image.rgba.empty(), ==, false);
  JpegWriter writer{};
  struct Cleanup {
    JpegWriter& writer;
    ~Cleanup() {
      jpeg_destroy_compress(&writer.info);
      std::free(writer.bytes);
    }
  } cleanup{writer};
  std::vector<std::uint8_t> row(static_cast<std::size_t>(image.width) * 3);
  if (!write_jpeg(writer, image, quality, row)) throw std::runtime_error(std::string("cannot encode a JPEG: ") + writer.message);
  return {reinterpret_cast<const char*>(writer.bytes), writer.size};
}

}  // namespace orbc::image_io
