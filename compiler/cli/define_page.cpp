// The command that opens the designer.
#include <CLI/CLI.hpp>

#include "compiler/cli/define.h"

namespace orbc::cli {

void define_design(Program& program) {
  const auto arguments = std::make_shared<DesignArguments>();
  DesignArguments& a = *arguments;
  CLI::App* c = program.app.add_subcommand("design", "Walk in a room and change it, in a page that needs no network");
  c->add_option("scene", a.scene, "Scene file, or - for standard input (default: the empty page)")->type_name("SCENE");
  c->add_option("-o,--output", a.output, "Where to write the page (default: a temporary file)")->type_name("FILE");
  c->add_flag("!--no-open", a.open, "Only write the page; do not open it in the browser");
  c->footer("Examples:\n  orbc design\n  orbc design s.yaml\n  orbc design s.yaml -o s.html --no-open");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return design(*arguments, common); }});
}

}  // namespace orbc::cli
