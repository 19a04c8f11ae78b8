#include "compiler/cli/lens.h"

#include <fmt/format.h>

namespace orbc::cli {

Diagnostics few_lens_samples(const driver::LoadedScene& loaded, int samples) {
  constexpr int kEnough = 16;   // from there on the eye takes noise for grain
  if (!loaded.eye.lens || samples >= kEnough) return {};
  return {make_warning("cli.few-lens-samples",
                       fmt::format("{} of a pixel look{} through the lens in too few places: what is out of focus is noise",
                                   samples == 1 ? "a single sample" : fmt::format("{} samples", samples), samples == 1 ? "s" : ""),
                       "--samples 64", loaded.scene.camera.lens->radius_span)};
}

Diagnostics leave_out_lens(driver::LoadedScene& loaded) {
  if (!loaded.eye.lens) return {};
  loaded.eye.lens.reset();
  return {make_note("cli.lens-left-out", "both pictures are drawn by a pinhole: exports have no lens", "",
                    loaded.scene.camera.lens->radius_span)};
}

}  // namespace orbc::cli
