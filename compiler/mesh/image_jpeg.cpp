// Writing JPEG by libjpeg-turbo. The slow integer transform is the same with and without SIMD, so the bytes are the same on every machine;
// nothing but the picture is written, no date and no name.
#include <cstdio>
#include <jpeglib.h>

#include <csetjmp>
#include <cstdlib>
#include <stdexcept>

#include "compiler/base/check.h"
#include "compiler/mesh/image.h"

namespace orbc::mesh {
namespace {

struct JpegWriter {
  jpeg_compress_struct info;
  jpeg_error_mgr errors;
  std::jmp_buf escape;
  char message[JMSG_LENGTH_MAX];
  unsigned char* bytes;
  unsigned long size;
};

void leave_writing(j_common_ptr info) {
  auto* writer = static_cast<JpegWriter*>(info->client_data);
  info->err->format_message(info, writer->message);
  std::longjmp(writer->escape, 1);
}
void no_message(j_common_ptr, int) {}

// Errors of the library leave by longjmp: nothing with a destructor is made between setjmp and it; `row` stands outside.
bool write_jpeg(JpegWriter& writer, const Image& image, int quality, std::vector<std::uint8_t>& row) {
  jpeg_compress_struct& info = writer.info;
  info.err = jpeg_std_error(&writer.errors);
  writer.errors.error_exit = leave_writing;
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
  info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;   // thin coloured frames stay sharp
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

std::string encode_jpeg(const Image& image, int quality) {
  ORBC_CHECK(image.rgba.size(), ==, static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4);
  ORBC_CHECK(image.rgba.empty(), ==, false);
  JpegWriter writer{};
  struct Ending {
    JpegWriter& writer;
    ~Ending() {
      jpeg_destroy_compress(&writer.info);
      std::free(writer.bytes);
    }
  } ending{writer};
  std::vector<std::uint8_t> row(static_cast<std::size_t>(image.width) * 3);
  if (!write_jpeg(writer, image, quality, row)) throw std::runtime_error(std::string("cannot encode a JPEG: ") + writer.message);
  return {reinterpret_cast<const char*>(writer.bytes), writer.size};
}

}  // namespace orbc::mesh
