// TIFF by libtiff, from memory, its errors taken down instead of printed.
#include "compiler/image_io/tiff.h"

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>

namespace orbc::image_io {
namespace {

/// The file as libtiff sees it.
struct MemoryFile {
  std::string_view bytes;
  std::uint64_t at = 0;
  std::string error;
};

tmsize_t read(thandle_t handle, void* to, tmsize_t count) {
  auto& file = *static_cast<MemoryFile*>(handle);
  const std::uint64_t left = file.at < file.bytes.size() ? file.bytes.size() - file.at : 0;
  const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(left, static_cast<std::uint64_t>(std::max<tmsize_t>(count, 0))));
  if (size > 0) std::memcpy(to, file.bytes.data() + file.at, size);
  file.at += size;
  return static_cast<tmsize_t>(size);
}
tmsize_t refuse_write(thandle_t, void*, tmsize_t) { return 0; }
toff_t seek(thandle_t handle, toff_t offset, int whence) {
  auto& file = *static_cast<MemoryFile*>(handle);
  file.at = whence == SEEK_CUR ? file.at + offset : whence == SEEK_END ? file.bytes.size() + offset : offset;
  return file.at;
}
int close(thandle_t) { return 0; }
toff_t size(thandle_t handle) { return static_cast<MemoryFile*>(handle)->bytes.size(); }
int keep_error(TIFF*, void* data, const char*, const char* format, std::va_list arguments) {
  char text[200];
  std::vsnprintf(text, sizeof text, format, arguments);
  static_cast<MemoryFile*>(data)->error = text;
  return 1;
}
int keep_quiet(TIFF*, void*, const char*, const char*, std::va_list) { return 1; }

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

Tiff open(MemoryFile& file) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_error, &file);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_quiet, nullptr);
  return Tiff(TIFFClientOpenExt("picture", "rm", &file, read, refuse_write, seek, close, size, nullptr, nullptr, options.get()),
              &TIFFClose);
}

}  // namespace

bool is_tiff(std::string_view bytes) {
  using namespace std::string_view_literals;
  const auto magic = bytes.substr(0, 4);
  return magic == "II*\0"sv || magic == "MM\0*"sv || magic == "II+\0"sv || magic == "MM\0+"sv;
}

Result<image::Image> decode_tiff(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  MemoryFile file{bytes, 0, {}};
  const Tiff tiff = open(file);
  if (!tiff) return bad_image(name, "the TIFF picture is damaged: " + file.error);
  std::uint32_t width = 0, height = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  if (auto wrong = check_size(width, height, name, limits); !wrong.empty()) return wrong;
  std::vector<std::uint32_t> pixels(std::size_t{width} * height);
  if (!TIFFReadRGBAImageOriented(tiff.get(), width, height, pixels.data(), ORIENTATION_TOPLEFT, 1))
    return bad_image(name, "the TIFF picture is damaged: " + file.error);
  image::Image image{static_cast<int>(width), static_cast<int>(height), {}};
  image.rgba.reserve(4 * pixels.size());
  for (const std::uint32_t p : pixels) {
    for (const std::uint32_t channel : {TIFFGetR(p), TIFFGetG(p), TIFFGetB(p), TIFFGetA(p)})
      image.rgba.push_back(static_cast<std::uint8_t>(channel));
  }
  return image;
}

}  // namespace orbc::image_io
