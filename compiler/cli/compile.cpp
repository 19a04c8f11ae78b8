#include <fmt/format.h>

#include <filesystem>

#include "compiler/cli/commands.h"
#include "compiler/cli/output.h"
#include "compiler/cli/progress_bar.h"
#include "compiler/cli/support.h"
#include "compiler/driver/compile.h"
#include "compiler/driver/threads.h"
#include "exporters/gltf/write_gltf.h"
#include "exporters/pov/write_pov.h"
#include "exporters/svg/write_svg.h"

namespace orbc::cli {
namespace {

std::string format_of(const CompileArguments& a) {
  if (!a.format.empty()) return a.format;
  const std::string ending = std::filesystem::path(a.output).extension().string();
  for (const char* known : {"pov", "glb", "gltf", "svg"})
    if (ending == std::string(".") + known) return known;
  throw UsageError(a.output == "-"
                       ? "say which format goes to standard output: -f pov, glb, gltf or svg"
                       : fmt::format("cannot tell the format from \"{}\"; end it in .pov, .glb, .gltf or .svg, or use --format", a.output));
}

std::string stem_of(const std::string& output) {
  const std::string stem = output == "-" ? "scene" : std::filesystem::path(output).stem().string();
  return stem.empty() ? "scene" : stem;
}

// The main output last: whoever sees it may rely on the files it names.
void write_files(const std::vector<driver::File>& files, const std::string& output) {
  const std::filesystem::path folder = std::filesystem::path(output).parent_path();
  for (const driver::File& file : files)
    if (!file.name.empty()) write_output((folder / file.name).string(), file.bytes);
  for (const driver::File& file : files)
    if (file.name.empty()) write_output(output, file.bytes);
}

driver::Tiling::Model model_of(const std::string& name) {
  return name == "klein" ? driver::Tiling::Model::klein : name == "plane" ? driver::Tiling::Model::plane : driver::Tiling::Model::disk;
}

int write_tiling(const driver::Opened& opened, const CompileArguments& a, const Common& common) {
  const auto tiling =
      driver::tile(opened, model_of(a.model), a.colour == "length" ? driver::Tiling::Colouring::length : driver::Tiling::Colouring::parity);
  if (!tiling) return print(tiling.error(), common), kSceneWrong;
  write_files(svg::write_svg(*tiling), a.output);
  if (!common.quiet) fmt::print(stderr, "{}: {} copies of {}\n", a.output, tiling->copies.size(), tiling->title);
  return kDone;
}

std::vector<driver::File> exported(const driver::Product& product, const std::string& format, const std::string& output,
                                   bool nodes_per_copy) {
  if (format == "pov") {
    pov::PovOptions options;
    options.name = stem_of(output);
    options.inline_atlas = output == "-";
    return pov::write_pov(product, options);
  }
  gltf::GltfOptions options;
  options.name = stem_of(output);
  options.binary = format == "glb";
  options.nodes_per_copy = nodes_per_copy;
  return gltf::write_gltf(product, options);
}

void print_notes(const driver::Compiled& compiled, const std::string& format, const CompileArguments& a, const Common& common) {
  Diagnostics notes = compiled.notes;
  if (compiled.product.native && format != "pov")
    notes.push_back(make_warning("gltf.native-lights-shared",
                                 "lamps of glTF are points and cones that light every copy, not their own alone; ambient light is left out",
                                 "draw it with POV-Ray, or bake the light (`lights: baked`)"));
  Common told = common;
  told.quiet = common.quiet && !a.tell_notes;
  print(notes, told);
}

}  // namespace

driver::CompileOptions compile_options(const CompileArguments& a) {
  driver::CompileOptions options;
  options.bend.view = a.view == "disk" ? bend::View::disk : bend::View::eye;
  options.bend.tolerance_px = a.tolerance;
  if (a.max_triangles && options.bend.view == bend::View::eye) options.budget = *a.max_triangles;
  else if (a.max_triangles) options.bend.max_triangles = *a.max_triangles;
  options.levels = !a.no_lod;
  options.paint.highlights = a.highlights;
  options.paint.max_side = a.max_atlas;
  options.max_memory = parse_bytes(a.max_memory);
  return options;
}

int compile(const CompileArguments& a, const Common& common) {
  if (a.output.empty() && !a.plan) throw UsageError("say where to write: -o FILE, or -o - for standard output");
  const std::string format = a.plan ? "glb" : format_of(a);
  if (a.output == "-" && format == "gltf") throw UsageError("a .gltf has files beside it and cannot go to standard output; use -f glb");
  if (a.output == "-" && (common.json || a.report == "-"))
    throw UsageError("only one thing can go to standard output: the scene, the report or --json");
  const driver::CompileOptions options = compile_options(a);
  const auto opened = driver::open_scene(a.scene.scene, overrides_of(a.scene));
  if (!opened) return print(opened.error(), common), kSceneWrong;
  print(opened->notes, common);
  if (opened->scene.bake.atlas == scene::AtlasDepth::exr && format.substr(0, 2) == "gl")
    return print({make_error("gltf.no-exr", "glTF holds its atlas as PNG or JPEG, not as EXR",
                             "use `atlas: 16` (--atlas 16), or write .pov", opened->scene.span)},
                 common),
           kSceneWrong;
  if (format == "svg") return write_tiling(*opened, a, common);

  ProgressBar bar(!common.quiet && stderr_is_terminal());
  const Executor executor = driver::parallel_executor(common.threads, &interrupted());
  if (a.plan) {
    const auto plan = driver::plan(*opened, options, executor);
    if (!plan) return print(plan.error(), common), kSceneWrong;
    write_output("-", driver::plan_json(*plan));
    return kDone;
  }
  const auto compiled = driver::compile(*opened, options, executor, bar.progress());
  if (!compiled) return bar.clear(), print(compiled.error(), common), kSceneWrong;
  bar.clear();
  print_notes(*compiled, format, a, common);
  report(bar.progress(), "writing", 0, 0);
  write_files(exported(compiled->product, format, a.output, a.nodes_per_copy), a.output);
  if (!a.report.empty()) write_output(a.report, driver::report_json(*compiled));
  if (common.json) write_output("-", driver::report_json(*compiled));
  bar.clear();
  const driver::Report& r = compiled->report;
  if (!common.quiet)
    fmt::print(stderr, "{}: {} copies, {} triangles, true within {:.3g} px\n", a.output == "-" ? "standard output" : a.output, r.copies,
               r.triangles, r.error_bound_px);
  return kDone;
}

}  // namespace orbc::cli
