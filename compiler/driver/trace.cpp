#include "compiler/driver/trace.h"

#include "compiler/render/draw.h"

namespace orbc::driver {

render::Film trace(const Opened& opened, const TraceOptions& options, const Executor& executor, const Progress& progress) {
  report(progress, "preparing", 0, 0);
  const orbc::trace::TraceScene scene = orbc::trace::prepare(*opened.room, executor);
  render::DrawOptions draw;
  draw.samples = options.samples;
  draw.max_bounces = opened.scene.cover.max_bounces;
  draw.min_weight = opened.scene.cover.min_weight;
  draw.background = opened.scene.cover.background;
  return render::draw(scene, opened.eye, draw, executor, progress);
}

}  // namespace orbc::driver
