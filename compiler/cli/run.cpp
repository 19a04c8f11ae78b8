// The command line: options in, exit code out. What each command understands stands in the files define_*.cpp, once; --help, the man page
// and the completions come from there.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "compiler/cli/accepts.h"
#include "compiler/cli/commands.h"
#include "compiler/cli/define.h"
#include "compiler/cli/ending.h"
#include "compiler/cli/memory_limit.h"
#include "compiler/cli/result.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"
#include "compiler/cli/usage.h"

namespace orbc::cli {
namespace {

// In the order of --help.
void define_commands(Program& program) {
  define_info(program);
  define_enumerate(program);
  define_svg(program);
  define_new(program);
  define_check(program);
  define_compile(program);
  define_design(program);
  define_render(program);
  define_trace(program);
  define_at(program);
  define_animate(program);
  define_compare(program);
  define_verify(program);
  define_diff(program);
  define_explain(program);
  define_schema(program);
  define_completion(program);
  define_man(program);
}

// Before the options are read, too.
bool asks_for_json(int argc, char** argv) {
  return std::any_of(argv, argv + argc, [](const char* word) { return std::string(word) == "--json"; });
}

int run_command(const Command& command, const Common& common) {
  try {
    limit_memory(parse_bytes(common.max_memory));
    return command.run(common);
  } catch (const UsageError& error) {
    print_message(fmt::format("orbc {}: {}\n", command.options->get_name(), error.what()));
    if (common.json) print_failure("cli.usage", error.what());
    return kUsage;
  }
}

int dispatch(int argc, char** argv) {
  CLI::App app(
      "orbc compiles rooms with mirrors. It realises the room of an orbifold notation such as *22222 on the sphere, the plane or the\n"
      "hyperbolic plane, unfolds its mirrors, bends every copy for the eye and writes files that POV-Ray and Blender draw truly.",
      "orbc");
  app.set_version_flag("--version", std::string("orbc ") + ORBC_VERSION);
  app.require_subcommand(0, 1);
  app.footer(
      "Start here:\n  orbc new '*2323' > s.yaml\n  orbc render s.yaml -o s.png --engine povray\n\norbc COMMAND --help tells more of a "
      "command, orbc explain CODE of a diagnostic. Exit codes: 0 done, 1 the scene is wrong, 2 usage, 3 the machine.");
  Program program{app, {}, {}};
  define_commands(program);
  format_help(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help, --version
      std::ostringstream wanted;
      const int code = app.exit(error, wanted, wanted);
      write_standard_output(wanted.str());
      return code;
    }
    const std::string message = usage_message(program, error, {argv + 1, argv + argc});
    print_message(fmt::format("{}\n", message));
    if (asks_for_json(argc, argv)) print_failure("cli.usage", message);
    return kUsage;
  }
  for (const CLI::App* command : app.get_subcommands())
    for (const CLI::Option* option : command->get_options())
      if (option->count() > 0 && !option->get_lnames().empty()) program.common.given.push_back(option->get_lnames().front());
  for (const Command& command : program.commands)
    if (app.got_subcommand(command.options)) return run_command(command, program.common);
  write_standard_output(app.help());
  return kDone;
}

}  // namespace

int run(int argc, char** argv) {
  reserve_standard_streams();
  end_on_signals(asks_for_json(argc, argv));
  const auto fail = [&](const char* code, const std::string& message, int exit_code) {
    print_message(fmt::format("orbc: {}\n", message));
    if (asks_for_json(argc, argv)) print_failure(code, message);
    return exit_code;
  };
  try {
    return dispatch(argc, argv);
  } catch (const MemoryLimitReached&) {
    return fail("cli.max-memory",
                "--max-memory is reached: allow more, or make less of it: fewer --max-bounces, a smaller --size, --quality draft, smaller "
                "textures, fewer --threads",
                kMachine);
  } catch (const std::bad_alloc&) {
    return fail("cli.out-of-memory", "out of memory; try fewer --max-bounces or a larger --tolerance", kMachine);
  } catch (const std::exception& error) {
    return fail("cli.machine", error.what(), kMachine);
  }
}

}  // namespace orbc::cli
