// Commands that tell of the program itself.
#include <CLI/CLI.hpp>

#include "compiler/cli/define.h"
#include "compiler/cli/manual.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"

namespace orbc::cli {

void define_explain(Program& program) {
  const auto arguments = std::make_shared<ExplainArguments>();
  CLI::App* c = program.app.add_subcommand("explain", "Say what causes a diagnostic and what cures it");
  c->add_option("code", arguments->code,
                "What stands in brackets behind error, warning or note; a word before the dot lists its codes, nothing all")
      ->type_name("CODE");
  c->footer("Examples:\n  orbc explain scene.no-effect\n  orbc explain notation\n  orbc explain");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return explain(*arguments, common); }});
}

void define_schema(Program& program) {
  CLI::App* c = program.app.add_subcommand("schema", "Print the JSON schema of scenes, from which editors complete and check");
  c->footer("Examples:\n  orbc schema > orbc-scene.schema.json");
  program.commands.push_back({c, [](const Common& common) { return schema(common); }});
}

void define_completion(Program& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* c = program.app.add_subcommand("completion", "Print the completion script of a shell");
  c->add_option("shell", *shell, "bash, zsh or fish")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}))->type_name("SHELL");
  c->footer("Examples:\n  orbc completion bash > ~/.local/share/bash-completion/completions/orbc\n  source <(orbc completion bash)");
  program.commands.push_back({c, [shell, &app = program.app](const Common&) {
                                write_standard_output(completion(app, *shell));
                                return kDone;
                              }});
}

void define_man(Program& program) {
  CLI::App* c = program.app.add_subcommand("man", "Print the man page");
  c->footer("Examples:\n  orbc man > orbc.1\n  orbc man | man -l -");
  program.commands.push_back({c, [&app = program.app](const Common&) {
                                write_standard_output(man_page(app));
                                return kDone;
                              }});
}

}  // namespace orbc::cli
