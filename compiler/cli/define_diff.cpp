#include <CLI/CLI.hpp>

#include "compiler/cli/commands.h"
#include "compiler/cli/define.h"

namespace orbc::cli {

void define_diff(Program& program) {
  const auto a = std::make_shared<DiffArguments>();
  CLI::App* c =
      program.app.add_subcommand("diff", "Compare two files that orbc has written: structure exactly, numbers and pixels within limits");
  c->add_option("golden", a->left, "A .pov, .svg, .json, .gltf, .glb, .png, .jpg or .exr file")->required()->type_name("FILE");
  c->add_option("other", a->right, "A file of the same kind; the pictures that both name are compared, too")->required()->type_name("FILE");
  c->add_option("--within", a->within, "Numbers a and b agree when |a - b| is at most this times max(1, |a|, |b|)")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e300))
      ->type_name("BOUND");
  c->add_option("--pixels", a->pixels, "Pixels agree when no channel differs by more than so many steps of 1/255")
      ->capture_default_str()
      ->check(CLI::Range(0, 255))
      ->type_name("N");
  c->footer(
      "Exit codes: 0 they agree, 1 they differ, 2 usage, 3 a file cannot be read.\n\n"
      "Examples:\n  orbc diff golden/room.pov room.pov\n  orbc diff golden/room.glb room.glb --within 1e-6 --pixels 1\n"
      "  orbc diff golden/report.json report.json --within 1e-9 --json");
  add_common(*c, program.common);
  program.commands.push_back({c, [a](const Common& common) { return diff(*a, common); }});
}

}  // namespace orbc::cli
