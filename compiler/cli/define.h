#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compiler/cli/commands.h"

namespace CLI {
class App;
}

namespace orbc::cli {

/// A command of the program and what runs it once the command line has been read; it returns the exit code.
struct Command {
  CLI::App* options = nullptr;      ///< owned by the program's CLI::App
  std::function<int(const Common&)> run;
  /// What to say of more words than the command takes, such as a pattern that the shell has expanded; "" = nothing of its own
  std::function<std::string(const std::vector<std::string>& words)> extra_words{};
};

/// The program as the command line sees it. --help, the man page and the completions come from `app`.
struct Program {
  CLI::App& app;
  Common common;
  std::vector<Command> commands;    ///< in the order of --help
};

// To add a command: its arguments and its function in commands.h, a function define_… in one of the files define_*.cpp that adds the
// options and pushes a Command, and a line for it here and in `define_commands` (run.cpp).

void define_info(Program& program);
void define_enumerate(Program& program);
void define_svg(Program& program);
void define_new(Program& program);
void define_check(Program& program);
void define_compile(Program& program);
void define_design(Program& program);
void define_render(Program& program);
void define_trace(Program& program);
void define_compare(Program& program);
void define_at(Program& program);
void define_animate(Program& program);
void define_verify(Program& program);
void define_diff(Program& program);
void define_explain(Program& program);
void define_schema(Program& program);
void define_completion(Program& program);
void define_man(Program& program);

// Options that several commands share (define_common.cpp).

/// --quiet, --verbose, --json, --threads, --max-memory.
void add_common(CLI::App& command, Common& common);
/// --set: any key of the scene.
void add_set(CLI::App& command, std::vector<std::string>& set);
/// The scene, and what is said instead of it.
void add_scene(CLI::App& command, SceneArguments& scene);
void add_quality(CLI::App& command, SceneArguments& scene, const std::string& help);
/// How exports are made: light, error, limits.
void add_compile_options(CLI::App& command, CompileArguments& arguments);

}  // namespace orbc::cli
