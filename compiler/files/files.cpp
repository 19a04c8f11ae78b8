// Files that scenes and meshes name are read whole and bounded; references never leave their folder.
#include "compiler/files/files.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace orbc::files {

namespace fs = std::filesystem;

Diagnostics check_file(const std::string& path, std::uint64_t max_bytes) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status)) {
    const auto folder = fs::path(path).parent_path().empty() ? fs::path(".") : fs::path(path).parent_path();
    std::vector<std::string> known;
    for (fs::directory_iterator it(folder, error), end; !error && it != end && known.size() < 10'000; it.increment(error)) {
      known.push_back(it->path().filename().string());
    }
    std::string hint;
    const auto nearest = nearest_word(fs::path(path).filename().string(), known);
    if (!nearest.empty()) {
      hint = fmt::format("did you mean {}?", nearest);
    } else if (!fs::is_directory(folder, error)) {
      hint = fmt::format("there is no folder {}", folder.string());
    }
    return {make_error("mesh.missing-file", fmt::format("{}: there is no such file", path), hint)};
  }
  if (!fs::is_regular_file(status)) {
    return {make_error("mesh.not-a-file", fmt::format("{}: is not an ordinary file", path))};
  }
  const auto size = fs::file_size(path, error);
  if (error) return {make_error("mesh.not-a-file", fmt::format("{}: cannot be read ({})", path, error.message()))};
  if (size > max_bytes) {
    return {make_error("mesh.too-big", fmt::format("{}: {} bytes; at most {} are read", path, size, max_bytes),
                       "make it smaller in the program that made it, or allow more with --max-memory")};
  }
  return {};
}

Result<std::string> read_file(const std::string& path, std::uint64_t max_bytes) {
  if (auto wrong = check_file(path, max_bytes); !wrong.empty()) return wrong;
  std::error_code error;
  const auto size = fs::file_size(path, error);
  std::ifstream in(path, std::ios::binary);
  std::string bytes(error ? 0 : size, '\0');
  if (!in || (!bytes.empty() && !in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))) {
    return make_error("mesh.not-a-file", fmt::format("{}: cannot be read", path), "look at its permissions");
  }
  return bytes;
}

std::string read_beginning(const std::string& path, std::size_t max_bytes) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes(max_bytes, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return bytes;
}

Result<std::string> referred_path(std::string_view reference, const std::string& name, const std::string& folder) {
  const std::string text(reference);
  const auto refuse = [&](const std::string& why) {
    std::string shown;
    for (const char c : text.substr(0, 80)) shown += c >= 32 && c != 127 ? c : '?';
    return make_error("mesh.bad-reference", fmt::format("{}: refers to \"{}\", {}", name, shown, why),
                      "put the file beside the mesh or in a folder below it, and refer to it by a relative path");
  };
  if (folder.empty()) return refuse("but other files are not read here");
  if (text.empty()) return refuse("which names no file");
  if (text.find('\0') != text.npos) return refuse("which has a zero byte");
  if (text.find("://") != text.npos) return refuse("which is not a local file");
  std::string slashed = text;
  for (auto& c : slashed) c = c == '\\' ? '/' : c;  // files from Windows
  const fs::path path(slashed);
  if (path.is_absolute() || (slashed.size() > 1 && slashed[1] == ':')) return refuse("which is an absolute path");
  for (const auto& part : path) {
    if (part == "..") return refuse("which leads out of its folder");
  }
  return (fs::path(folder) / path).string();
}

}  // namespace orbc::files
