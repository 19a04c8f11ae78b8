// The two roads side by side: the export drawn by an unmodified renderer, and the tracer's picture with real mirrors.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

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
#include "compiler/driver/threads.h"
#include "compiler/driver/trace_film.h"
#include "compiler/image/image.h"
#include "compiler/verify/compare.h"

namespace orbc::cli {
namespace {

constexpr const char* kEightBits = "pictures of verify have 8 bits";

struct Verdict {
  std::string engine;
  verify::Comparison comparison;
  bool passed = false;
};

bool passes(const verify::Comparison& c, const VerifyArguments& a) {
  const std::uint64_t good = a.within == 1 ? c.within_1 : a.within == 2 ? c.within_2 : a.within == 4 ? c.within_4 : c.within_8;
  return verify::share(good, c) >= a.threshold && (a.samples > 1 || verify::share(c.beyond_off_edge, c) <= a.off_edge);
}

std::string table(const std::vector<Verdict>& verdicts) {
  std::string text = fmt::format("{:<10}{:>11}{:>11}{:>11}{:>11}{:>9}{:>9}{:>11}{:>11}\n", "against", "<= 1/255", "<= 2/255", "<= 4/255",
                                 "<= 8/255", "mean", "largest", "> 2, edge", "> 2, else");
  for (const Verdict& v : verdicts) {
    const verify::Comparison& c = v.comparison;
    text += fmt::format("{:<10}{:>10.3f}%{:>10.3f}%{:>10.3f}%{:>10.3f}%{:>9.4f}{:>9}{:>11}{:>11}  {}\n", v.engine,
                        100 * verify::share(c.within_1, c), 100 * verify::share(c.within_2, c), 100 * verify::share(c.within_4, c),
                        100 * verify::share(c.within_8, c), c.mean, c.largest, c.beyond_on_edge, c.beyond_off_edge,
                        v.passed ? "agrees" : "DIFFERS");
  }
  return text;
}

nlohmann::ordered_json json(const std::vector<Verdict>& verdicts) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Verdict& v : verdicts) {
    const verify::Comparison& c = v.comparison;
    list.push_back({{"engine", v.engine},
                    {"pixels", c.pixels},
                    {"within_1", verify::share(c.within_1, c)},
                    {"within_2", verify::share(c.within_2, c)},
                    {"within_4", verify::share(c.within_4, c)},
                    {"within_8", verify::share(c.within_8, c)},
                    {"mean", c.mean},
                    {"largest", c.largest},
                    {"beyond_2_on_edges", c.beyond_on_edge},
                    {"beyond_2_elsewhere", c.beyond_off_edge},
                    {"agrees", v.passed}});
  }
  return list;
}

// Where the two pictures and that of their differences go: "shot.jpg" makes shot-export.jpg and shot-tracer.jpg, "shot" writes PNG.
struct Kept {
  std::string stem, ending;
  PictureFormat format = PictureFormat::png;
};

Kept kept(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension().string();
  const std::string known = lower_case(ending);
  if (known != ".png" && known != ".jpg" && known != ".jpeg") return {name, ".png"};
  return {name.substr(0, name.size() - ending.size()), ending, known == ".png" ? PictureFormat::png : PictureFormat::jpeg};
}

/// The names of the pictures that are kept; empty: not wanted.
struct KeptNames {
  std::string difference, drawn, traced;
  [[nodiscard]] std::vector<std::string> all() const { return {difference, drawn, traced}; }
};

KeptNames kept_names(const VerifyArguments& a) {
  if (a.keep.empty()) return {a.difference, "", ""};
  const Kept names = kept(a.keep);
  return {a.difference, names.stem + "-export" + names.ending, names.stem + "-tracer" + names.ending};
}

void write_pictures(const VerifyArguments& a, const image::Image& drawn, const image::Image& reference) {
  const KeptNames names = kept_names(a);
  std::vector<std::pair<std::string, std::string>> files;  // name, bytes
  if (!a.difference.empty())
    files.emplace_back(names.difference,
                       encoded(verify::difference_picture(drawn, reference), picture_format_of(a.difference, false, kEightBits)));
  if (!a.keep.empty()) {
    files.emplace_back(names.drawn, encoded(drawn, kept(a.keep).format));
    files.emplace_back(names.traced, encoded(reference, kept(a.keep).format));
  }
  std::vector<OutputFile> outputs;
  for (const auto& [name, bytes] : files) outputs.push_back({name, bytes});
  if (!outputs.empty()) write_together(outputs);
}

void refuse_what_cannot_be(const VerifyArguments& a) {
  if (a.difference == "-" || a.keep == "-") throw UsageError("standard output holds the table of verify; name a file for its pictures");
  if (!a.difference.empty()) (void)picture_format_of(a.difference, false, kEightBits);
}

