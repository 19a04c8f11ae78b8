// Completion of commands, options and values for three shells, from the definitions of the options. Scenes are completed by their ending,
// other files by the shell; diagnostics by their codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "compiler/cli/accepts.h"
#include "compiler/cli/explain.h"
#include "compiler/cli/manual.h"

namespace orbc::cli {
namespace {

// One room of each space and the two strips of the sphere: what a notation looks like.
const std::vector<std::string> kNotations = {"*235", "*222", "*333", "*442", "*632", "*2222", "**", "*237", "*2323", "*22222"};

enum class Values { none, words, scenes, files };

struct Wanted {
  Values values = Values::none;
  std::vector<std::string> words;
};

// What completes the value of an option or a word of a command.
Wanted wanted(const CLI::Option& option) {
  const Accepts taken = accepts(option);
  if (!taken.choices.empty()) return {Values::words, taken.choices};
  if (taken.type == "NOTATION") return {Values::words, kNotations};
  if (taken.type == "CODE") {
    Wanted codes{Values::words, {}};
    for (const Explained& row : explained()) codes.words.push_back(row.code);
    return codes;
  }
  if (taken.type == "SCENE") return {Values::scenes, {}};
  if (taken.type == "FILE" || taken.type == "STEM") return {Values::files, {}};
  return {};
}

std::vector<std::string> dashed(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  return names;
}

const CLI::Option* positional(const CLI::App& command) {
  for (const CLI::Option* option : options_of(command))
    if (option->get_positional()) return option;
  return nullptr;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string replaced(const std::string& text, const std::string& from, const std::string& to) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    if (text.compare(at, from.size(), from) == 0) out += to, at += from.size();
    else out += text[at++];
  }
  return out;
}

// ---- bash: a list of words and a kind of files for each word in front of the one that is completed ----

std::string bash_reply(const Wanted& want) {
  switch (want.values) {
    case Values::words: return fmt::format("_orbc_words '{}'", fmt::join(want.words, " "));
    case Values::scenes: return "_orbc_scenes";
    case Values::files: return "_orbc_files";
    case Values::none: break;
  }
  return ":";
}

std::string bash_case(const CLI::App& command) {
  std::string values, flags;
  for (const CLI::Option* option : options_of(command)) {
    if (option->get_positional()) continue;
    flags += fmt::format("{}{}", flags.empty() ? "" : " ", fmt::join(dashed(*option), " "));
    if (option->get_items_expected_max() > 0)
      values += fmt::format("        {}) {}; return;;\n", fmt::join(dashed(*option), "|"), bash_reply(wanted(*option)));
  }
  const CLI::Option* word = positional(command);
  return fmt::format("    {})\n      case $previous in\n{}      esac\n"
                     "      if [[ $current == -* ]]; then _orbc_words '{}'\n      else {}; fi;;\n",
                     command.get_name(), values, flags, word ? bash_reply(wanted(*word)) : ":");
}

// COMP_WORDS splits --quality=fine at the equal sign: it is skipped. A word that is begun without a quote is quoted for the shell, which
// would look for files of a notation's name.
constexpr const char* kBash = R"bash(_orbc_words() {
  local word
  COMPREPLY=()
  for word in $1; do
    [[ $word == "$bare"* ]] || continue
    if [[ $current == [\'\"]* ]]; then COMPREPLY+=("$word"); else COMPREPLY+=("$(printf %q "$word")"); fi
  done
}
_orbc_scenes() {
  local file
  COMPREPLY=()
  while IFS= read -r file; do
    if [[ -d $file || $file == *.yaml || $file == *.yml || $file == *.json ]]; then COMPREPLY+=("$file"); fi
  done < <(compgen -f -- "$current")
  compopt -o filenames 2>/dev/null
}
_orbc_files() {
  local file
  COMPREPLY=()
  while IFS= read -r file; do COMPREPLY+=("$file"); done < <(compgen -f -- "$current")
  compopt -o filenames 2>/dev/null
}
_orbc() {
  local -
  set -f
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} bare
  if [[ $current == = ]]; then current=
  elif [[ $previous == = ]]; then previous=${COMP_WORDS[COMP_CWORD-2]}; fi
  bare=${current#[\'\"\\]}
)bash";

std::string bash(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : commands_of(app)) {
    commands += (commands.empty() ? "" : " ") + command->get_name();
    cases += bash_case(*command);
  }
  std::vector<std::string> own;
  for (const CLI::Option* option : options_of(app))
    for (const std::string& name : dashed(*option)) own.push_back(name);
  return fmt::format("{}  if (( COMP_CWORD == 1 )); then _orbc_words '{} {}'; else _orbc_command; fi\n}}\n"
                     "_orbc_command() {{\n  case ${{COMP_WORDS[1]}} in\n{}  esac\n}}\ncomplete -F _orbc orbc\n",
                     kBash, commands, fmt::join(own, " "), cases);
}

// ---- zsh ----

// Within the quotes and brackets of _arguments.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : first_line(text))
    out += c == '\'' ? std::string("'\\''") : c == '[' || c == ']' || c == ':' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out;
}

std::string zsh_action(const Wanted& want) {
  switch (want.values) {
    case Values::words: return fmt::format("({})", replaced(fmt::format("{}", fmt::join(want.words, " ")), "*", "\\*"));
    case Values::scenes: return "_files -g \"*.(yaml|yml|json)\"";
    case Values::files: return "_files";
    case Values::none: break;
  }
  return " ";
}

std::string zsh_case(const CLI::App& command) {
  std::string arguments;
  for (const CLI::Option* option : options_of(command)) {
    const std::string type = zsh_text(accepts(*option).type);
    if (option->get_positional()) {
      const char* many = option->get_items_expected_max() > 1 ? "*" : "";
      arguments += fmt::format(" \\\n        '{}:{}:{}'", many, type, zsh_action(wanted(*option)));
      continue;
    }
    const bool value = option->get_items_expected_max() > 0;
    const bool again = option->check_lname("set");
    for (const std::string& name : dashed(*option))
      arguments += fmt::format(" \\\n        '{}{}{}[{}]{}'", again ? "*" : "", name, value && name[1] == '-' ? "=" : "",
                               zsh_text(option->get_description()), value ? fmt::format(":{}:{}", type, zsh_action(wanted(*option))) : "");
  }
  return fmt::format("    {})\n      _arguments{};;\n", command.get_name(), arguments);
}

std::string zsh(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : commands_of(app)) {
    commands += fmt::format(" '{}:{}'", command->get_name(), zsh_text(command->get_description()));
    cases += zsh_case(*command);
  }
  return fmt::format(
      "#compdef orbc\n_orbc() {{\n  local -a commands=({})\n  if (( CURRENT == 2 )); then _describe command commands; return; fi\n  local "
      "command=$words[2]\n  shift words; (( CURRENT-- ))\n  case $command in\n{}  esac\n}}\n"
      "if [ \"$funcstack[1]\" = _orbc ]; then _orbc \"$@\"; else compdef _orbc orbc; fi\n",
      commands, cases);
}

