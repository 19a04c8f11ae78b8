// From a path to a mesh: each format becomes a polygon soup and that a mesh; glTF becomes a mesh directly.
#include "compiler/mesh_io/load.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "compiler/files/files.h"
#include "compiler/image_io/decode.h"
#include "compiler/mesh_io/ply_header.h"
#include "compiler/mesh_io/read_gltf.h"
#include "compiler/mesh_io/readers.h"
#include "compiler/mesh_io/tokens.h"

namespace orbc::mesh_io {
namespace {

constexpr std::uint64_t kBytesPerTriangle = 400;
constexpr std::size_t kBeginning = 64 << 10;

std::string hint_for_ending(const std::string& ending) {
  for (const char* known :
       {".dae", ".fbx", ".usd", ".usda", ".usdc", ".usdz", ".blend", ".3ds", ".abc", ".x3d", ".wrl", ".dxf", ".3mf", ".bvh"})
    if (ending == known) return "open it in Blender and export it as glTF (.glb)";
  return "known are .obj, .ply, .off, .stl, .gltf and .glb";
}

Result<PolygonSoup> read_soup(std::string_view bytes, Format format, const ReadContext& context) {
  switch (format) {
    case Format::obj:
      return read_obj(bytes, context);
    case Format::ply:
      return read_ply(bytes, context);
    case Format::off:
      return read_off(bytes, context);
    default:
      return read_stl(bytes, context);
  }
}

/// Refuses what its first bytes promise to be too large, before it is read whole: that takes several times its size.
Diagnostics refuse_by_beginning(const std::string& path, Format format, const LoadOptions& options) {
  if (format != Format::stl && format != Format::ply) return {};
  const std::string beginning = files::read_beginning(path, kBeginning);
  const ReadContext context{path, "", options};
  if (format == Format::stl) {
    std::error_code error;
    return check_stl_size(beginning, std::filesystem::file_size(path, error), context);
  }
  const auto header = read_ply_header(beginning, context);
  return header ? check_ply_size(*header, context) : Diagnostics{};
}

}  // namespace

std::optional<Format> format_of(const std::string& path) {
  const auto ending = lower_case(std::filesystem::path(path).extension().string());
  if (ending == ".obj") return Format::obj;
  if (ending == ".ply") return Format::ply;
  if (ending == ".off") return Format::off;
  if (ending == ".stl") return Format::stl;
  if (ending == ".gltf") return Format::gltf;
  if (ending == ".glb") return Format::glb;
  return {};
}

LoadOptions bounds_within(std::uint64_t max_memory) {
  LoadOptions options;
  options.max_file_bytes = max_memory / 4;
  options.max_triangles = std::min(options.max_triangles, max_memory / kBytesPerTriangle);
  options.images.max_bytes = max_memory / 8;
  return options;
}

Result<mesh::LoadedMesh> load_mesh_bytes(std::string_view bytes, Format format, const std::string& name, const std::string& folder,
                                         const LoadOptions& options) {
  if (bytes.size() > options.max_file_bytes) {
    return make_error("mesh.too-big", fmt::format("{}: {} bytes; at most {} are read", name, bytes.size(), options.max_file_bytes));
  }
  if (bytes.empty()) return make_error("mesh.truncated", fmt::format("{}: the file is empty", name), "copy or export it again");
  const ReadContext context{name, folder, options};
  if (format == Format::gltf || format == Format::glb) return read_gltf(bytes, format == Format::glb, context);
  auto soup = read_soup(bytes, format, context);
  if (!soup) return std::move(soup).error();
  return to_mesh(*std::move(soup), context);
}

Result<mesh::LoadedMesh> load_mesh(const std::string& path, const LoadOptions& options) {
  const auto format = format_of(path);
  if (!format) {
    if (auto wrong = files::check_file(path, options.max_file_bytes); !wrong.empty() && wrong.front().code == "mesh.missing-file")
      return wrong;
    return make_error("mesh.unknown-format", fmt::format("{}: is not a kind of mesh file that is known here", path),
                      hint_for_ending(lower_case(std::filesystem::path(path).extension().string())));
  }
  if (auto wrong = refuse_by_beginning(path, *format, options); !wrong.empty()) return wrong;
  report_read(options, path);
  auto bytes = files::read_file(path, options.max_file_bytes);
  if (!bytes) return std::move(bytes).error();
  auto folder = std::filesystem::path(path).parent_path().string();
  return load_mesh_bytes(*bytes, *format, path, folder.empty() ? "." : folder, options);
}

mesh::AssetSource assets_from_files(const LoadOptions& options) {
  return {[options](const std::string& path) { return load_mesh(path, options); },
          [options](const std::string& path) {
            report_read(options, path);
            return image_io::load_image(path, options.images);
          }};
}

}  // namespace orbc::mesh_io
