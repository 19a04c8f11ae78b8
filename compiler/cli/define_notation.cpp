// Commands that need a notation and no scene.
#include <CLI/CLI.hpp>

#include "compiler/cli/define.h"
#include "compiler/cli/expanded_star.h"

namespace orbc::cli {

void define_info(Program& program) {
  const auto arguments = std::make_shared<InfoArguments>();
  InfoArguments& a = *arguments;
  CLI::App* c = program.app.add_subcommand("info", "What is known of an orbifold: its space, area, group, number of copies, side lengths");
  c->add_option("notation", a.notation, "Orbifold notation; quote it, shells love the star")->required()->type_name("NOTATION");
  c->add_option("--max-length", a.max_length, "Count the copies up to this word length")
      ->capture_default_str()
      ->check(CLI::Range(0, 10000))
      ->type_name("N");
  c->add_option("--shape", a.shape, "Shape of the room: tangential (all walls touch one circle) or paper (cuts of given length)")
      ->capture_default_str()
      ->check(CLI::IsMember({"tangential", "paper"}))
      ->type_name("NAME");
  c->add_option("--cut", a.cut, "Length of every cut of the paper's shape")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 100.0))
      ->type_name("LENGTH");
  c->add_option("--copies", a.copies, "With --json: how many of the first copies are told with their isometries")
      ->capture_default_str()
      ->check(CLI::Range(0, 100000))
      ->type_name("N");
  c->add_flag("--allow-non-orbifold", a.allow_non_orbifold, "Accept real-valued corners such as *(3/2)(12)(12)");
  c->footer("Examples:\n  orbc info '*237'\n  orbc info '*23456789(10)(11)' --json\n  orbc info '*22222' --shape paper --cut 1.4");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return info(*arguments, common); },
                              [](const std::vector<std::string>& words) { return expanded_star_message("info", words); }});
}

void define_enumerate(Program& program) {
  const auto arguments = std::make_shared<EnumerateArguments>();
  EnumerateArguments& a = *arguments;
  CLI::App* c = program.app.add_subcommand(
      "enumerate",
      "List all orbifolds with a given number of corners, one a line: notation, space, Euler characteristic");
  c->add_option("--corners", a.corners, "Number of corners (and walls)")->capture_default_str()->check(CLI::Range(0, 40))->type_name("N");
  c->add_option("--max-order", a.max_order, "Largest corner order")->capture_default_str()->check(CLI::Range(2, 1000000))->type_name("K");
  c->add_option("--space", a.space, "Only these")->check(CLI::IsMember({"spherical", "euclidean", "hyperbolic"}))->type_name("NAME");
  c->add_flag("--all", a.all, "List more than a million, too");
  c->footer("Examples:\n  orbc enumerate --corners 3 --max-order 8\n  orbc enumerate --corners 4 --max-order 3 --json");
  add_common(*c, program.common);
  program.commands.push_back({c, [arguments](const Common& common) { return enumerate(*arguments, common); }});
}

}  // namespace orbc::cli
