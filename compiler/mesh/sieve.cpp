// What the formats' sieves share: files, references from file to file, common diagnostics.
#include "compiler/mesh/sieve.h"

#include <fmt/core.h>

#include <filesystem>
#include <fstream>

namespace orbc::mesh {

namespace fs = std::filesystem;

Diagnostic not_finite(const std::string& name, const std::string& where) {
  return make_error("mesh.not-finite",
                    fmt::format("{}: {} has a coordinate that is not a finite number below {:g}", name, where, kLargestCoordinate),
                    "export the mesh again");
}

Diagnostic bad_number(const std::string& name, const std::string& where, std::string_view word) {
  std::string shown;
  for (const char c : word.substr(0, 40)) shown += c >= 32 && c < 127 ? c : '?';
  return make_error("mesh.bad-number", fmt::format("{}: {}: \"{}\" is not a number", name, where, shown));
}

Diagnostic truncated(const std::string& name, const std::string& what) {
  return make_error("mesh.truncated", fmt::format("{}: {}", name, what),
                    "the file was cut off, or its header is wrong: copy or export it again");
}

Diagnostic too_many(const std::string& name, const std::string& what, std::uint64_t count, std::uint64_t bound) {
  return make_error("mesh.too-big", fmt::format("{}: {} {}; at most {} are read", name, count, what, bound),
                    "simplify the mesh in the program that made it");
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

void add_texture(std::string_view reference, const std::string& name, const std::string& folder, const LoadOptions& options,
                 const std::array<double, 3>& color, Sieved& sieved) {
  sieved.looks.push_back({color, -1});
  const auto warn = [&](const Diagnostics& reasons) {
    sieved.warnings.push_back(make_warning("mesh.bad-texture", fmt::format("{}: a texture is left out: {}", name, reasons.front().message),
                                           reasons.front().hint));
  };
  auto path = referred_path(reference, name, folder);
  if (!path) return warn(path.error());
  for (std::size_t i = 0; i < sieved.texture_paths.size(); ++i) {
    if (sieved.texture_paths[i] == *path) {
      sieved.looks.back().texture = static_cast<int>(i);
      return;
    }
  }
  std::uint64_t used = 0;
  for (const auto& texture : sieved.textures) used += texture.rgba.size();
  auto limits = options.images;
  limits.max_bytes = limits.max_bytes > used ? limits.max_bytes - used : 0;
  auto image = load_image(*path, limits);
  if (!image) return warn(image.error());
  sieved.looks.back().texture = static_cast<int>(sieved.textures.size());
  sieved.texture_paths.push_back(*path);
  sieved.textures.push_back(*std::move(image));
}

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
    return {make_error("mesh.too-big", fmt::format("{}: {} bytes; at most {} are read", path, size, max_bytes))};
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

}  // namespace orbc::mesh
