#pragma once
#include <string>
#include <vector>

namespace CLI {
class ParseError;
}

namespace orbc::cli {

struct Program;

/// What is wrong with a command line that could not be read, in the program's own words: "orbc render: there is no option --sampels; did
/// you mean --samples?". In: the program's commands, what the parser made of it, the words behind the program's name.
[[nodiscard]] std::string usage_message(const Program& program, const CLI::ParseError& error, const std::vector<std::string>& words);

}  // namespace orbc::cli
