#pragma once
// Included by the files that write OpenEXR only.
#include <OpenEXR/ImfIO.h>

#include <cstring>
#include <string>

namespace orbc::mesh {

/// An OpenEXR file in memory, so that only the command line opens files.
class MemoryStream : public Imf::OStream {
 public:
  explicit MemoryStream(std::string& bytes) : Imf::OStream("memory.exr"), bytes_(bytes) {}
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

}  // namespace orbc::mesh
