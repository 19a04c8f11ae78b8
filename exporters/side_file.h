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

/// A hash by which names tell contents apart: each word is mixed in by a multiplication and a shift, which can be undone, so that contents
/// of one length that differ in one word never agree.
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

/// "room-atlas-0a1b2c3d4e5f.png": the name says what is in the file, so a main output never finds other bytes under it than those it was
/// written with. Makes: the same name for the same stem, format and bytes; plain ASCII.
[[nodiscard]] inline std::string side_file_name(const SideFileName& name, std::string_view bytes) {
  std::uint64_t hash = content_hash(bytes, content_hash(name.stem, content_hash(name.format, 0)));
  std::string text = plain_name(name.stem);
  text.append(name.kind).append("-");
  for (int digit = 0; digit < 12; ++digit, hash <<= 4) text += "0123456789abcdef"[hash >> 60];
  return text.append(name.ending);
}

/// Whether a name ends as those of side files do, before anybody reads what is in the file.
[[nodiscard]] inline bool looks_like_side_file(std::string_view name) {
  constexpr std::size_t kHash = 13;  // with its hyphen
  const std::size_t dot = name.rfind('.');
  return dot != std::string_view::npos && dot >= kHash && name[dot - kHash] == '-' &&
         name.substr(dot - kHash + 1, kHash - 1).find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Whether a file of that name and content has been written beside a main output of that stem and format.
[[nodiscard]] inline bool is_side_file(std::string_view name, std::string_view bytes, std::string_view stem, std::string_view format) {
  constexpr std::size_t kHash = 13;  // with its hyphen
  const std::string start = plain_name(stem);
  const std::size_t dot = name.rfind('.');
  if (!looks_like_side_file(name) || dot < start.size() + kHash || name.substr(0, start.size()) != start) return false;
  return name == side_file_name({stem, format, name.substr(start.size(), dot - kHash - start.size()), name.substr(dot)}, bytes);
}

}  // namespace orbc::exporters
