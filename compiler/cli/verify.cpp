// The two roads side by side: the export drawn by an unmodified renderer, and the tracer's picture with real mirrors.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "compiler/cli/commands.h"
#include "compiler/cli/output.h"
#include "compiler/cli/progress_bar.h"
#include "compiler/cli/support.h"
#include "compiler/driver/compare.h"
#include "compiler/driver/threads.h"
#include "compiler/driver/trace.h"
#include "compiler/mesh/image.h"

namespace orbc::cli {
namespace {

struct Verdict {
  std::string engine;
  driver::Comparison comparison;
  bool passed = false;
};

mesh::Image decoded(const std::string& path) {
  const auto image = mesh::load_image(path);
  if (!image) throw std::runtime_error("cannot read back the renderer's picture: " + to_text(image.error()));
  return *image;
}

bool passes(const driver::Comparison& c, const VerifyArguments& a) {
  const std::uint64_t good = a.within == 1 ? c.within_1 : a.within == 2 ? c.within_2 : a.within == 4 ? c.within_4 : c.within_8;
  return driver::share(good, c) >= a.threshold && (a.samples > 1 || driver::share(c.beyond_off_edge, c) <= a.off_edge);
}

std::string table(const std::vector<Verdict>& verdicts) {
  std::string text = fmt::format("{:<10}{:>11}{:>11}{:>11}{:>11}{:>9}{:>9}{:>11}{:>11}\n", "against", "<= 1/255", "<= 2/255", "<= 4/255",
                                 "<= 8/255", "mean", "largest", "> 2, edge", "> 2, else");
  for (const Verdict& v : verdicts) {
    const driver::Comparison& c = v.comparison;
    text += fmt::format("{:<10}{:>10.3f}%{:>10.3f}%{:>10.3f}%{:>10.3f}%{:>9.4f}{:>9}{:>11}{:>11}  {}\n", v.engine,
                        100 * driver::share(c.within_1, c), 100 * driver::share(c.within_2, c), 100 * driver::share(c.within_4, c),
                        100 * driver::share(c.within_8, c), c.mean, c.largest, c.beyond_on_edge, c.beyond_off_edge,
                        v.passed ? "agrees" : "DIFFERS");
  }
  return text;
}

std::string json(const std::vector<Verdict>& verdicts) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Verdict& v : verdicts) {
    const driver::Comparison& c = v.comparison;
    list.push_back({{"engine", v.engine},
                    {"pixels", c.pixels},
                    {"within_1", driver::share(c.within_1, c)},
                    {"within_2", driver::share(c.within_2, c)},
                    {"within_4", driver::share(c.within_4, c)},
                    {"within_8", driver::share(c.within_8, c)},
                    {"mean", c.mean},
                    {"largest", c.largest},
                    {"beyond_2_on_edges", c.beyond_on_edge},
                    {"beyond_2_elsewhere", c.beyond_off_edge},
                    {"agrees", v.passed}});
  }
  return list.dump(2) + "\n";
}

}  // namespace

int verify(const VerifyArguments& a, const Common& common) {
  const auto opened = driver::open_scene(a.compile.scene.scene, overrides_of(a.compile.scene));
  if (!opened) return print(opened.error(), common), kSceneWrong;
  print(opened->notes, common);
  Common within = common;
  within.json = false;
  ProgressBar bar(!common.quiet && stderr_is_terminal());
  const render::Film film = driver::trace(*opened, {a.samples}, driver::parallel_executor(common.threads, &interrupted()), bar.progress());
  bar.clear();
  const mesh::Image reference = render::to_image(film, opened->scene.exposure);
  const TemporaryFolder folder;
  std::vector<Verdict> verdicts;
  mesh::Image drawn;
  CompileArguments finest = a.compile;  // two roads are compared, not how coarsely one of them may be walked
  if (finest.scene.quality.empty()) finest.scene.quality = "fine";
  for (const char* engine : {"blender", "povray"}) {  // the difference picture shows POV-Ray's, which is always drawn
    if (engine == std::string("blender") && !a.blender) continue;
    RenderArguments render_arguments;
    render_arguments.compile = finest;
    render_arguments.engine = engine;
    render_arguments.samples = a.samples;
    render_arguments.compile.output = (folder.path() / (std::string(engine) + ".png")).string();
    Common silent = within;
    silent.quiet = true;
    if (const int code = render(render_arguments, silent); code != kDone) return code;
    drawn = decoded(render_arguments.compile.output);
    if (drawn.width != reference.width || drawn.height != reference.height)
      throw std::runtime_error("the renderer's picture has another size");
    Verdict verdict{engine, driver::compare(drawn, reference), false};
    verdict.passed = passes(verdict.comparison, a);
    verdicts.push_back(verdict);
  }
  if (!a.difference.empty()) write_output(a.difference, mesh::encode_png(driver::difference_picture(drawn, reference)));
  if (!a.keep.empty()) {
    write_output(a.keep + "-export.png", mesh::encode_png(drawn));
    write_output(a.keep + "-tracer.png", mesh::encode_png(reference));
  }
  write_output("-", common.json ? json(verdicts) : table(verdicts));
  bool all = true;
  for (const Verdict& v : verdicts) all = all && v.passed;
  if (!all && !opened->scene.lamps.empty() && !common.quiet)
    fmt::print(stderr,
               "hint: exports hold light at texels, so lit scenes differ along shadows and glass; --samples 64 --within 4 --threshold 0.99 "
               "compares them fairly\n");
  return all ? kDone : kSceneWrong;
}

}  // namespace orbc::cli
