#include "compiler/mesh_io/texture_loader.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "compiler/files/files.h"
#include "compiler/image_io/decode.h"
#include "compiler/mesh_io/tokens.h"

namespace orbc::mesh_io {
namespace {

namespace fs = std::filesystem;

/// Folders with more entries than this are searched no further.
constexpr int kMaxFolderEntries = 100'000;

/// The entry of a folder that has this name, or else the first in alphabetical order that has it in other case.
std::optional<fs::path> entry_in_any_case(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  std::optional<fs::path> found;
  int seen = 0;
  for (fs::directory_iterator it(folder, error), end; !error && it != end && seen < kMaxFolderEntries; it.increment(error), ++seen) {
    const fs::path entry = it->path().filename();
    if (lower_case(entry.string()) == lower_case(name) && (!found || entry < found->filename())) found = folder / entry;
  }
  return found;
}

std::optional<std::string> path_in_any_case(const fs::path& folder, const fs::path& relative) {
  fs::path at = folder;
  for (const auto& part : relative) {
    if (part == ".") continue;
    const auto entry = entry_in_any_case(at, part.string());
    if (!entry) return {};
    at = *entry;
  }
  return at.string();
}

}  // namespace

Result<std::string> find_referred_file(std::string_view reference, const ReadContext& context) {
  auto path = files::referred_path(reference, context.name, context.folder);
  if (context.folder.empty()) return path;
  std::error_code error;
  if (path && fs::exists(*path, error)) return path;
  std::string slashed(reference);
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  if (slashed.find('\0') != slashed.npos) return path;
  if (path) {
    if (auto found = path_in_any_case(context.folder, slashed)) return *std::move(found);
  }
  const fs::path name = fs::path(slashed).filename();
  if (!name.empty() && name != ".." && name != ".") {
    if (auto found = path_in_any_case(context.folder, name)) return *std::move(found);
  }
  if (!path) return path;
  if (auto wrong = files::check_file(*path, context.options.max_file_bytes); !wrong.empty()) return wrong;
  return path;
}

int TextureLoader::load(std::string_view reference) {
  const auto path = find_referred_file(reference, context_);
  if (!path) return warn(path.error()), -1;
  const auto known = index_of_path_.find(*path);
  if (known != index_of_path_.end()) return known->second;
  std::uint64_t used = 0;
  for (const auto& texture : textures) used += texture.rgba.size();
  auto limits = context_.options.images;
  limits.max_bytes = limits.max_bytes > used ? limits.max_bytes - used : 0;
  report_read(context_.options, *path);
  auto image = image_io::load_image(*path, limits);
  if (!image) {
    warn(image.error());
    return index_of_path_[*path] = -1;
  }
  return index_of_path_[*path] = add(*std::move(image));
}

int TextureLoader::add(image::Image image) {
  textures.push_back(std::move(image));
  return static_cast<int>(textures.size()) - 1;
}

void TextureLoader::warn(const Diagnostics& reasons) {
  warnings.push_back(make_warning("mesh.bad-texture", fmt::format("{}: a texture is left out: {}", context_.name, reasons.front().message),
                                  reasons.front().hint));
}

}  // namespace orbc::mesh_io
