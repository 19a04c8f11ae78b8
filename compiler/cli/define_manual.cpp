// Commands that tell of the program itself.
#include <CLI/CLI.hpp>

#include "compiler/cli/define.h"
#include "compiler/cli/manual.h"
#include "compiler/cli/output.h"
#include "compiler/cli/support.h"

namespace orbc::cli {

void define_completion(Program& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* c = program.app.add_subcommand("completion", "Print the completion script of a shell");
  c->add_option("shell", *shell, "bash, zsh or fish")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}))->type_name("SHELL");
  program.commands.push_back({c, [shell, &app = program.app](const Common&) {
                                write_output("-", completion(app, *shell));
                                return kDone;
                              }});
}

void define_man(Program& program) {
  CLI::App* c = program.app.add_subcommand("man", "Print the man page");
  program.commands.push_back({c, [&app = program.app](const Common&) {
                                write_output("-", man_page(app));
                                return kDone;
                              }});
}

}  // namespace orbc::cli
