#include <fmt/format.h>

#include <charconv>
#include <cmath>

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
#include "compiler/image_io/decode.h"
#include "compiler/image_io/exr.h"
#include "compiler/render/indirect.h"
#include "compiler/verify/compare.h"
#include "exporters/formats.h"

namespace orbc::cli {
namespace {

// POV-Ray's own antialiasing samples only where neighbours differ and blends encoded colours; a picture n times larger, averaged in linear
// light, has n² true samples a pixel. Blender takes any number.
int side_of(int samples) {
  const int side = static_cast<int>(std::lround(std::sqrt(samples)));
  if (side * side != samples || side > 16) throw UsageError("POV-Ray takes a square number of samples a pixel: 1, 4, 9, 16, ... 256");
  return side;
}

std::vector<std::string> drawing_command(const RenderArguments& a, const place::Camera& eye, const std::string& scene,
                                         const std::string& picture, const Common& common) {
  std::vector<std::string> command;
  if (a.engine == "povray") {
    command = {shipped_script("povray-pipe"), scene, "-o", picture};
    const int side = side_of(a.samples);
    if (side > 1) command.insert(command.end(), {fmt::format("+W{}", side * eye.width), fmt::format("+H{}", side * eye.height)});
    if (common.threads > 0) command.push_back(fmt::format("+WT{}", common.threads));
  } else {
    command = {shipped_script("render_blender.py"), scene, "-o", picture, "--samples", std::to_string(a.samples)};
    if (common.threads > 0) command.insert(command.end(), {"--threads", std::to_string(common.threads)});
  }
  return command;
}

// Edges want several samples; the other passes are those of a pixel's first sample, and the only one lies in its middle.
int samples_of(const RenderArguments& a) {
  constexpr int kSmooth = 4;
  return a.samples > 0 ? a.samples : a.engine == "tracer" && a.pass != "color" ? 1 : kSmooth;
}

render::Pass pass_of(const std::string& name) {
  for (const auto& [known, pass] : {std::pair{"depth", render::Pass::depth},
                                    {"normal", render::Pass::normal},
                                    {"object", render::Pass::object},
                                    {"bounces", render::Pass::bounces},
                                    {"weight", render::Pass::weight}})
    if (name == known) return pass;
  return render::Pass::color;
}

// What chance has left in a path-traced picture.
std::string noise_text(const render::Film& film, double exposure) {
  if (film.error.empty()) return "";
  return fmt::format("; noise {:.1f}/255, less with more --samples", render::rms_noise(film, exposure));
}

nlohmann::ordered_json result_of(const RenderArguments& a, PictureFormat format, const place::Camera& eye) {
  return {{"output", a.compile.output}, {"format", name(format)}, {"engine", a.engine},
          {"width", eye.width},         {"height", eye.height},   {"samples", a.samples}};
}

int render_elsewhere(const driver::PreparedScene& scene, const RenderArguments& a, PictureFormat format, const Common& common) {
  const Drawn drawn = draw_elsewhere(scene, a, common);
  if (drawn.code != kDone) return drawn.code;
  write_output(a.compile.output, encoded(drawn.picture, format));
  const driver::Report& r = drawn.exported.report;
  nlohmann::ordered_json result = result_of(a, format, scene.loaded().eye);
  result.update({{"copies", r.copies}, {"triangles", r.triangles}, {"error_bound_px", r.error_bound_px}});
  Diagnostics diagnostics = scene.loaded().notes;
  append(diagnostics, drawn.exported.size_warning);
  append(diagnostics, drawn.exported.notes);
  print_result(std::move(result), diagnostics, common);
  if (!common.quiet)
    print_message(fmt::format("{}: {}x{}, {} samples a pixel, drawn by {} from {} copies, {} triangles, true within {:.3g} px\n",
                    shown(a.compile.output), scene.loaded().eye.width, scene.loaded().eye.height, a.samples, a.engine, r.copies,
                    r.triangles, r.error_bound_px));
  return kDone;
}

/// What to say of a picture in which much is cut off at white.
Diagnostics clipped_note(const render::Film& film, double exposure) {
  constexpr double kMuch = 0.01;
  const double share = render::clipped_share(film, exposure);
  if (share <= kMuch) return {};
  return {make_note("render.clipped", fmt::format("{:.2g} % of the pixels are brighter than white and are cut off there", 100 * share),
                    "a lower `exposure` shows them; .exr keeps them as they are")};
}

std::string bytes_of(const render::Film& film, const RenderArguments& a, PictureFormat format, double exposure) {
  return format == PictureFormat::exr ? image_io::encode_exr(render::to_float_image(film))
                                      : encoded(render::to_image(film, pass_of(a.pass), exposure), format);
}

int render_here(const driver::PreparedScene& scene, const RenderArguments& a, PictureFormat format, const Common& common) {
  ProgressBar bar(!common.quiet && stderr_is_terminal());
  const double exposure = scene.scene().exposure;
  const render::Film film = driver::trace_film(scene, scene.loaded().eye, {.samples = a.samples, .exact = a.exact},
                                               driver::parallel_executor(common.threads), bar.progress());
  write_output(a.compile.output, bytes_of(film, a, format, exposure));
  bar.clear();
  nlohmann::ordered_json result = result_of(a, format, scene.loaded().eye);
  result["pass"] = format == PictureFormat::exr ? "all" : a.pass;
  if (!film.error.empty()) result["noise"] = render::rms_noise(film, exposure);
  Diagnostics notes = scene.loaded().notes;
  if (format != PictureFormat::exr && a.pass == "color") {
    const Diagnostics clipped = clipped_note(film, exposure);
    print(clipped, common);
    append(notes, clipped);
  }
  print_result(std::move(result), notes, common);
  if (!common.quiet)
    print_message(fmt::format("{}: {}x{}, {} samples a pixel, traced{}\n", shown(a.compile.output), film.width, film.height, a.samples,
                              noise_text(film, exposure)));
  return kDone;
}

/// The share of white that --noise says: a number, or a fraction such as 1/255.
double parse_noise(const std::string& text) {
  double values[2] = {0, 1};
  const char *at = text.data(), *end = at + text.size();
  for (double& value : values) {
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || next == at) break;
    at = next;
    if (at == end || *at != '/' || &value == &values[1]) break;
    ++at;
  }
  const double noise = values[0] / values[1];
  if (at != end || !(noise >= 1e-4 && noise <= 1))
    throw UsageError("--noise takes a share of white from 0.0001 to 1, such as 1/255; got " + text);
  return noise;
}

int render_to_noise(const driver::PreparedScene& scene, const RenderArguments& a, PictureFormat format, const Common& common) {
  constexpr int kMostSamples = 1024;
  ProgressBar bar(!common.quiet && stderr_is_terminal());
  const driver::NoiseTarget target{parse_noise(a.noise), a.samples > 0 ? a.samples : kMostSamples, a.exact};
  nlohmann::ordered_json result = result_of(a, format, scene.loaded().eye);
  double mean_samples = 0, unsettled = 1;
  const bool replaces = !is_stream(a.compile.output);
  const auto write = [&](const render::Film& film) { write_output(a.compile.output, bytes_of(film, a, format, scene.scene().exposure)); };
  const render::Film film = driver::trace_to_noise(
      scene, scene.loaded().eye, target, driver::parallel_executor(common.threads),
      [&](const driver::FilmPass& pass) {
        result["samples"] = pass.samples;
        mean_samples = pass.mean_samples;
        unsettled = pass.unsettled;
        if (replaces) write(pass.film);
      },
      bar.progress());
  if (!replaces) write(film);
  bar.clear();
  result.update({{"pass", format == PictureFormat::exr ? "all" : "color"},
                 {"noise_target", target.noise},
                 {"mean_samples", mean_samples},
                 {"unsettled", unsettled}});
  if (!film.error.empty()) result["noise"] = render::rms_noise(film, scene.scene().exposure);
  const int most = result["samples"];
  print_result(std::move(result), scene.loaded().notes, common);
  if (!common.quiet)
    print_message(fmt::format(
        "{}: {}x{}, traced until {}: {:.1f} samples a pixel on average, at most {}{}\n", shown(a.compile.output), film.width, film.height,
        unsettled == 0 ? fmt::format("no pixel is noisier than {:.2g}/255", 255 * target.noise)
                       : fmt::format("{:.2g} % of the pixels are noisier than {:.2g}/255", 100 * unsettled, 255 * target.noise),
        mean_samples, most, noise_text(film, scene.scene().exposure)));
  return kDone;
}

}  // namespace

