#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "compiler/cli/commands.h"
#include "compiler/cli/output.h"
#include "compiler/cli/progress_bar.h"
#include "compiler/cli/support.h"
#include "compiler/driver/compare.h"
#include "compiler/driver/threads.h"
#include "compiler/driver/trace.h"
#include "compiler/mesh/image.h"
#include "compiler/render/path.h"

namespace orbc::cli {
namespace {

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// POV-Ray's own antialiasing samples only where neighbours differ and blends encoded colours; a picture n times larger, averaged in linear
// light, has n² true samples a pixel. Blender takes any number.
int side_of(int samples) {
  const int side = static_cast<int>(std::lround(std::sqrt(samples)));
  if (side * side != samples || side > 16) throw UsageError("POV-Ray takes a square number of samples a pixel: 1, 4, 9, 16, ... 256");
  return side;
}

std::vector<std::string> drawing_command(const RenderArguments& a, const driver::Opened& opened, const std::string& scene,
                                         const std::string& picture, const Common& common) {
  std::vector<std::string> command;
  if (a.engine == "povray") {
    command = {shipped_script("povray-pipe"), scene, "-o", picture};
    const int side = side_of(a.samples);
    if (side > 1)
      command.insert(command.end(), {fmt::format("+W{}", side * opened.eye.width), fmt::format("+H{}", side * opened.eye.height)});
    if (common.threads > 0) command.push_back(fmt::format("+WT{}", common.threads));
  } else {
    command = {shipped_script("render_blender.py"), scene, "-o", picture, "--samples", std::to_string(a.samples)};
    if (common.threads > 0) command.insert(command.end(), {"--threads", std::to_string(common.threads)});
  }
  return command;
}

int render_elsewhere(const RenderArguments& a, const Common& common) {
  if (a.engine == "povray") (void)side_of(a.samples);
  const auto opened = driver::open_scene(a.compile.scene.scene, overrides_of(a.compile.scene));
  if (!opened) return print(opened.error(), common), kSceneWrong;
  print(opened->notes, common);
  const TemporaryFolder folder;
  CompileArguments exported = a.compile;
  exported.output = (folder.path() / (a.engine == "povray" ? "scene.pov" : "scene.glb")).string();
  exported.tell_notes = !common.quiet;
  Common within = common;
  within.quiet = true, within.json = false;
  if (const int code = compile(exported, within); code != kDone) return code;
  const std::string picture = (folder.path() / "picture.png").string();
  if (!common.quiet && stderr_is_terminal()) fmt::print(stderr, "{} draws ...\n", a.engine);
  const int code = run_program(drawing_command(a, *opened, exported.output, picture, common), true);
  if (code != 0) return code == 127 ? kMachine : code;
  const int side = a.engine == "povray" ? side_of(a.samples) : 1;
  if (side == 1) {
    write_output(a.compile.output, read_file(picture));
  } else {
    const auto large = mesh::load_image(picture, {.max_side = 1 << 20, .max_bytes = std::uint64_t{8} << 30});
    if (!large) throw std::runtime_error("cannot read back POV-Ray's picture: " + to_text(large.error()));
    write_output(a.compile.output, mesh::encode_png(driver::averaged(*large, side)));
  }
  if (!common.quiet) fmt::print(stderr, "{}: drawn by {}\n", a.compile.output, a.engine);
  return kDone;
}

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
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
  return fmt::format("; noise {:.1f}/255, less with more --samples", render::noise_of(film, exposure));
}

int render_here(const RenderArguments& a, const Common& common) {
  const auto opened = driver::open_scene(a.compile.scene.scene, overrides_of(a.compile.scene));
  if (!opened) return print(opened.error(), common), kSceneWrong;
  print(opened->notes, common);
  ProgressBar bar(!common.quiet && stderr_is_terminal());
  const render::Film film = driver::trace(*opened, {a.samples}, driver::parallel_executor(common.threads, &interrupted()), bar.progress());
  const bool exr = ends_with(a.compile.output, ".exr");
  write_output(a.compile.output,
               exr ? render::to_exr(film) : mesh::encode_png(render::to_image(film, pass_of(a.pass), opened->scene.exposure)));
  bar.clear();
  if (!common.quiet)
    fmt::print(stderr, "{}: {}x{}, {} samples a pixel, traced{}\n", a.compile.output, film.width, film.height, a.samples,
               noise_text(film, opened->scene.exposure));
  return kDone;
}

}  // namespace

int render(const RenderArguments& a, const Common& common) {
  return a.engine == "tracer" ? render_here(a, common) : render_elsewhere(a, common);
}

}  // namespace orbc::cli
