// The parser says that something is wrong and often not what the user meant: an unknown option moves all words behind it, so that a number
// is taken for the scene. So the words are looked through once more, and the first thing that is no sense is named.
#include "compiler/cli/usage.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "compiler/base/diagnostic.h"
#include "compiler/cli/accepts.h"
#include "compiler/cli/define.h"

namespace orbc::cli {
namespace {

struct Given {
  const CLI::Option* option = nullptr;
  std::string name;                 // as it was written
  std::string value;
  bool has_value = false;
};

struct Scan {
  std::vector<Given> options;
  std::vector<std::string> words;   // neither options nor their values
  std::string unknown;              // the first option that the command does not have
  std::string one_dash;             // the first word such as -output, which is read as -o utput
};

bool looks_like_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && !(word[1] >= '0' && word[1] <= '9') && word[1] != '.';
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

// One letter after the other: -qv, -o FILE, -oFILE.
void scan_letters(const CLI::App& command, const std::vector<std::string>& words, std::size_t& at, Scan& scan) {
  const std::string word = words[at];
  if (word.size() > 2 && scan.one_dash.empty() && command.get_option_no_throw("-" + word)) scan.one_dash = word;
  for (std::size_t i = 1; i < word.size(); ++i) {
    const std::string name = std::string("-") + word[i];
    const CLI::Option* option = command.get_option_no_throw(name);
    if (!option) return void(scan.unknown = scan.unknown.empty() ? (i == 1 ? word : name) : scan.unknown);
    Given given{option, name, "", false};
    if (takes_value(*option)) {
      given.has_value = i + 1 < word.size() || (at + 1 < words.size() && !looks_like_option(words[at + 1]));
      if (given.has_value) given.value = i + 1 < word.size() ? word.substr(i + 1) : words[++at];
      i = word.size();
    }
    scan.options.push_back(std::move(given));
  }
}

Scan scan_words(const CLI::App& command, const std::vector<std::string>& words) {
  Scan scan;
  bool only_words = false;
  for (std::size_t at = 0; at < words.size(); ++at) {
    const std::string& word = words[at];
    if (only_words || !looks_like_option(word)) {
      scan.words.push_back(word);
    } else if (word == "--") {
      only_words = true;
    } else if (word[1] != '-') {
      scan_letters(command, words, at, scan);
    } else {
      const std::size_t equals = word.find('=');
      Given given{command.get_option_no_throw(word.substr(0, equals)), word.substr(0, equals), "", equals != std::string::npos};
      if (!given.option) {
        if (scan.unknown.empty()) scan.unknown = given.name;
        continue;
      }
      if (given.has_value) given.value = word.substr(equals + 1);
      else if (takes_value(*given.option) && at + 1 < words.size() && !looks_like_option(words[at + 1]))
        given.has_value = true, given.value = words[++at];
      scan.options.push_back(std::move(given));
    }
  }
  return scan;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(command)) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::string unknown_option(const CLI::App& app, const CLI::App& command, const std::string& name) {
  std::string text = fmt::format("there is no option {}", name);
  const std::vector<std::string> known = option_names(command);
  if (std::find(known.begin(), known.end(), "-" + name) != known.end()) return fmt::format("{}; did you mean -{}?", text, name);
  if (const std::string nearest = nearest_word(name, known); name.size() > 3 && !nearest.empty())
    return fmt::format("{}; did you mean {}?", text, nearest);
  std::vector<std::string> owners;
  for (const CLI::App* other : commands_of(app))
    if (other->get_option_no_throw(name)) owners.push_back("orbc " + other->get_name());
  if (!owners.empty()) return fmt::format("{} here; {} {} it", text, fmt::join(owners, ", "), owners.size() == 1 ? "has" : "have");
  if (command.get_option_no_throw("--set")) text += "; keys of the scene are said by --set, such as --set camera.fov=60deg";
  return text + fmt::format("\n{} --help lists the options", &command == &app ? "orbc" : "orbc " + command.get_name());
}

std::string wrong_value(const CLI::Option& option, const std::string& name, const std::string& value) {
  const Accepts taken = accepts(option);
  if (!takes_value(option)) return fmt::format("{} takes no value; got {}", name, value);
  const std::string nearest = nearest_word(value, taken.choices);
  return fmt::format("{} takes {}; got {}{}", name, in_words(taken), value.empty() ? "nothing" : value,
                     nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
}

// CLI11's text names the option first: "--samples: Value 0 not in range", "Could not convert: --samples = abc".
const CLI::Option* option_named_in(const CLI::App& command, std::string text) {
  const std::string conversion = "Could not convert: ";
  if (text.rfind(conversion, 0) == 0) text = text.substr(conversion.size());
  const std::string name = text.substr(0, text.find_first_of(": "));
  for (const CLI::Option* option : command.get_options())
    if (option->get_name(false, false) == name || option->get_name(true, false) == name) return option;
  return nullptr;
}

std::string missing(const CLI::Option& option) {
  const std::string type = accepts(option).type;
  if (type == "SCENE") return "which scene? give the path of a scene file, or - for standard input";
  if (type == "NOTATION") return "which orbifold? give its notation in quotes, such as '*22222'";
  if (option.check_lname("output")) return "where to? say -o FILE";
  const std::string words = in_words(accepts(option));
  return fmt::format("{} is missing: {}", names_of(option), words == type ? option.get_description() : words);
}

// How many words without dashes a command takes; -1 = as many as wanted.
int word_places(const CLI::App& command) {
  int places = 0;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) places = option->get_items_expected_max() > 1000 ? -1 : places + option->get_items_expected_max();
  return places;
}

std::string extra_words(const CLI::App& command, const std::vector<std::string>& words, std::size_t places) {
  if (places == 0) return fmt::format("it takes no words behind it; got {}", words.front());
  std::vector<std::string> wanted;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) wanted.push_back(accepts(*option).type);
  return fmt::format("it takes one {}; {} is one too many", fmt::join(wanted, " and one "), words[places]);
}

std::string message_of(const Program& program, const Command& command, const CLI::ParseError& error,
                       const std::vector<std::string>& words) {
  const CLI::App& app = *command.options;
  const Scan scan = scan_words(app, words);
  if (!scan.one_dash.empty()) return unknown_option(program.app, app, scan.one_dash);
  if (!scan.unknown.empty()) return unknown_option(program.app, app, scan.unknown);
  for (const Given& given : scan.options) {
    if (takes_value(*given.option) && !given.has_value)
      return fmt::format("{} takes {}, but nothing stands behind it", given.name, in_words(accepts(*given.option)));
    const auto twice = [&](const Given& other) { return &other != &given && other.option == given.option; };
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) && takes_value(*given.option) && given.option->get_items_expected_max() == 1 &&
        std::any_of(scan.options.begin(), scan.options.end(), twice))
      return fmt::format("{} is given twice; keep one of the two", given.name);
  }
  if (const CLI::Option* option = option_named_in(app, error.what()); option && !dynamic_cast<const CLI::RequiredError*>(&error)) {
    const Given* last = nullptr;
    for (const Given& given : scan.options)
      if (given.option == option) last = &given;
    if (last) return wrong_value(*option, last->name, last->value);
    if (option->get_positional() && !scan.words.empty()) return wrong_value(*option, option->get_name(true, false), scan.words.back());
  }
  const int places = word_places(app);
  if (places >= 0 && scan.words.size() > static_cast<std::size_t>(places)) {
    const std::string told = command.extra_words ? command.extra_words(scan.words) : "";
    return told.empty() ? extra_words(app, scan.words, static_cast<std::size_t>(places)) : told;
  }
  for (const CLI::Option* option : app.get_options()) {
    const auto same = [&](const Given& given) { return given.option == option; };
    const bool there = option->get_positional() ? !scan.words.empty() : std::any_of(scan.options.begin(), scan.options.end(), same);
    if (option->get_required() && !there) return missing(*option);
  }
  return error.what();
}

}  // namespace

std::string usage_message(const Program& program, const CLI::ParseError& error, const std::vector<std::string>& words) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(program.app)) names.push_back(command->get_name());
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (looks_like_option(words[i])) {
      for (const CLI::App* command : commands_of(program.app))
        if (command->get_option_no_throw(words[i].substr(0, words[i].find('='))))
          return fmt::format("orbc: {} belongs behind a command, as in orbc {} {}", words[i], command->get_name(), words[i]);
      return "orbc: " + unknown_option(program.app, program.app, words[i]);
    }
    for (const Command& command : program.commands)
      if (command.options->get_name() == words[i])
        return fmt::format("orbc {}: {}", words[i],
                           message_of(program, command, error, {words.begin() + static_cast<std::ptrdiff_t>(i) + 1, words.end()}));
    const std::string nearest = nearest_word(words[i], names);
    return nearest.empty() ? fmt::format("orbc: there is no command `{}`; the commands are {}", words[i], fmt::join(names, ", "))
                           : fmt::format("orbc: there is no command `{}`; did you mean `{}`?", words[i], nearest);
  }
  return fmt::format("orbc: {}", error.what());
}

}  // namespace orbc::cli
