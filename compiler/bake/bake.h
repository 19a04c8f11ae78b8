#pragma once
#include "compiler/bake/atlas.h"
#include "compiler/bake/blocks.h"
#include "compiler/bake/passing.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/light/lighting.h"

namespace orbc::bake {

/// How finely light is baked: lengths are intrinsic, per unit of length of the room.
struct BakeOptions {
  double coarse = 32;         ///< points per unit that are always lit: smaller shadows may be missed
  double fine = 160;          ///< points per unit where light changes (shadow borders)
  double texture_fine = 400;  ///< the same where a texture or a solid pattern does
  double tolerance = 1.5;     ///< in steps of 1/255 of the picture: what lies between points may be off by
  int max_side = 16384;       ///< pixels of the atlas
  bool with_image16 = false;  ///< 16 bits a channel as well
  PassOptions passing;        ///< of what surfaces pass on to each other, if LightField::options say that they do
};
/// What the author of a scene, or the command line, says of it.
[[nodiscard]] BakeOptions bake_options(const scene::BakeSpec& spec);
/// Light for a bake of that quality: a draft leaves out more of what adds little.
[[nodiscard]] light::LightOptions baked_light_options(const scene::Scene& scene);

/// Whether one sees the room in a material: in mirror and glass, and, where there is light, in metals.
[[nodiscard]] bool shows_room(const scene::Material& material, bool lit);
/// Whether a room has such looks.
[[nodiscard]] bool shows_room(const place::PlacedRoom& room, bool lit);

/// Whether the plain colours of `make_atlas` do not suffice: there are lamps, mirror or glass objects, or solid patterns (which a field
/// without lamps shows unlit).
[[nodiscard]] bool needs_bake(const scene::Scene& scene, const place::PlacedRoom& room);

/// What was baked, for reports.
struct BakeCounts {
  std::uint64_t points = 0;  ///< surface points that were lit
  std::uint64_t texels = 0;
};

/// Bakes the light of a room into one picture.
/// Makes:       for every two neighbouring triangles of one look (or a single one) a block of texels, a grid from corner to corner; texel
///              centres lie on the corners, so bilinear lookup never leaves the block, and neighbours that share an edge agree on it. A
///              single triangle's texels beyond its long side continue it: c₁ + c₂ − c₀, so that the lookup is linear up to the border. A
///              grid is as fine as the light on it asks for: it starts coarse, and between points that differ, or near points that a mean
///              would have missed, it is lit again at half the distance. Same bytes for any executor.
/// In:          the field that prepare_light made for this room. Parts beyond those of the field are coarser levels of them: their points
///              have the light that was found on the surface there; only those that lie on none are lit themselves.
/// Diagnostics: light.atlas-too-large; the hint names what makes it smaller.
struct Baked {
  Atlas atlas;
  BakeCounts counts;
  /// Per part of the room; atlas.room has their vertices in this order: corners 00, 10, 01, of pairs 11
  std::vector<std::vector<Block>> blocks;
  std::vector<std::vector<Box>> boxes;  ///< parallel: where in the picture
};
[[nodiscard]] Result<Baked> bake(const place::PlacedRoom& room, const light::LightingContext& lighting, const BakeOptions& options,
                                 const Executor& executor, const Progress& progress = {});

}  // namespace orbc::bake
