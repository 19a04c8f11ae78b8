// CLI11 keeps what a check allows as text behind the type's name: "NAME:{draft,normal,fine}", "N:INT in [1 - 65536]". It is read back here.
#include "compiler/cli/accepts.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

namespace orbc::cli {
namespace {

constexpr std::size_t kNameColumns = 34, kHelpColumns = 120;  // of --help

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// In lines of so many columns; the formatter indents all but the first.
std::string in_columns(const std::string& text, std::size_t columns) {
  std::string out;
  std::size_t column = 0;
  for (const std::string& word : split(text, ' ')) {
    if (column > 0 && column + 1 + word.size() > columns) out += '\n', column = 0;
    else if (column > 0) out += ' ', ++column;
    out += word;
    column += word.size();
  }
  return out;
}

class HelpFormatter final : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const Accepts taken = accepts(*option);
    const std::string what = placeholder(taken);
    return (what.empty() ? "" : " " + what) + (option->get_required() ? " (required)" : "");
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    std::string text = option->get_description();
    const Accepts taken = accepts(*option);
    std::vector<std::string> more;
    if (taken.bounds) more.push_back(fmt::format("{} to {}", taken.bounds->least, taken.bounds->most));
    if (!option->get_default_str().empty()) more.push_back("default: " + option->get_default_str());
    return in_columns(more.empty() ? text : fmt::format("{} ({})", text, fmt::join(more, "; ")), kHelpColumns - kNameColumns);
  }

  std::string make_option_name(const CLI::Option* option, bool positional) const override {
    return positional ? option->get_name(true, false) : names_of(*option);
  }
};

}  // namespace

Accepts accepts(const CLI::Option& option) {
  Accepts found;
  if (option.get_items_expected_max() == 0) return found;
  const std::string text = option.get_type_name();
  const std::size_t colon = text.find(':');
  found.type = text.substr(0, colon);
  if (colon == std::string::npos) return found;
  const std::string check = text.substr(colon + 1);
  if (check.size() > 2 && check.front() == '{' && check.back() == '}') {
    found.choices = split(check.substr(1, check.size() - 2), ',');
  } else if (const std::size_t open = check.find("in ["), middle = check.find(" - "); open != std::string::npos && middle > open) {
    found.bounds = Accepts::Bounds{check.substr(open + 4, middle - open - 4), check.substr(middle + 3, check.find(']') - middle - 3),
                                   check.rfind("INT", 0) == 0 || check.rfind("UINT", 0) == 0};
  }
  return found;
}

std::string in_words(const Accepts& taken) {
  std::string text;
  for (std::size_t i = 0; i < taken.choices.size(); ++i)
    text += (i == 0 ? "" : i + 1 == taken.choices.size() ? " or " : ", ") + taken.choices[i];
  if (!text.empty()) return text;
  if (taken.bounds) return fmt::format("a {}number from {} to {}", taken.bounds->whole ? "whole " : "", taken.bounds->least,
                                       taken.bounds->most);
  return taken.type == "N" ? "a whole number" : taken.type;
}

std::string placeholder(const Accepts& taken) {
  return taken.choices.empty() ? taken.type : fmt::format("{}", fmt::join(taken.choices, "|"));
}

std::string names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names.empty() ? option.get_name(true, false) : fmt::format("{}", fmt::join(names, ", "));
}

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

void format_help(CLI::App& app) {
  const auto formatter = std::make_shared<HelpFormatter>();
  formatter->column_width(kNameColumns);
  app.formatter(formatter);
  for (CLI::App* command : app.get_subcommands(nullptr)) command->formatter(formatter);
}

}  // namespace orbc::cli
