#include "compiler/driver/trace.h"

#include <algorithm>

#include "compiler/bake/diffuse.h"
#include "compiler/driver/prepared.h"
#include "compiler/driver/tail.h"
#include "compiler/render/draw.h"

namespace orbc::driver {

render::DrawOptions draw_options(const Opened& opened, const light::LightingContext& light, const Executor& executor) {
  render::DrawOptions draw;
  draw.lighting = light.lit ? &light : nullptr;
  draw.paths = std::max(1, bake::bake_options(opened.scene.bake).radiosity.samples / 32);
  draw.max_bounces = opened.scene.cover.max_bounces;
  draw.min_weight = opened.scene.cover.min_weight;
  draw.background = opened.scene.cover.background;
  // The film is exposed as a whole; the background is not.
  if (light.exposure > 0) draw.background = (1 / light.exposure) * draw.background, draw.max_radiance = 1 / light.exposure;
  if (opened.expected_background) draw.background = look_beyond(opened, *opened.room, {true, {}, {}}, executor).color;
  return draw;
}

render::Film trace(const Opened& opened, const TraceOptions& options, const Executor& executor, const Progress& progress) {
  report(progress, "preparing", 0, 0);
  const Prepared& ready = prepared(opened, executor);
  render::DrawOptions draw = draw_options(opened, ready.light, executor);
  draw.samples = options.samples;
  return render::draw(ready.scene, opened.eye, draw, executor, progress);
}

}  // namespace orbc::driver
