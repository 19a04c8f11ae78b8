#include "compiler/diff/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "compiler/diff/compare.h"

namespace orbc::diff {
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

ExrPicture read(std::string_view bytes) {
  MemoryInput stream(bytes);
  Imf::InputFile file(stream, 1);
  const auto window = file.header().dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1, height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide)
    throw std::runtime_error(fmt::format("{} x {} pixels", width, height));
  ExrPicture picture{static_cast<int>(width), static_cast<int>(height), {}};
  const auto& list = file.header().channels();
  std::int64_t room = kMaxUnpacked;
  Imf::FrameBuffer frame;
  for (auto channel = list.begin(); channel != list.end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) throw std::runtime_error("subsampled channels are not read");
    if ((room -= 4 * width * height) < 0) throw std::runtime_error("it is too large");
    auto& values = picture.channels[channel.name()];
    values.resize(static_cast<std::size_t>(width * height));
    const auto row = sizeof(float) * static_cast<std::size_t>(width);
    frame.insert(channel.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), window, sizeof(float), row));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return picture;
}

}  // namespace

bool is_exr(std::string_view bytes) { return bytes.substr(0, 4) == std::string_view("\x76\x2f\x31\x01", 4); }

Result<ExrPicture> read_exr(std::string_view bytes, const std::string& name) {
  try {
    return read(bytes);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return bad_file(name, error.what());
  }
}

}  // namespace orbc::diff
