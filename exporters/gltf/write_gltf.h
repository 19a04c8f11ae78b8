#pragma once
#include <string>
#include <vector>

#include "compiler/driver/product.h"

namespace orbc::gltf {

struct GltfOptions {
  std::string name = "scene";   ///< the output's stem: unless `binary` the files beside it are called after it (side_file.h)
  bool binary = true;           ///< one GLB; false: .gltf with .bin and .png beside it
  bool nodes_per_copy = false;  ///< a node, mesh and material a copy, to be clicked in an editor; slow to import from 5,000 copies on
  bool nodes_per_object = false;  ///< a node, mesh and material an object, of all its copies; for products that are made by object
  bool interpolate = false;     ///< bilinear instead of the nearest texel; always so for a blended atlas
};

/// Writes the product as glTF 2.0: unlit triangles that any viewer draws with straight rays.
/// In:     copies whose triangles use only their own vertices; an atlas that is to be PNG (of 8 or 16 bits): glTF knows no EXR;
///         nodes_per_object needs a product by object, and excludes nodes_per_copy.
/// Makes:  by default one primitive with the weights in COLOR_0 (u16, linear) and words and ranges of the copies in the root's extras
///         (orbc_copies); with nodes_per_object such a primitive, node and material for each object, under its name (extras of the node:
///         orbc_object, and orbc_copies, how many). Positions are turned to glTF's y-up axes exactly, so that Blender shows the product's
///         coordinates; a camera node, whose extras (orbc_projection, orbc_width, orbc_height, orbc_fov_deg, orbc_background) carry what
///         glTF cannot say. The same bytes for the same product; the Khronos validator finds neither errors nor warnings. A product
///         without triangles becomes a scene with a camera.
/// Throws: std::length_error for a GLB of 4 GiB or more.
[[nodiscard]] std::vector<driver::File> write_gltf(const driver::Product& product, const GltfOptions& options = {});

/// About how many bytes that takes, all files together, without the atlas. Error: 10 %, with nodes per copy more.
[[nodiscard]] std::uint64_t bytes_of(const driver::Amount& amount);

}  // namespace orbc::gltf
