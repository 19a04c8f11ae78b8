#include "compiler/driver/compile.h"

#include <fmt/format.h>

#include <filesystem>

#include "compiler/cli/commands.h"
#include "compiler/cli/effects.h"
#include "compiler/cli/export.h"
#include "compiler/cli/output.h"
#include "compiler/cli/page.h"
#include "compiler/cli/progress_bar.h"
#include "compiler/cli/result.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"
#include "compiler/cli/write_export.h"
#include "compiler/driver/compile.h"
#include "compiler/driver/straight.h"
#include "compiler/driver/threads.h"
#include "compiler/driver/unlit.h"
#include "compiler/native_lights/split.h"
#include "exporters/formats.h"
#include "exporters/svg/write_svg.h"

namespace orbc::cli {

namespace {

const exporters::ExportFormat& format_of(const CompileArguments& a) {
  const std::string ending = lower_case(std::filesystem::path(a.output).extension().string());
  const std::string name = !a.format.empty() ? a.format : ending.empty() ? "" : ending.substr(1);
  if (const auto* format = exporters::find_export_format(name)) return *format;
  throw UsageError(a.output == "-" ? "say which format goes to standard output: -f " + exporters::export_format_names("")
                                   : fmt::format("cannot tell the format from \"{}\"; end it in {}, or use --format", a.output,
                                                 exporters::export_format_names(".")));
}

driver::Tiling::Model model_of(const std::string& name) {
  return name == "klein" ? driver::Tiling::Model::klein : name == "plane" ? driver::Tiling::Model::plane : driver::Tiling::Model::disk;
}

int write_tiling(const driver::LoadedScene& loaded, const CompileArguments& a, const Common& common) {
  const auto tiling =
      driver::tile(loaded, model_of(a.model), a.color == "length" ? driver::Tiling::Coloring::length : driver::Tiling::Coloring::parity);
  if (!tiling) return print(tiling.error(), common), kSceneWrong;
  const std::vector<driver::File> files = svg::write_svg(*tiling);
  const std::uint64_t bytes = write_export(files, {a.output, exporters::find_export_format("svg"), {}, {}}, loaded.files);
  print_result({{"output", a.output}, {"format", "svg"}, {"bytes", bytes}, {"orbifold", tiling->title}, {"copies", tiling->copies.size()}},
               loaded.notes, common);
  if (!common.quiet) print_message(fmt::format("{}: {} copies of {}\n", shown(a.output), tiling->copies.size(), tiling->title));
  return kDone;
}

exporters::ExportOptions export_options(const CompileArguments& a) {
  return {stem_of(a.output), is_stream(a.output), a.nodes_per_copy, a.nodes_per_object};
}

void check_nodes(const CompileArguments& a, const exporters::ExportFormat& format) {
  if (!a.nodes_per_object) return;
  if (a.nodes_per_copy) throw UsageError("--nodes-per-copy and --nodes-per-object part the same triangles in two ways; choose one of them");
  if (!format.has_nodes) throw UsageError("--nodes-per-object is for .glb and .gltf: other formats have no nodes");
}

Diagnostics notes_of(const driver::Compiled& compiled, const exporters::ExportFormat& format) {
  Diagnostics notes = compiled.notes;
  if (compiled.product.native && !format.lights_copies_apart)
    notes.push_back(make_warning("gltf.native-lights-shared",
                                 "lamps of glTF are points and cones that light every copy, not their own alone; ambient light is left out",
                                 "draw it with POV-Ray, or bake the light (`lights: baked`)"));
  return notes;
}

driver::CompileOptions compile_options(const CompileArguments& a, const Common& common) {
  driver::CompileOptions options;
  options.bend.view = a.view == "disk" ? bend::View::disk : bend::View::eye;
  options.bend.tolerance_px = a.tolerance / driver::kToleranceShares;
  options.bend.message_factor = driver::kToleranceShares;
  if (a.max_triangles && options.bend.view == bend::View::eye) options.budget = *a.max_triangles;
  else if (a.max_triangles) options.bend.max_triangles = *a.max_triangles;
  options.by_object = a.nodes_per_object;
  options.highlights = a.highlights;
  options.max_memory = parse_bytes(common.max_memory);
  return options;
}

driver::Amount amount_of(const cover::Plan& plan, bool native) {
  return {static_cast<std::uint64_t>(plan.copies), plan.vertices, plan.triangles, native};
}

/// Says that an export will be large, and what would make it smaller; before light is baked, so that there is time to stop.
void warn_of_size(const cover::Plan& plan, const exporters::ExportFormat& format, bool native, const Common& common,
                  Diagnostics& warnings) {
  constexpr std::uint64_t kLarge = 500'000'000;
  const std::uint64_t bytes = format.estimated_bytes(amount_of(plan, native));
  if (bytes <= kLarge) return;
  driver::Amount fits{0, 0, 0, native};
  int bounces = -1;
  for (std::size_t b = 0; b < plan.copies_per_bounces.size(); ++b) {
    fits.copies += static_cast<std::uint64_t>(plan.copies_per_bounces[b]);
    fits.vertices += plan.vertices_per_bounces[b], fits.triangles += plan.triangles_per_bounces[b];
    if (format.estimated_bytes(fits) > kLarge) break;
    bounces = static_cast<int>(b);
  }
  const double share = 0.8 * static_cast<double>(kLarge) / static_cast<double>(bytes);  // the plan may be off by a fifth
  const auto triangles = static_cast<std::uint64_t>(share * static_cast<double>(plan.triangles)) / 100'000 * 100'000;
  std::string hint = fmt::format("--max-triangles {} makes it smaller, with the least error that does", triangles);
  if (bounces >= 0) hint = fmt::format("--max-bounces {} would stay below 500 MB; {}", bounces, hint);
  const Diagnostics warning{
      make_warning("cli.large-export",
                   fmt::format("the export will have about {:.2g} GB: {} copies, {:.3g} million triangles",
                               static_cast<double>(bytes) / 1e9, to_string(plan.copies), static_cast<double>(plan.triangles) / 1e6),
                   hint)};
  print(warning, common);
  append(warnings, warning);
}

int write_plan(const driver::PreparedScene& scene, const CompileArguments& a, const Common& common) {
  const auto plan = driver::plan(scene, scene.loaded().eye, compile_options(a, common), driver::parallel_executor(common.threads));
  if (!plan) return print(plan.error(), common), kSceneWrong;
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(driver::plan_json(*plan));
  const driver::Amount amount = amount_of(*plan, native_lights::uses_native_lights(scene.scene()));
  json["pov_bytes"] = exporters::find_export_format("pov")->estimated_bytes(amount);
  json["gltf_bytes"] = exporters::find_export_format("gltf")->estimated_bytes(amount);
  write_standard_output(json.dump(2) + "\n");
  return kDone;
}

void refuse_what_cannot_be(const CompileArguments& a, const exporters::ExportFormat& format, const Common& common) {
  if (a.output == "-" && !format.can_be_single_file)
    throw UsageError("a .gltf has files beside it and cannot go to standard output; use -f glb");
  if (!a.plan && !format.can_be_single_file && is_stream(a.output))
    throw UsageError(fmt::format("a .gltf has files beside it and cannot go to {}, which is no ordinary file; use -f glb", a.output));
  if ((a.output == "-") + (a.report == "-") + (common.json ? 1 : 0) > 1)
    throw UsageError("only one thing can go to standard output: the scene, the report or --json");
}

}  // namespace

driver::PrepareOptions prepare_options(const CompileArguments& a) {
  driver::PrepareOptions options;
  options.lods = !a.no_lod && a.view != "disk";  // the disk is seen from anywhere: it shows everything in full detail
  options.max_atlas_side = a.max_atlas;
  return options;
}

Result<Exported> export_scene(const driver::PreparedScene& scene, const CompileArguments& a, const std::string& format_name,
                              const Common& common) {
  const exporters::ExportFormat& format = *exporters::find_export_format(format_name);
  if (scene.scene().bake.atlas == scene::AtlasFormat::exr && !format.holds_exr)
    return make_error("gltf.no-exr", "glTF holds its atlas as PNG or JPEG, not as EXR", "use `atlas: 16` (--atlas 16), or write .pov",
                      scene.scene().span);
  ProgressBar bar(!common.quiet && stderr_is_terminal());
  const Executor executor = driver::parallel_executor(common.threads);
  driver::CompileOptions options = compile_options(a, common);
  Diagnostics large;
  if (!a.max_triangles || *a.max_triangles > 4'000'000)  // fewer are small
    options.on_large_plan = [&](const cover::Plan& plan) {
      bar.clear();
      if (large.empty()) warn_of_size(plan, format, native_lights::uses_native_lights(scene.scene()), common, large);
    };
  const auto compiled = driver::compile(scene, scene.loaded().eye, options, executor, bar.progress());
  if (!compiled) return compiled.error();
  Exported result{compiled->report, driver::report_json(*compiled), notes_of(*compiled, format), large, 0};
  report(bar.progress(), "writing", 0, 0);
  result.bytes = write_export(format.write(compiled->product, export_options(a)), {a.output, &format, a.report, result.report_json},
                              scene.loaded().files);
  return result;
}

int compile(const CompileArguments& a, const Common& common) {
  if (a.output.empty() && !a.plan) throw UsageError("say where to write: -o FILE, or -o - for standard output");
  const exporters::ExportFormat& format = a.plan ? *exporters::find_export_format("glb") : format_of(a);
  refuse_what_cannot_be(a, format, common);
  check_nodes(a, format);
  if (format.is_page) return write_page(a, common);
  if (!a.plan) check_outputs({a.output, a.report});
  auto loaded = driver::load(a.scene.scene, overrides_of(a.scene), parse_bytes(common.max_memory));
  if (!loaded) return print(loaded.error(), common), kSceneWrong;
  refuse_inputs({a.output, a.report}, loaded->files);
  const unsigned target = a.plan ? kPov | kGltf : !format.write ? kSvg : format.has_nodes ? kGltf : kPov;
  append(loaded->notes, without_effect(common.given, {target, a.plan, a.view == "disk", false, 1}, *loaded));
  print(loaded->notes, common);
  const driver::PreparedScene scene(*loaded, prepare_options(a));
  if (a.plan) return write_plan(scene, a, common);
  if (!format.write) return write_tiling(*loaded, a, common);
  Diagnostics unlit = driver::unlit_note(*loaded);
  append(unlit, driver::straight_note(*loaded));
  print(unlit, common);
  append(loaded->notes, unlit);
  const auto made = export_scene(scene, a, std::string(format.name), common);
  if (!made) return print(made.error(), common), kSceneWrong;
  print(made->notes, common);
  append(loaded->notes, made->size_warning);
  append(loaded->notes, made->notes);
  if (common.json) {
    nlohmann::ordered_json result{{"output", a.output}, {"format", format.name}, {"bytes", made->bytes}};
    result.update(nlohmann::ordered_json::parse(made->report_json));
    print_result(std::move(result), loaded->notes, common);
  }
  const driver::Report& r = made->report;
  if (!common.quiet)
    print_message(
        fmt::format("{}: {} copies, {} triangles, true within {:.3g} px\n", shown(a.output), r.copies, r.triangles, r.error_bound_px));
  return kDone;
}

}  // namespace orbc::cli
