#include "compiler/diff/source.h"

#include <array>
#include <cstdint>
#include <filesystem>

#include "compiler/files/files.h"

namespace orbc::diff {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{8} << 30;

bool is_alphanumeric(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

Result<std::string> read_whole(const std::string& path) {
  auto bytes = files::read_file(path, kMaxBytes);
  if (bytes) return bytes;
  Diagnostics faults = bytes.error();
  for (Diagnostic& d : faults) d.code = "diff.cannot-read";
  return faults;
}

// "a-atlas-0a1b2c3d4e5f.png" without the digits that say what is in the file: that is compared by itself.
std::string without_hash(std::string_view name) {
  constexpr std::size_t kHash = 13;  // with its hyphen
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos || dot < kHash || name[dot - kHash] != '-') return std::string(name);
  const std::string_view digits = name.substr(dot - kHash + 1, kHash - 1);
  if (digits.find_first_not_of("0123456789abcdef") != std::string_view::npos) return std::string(name);
  return std::string(name.substr(0, dot - kHash)) + std::string(name.substr(dot));
}

}  // namespace

Result<Source> read_source(const std::string& path) {
  auto bytes = read_whole(path);
  if (!bytes) return bytes.error();
  const std::filesystem::path where(path);
  const std::string folder = where.parent_path().string();
  return Source{path, folder.empty() ? "." : folder, where.stem().string(), *std::move(bytes)};
}

Result<std::string> read_beside(const Source& source, std::string_view reference) {
  const auto path = files::referred_path(reference, source.name, source.folder);
  if (path) return read_whole(*path);
  Diagnostics faults = path.error();
  for (Diagnostic& d : faults) d.code = "diff.cannot-read";
  return faults;
}

bool same_name(std::string_view a, const Source& in_a, std::string_view b, const Source& in_b) {
  if (without_hash(a) == without_hash(b)) return true;
  if (in_a.stem.empty() || in_b.stem.empty()) return false;
  if (a.substr(0, in_a.stem.size()) != in_a.stem || b.substr(0, in_b.stem.size()) != in_b.stem) return false;
  a.remove_prefix(in_a.stem.size());
  b.remove_prefix(in_b.stem.size());
  return without_hash(a) == without_hash(b) && (a.empty() || !is_alphanumeric(a.front()));
}

std::string without_stem(std::string_view text, const Source& source) {
  std::string out;
  while (!source.stem.empty()) {
    const std::size_t at = text.find(source.stem);
    if (at == std::string_view::npos) break;
    const std::string_view rest = text.substr(at + source.stem.size());
    const bool own = rest.substr(0, 4) == ".pov" || rest.substr(0, 7) == "-atlas." || rest.substr(0, 6) == "-mask.";
    out.append(text.substr(0, at)).append(own ? std::string_view("STEM") : text.substr(at, source.stem.size()));
    text = rest;
  }
  return out.append(text);
}

bool names_picture(std::string_view name) {
  for (const std::string_view ending : {".png", ".jpg", ".jpeg", ".exr"})
    if (name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending) return true;
  return false;
}

std::optional<std::string> decode_base64(std::string_view text) {
  static const auto table = [] {
    std::array<std::int8_t, 256> t{};
    t.fill(-1);
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kDigits.size(); ++i) t[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
    return t;
  }();
  std::string out;
  out.reserve(text.size() / 4 * 3);
  std::uint32_t held = 0;
  int bits = 0;
  bool padded = false;
  for (const char c : text) {
    if (c == '\n' || c == '\r' || c == ' ' || c == '\t') continue;
    if (c == '=') {
      padded = true;
      continue;
    }
    const std::int8_t digit = table[static_cast<unsigned char>(c)];
    if (digit < 0 || padded) return {};
    held = (held << 6 | static_cast<std::uint32_t>(digit)) & 0xffffff;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    out += static_cast<char>(held >> bits & 255);
  }
  return out;
}

}  // namespace orbc::diff
