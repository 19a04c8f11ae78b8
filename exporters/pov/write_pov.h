#pragma once
#include <string>
#include <vector>

#include "compiler/driver/product.h"

namespace orbc::pov {

struct PovOptions {
  std::string name = "scene";   ///< the output's stem: files beside it are called after it (side_file.h)
  bool inline_atlas = false;    ///< for pipes: the atlas rides along as base64 in a comment, scripts/povray-pipe unpacks it
  bool interpolate = false;     ///< bilinear in linear light instead of the nearest texel; always so for a blended atlas
};

/// Writes the product as a scene of POV-Ray 3.7 that an unmodified povray draws with straight rays and exact colours.
/// In:     copies whose triangles use only their own vertices.
/// Makes:  the scene (name "") and, unless `inline_atlas`, the atlas beside it; the same bytes for the same product. One mesh2 a copy with
///         its weight as emission; no normals and no lights, unless the product has lamps: then each copy is a light_group with its own;
///         the camera in its explicit right-handed form. Copies without triangles are only mentioned.
/// Source: renderers study §2–4: assumed_gamma 1 and adc_bailout 0 give exact colours; the spherical camera wants right and up negated.
[[nodiscard]] std::vector<driver::File> write_pov(const driver::Product& product, const PovOptions& options = {});

/// About how many bytes that takes, without the atlas. Error: 15 %.
[[nodiscard]] std::uint64_t bytes_of(const driver::Amount& amount);

}  // namespace orbc::pov