Drawn draw_elsewhere(const driver::PreparedScene& scene, const RenderArguments& a, const Common& common) {
  const int side = a.engine == "povray" ? side_of(a.samples) : 1;
  const TemporaryFolder folder;
  CompileArguments exported = a.compile;
  const std::string format(exporters::find_format_of_engine(a.engine)->name);
  exported.output = (folder.path() / ("scene." + format)).string();
  exported.report.clear();
  Drawn drawn;
  {
    auto made = export_scene(scene, exported, format, common);
    if (!made) return print(made.error(), common), Drawn{kSceneWrong, {}, {}};
    drawn.exported = std::move(made).value();
  }
  print(drawn.exported.notes, common);
  const std::string picture = (folder.path() / "picture.png").string();
  if (!common.quiet && stderr_is_terminal()) print_message(fmt::format("{} draws ...\n", a.engine));
  if (const int code = run_child({drawing_command(a, scene.loaded().eye, exported.output, picture, common), folder.path().string()});
      code != 0) {
    print({make_error("cli.not-drawn", fmt::format("{} did not draw the export (exit code {})", a.engine, code),
                      code == 127 ? "its script could not be started" : "what it says of it stands above")},
          common);
    return {code == 127 ? kMachine : code, {}, {}};
  }
  // Decoded, since such pictures carry dates: what is written of it is the same for the same scene.
  auto decoded = image_io::load_image(picture, {.max_side = 1 << 20, .max_bytes = std::uint64_t{8} << 30});
  if (!decoded) throw std::runtime_error(fmt::format("cannot read back the picture of {}: {}", a.engine, to_text(decoded.error())));
  drawn.picture = side == 1 ? std::move(*decoded) : verify::box_downsample(*decoded, side);
  return drawn;
}

