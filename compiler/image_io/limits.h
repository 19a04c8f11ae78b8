#pragma once
#include <cstdint>
#include <string>

#include "compiler/base/diagnostic.h"

namespace orbc::image_io {

/// Bounds on a picture. They are checked against its header before any pixel is read.
struct ImageLimits {
  int max_side = 16384;                  ///< pixels
  std::uint64_t max_bytes = 512u << 20;  ///< width × height × 4
};

/// Diagnostics: mesh.bad-image of an empty picture, mesh.image-too-big; none if width × height pixels may be read.
[[nodiscard]] Diagnostics check_size(std::uint64_t width, std::uint64_t height, const std::string& name, const ImageLimits& limits);

/// mesh.bad-image: the picture `name` cannot be decoded because of `what`.
[[nodiscard]] Diagnostic bad_image(const std::string& name, const std::string& what);

}  // namespace orbc::image_io
