#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "compiler/mesh/asset_source.h"

namespace orbc::html {

/// Files that scenes name, in memory: as they are on a disk, or in the form that the page holds them, whose numbers are little endian.
///   A mesh: "OMSH", then 8 counts as u32: positions, uv, colors, triangles, triangle materials, materials, textures, 0. The lists follow
///   in this order: positions 3 f64; uv 2 f32; colors 3 f32; triangles 3 u32; triangle materials u32; materials 9 f64 (kind, color,
///   texture, alpha cutoff, roughness, index, emission); pictures. A picture: "OIMG", then width and height as u32, and 4 bytes a pixel
///   (sRGB and alpha), rows from top to bottom.
using PageFiles = std::map<std::string, std::vector<std::uint8_t>>;

[[nodiscard]] std::vector<std::uint8_t> page_file(const mesh::Mesh& mesh);
[[nodiscard]] std::vector<std::uint8_t> page_file(const image::Image& picture);

/// Whether the bytes have that form.
[[nodiscard]] bool is_page_file(const std::vector<std::uint8_t>& bytes);

/// The files as a source of assets. In: files that outlive the source. A file serves every path that ends in its name, unless another has
/// the path itself: what is dropped on the page has lost its folders.
/// Makes: meshes and pictures as the program reads them from a disk. The files that a mesh of a disk refers to are only found in the page.
/// Diagnostics: mesh.missing-file for names that are not there; page.bad-asset for bytes that are no such file; those of mesh_io.
[[nodiscard]] mesh::AssetSource assets_of_page(const PageFiles& files);

}  // namespace orbc::html
