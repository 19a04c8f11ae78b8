// What the formats' sieves share: textures, common diagnostics.
#include "compiler/mesh/sieve.h"

#include <fmt/core.h>

#include "compiler/files/files.h"
#include "compiler/image_io/decode.h"

namespace orbc::mesh {

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

void add_texture(std::string_view reference, const std::string& name, const std::string& folder, const LoadOptions& options,
                 const std::array<double, 3>& color, Sieved& sieved) {
  sieved.looks.push_back({color, -1});
  const auto warn = [&](const Diagnostics& reasons) {
    sieved.warnings.push_back(make_warning("mesh.bad-texture", fmt::format("{}: a texture is left out: {}", name, reasons.front().message),
                                           reasons.front().hint));
  };
  auto path = files::referred_path(reference, name, folder);
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
  auto image = image_io::load_image(*path, limits);
  if (!image) return warn(image.error());
  sieved.looks.back().texture = static_cast<int>(sieved.textures.size());
  sieved.texture_paths.push_back(*path);
  sieved.textures.push_back(*std::move(image));
}

}  // namespace orbc::mesh
