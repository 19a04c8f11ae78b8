#include "exporters/formats.h"

#include "exporters/gltf/write_gltf.h"
#include "exporters/pov/write_pov.h"

namespace orbc::exporters {
namespace {

std::vector<driver::File> write_pov_files(const driver::Product& product, const ExportOptions& options) {
  pov::PovOptions own;
  own.name = options.name;
  own.inline_atlas = options.single_file;
  return pov::write_pov(product, own);
}

std::vector<driver::File> write_gltf_files(const driver::Product& product, const ExportOptions& options, bool binary) {
  gltf::GltfOptions own;
  own.name = options.name;
  own.binary = binary;
  own.nodes_per_copy = options.nodes_per_copy;
  own.nodes_per_object = options.nodes_per_object;
  return gltf::write_gltf(product, own);
}

std::vector<driver::File> write_glb(const driver::Product& product, const ExportOptions& options) {
  return write_gltf_files(product, options, true);
}

std::vector<driver::File> write_gltf_with_files(const driver::Product& product, const ExportOptions& options) {
  return write_gltf_files(product, options, false);
}

}  // namespace

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> kFormats = {
      {.name = "pov",
       .engine = "povray",
       .holds_exr = true,
       .lights_copies_apart = true,
       .has_side_files = true,
       .write = write_pov_files,
       .estimated_bytes = pov::bytes_of},
      {.name = "glb", .engine = "blender", .has_nodes = true, .write = write_glb, .estimated_bytes = gltf::bytes_of},
      {.name = "gltf",
       .can_be_single_file = false,
       .has_nodes = true,
       .has_side_files = true,
       .write = write_gltf_with_files,
       .estimated_bytes = gltf::bytes_of},
      {.name = "svg"},
      {.name = "html", .is_page = true},
  };
  return kFormats;
}

const ExportFormat* find_export_format(std::string_view name) {
  for (const ExportFormat& format : export_formats())
    if (format.name == name) return &format;
  return nullptr;
}

const ExportFormat* find_format_of_engine(std::string_view engine) {
  for (const ExportFormat& format : export_formats())
    if (!engine.empty() && format.engine == engine) return &format;
  return nullptr;
}

std::string export_format_names(std::string_view prefix) {
  std::string names;
  const auto& formats = export_formats();
  for (std::size_t i = 0; i < formats.size(); ++i) {
    names += i == 0 ? "" : i + 1 == formats.size() ? " or " : ", ";
    names += prefix;
    names += formats[i].name;
  }
  return names;
}

}  // namespace orbc::exporters
