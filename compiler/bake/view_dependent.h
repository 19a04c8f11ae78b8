#pragma once
#include <functional>

#include "compiler/bake/diffuse.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/cover/copy.h"
#include "compiler/place/camera.h"

namespace orbc::bake {

/// What an eye sees in a mirror, glass or metal object.
/// In:    a point of the room near the surface; the unit direction there to the eye's image; the copy in which the eye sees the point; how
///        far the point may lie beside the surface (levels of detail); which sample of a texel this is.
/// Makes: radiance × exposure, without the copy's weight. It may be called from several threads.
using SpecularQuery = std::function<scene::Color(const geometry::Position& at, const trace::Direction& to_eye, const cover::Copy& copy,
                                                 double surface_offset, const light::SampleStratum& sample)>;

struct ViewBakeOptions {
  SpecularQuery specular;                 ///< none: mirror, glass and metal objects keep their plain colours
  double tolerance = 1;                   ///< steps of 1/255 of the picture: smaller highlights are left out
  double probe_spacing_px = 4;            ///< pixels between points that are always sampled
  double min_spacing_px = 0.8;            ///< pixels between points where highlights change
  int rays_per_texel = 2;                 ///< a side, where what glass, mirrors and metals show is finer than a texel
  double offscreen_factor = 4;            ///< of all spacings, for what lies outside the picture: only a camera that turns sees it
  int max_side = 16384;                   ///< texels of the atlas
  std::uint64_t max_texels = 40'000'000;  ///< of the view-dependent part; the nearest copies come first
};

/// The options for what the author of a scene, or the command line, says of the bake.
[[nodiscard]] ViewBakeOptions view_bake_options(const scene::BakeSpec& spec);

/// The parts of the baked room that copies are drawn from. Without models every copy is drawn from all parts that the lighting knows.
struct DrawnParts {
  std::vector<std::vector<std::uint32_t>> models;  ///< indices of parts
  std::vector<std::uint32_t> model_of_copy;
  std::vector<double> surface_offset;  ///< per part: how far it may lie beside the surface that it stands for; missing: 0
};

/// The room, its light, and how the eye sees it.
struct ViewBakeInput {
  const place::Interior& interior;  ///< of which `diffuse` was made
  const light::LightingContext& lighting;
  const DiffuseBake& diffuse;
  const std::vector<cover::Copy>& copies;
  const DrawnParts& drawn;
  const place::Camera& eye;
};

/// The places in the atlas of one part of one copy, instead of those that all copies share.
struct CopyUv {
  std::size_t copy = 0, part = 0;
  std::vector<std::array<float, 2>> uv;  ///< per vertex of the part of the atlas
  std::vector<std::size_t> patches = {};  ///< ascending: those with texels of their own
};

/// The texels of a patch in one copy that are above white where no mirror has dimmed them yet.
struct PatchAboveWhite {
  std::size_t copy = 0, part = 0, patch = 0;
  PatchTexels texels;
};

struct ViewBakeCounts {
  std::uint64_t texels = 0;
  std::size_t copies = 0;           ///< that have texels of their own
  std::size_t copies_left_out = 0;  ///< beyond max_texels: they show no highlights at all
};

/// The atlas of the diffuse bake with the texels of this eye below it.
struct ViewBake {
  image::Image image;
  image::Image16 image16;                             ///< empty if the diffuse bake has none
  std::vector<std::vector<std::array<float, 2>>> uv;  ///< of the diffuse bake, in the larger picture: per part, per vertex
  std::vector<CopyUv> copy_uv;                        ///< by copy, then by part
  ViewBakeCounts counts;
  double first_dimmed_v = 2;  ///< texels from here on are dimmed by mirrors already; above 1: none
  std::vector<PatchAboveWhite> above_white;  ///< by copy, then by part: not in the picture yet (add_dimmed_light)
};

/// Whether a room has surfaces that look different from every side: mirror, glass and metal, and glossy ones where there are lamps.
[[nodiscard]] bool needs_view_bake(const place::Interior& interior, const light::LightingContext& lighting);

/// Bakes what glossy surfaces send to an eye, and what it sees in mirror, glass and metal objects, copy by copy: as seen from a copy, the
/// eye is its image under the inverse map of that copy.
/// Makes: patches with a visible highlight get texels of their own in a copy, about one for each pixel that they take; all others keep the
///        diffuse texels. Same bytes for any executor.
/// Error: `tolerance`, and that of colours of 8 bits.
[[nodiscard]] ViewBake bake_view_dependent(const ViewBakeInput& input, const ViewBakeOptions& options, const Executor& executor,
                                           const Progress& progress = {});

}  // namespace orbc::bake
