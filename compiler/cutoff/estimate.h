#pragma once
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/cutoff/endings.h"
#include "compiler/light/lighting.h"
#include "compiler/trace/follow.h"

namespace orbc::cutoff {

/// A scene as one eye sees it.
struct ViewedScene {
  const scene::Scene& scene;
  const place::Camera& eye;
  const trace::TraceScene& tracer;                   ///< of the room or, where only weights are wanted, of a coarse proxy
  const light::LightingContext* lighting = nullptr;  ///< null: plain colors; only weights may be asked for then
};

struct CutoffOptions {
  bool wants_color = false;   ///< estimate the radiance behind the cut-off by bounces and weight
  CullTest is_culled;         ///< estimate the radiance of these copies; empty: there are none
  std::vector<double> bands;  ///< heights between which culled copies get a color each (height_bands)
};

/// What a picture loses where its paths end. Weights are largest channels, means over the picture.
struct CutoffEstimate {
  double weight_lost = 0;    ///< of paths that end by `max_bounces` or `min_weight`
  double weight_culled = 0;  ///< of paths that lead into culled copies
  scene::Color color;        ///< expected radiance where paths end by depth; the scene's background where it was not estimated
  std::vector<scene::Color> color_by_band;  ///< expected radiance of culled copies seen through each band of a mirror, floor first
};

/// Whether paths that end by depth show anything: then exports need impostors there.
[[nodiscard]] bool shows_cutoff(const scene::CoverSpec& spec);

/// Estimates what lies behind the mirrors at which an export ends. A fixed grid of rays through the picture is followed through the real
/// mirrors; those that are cut off are followed much farther.
/// Makes: color = Σ (radiance the paths bring to the eye) / Σ (their weights at that mirror), channel by channel, so that the mean over the
///        grid is right when `color` takes the place of what is cut off. The same for any executor.
/// Error: that of the grid. Indirect light between surfaces is left out.
[[nodiscard]] CutoffEstimate estimate_cutoff(const ViewedScene& view, const CutoffOptions& options, const Executor& executor);

}  // namespace orbc::cutoff
