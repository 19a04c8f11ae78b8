// Straight rays and curved ones side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "compiler/cli/child.h"
#include "compiler/cli/commands.h"
#include "compiler/cli/draw.h"
#include "compiler/cli/effects.h"
#include "compiler/cli/lens.h"
#include "compiler/cli/output.h"
#include "compiler/cli/picture.h"
#include "compiler/cli/progress_bar.h"
#include "compiler/cli/result.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"
#include "compiler/driver/straight.h"
#include "compiler/driver/threads.h"
#include "compiler/driver/trace_film.h"
#include "compiler/driver/unlit.h"

namespace orbc::cli {
namespace {

constexpr int kSamples = 4;

/// The scene with rays of one kind, whatever it says itself.
Result<driver::LoadedScene> load_with(const char* rays, const scene::SceneText& text, const RenderArguments& a, const Common& common) {
  scene::Overrides overrides = overrides_of(a.compile.scene);
  overrides.push_back({"<compare>", std::string("rays=") + rays});
  return driver::load(text, overrides, parse_bytes(common.max_memory));
}

Drawn draw(const driver::PreparedScene& scene, const RenderArguments& a, const Common& common) {
  if (a.engine != "tracer") return draw_elsewhere(scene, a, common);
  ProgressBar bar(!common.quiet && stderr_is_terminal());
  const render::Film film = driver::trace_film(scene, scene.loaded().eye, {.samples = a.samples, .exact = a.exact},
                                               driver::parallel_executor(common.threads), bar.progress());
  bar.clear();
  return {kDone, render::to_image(film, scene.scene().exposure), {}};
}

/// In: pictures of the same height.
image::Image side_by_side(const image::Image& left, const image::Image& right) {
  image::Image both{left.width + right.width, left.height, {}};
  both.rgba.reserve(left.rgba.size() + right.rgba.size());
  for (int y = 0; y < both.height; ++y)
    for (const image::Image* picture : {&left, &right}) {
      const std::ptrdiff_t row = std::ptrdiff_t{4} * picture->width;
      both.rgba.insert(both.rgba.end(), picture->rgba.begin() + y * row, picture->rgba.begin() + (y + 1) * row);
    }
  return both;
}

}  // namespace

int compare(const RenderArguments& arguments, const Common& common) {
  RenderArguments a = arguments;
  if (a.samples == 0) a.samples = kSamples;
  const PictureFormat format = picture_format_of(a.compile.output, false, "the two pictures side by side have 8 bits");
  keep_standard_output_apart(a.compile.output, common);
  check_outputs({a.compile.output});
  const bool here = a.engine == "tracer";
  if (!here)
    if (const Diagnostics missing = missing_renderer(a.engine); !missing.empty()) return print(missing, common), kMachine;
  const auto text = driver::open(a.compile.scene.scene);
  if (!text) return print(text.error(), common), kSceneWrong;
  const auto straight = load_with("straight", *text, a, common);
  const auto curved = load_with("curved", *text, a, common);
  if (!straight || !curved) return print(straight ? curved.error() : straight.error(), common), kSceneWrong;
  refuse_inputs({a.compile.output}, curved->files);
  Diagnostics notes = curved->notes;
  const unsigned target = here ? kTraced : a.engine == "povray" ? kPov : kGltf;
  append(notes, without_effect(common.given, {target, false, false, false, a.samples}, *curved));
  if (!driver::draws_straight(straight->scene))
    append(notes, {make_warning("cli.same-rays", "in flat rooms geodesics are straight: both pictures are the same",
                                "compare a room on the sphere or in the hyperbolic plane", curved->scene.orbifold_span)});
  append(notes, driver::unlit_note(*curved));
  append(notes, driver::straight_note(*straight));
  if (here) append(notes, few_lens_samples(*curved, a.samples));
  print(notes, common);
  const Drawn left = draw(driver::PreparedScene(*straight, prepare_options(a.compile)), a, common);
  if (left.code != kDone) return left.code;
  const Drawn right = draw(driver::PreparedScene(*curved, prepare_options(a.compile)), a, common);
  if (right.code != kDone) return right.code;
  const image::Image both = side_by_side(left.picture, right.picture);
  write_output(a.compile.output, encoded(both, format));
  print_result({{"output", a.compile.output},
                {"format", name(format)},
                {"engine", a.engine},
                {"left", "straight"},
                {"right", "curved"},
                {"width", both.width},
                {"height", both.height},
                {"samples", a.samples}},
               notes, common);
  if (!common.quiet)
    print_message(fmt::format("{}: {}x{}, straight rays on the left, curved ones on the right, {} samples a pixel, drawn by {}\n",
                              shown(a.compile.output), both.width, both.height, a.samples, a.engine));
  return kDone;
}

}  // namespace orbc::cli
