// glTF 2.0 (Khronos specification 2.0.1) by tinygltf. It parses, and touches the disk only through the callbacks below, which read nothing
// outside the folder of the file. Pictures are not decoded while it parses: it would hand over unchecked ranges of buffers.
#include "compiler/mesh_io/read_gltf.h"

#include <fmt/core.h>
#include <tiny_gltf.h>

#include <new>
#include <optional>
#include <utility>

#include "compiler/files/files.h"
#include "compiler/mesh/weld.h"
#include "compiler/mesh_io/colors.h"
#include "compiler/mesh_io/data_uri.h"
#include "compiler/mesh_io/errors.h"
#include "compiler/mesh_io/gltf_material.h"
#include "compiler/mesh_io/gltf_nodes.h"
#include "compiler/mesh_io/gltf_primitives.h"
#include "compiler/mesh_io/texture_loader.h"
#include "compiler/mesh_io/transparency.h"

namespace orbc::mesh_io {
namespace {

const char kValidatorHint[] = "check it with the Khronos glTF validator";

/// What the callbacks of tinygltf need and take down.
struct ReferredFiles {
  const ReadContext& context;
  std::uint64_t max_bytes;  ///< that may still be read
  GltfPictures pictures;
};

std::string_view without_dots(std::string_view reference) {
  while (reference.substr(0, 2) == "./") reference.remove_prefix(2);
  return reference;
}

std::optional<std::string> path_of(ReferredFiles& files, std::string_view reference) {
  constexpr std::size_t kMaxReference = 1000;  // messages quote it
  auto path = find_referred_file(without_dots(reference).substr(0, kMaxReference), files.context);
  const auto wrong = path ? files::check_file(*path, files.max_bytes) : path.error();
  if (wrong.empty()) return *path;
  for (const auto& known : files.pictures.refused) {
    if (known.message == wrong.front().message) return {};
  }
  files.pictures.refused.push_back(wrong.front());
  return {};
}

tinygltf::FsCallbacks callbacks(ReferredFiles& files) {
  tinygltf::FsCallbacks fs{};
  fs.user_data = &files;
  fs.FileExists = [](const std::string& path, void* data) {
    return is_data_uri(without_dots(path)) || path_of(*static_cast<ReferredFiles*>(data), path).has_value();
  };
  fs.ExpandFilePath = [](const std::string& path, void*) { return path; };
  fs.ReadWholeFile = [](std::vector<unsigned char>* out, std::string* error, const std::string& path, void* data) {
    auto& own = *static_cast<ReferredFiles*>(data);
    // tinygltf itself decodes those of known types only.
    if (is_data_uri(without_dots(path))) {
      const auto decoded = decode_data_uri(without_dots(path));
      if (decoded) out->assign(decoded->begin(), decoded->end());
      if (!decoded) *error = "no data URI";
      return decoded.has_value();
    }
    const auto full = path_of(own, path);
    if (full) report_read(own.context.options, *full);
    auto bytes = full ? files::read_file(*full, own.max_bytes) : Result<std::string>(Diagnostics{});
    if (!bytes) {
      *error = "refused";
      return false;
    }
    own.max_bytes -= bytes->size();
    out->assign(bytes->begin(), bytes->end());
    return true;
  };
  fs.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; };
  return fs;
}

bool keep_picture(tinygltf::Image* image, const int index, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
                  void* data) {
  // In a buffer: the range is not checked yet, so not touched; it is found again through image->bufferView.
  if (image->bufferView < 0 && size > 0)
    static_cast<ReferredFiles*>(data)->pictures.encoded[index].assign(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  return true;
}

mesh::LoadedMesh assemble(const GltfSource& source, const GltfPictures& pictures) {
  GltfMaterials materials(source, pictures);
  mesh::Mesh mesh = assemble_mesh(source, mesh_instances(source), materials);
  if (mesh.triangles.empty()) source.fail("mesh.no-triangles", "there is no triangle in its scene");
  if (materials.materials.size() < 2) mesh.triangle_material.clear();
  mesh = mesh::remove_unused_vertices(std::move(mesh)).mesh;
  mesh.materials = std::move(materials.materials);
  mesh.textures = std::move(materials.textures);
  mesh = fold_uniform_colors(apply_wrap_modes(without_invisible_triangles(std::move(mesh)), materials.wrap_modes));
  Diagnostics warnings = materials.warnings();
  if (!source.model.animations.empty())
    warnings.push_back(make_note("mesh.ignored", source.context.name + ": is animated; it is shown in the pose in which it is stored"));
  return {std::move(mesh), std::move(warnings)};
}

std::string first_line(const std::string& text) {
  const std::string shown = quotable(std::string_view(text).substr(0, text.find('\n')), 300);
  return shown.empty() ? "it is not glTF" : shown;
}

}  // namespace

Result<mesh::LoadedMesh> read_gltf(std::string_view bytes, bool binary, const ReadContext& context) {
  if (auto wrong = scan_gltf(bytes, binary, context); !wrong.empty()) return wrong;
  ReferredFiles files{context, context.options.max_file_bytes, {}};
  try {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(&keep_picture, &files);
    loader.SetFsCallbacks(callbacks(files));
    tinygltf::Model model;
    std::string error, warning;
    const auto size = static_cast<unsigned int>(bytes.size());
    const bool done =
        binary ? loader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()), size, "")
               : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "");
    if (!done) {
      if (!files.pictures.refused.empty()) return files.pictures.refused;
      return make_error("mesh.bad-gltf", fmt::format("{}: {}", context.name, first_line(error)), kValidatorHint);
    }
    return assemble({model, context}, files.pictures);
  } catch (const GltfError& error) {
    return error.diagnostic;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& thrown) {
    return make_error("mesh.bad-gltf", fmt::format("{}: {}", context.name, first_line(thrown.what())), kValidatorHint);
  }
}

}  // namespace orbc::mesh_io
