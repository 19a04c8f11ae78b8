#include "compiler/cli/manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

namespace orbc::cli {
namespace {

std::string roff(std::string text) {
  std::string out;
  bool line_start = true;
  for (const char c : text) {
    if (c == '\\') out += "\\e";
    else if (c == '-') out += "\\-";
    else if (line_start && (c == '.' || c == '\'')) out += std::string("\\&") + c;
    else out += c;
    line_start = c == '\n';
  }
  return out;
}

// Options of a command without --help; positionals have no name beginning with '-'.
std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  std::vector<const CLI::Option*> options;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) options.push_back(option);
  return options;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  std::vector<const CLI::App*> commands;
  for (const CLI::App* command : app.get_subcommands({}))
    if (!command->get_group().empty()) commands.push_back(command);
  return commands;
}

std::string option_entry(const CLI::Option& option) {
  std::string text = ".TP\n.B " + roff(option.get_name(true, true)) + "\n" + roff(option.get_description());
  if (!option.get_default_str().empty()) text += roff(fmt::format(" (default: {})", option.get_default_str()));
  return text + "\n";
}

std::vector<std::string> flags(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(app))
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string bash(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : commands_of(app)) {
    commands += command->get_name() + " ";
    cases += fmt::format("    {}) words=\"{}\";;\n", command->get_name(), fmt::join(flags(*command), " "));
  }
  return fmt::format(
      "_orbc() {{\n  local current=${{COMP_WORDS[COMP_CWORD]}} words=\n  if [ \"$COMP_CWORD\" -eq 1 ]; then words=\"{}\"; else\n  case "
      "${{COMP_WORDS[1]}} in\n{}"
      "  esac; fi\n  if [[ $current == -* || $COMP_CWORD -eq 1 ]]; then COMPREPLY=($(compgen -W \"$words {}\" -- \"$current\"))\n"
      "  else COMPREPLY=($(compgen -f -- \"$current\")); fi\n}}\ncomplete -o filenames -F _orbc orbc\n",
      commands, cases, fmt::join(flags(app), " "));
}

std::string zsh(const CLI::App& app) {
  const auto quoted = [](std::string text) {
    std::string out;
    for (const char c : text.substr(0, text.find('\n')))
      out += c == '\'' ? std::string("'\\''") : c == '[' || c == ']' || c == ':' ? std::string("\\") + c : std::string(1, c);
    return out;
  };
  std::string commands, cases;
  for (const CLI::App* command : commands_of(app)) {
    commands += fmt::format(" '{}:{}'", command->get_name(), quoted(command->get_description()));
    std::string arguments;
    for (const CLI::Option* option : options_of(*command))
      for (const std::string& name : option->get_lnames())
        arguments +=
            fmt::format(" '--{}[{}]{}'", name, quoted(option->get_description()), option->get_expected_max() > 0 ? ":value:_files" : "");
    cases += fmt::format("    {}) _arguments{} '*:file:_files';;\n", command->get_name(), arguments);
  }
  return fmt::format(
      "#compdef orbc\n_orbc() {{\n  local -a commands=({})\n  if (( CURRENT == 2 )); then _describe command commands; return; fi\n  local "
      "command=$words[2]\n"
      "  shift words; (( CURRENT-- ))\n  case $command in\n{}  esac\n}}\n_orbc \"$@\"\n",
      commands, cases);
}

std::string fish(const CLI::App& app) {
  const auto quoted = [](std::string text) {
    text = text.substr(0, text.find('\n'));
    std::string out;
    for (const char c : text) out += c == '\'' ? std::string("\\'") : std::string(1, c);
    return out;
  };
  std::string text;
  for (const CLI::App* command : commands_of(app)) {
    text += fmt::format("complete -c orbc -n __fish_use_subcommand -f -a {} -d '{}'\n", command->get_name(),
                        quoted(command->get_description()));
    for (const CLI::Option* option : options_of(*command))
      for (const std::string& name : option->get_lnames())
        text += fmt::format("complete -c orbc -n '__fish_seen_subcommand_from {}' -l {} -d '{}'{}\n", command->get_name(), name,
                            quoted(option->get_description()), option->get_expected_max() > 0 ? " -r" : "");
  }
  return text;
}

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string text = fmt::format(
      ".TH ORBC 1 \"\" \"{}\" \"User Commands\"\n.SH NAME\norbc \\- {}\n.SH SYNOPSIS\n.B orbc\n\\fIcommand\\fR [\\fIoptions\\fR]\n",
      roff(app.version()), roff("compile rooms with mirrors: orbifolds to POV-Ray, Blender and SVG"));
  text += ".SH DESCRIPTION\n" + roff(app.get_description()) + "\n.SH OPTIONS\n";
  for (const CLI::Option* option : options_of(app)) text += option_entry(*option);
  text += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) {
    text += fmt::format(".SS orbc {}\n{}\n", roff(command->get_name()), roff(command->get_description()));
    for (const CLI::Option* option : options_of(*command)) text += option_entry(*option);
    if (const std::string footer = command->get_footer(); !footer.empty()) text += ".PP\n.nf\n" + roff(footer) + "\n.fi\n";
  }
  text +=
      ".SH EXIT STATUS\n.TP\n.B 0\ndone\n.TP\n.B 1\nthe scene is wrong\n.TP\n.B 2\nusage\n.TP\n.B 3\nthe machine: disk, memory, missing "
      "renderer\n";
  return text;
}

std::string completion(const CLI::App& app, const std::string& shell) {
  return shell == "bash" ? bash(app) : shell == "zsh" ? zsh(app) : shell == "fish" ? fish(app) : "";
}

}  // namespace orbc::cli
