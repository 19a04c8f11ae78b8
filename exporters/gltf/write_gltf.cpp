// One primitive for all copies: importers pay by the node and the material (5,000 of each take Blender 106 s, one primitive 1.2 s), hence
// the weights per vertex. KHR_materials_unlit with baseColorTexture is the one form that Blender 3.4 draws with exact colours. doubleSided,
// because every other copy is a mirror image and turns its triangles around. glTF (x, y, z) is Blender's (x, −z, y).
// Sources: glTF 2.0 specification (Khronos), §3.6–3.11, §4.4 (GLB); renderers study §8–10.
#include "exporters/gltf/write_gltf.h"

#include <algorithm>
#include <stdexcept>

#include "compiler/base/check.h"
#include "compiler/image_io/png.h"
#include "exporters/gltf/document.h"
#include "exporters/gltf/layout.h"
#include "exporters/side_file.h"

namespace orbc::gltf {
namespace {

using driver::Product;
using driver::ProductCopy;

void append_u32(std::string& out, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 255);
}

void append_atlas(const Layout& layout, const std::string& png, std::string& out) {
  if (layout.atlas_bytes == 0) return;
  out += png;
  out.append(layout.total_bytes - layout.atlas_at - png.size(), '\0');
}

/// Header, JSON chunk padded with spaces, binary chunk padded with zeros (glTF 2.0 §4.4).
std::string make_glb(const Product& product, const Layout& layout, const std::string& png, std::string json) {
  json.append((4 - json.size() % 4) % 4, ' ');
  const bool has_bin = layout.total_bytes > 0;
  const std::size_t total = 12 + 8 + json.size() + (has_bin ? 8 + layout.total_bytes : 0);
  if (total > 0xFFFFFFFFu)
    throw std::length_error("a GLB file holds less than 4 GiB, this one would need " + std::to_string(total) +
                            " bytes; write .gltf instead");
  std::string out;
  out.reserve(total);
  out += "glTF";
  append_u32(out, 2);
  append_u32(out, total);
  append_u32(out, json.size());
  out += "JSON";
  out += json;
  json = {};
  if (has_bin) {
    append_u32(out, layout.total_bytes);
    out.append("BIN\0", 4);
    append_geometry(product, layout, out);
    append_atlas(layout, png, out);
  }
  ORBC_CHECK(out.size(), ==, total);
  return out;
}

std::string atlas_png(const Product& product) {
  ORBC_CHECK(static_cast<int>(product.depth), !=, static_cast<int>(scene::AtlasFormat::exr));
  if (product.atlas16.rgb.empty()) return image_io::encode_png(product.atlas);
  return image_io::encode_png(product.atlas16, product.masked ? &product.atlas : nullptr);
}

}  // namespace

std::vector<driver::File> write_gltf(const Product& product, const GltfOptions& options) {
  ORBC_CHECK(product.uv.size(), ==, product.positions.size());
  ORBC_CHECK(options.nodes_per_object && (options.nodes_per_copy || (product.objects.empty() && !product.copies.empty())), ==, false);
  const bool drawn =
      std::any_of(product.copies.begin(), product.copies.end(), [](const ProductCopy& c) { return c.vertex_count && c.index_count; });
  std::string png;
  if (drawn && !product.atlas.rgba.empty()) png = atlas_png(product);
  const Layout layout = make_layout(product, options.nodes_per_copy, options.binary ? png.size() : 0);

  std::vector<driver::File> files;
  if (options.binary) {
    files.push_back({"", make_glb(product, layout, png, make_json(product, layout, options, {}))});
    return files;
  }
  std::string bin;
  if (layout.total_bytes > 0) {
    bin.reserve(layout.total_bytes);
    append_geometry(product, layout, bin);
  }
  const Uris uris{exporters::side_file_name({options.name, "gltf", "", ".bin"}, bin),
                  exporters::side_file_name({options.name, "gltf", "-atlas", ".png"}, png)};
  files.push_back({"", make_json(product, layout, options, uris)});
  if (!bin.empty()) files.push_back({uris.bin, std::move(bin)});
  if (!png.empty()) files.push_back({uris.atlas, std::move(png)});
  return files;
}

std::uint64_t bytes_of(const driver::Amount& amount) {
  constexpr std::uint64_t kHead = 2500, kCopy = 190;  // of JSON, measured
  const std::uint64_t vertex = amount.normals ? 40 : 28, index = amount.vertices <= 65535 ? 2 : 4;
  return kHead + kCopy * amount.copies + vertex * amount.vertices + 3 * index * amount.triangles;
}

}  // namespace orbc::gltf
