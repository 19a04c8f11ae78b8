// OpenEXR through streams in memory, so that only the command line opens files.
#include "compiler/image_io/exr.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "compiler/base/check.h"
#include "compiler/image/srgb.h"

namespace orbc::image_io {
namespace {

constexpr std::int64_t kMaxSide = 16384, kMaxUnpacked = std::int64_t{2} << 30;

/// Bytes in memory as OpenEXR wants to read them.
class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::string_view bytes) : Imf::IStream("memory.exr"), bytes_(bytes) {}
  bool read(char* to, int count) override {
    if (count < 0 || static_cast<std::uint64_t>(count) > bytes_.size() - at_) throw std::runtime_error("the file is cut short");
    std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override {
    if (at > bytes_.size()) throw std::runtime_error("the file is cut short");
    at_ = at;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// Writes an OpenEXR file into memory.
class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(std::string& bytes) : Imf::OStream("memory.exr"), bytes_(bytes) {}
  void write(const char* data, int count) override {
    const std::size_t end = at_ + static_cast<std::size_t>(count);
    if (bytes_.size() < end) bytes_.resize(end);
    std::memcpy(bytes_.data() + at_, data, static_cast<std::size_t>(count));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }

 private:
  std::string& bytes_;
  std::size_t at_ = 0;
};

image::FloatImage read_channels(std::string_view bytes) {
  MemoryInput stream(bytes);
  Imf::InputFile file(stream, 1);
  const auto window = file.header().dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1, height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide)
    throw std::runtime_error(fmt::format("{} x {} pixels", width, height));
  image::FloatImage picture{static_cast<int>(width), static_cast<int>(height), {}};
  const auto& list = file.header().channels();
  std::int64_t bytes_left = kMaxUnpacked;
  Imf::FrameBuffer frame;
  for (auto channel = list.begin(); channel != list.end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) throw std::runtime_error("subsampled channels are not read");
    if ((bytes_left -= 4 * width * height) < 0) throw std::runtime_error("it is too large");
    auto& values = picture.channels[channel.name()];
    values.resize(static_cast<std::size_t>(width * height));
    const auto row = sizeof(float) * static_cast<std::size_t>(width);
    frame.insert(channel.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), window, sizeof(float), row));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return picture;
}

std::string write_file(const Imf::Header& header, const Imf::FrameBuffer& frame, int height) {
  std::string bytes;
  {
    MemoryOutput stream(bytes);
    Imf::OutputFile file(stream, header, 1);
    file.setFrameBuffer(frame);
    file.writePixels(height);
  }
  return bytes;
}

}  // namespace

bool is_exr(std::string_view bytes) { return bytes.substr(0, 4) == std::string_view("\x76\x2f\x31\x01", 4); }

Result<image::FloatImage> decode_exr(std::string_view bytes) {
  try {
    return read_channels(bytes);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return make_error("mesh.bad-image", error.what());
  }
}

std::string encode_exr(const image::FloatImage& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  for (const auto& [name, values] : image.channels) {
    ORBC_CHECK(values.size(), ==, static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(values.data())), sizeof(float),
                                  sizeof(float) * static_cast<std::size_t>(image.width)));
  }
  return write_file(header, frame, image.height);
}

std::string encode_exr(const image::Image16& image) {
  ORBC_CHECK(image.rgb.size(), ==, static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  std::vector<Imath::half> table(65536);
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = static_cast<float>(image::decode_srgb16(static_cast<std::uint16_t>(i)));
  std::vector<Imath::half> pixels(image.rgb.size());
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
  return write_file(header, frame, image.height);
}

}  // namespace orbc::image_io
