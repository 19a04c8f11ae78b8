#pragma once
#include <array>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/image/image.h"
#include "compiler/place/interior.h"

namespace orbc::bake {

/// One picture for the whole room, and where every vertex of every part finds its colour in it.
struct Atlas {
  image::Image image;                                 ///< sRGB, rows from top to bottom
  place::Interior room;                               ///< the room with vertices split where triangles of different styles met
  std::vector<std::vector<std::array<float, 2>>> uv;  ///< per part, per vertex; v from top to bottom
  image::Image16 image16;                             ///< the same picture with 16 bits a channel, where that was asked for
};

/// A picture without content: grey and opaque.
[[nodiscard]] image::Image blank_image(int width, int height);
[[nodiscard]] image::Image16 blank_image16(int width, int height);

struct AtlasOptions {
  int max_side = 16384;       ///< pixels
  bool with_image16 = false;  ///< 16 bits a channel as well
};

/// Gathers the plain colours and pictures of a room in one picture.
/// In:          uv of textured triangles in [0, 1]² (place::furnish sees to it).
/// Makes:       every distinct colour as a square of 4×4 texels, addressed in its middle, so that nearest and bilinear lookup are both
///              exact; every pair of texture and tint once, texel by texel (uv keeps its place between texel centres, so nearest lookup is
///              exact), with a gutter of 4 texels: repeated where the texture tiles a panel, stretched where it covers an object. Same
///              room, same bytes.
/// Diagnostics: light.atlas-too-large; the hint names the largest picture.
[[nodiscard]] Result<Atlas> make_atlas(const place::Interior& interior, const AtlasOptions& options = {});

}  // namespace orbc::bake
