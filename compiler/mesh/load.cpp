// The door of the room: from a path to a mesh. Each format goes file → sieve → OpenMesh → soup → mesh; glTF has its own way.
#include "compiler/mesh/load.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "compiler/files/files.h"
#include "compiler/mesh/gltf.h"
#include "compiler/mesh/sieve.h"

namespace orbc::mesh {
namespace {

std::optional<Format> format_of(const std::string& path) {
  auto ending = std::filesystem::path(path).extension().string();
  for (auto& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (ending == ".obj") return Format::obj;
  if (ending == ".ply") return Format::ply;
  if (ending == ".off") return Format::off;
  if (ending == ".stl") return Format::stl;
  if (ending == ".gltf") return Format::gltf;
  if (ending == ".glb") return Format::glb;
  return {};
}

Result<Sieved> sieve(std::string_view bytes, Format format, const std::string& name, const std::string& folder,
                     const LoadOptions& options) {
  switch (format) {
    case Format::obj:
      return sieve_obj(bytes, name, folder, options);
    case Format::ply:
      return sieve_ply(bytes, name, folder, options);
    case Format::off:
      return sieve_off(bytes, name, options);
    default:
      return sieve_stl(bytes, name, options);
  }
}

std::string word_of(Format format) {
  switch (format) {
    case Format::obj:
      return "obj";
    case Format::ply:
      return "ply";
    case Format::off:
      return "off";
    default:
      return "stl";
  }
}

}  // namespace

Result<Loaded> load_mesh_bytes(std::string_view bytes, Format format, const std::string& name, const std::string& folder,
                               const LoadOptions& options) {
  if (bytes.size() > options.max_file_bytes) {
    return make_error("mesh.too-big", fmt::format("{}: {} bytes; at most {} are read", name, bytes.size(), options.max_file_bytes));
  }
  if (bytes.empty()) return make_error("mesh.truncated", fmt::format("{}: the file is empty", name), "copy or export it again");
  if (format == Format::gltf || format == Format::glb) return read_gltf(bytes, format == Format::glb, name, folder, options);
  auto sieved = sieve(bytes, format, name, folder, options);
  if (!sieved) return std::move(sieved).error();
  auto soup = read_by_openmesh(*sieved, word_of(format), name);
  if (!soup) return std::move(soup).error();
  auto loaded = to_mesh(*soup, name, options);
  if (!loaded) return loaded;
  loaded->mesh.looks = std::move(sieved->looks);
  loaded->mesh.textures = std::move(sieved->textures);
  loaded->warnings.insert(loaded->warnings.begin(), sieved->warnings.begin(), sieved->warnings.end());
  return loaded;
}

Result<Loaded> load_mesh(const std::string& path, const LoadOptions& options) {
  const auto format = format_of(path);
  if (!format) {
    if (auto wrong = files::check_file(path, options.max_file_bytes); !wrong.empty() && wrong.front().code == "mesh.missing-file")
      return wrong;
    return make_error("mesh.unknown-format", fmt::format("{}: is not a kind of mesh file that is known here", path),
                      "known are .obj, .ply, .off, .stl, .gltf and .glb");
  }
  auto bytes = files::read_file(path, options.max_file_bytes);
  if (!bytes) return std::move(bytes).error();
  auto folder = std::filesystem::path(path).parent_path().string();
  return load_mesh_bytes(*bytes, *format, path, folder.empty() ? "." : folder, options);
}

}  // namespace orbc::mesh
