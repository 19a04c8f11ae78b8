#pragma once
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "compiler/base/number_text.h"
#include "compiler/base/utf8.h"

namespace orbc::exporters {

/// Writes text quickly: numbers go through a small buffer that stays in the cache and from there to the string in large pieces.
/// Makes: numbers as the shortest text that reads back as the same value (std::to_chars), whatever the locale.
class Pen {
 public:
  explicit Pen(std::string& out) : out_(out) {}
  Pen(const Pen&) = delete;
  Pen& operator=(const Pen&) = delete;
  ~Pen() { flush(); }

  Pen& operator<<(std::string_view text) {
    if (text.size() > kRoom) {
      flush();
      out_.append(text);
      return *this;
    }
    make_room();
    std::memcpy(buffer_ + used_, text.data(), text.size());
    used_ += text.size();
    return *this;
  }
  Pen& operator<<(const char* text) { return *this << std::string_view(text); }
  Pen& operator<<(char c) {
    make_room();
    buffer_[used_++] = c;
    return *this;
  }
  Pen& operator<<(bool) = delete;
  Pen& operator<<(float value) { return number(value); }
  Pen& operator<<(double value) { return number(value); }
  Pen& operator<<(int value) { return number(value); }
  template <std::integral Integer>
  Pen& operator<<(Integer value) {
    return number(value);
  }

  void flush() {
    out_.append(buffer_, used_);
    used_ = 0;
  }

 private:
  static constexpr std::size_t kRoom = 512;  // longer than any number; one text piece at most this long goes through the buffer
  template <class T>
  Pen& number(T value) {
    make_room();
    used_ = static_cast<std::size_t>(put_shortest(buffer_ + used_, value) - buffer_);
    return *this;
  }
  void make_room() {
    if (sizeof buffer_ - used_ < kRoom) flush();
  }

  std::string& out_;
  std::size_t used_ = 0;
  char buffer_[32768];
};

/// Length of the UTF-8 character at the start of `s`, in bytes; 0 when there is none.
[[nodiscard]] inline std::size_t utf8_length(std::string_view s) {
  const auto character = decode_utf8(s);
  return character ? character->length : 0;
}

/// The text on one line: control characters become spaces, so that it can stand in a `//` comment.
[[nodiscard]] inline std::string one_line(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
  return line;
}

/// A name for a file beside the main output that every format and file system can spell: letters, digits, `.`, `_` and `-` of ASCII.
/// Names that had to change, or are so long that no word could be put behind them, get a short hash of the original, so that two scenes
/// never share one atlas.
[[nodiscard]] inline std::string plain_name(std::string_view stem) {
  std::string name(stem);
  std::uint32_t hash = 2166136261u;  // FNV-1a
  bool changed = false;
  for (char& c : name) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
    if (!plain) c = '_', changed = true;
  }
  if (name.empty()) return "scene";
  constexpr std::size_t kLongest = 200;  // of 255 bytes that file systems allow
  if (name.size() > kLongest) name.resize(kLongest), changed = true;
  if (!changed && name[0] != '.' && name[0] != '-') return name;
  char digits[8];
  const auto end = std::to_chars(digits, digits + sizeof digits, hash, 16).ptr;
  return "scene" + name + "-" + std::string(digits, static_cast<std::size_t>(end - digits));
}

}  // namespace orbc::exporters
