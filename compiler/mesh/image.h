#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

/// Bounds on a picture, checked against its header before any pixel is read.
struct ImageLimits {
  int max_side = 16384;
  std::uint64_t max_bytes = 512u << 20;  ///< width × height × 4
};

/// Reads a PNG or JPEG file (told by its bytes, not its name) as 8-bit sRGB RGBA.
/// Makes:        rows from top to bottom; grey becomes RGB, a missing alpha 255; a PNG of another gamma or of 16 bits is encoded to sRGB.
/// Diagnostics:  mesh.missing-file, mesh.not-a-file, mesh.image-too-big, mesh.bad-image.
[[nodiscard]] Result<Image> load_image(const std::string& path, const ImageLimits& limits = {});

/// The same for an encoded picture in memory; `name` is what diagnostics call it.
[[nodiscard]] Result<Image> decode_image(std::string_view bytes, const std::string& name, const ImageLimits& limits = {});

/// The picture as a PNG file, RGB if it is opaque everywhere, else RGBA; same picture, same bytes (no time stamp, no text).
[[nodiscard]] std::string encode_png(const Image& image);

/// The picture as a baseline JPEG of the given quality (1 to 100), its colours not subsampled, without alpha; same picture, same bytes.
[[nodiscard]] std::string encode_jpeg(const Image& image, int quality = 92);

/// A picture of 16 bits a channel as PNG, its codes sRGB as they are; with the alpha of a picture of the same size, if one is given.
[[nodiscard]] std::string encode_deep_png(const DeepImage& image, const Image* alpha = nullptr);
/// The same as OpenEXR: linear light in half floats.
[[nodiscard]] std::string encode_exr(const DeepImage& image);
/// The alpha of a picture as a grey PNG.
[[nodiscard]] std::string encode_mask(const Image& image);

/// Reads what encode_png wrote, or any PNG.
[[nodiscard]] Result<Image> decode_png(std::string_view bytes, const ImageLimits& limits = {});

}  // namespace orbc::mesh