// ---- fish ----

std::string fish_text(const std::string& text) { return replaced(replaced(first_line(text), "\\", "\\\\"), "'", "\\'"); }

std::string fish_values(const Wanted& want) {
  switch (want.values) {
    case Values::words: return fmt::format(" -x -a '{}'", replaced(fmt::format("{}", fmt::join(want.words, " ")), "*", "\\*"));
    case Values::scenes: return " -k -x -a '(__fish_complete_suffix .yaml)'";
    case Values::files: return " -r -F";
    case Values::none: break;
  }
  return " -x";
}

std::string fish(const CLI::App& app) {
  std::string text = "complete -c orbc -f\n";
  for (const CLI::App* command : commands_of(app)) {
    text += fmt::format("complete -c orbc -n __fish_use_subcommand -a {} -d '{}'\n", command->get_name(),
                        fish_text(command->get_description()));
    for (const CLI::Option* option : options_of(*command)) {
      const std::string start = fmt::format("complete -c orbc -n '__fish_seen_subcommand_from {}'", command->get_name());
      if (option->get_positional()) {
        if (wanted(*option).values != Values::none) text += start + fish_values(wanted(*option)) + "\n";
        continue;
      }
      for (const std::string& name : option->get_lnames()) text += fmt::format("{} -l {}", start, name);
      for (const std::string& name : option->get_snames()) text += fmt::format("{} -s {}", option->get_lnames().empty() ? start : "", name);
      text += option->get_items_expected_max() > 0 ? fish_values(wanted(*option)) : "";
      text += fmt::format(" -d '{}'\n", fish_text(option->get_description()));
    }
  }
  return text;
}

}  // namespace

std::string completion(const CLI::App& app, const std::string& shell) {
  return shell == "bash" ? bash(app) : shell == "zsh" ? zsh(app) : shell == "fish" ? fish(app) : "";
}

}  // namespace orbc::cli
