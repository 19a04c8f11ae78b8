#pragma once
#include <functional>

#include "compiler/bake/bake.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/cover/copy.h"
#include "compiler/place/eye.h"

namespace orbc::bake {

/// What the eye sees in a mirror, glass or metal object: at a point of the room near its surface, in a copy; `to_eye` is the unit direction
/// there in which the eye lies; `beside`: how far the point may lie beside that surface (coarser levels); `stratum`: of several points that
/// are one texel.
/// Makes: colour × exposure as the copy's texture shows it, so without the copy's weight. Thread-safe.
using SeenIn = std::function<scene::Color(const geometry::Position& at, const trace::Direction& to_eye, const cover::Copy& copy,
                                          double beside, const light::SampleStratum& stratum)>;

struct HighlightOptions {
  SeenIn seen_in;                         ///< none: mirror, glass and metal objects keep their plain colours
  double tolerance = 1;                   ///< in steps of 1/255 of the picture: smaller highlights are left out
  double probe_px = 4;                    ///< pixels between points that are always asked
  double fine_px = 0.8;                   ///< and where highlights change
  int rays_per_texel = 2;                 ///< a side, where glass, a mirror or metal shows what is finer than a texel
  double coarser_beside = 4;              ///< times that, for what lies beside the picture: seen only when the camera is turned
  int max_side = 16384;                   ///< pixels of the atlas
  std::uint64_t max_texels = 40'000'000;  ///< for highlights; the nearest copies come first
};

/// What the author of a scene, or the command line, says of them.
[[nodiscard]] HighlightOptions highlight_options(const scene::BakeSpec& spec);

/// Which parts of the baked room copies are drawn from. No models: every copy from all parts that the field knows.
struct DrawnParts {
  std::vector<std::vector<std::uint32_t>> models;
  std::vector<std::uint32_t> model_of_copy;
  std::vector<double> beside;  ///< per part of the baked room, how far it lies beside the surface that it stands for; missing: 0
};

/// Places in the atlas of a part of one copy, in place of those that all copies share.
struct OwnUv {
  std::size_t copy = 0, part = 0;
  std::vector<std::array<float, 2>> uv;  ///< parallel to the vertices of the baked part
};

struct HighlightCounts {
  std::uint64_t texels = 0;
  std::size_t copies = 0;    ///< with highlights of their own
  std::size_t left_out = 0;  ///< copies beyond max_texels: they show their highlights nowhere
};

struct Highlights {
  std::vector<OwnUv> own;  ///< by copy, then part
  HighlightCounts counts;
};

/// Whether a room has surfaces whose light depends on where the eye is: mirror, glass and metal, and in a field with lamps glossy ones.
[[nodiscard]] bool needs_highlights(const place::PlacedRoom& room, const light::LightingContext& lighting);

/// Bakes what glossy surfaces send to the given eye, and what it sees in mirror, glass and metal objects, for every copy by itself: as
/// seen from a copy, the eye is its image under that copy's inverse map.
/// In:    the room and the field that `baked` was made of; copies of the room, and what they are drawn from.
/// Makes: more rows below the picture of `baked`, in which blocks with a highlight have texels of their own for a copy: as coarse as the
///        copy is far away; all others, and far copies, keep the diffuse ones. Places in the shared atlas are moved to the new size. Same
///        bytes for any executor.
/// Error: colours add up in the 8 bits of the atlas; `tolerance` besides.
[[nodiscard]] Highlights bake_highlights(const place::PlacedRoom& room, const light::LightingContext& lighting,
                                         const std::vector<cover::Copy>& copies, const DrawnParts& drawn, const place::Eye& eye,
                                         const HighlightOptions& options, Baked& baked, const Executor& executor,
                                         const Progress& progress = {});

}  // namespace orbc::bake
