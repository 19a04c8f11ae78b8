#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "exporters/text.h"

namespace orbc::exporters {

/// What a file beside the main output is called after.
struct SideFileName {
  std::string_view stem;    ///< of the main output's name
  std::string_view format;  ///< of the main output: two formats with one stem share no file
  std::string_view kind;    ///< "-atlas", "-mask" or ""
  std::string_view ending;  ///< ".png"
};

/// A hash of bytes. Each word of 8 bytes is mixed in by a multiplication and a shift, which can be undone: contents of one length that
/// differ in one word never have the same hash.
[[nodiscard]] inline std::uint64_t content_hash(std::string_view bytes, std::uint64_t start) {
  constexpr std::uint64_t kFactor = 0x9E3779B97F4A7C15;  // 2^64 / golden ratio, as in SplitMix64 (Steele, Lea, Flood 2014)
  std::uint64_t hash = start ^ bytes.size();
  const auto mix = [&](std::uint64_t word) {
    hash = (hash ^ word) * kFactor;
    hash ^= hash >> 29;
  };
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, 8);
    mix(word);
  }
  std::uint64_t rest = 0;
  std::memcpy(&rest, bytes.data() + at, bytes.size() - at);
  mix(rest);
  mix(0);
  return hash;
}

inline constexpr std::size_t kHashDigits = 12;  // in the names of files beside the main output

/// "room-atlas-0a1b2c3d4e5f.png". The digits are a hash of the bytes, so a main output never finds other bytes under that name than those
/// that it was written with. Makes: the same name for the same stem, format and bytes; plain ASCII.
[[nodiscard]] inline std::string side_file_name(const SideFileName& name, std::string_view bytes) {
  std::uint64_t hash = content_hash(bytes, content_hash(name.stem, content_hash(name.format, 0)));
  std::string text = plain_name(name.stem);
  text.append(name.kind).append("-");
  for (std::size_t digit = 0; digit < kHashDigits; ++digit, hash <<= 4) text += "0123456789abcdef"[hash >> 60];
  return text.append(name.ending);
}

/// Whether a name ends with a hyphen, as many hexadecimal digits as a hash has, and an ending. Necessary for `is_side_file`.
[[nodiscard]] inline bool looks_like_side_file(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot != std::string_view::npos && dot > kHashDigits && name[dot - kHashDigits - 1] == '-' &&
         name.substr(dot - kHashDigits, kHashDigits).find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Whether a file of that name and content has been written beside a main output of that stem and format.
[[nodiscard]] inline bool is_side_file(std::string_view name, std::string_view bytes, std::string_view stem, std::string_view format) {
  const std::string start = plain_name(stem);
  const std::size_t dot = name.rfind('.'), after_kind = dot - kHashDigits - 1;
  if (!looks_like_side_file(name) || after_kind < start.size() || name.substr(0, start.size()) != start) return false;
  return name == side_file_name({stem, format, name.substr(start.size(), after_kind - start.size()), name.substr(dot)}, bytes);
}

}  // namespace orbc::exporters