/// What a renderer has drawn of the export, compared with the tracer's picture.
struct Compared {
  int code = kDone;  ///< exit code; all else is there when it is kDone
  image::Image drawn;
  Verdict verdict;
  Diagnostics notes;
};

Compared compare_with(const std::string& engine, const driver::PreparedScene& scene, const image::Image& reference,
                      const VerifyArguments& a, const Common& common) {
  RenderArguments arguments;
  arguments.compile = a.compile;
  arguments.engine = engine;
  arguments.samples = a.samples;
  Common silent = common;
  silent.quiet = true;
  Drawn by_engine = draw_elsewhere(scene, arguments, silent);
  if (by_engine.code != kDone) return {by_engine.code, {}, {}, {}};
  if (by_engine.picture.width != reference.width || by_engine.picture.height != reference.height)
    throw std::runtime_error("the renderer's picture has another size");
  Verdict verdict{engine, verify::compare(by_engine.picture, reference), false};
  verdict.passed = passes(verdict.comparison, a);
  return {kDone, std::move(by_engine.picture), verdict, by_engine.exported.notes};
}

/// Whether the command line says how finely light is baked.
bool asks_quality(const SceneArguments& a) {
  return !a.quality.empty() || std::any_of(a.set.begin(), a.set.end(), [](const std::string& text) {
    return text.rfind("bake.quality=", 0) == 0 || text.rfind("bake=", 0) == 0;
  });
}

}  // namespace

int verify(const VerifyArguments& a, const Common& common) {
  refuse_what_cannot_be(a);
  const std::vector<std::string> outputs = kept_names(a).all();
  check_outputs(outputs);
  Diagnostics missing = missing_renderer("povray");
  if (a.blender) append(missing, missing_renderer("blender"));
  if (!missing.empty()) return print(missing, common), kMachine;
  auto loaded = driver::load(a.compile.scene.scene, overrides_of(a.compile.scene), parse_bytes(common.max_memory));
  if (!loaded) return print(loaded.error(), common), kSceneWrong;
  refuse_inputs(outputs, loaded->files);
  const unsigned targets = kTraced | kPov | (a.blender ? unsigned{kGltf} : 0);
  append(loaded->notes, without_effect(common.given, {targets, false, false, false, a.samples}, *loaded));
  append(loaded->notes, leave_out_lens(*loaded));
  print(loaded->notes, common);
  ProgressBar bar(!common.quiet && stderr_is_terminal());
  // The two roads are compared at the quality of their best export, whatever quality the scene asks for. A quality that the command line
  // asks for holds.
  const scene::BakeQuality path_quality = loaded->scene.bake.quality;
  if (!asks_quality(a.compile.scene)) loaded->scene.bake.quality = scene::BakeQuality::fine;
  const driver::PreparedScene scene(*loaded, prepare_options(a.compile));
  const render::Film film = driver::trace_film(scene, loaded->eye, {.samples = a.samples, .exact = true, .path_quality = path_quality},
                                               driver::parallel_executor(common.threads), bar.progress());
  bar.clear();
  const image::Image reference = render::to_image(film, loaded->scene.exposure);
  std::vector<Verdict> verdicts;
  image::Image drawn;
  Diagnostics notes = loaded->notes;
  for (const char* engine : {"blender", "povray"}) {  // the difference picture shows POV-Ray's, which is always drawn
    if (engine == std::string("blender") && !a.blender) continue;
    Compared compared = compare_with(engine, scene, reference, a, common);
    if (compared.code != kDone) return compared.code;
    append(notes, compared.notes);
    drawn = std::move(compared.drawn);
    verdicts.push_back(std::move(compared.verdict));
  }
  write_pictures(a, drawn, reference);
  const bool all = std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.passed; });
  if (!common.json) write_standard_output(table(verdicts));
  print_result({{"agrees", all},
                {"width", reference.width},
                {"height", reference.height},
                {"samples", a.samples},
                {"within", a.within},
                {"threshold", a.threshold},
                {"off_edge", a.off_edge},
                {"pictures", json(verdicts)}},
               notes, common);
  if (!all && !loaded->scene.lamps.empty() && !common.quiet)
    print_message(
        a.samples >= 64 && a.within >= 4 && a.threshold <= 0.99
            ? "hint: exports hold light at texels, so lit scenes differ along edges, shadows and glass; these weigh less in larger "
              "pictures, such as --size 800x600\n"
            : "hint: exports hold light at texels, so lit scenes differ along shadows and glass; --samples 64 --within 4 "
              "--threshold 0.99 compares them fairly, in a picture of 800x600\n");
  return all ? kDone : kSceneWrong;
}

}  // namespace orbc::cli