int render(const RenderArguments& arguments, const Common& common) {
  RenderArguments a = arguments;
  const bool here = a.engine == "tracer";
  const PictureFormat format = picture_format_of(a.compile.output, here, fmt::format("pictures of {} have 8 bits", a.engine));
  if (format == PictureFormat::exr) a.pass = "color";  // it holds all passes, whichever is asked for
  const bool to_noise = here && !a.noise.empty();
  if (to_noise && a.pass != "color") throw UsageError("--noise is of the picture; --pass " + a.pass + " has one sample a pixel");
  if (to_noise) (void)parse_noise(a.noise);
  else a.samples = samples_of(a);
  keep_standard_output_apart(a.compile.output, common);
  if (a.engine == "povray") (void)side_of(a.samples);
  check_outputs({a.compile.output});
  if (!here)
    if (const Diagnostics missing = missing_renderer(a.engine); !missing.empty()) return print(missing, common), kMachine;
  auto loaded = driver::load(a.compile.scene.scene, overrides_of(a.compile.scene), parse_bytes(common.max_memory));
  if (!loaded) return print(loaded.error(), common), kSceneWrong;
  refuse_inputs({a.compile.output}, loaded->files);
  const unsigned target = here ? kTraced : a.engine == "povray" ? kPov : kGltf;
  append(loaded->notes, without_effect(common.given, {target, false, false, format == PictureFormat::exr, a.samples}, *loaded));
  if (a.pass == "color") append(loaded->notes, driver::unlit_note(*loaded));
  append(loaded->notes, driver::straight_note(*loaded));
  if (here) append(loaded->notes, few_lens_samples(*loaded, to_noise ? 1024 : a.samples));
  print(loaded->notes, common);
  const driver::PreparedScene scene(*loaded, prepare_options(a.compile));
  if (to_noise) return render_to_noise(scene, a, format, common);
  return here ? render_here(scene, a, format, common) : render_elsewhere(scene, a, format, common);
}

}  // namespace orbc::cli
