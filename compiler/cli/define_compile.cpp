// The command that writes files for renderers and viewers.
#include <CLI/CLI.hpp>

#include "compiler/cli/define.h"
#include "exporters/formats.h"

namespace orbc::cli {
namespace {

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const auto& format : exporters::export_formats()) names.emplace_back(format.name);
  return names;
}

}  // namespace

void define_compile(Program& program) {
  const auto arguments = std::make_shared<CompileArguments>();
  CompileArguments& a = *arguments;
  CLI::App* c = program.app.add_subcommand("compile", "Unfold the mirrors, bend every copy for the eye, and write a file for a renderer");
  add_scene(*c, a.scene);
  c->add_option("-o,--output", a.output, "Where to write; - for standard output")->type_name("FILE");
  c->add_option("-f,--format", a.format, exporters::export_format_names("") + " (default: by the ending of the output)")
      ->check(CLI::IsMember(format_names()))
      ->type_name("FORMAT");
  c->add_option("--view", a.view, "eye (for straight rays from the camera) or disk (the conformal chart, seen from anywhere)")
      ->capture_default_str()
      ->check(CLI::IsMember({"eye", "disk"}))
      ->type_name("VIEW");
  add_compile_options(*c, a);
  c->add_option("--report", a.report, "Write copies, triangles and error bounds as JSON")->type_name("FILE");
  c->add_flag("--nodes-per-copy", a.nodes_per_copy, "glTF: one node for every copy, so that copies can be clicked");
  c->add_flag("--nodes-per-object", a.nodes_per_object,
              "glTF: one node and material for every object, of all its copies, under its name: to be hidden and restyled");
  c->add_option("--model", a.model, "SVG: disk, klein or plane")
      ->capture_default_str()
      ->check(CLI::IsMember({"disk", "klein", "plane"}))
      ->type_name("MODEL");
  c->add_option("--colour", a.color, "SVG: colour the copies by parity or length")
      ->capture_default_str()
      ->check(CLI::IsMember({"parity", "length"}))
      ->type_name("RULE");
  c->add_flag("--plan", a.plan, "Only say how many copies, triangles and bytes it would take");
  c->footer(
      "Examples:\n  orbc compile s.yaml -o s.glb\n  orbc compile s.yaml -o s.svg --model klein\n  orbc compile s.yaml -f pov -o - | "
      "scripts/povray-pipe -o s.png");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return compile(*arguments, common); }});
}

}  // namespace orbc::cli
