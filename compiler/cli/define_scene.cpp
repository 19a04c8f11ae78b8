// Commands that write or check scenes.
#include <CLI/CLI.hpp>

#include "compiler/cli/define.h"
#include "compiler/cli/expanded_star.h"

namespace orbc::cli {

void define_new(Program& program) {
  const auto arguments = std::make_shared<NewArguments>();
  CLI::App* c = program.app.add_subcommand("new", "Print a commented starter scene for an orbifold");
  c->add_option("notation", arguments->notation, "Orbifold notation")->capture_default_str()->type_name("NOTATION");
  c->footer("Examples:\n  orbc new '*2323' > s.yaml\n  orbc new '*235' > dodecahedral.yaml");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return new_scene(*arguments, common); },
                              [](const std::vector<std::string>& words) { return expanded_star_message("new", words); }});
}

void define_check(Program& program) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* c = program.app.add_subcommand("check", "Check scenes and say everything that is wrong with them");
  c->add_option("scenes", arguments->scenes, "Scene files, or - for standard input")->required()->type_name("SCENE");
  add_set(*c, arguments->set);
  c->footer("Examples:\n  orbc check s.yaml\n  orbc check examples/*/scene.yaml --json\n  orbc check s.yaml --set camera.fov=60deg");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return check(*arguments, common); }});
}

}  // namespace orbc::cli
