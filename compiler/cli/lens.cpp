#include "compiler/cli/lens.h"

#include <fmt/format.h>

#include "compiler/cli/support.h"

namespace orbc::cli {

void tell_of_lens(const driver::Opened& opened, int samples, const Common& common) {
  constexpr int kEnough = 16;   // from there on the eye takes noise for grain
  if (!opened.eye.lens || samples >= kEnough) return;
  print({make_warning("cli.few-lens-samples",
                      fmt::format("{} of a pixel look{} through the lens in too few places: what is out of focus is noise",
                                  samples == 1 ? "a single sample" : fmt::format("{} samples", samples), samples == 1 ? "s" : ""),
                      "--samples 64", opened.scene.camera.lens->radius_span)},
        common);
}

void leave_out_lens(driver::Opened& opened, const Common& common) {
  if (!opened.eye.lens) return;
  opened.eye.lens.reset();
  print({make_note("cli.lens-left-out", "both pictures are drawn by a pinhole: exports have no lens", "",
                   opened.scene.camera.lens->radius_span)},
        common);
}

}  // namespace orbc::cli
