#pragma once
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}

namespace orbc::cli {

/// What an option takes, as its definition says it: so that --help, man page, completions and usage errors agree.
struct Accepts {
  std::string type;                 ///< "N", "FILE", "SCENE"; empty for flags
  std::vector<std::string> choices; ///< the words it takes; empty = any
  struct Bounds {
    std::string least, most;
    bool whole = false;
  };
  std::optional<Bounds> bounds;     ///< of a number
};
[[nodiscard]] Accepts accepts(const CLI::Option& option);

/// "draft, normal or fine"; "a whole number from 1 to 65536"; "FILE".
[[nodiscard]] std::string in_words(const Accepts& accepts);

/// What stands behind the name of an option in a synopsis: "draft|normal|fine", "N", "FILE"; "" for flags.
[[nodiscard]] std::string placeholder(const Accepts& accepts);

/// "-o, --output", "--quiet", or the name of a word without dashes.
[[nodiscard]] std::string names_of(const CLI::Option& option);

/// Options of a command in the order of their definition, without hidden ones.
[[nodiscard]] std::vector<const CLI::Option*> options_of(const CLI::App& app);
[[nodiscard]] std::vector<const CLI::App*> commands_of(const CLI::App& app);

/// Makes --help show choices, bounds and defaults in words.
void format_help(CLI::App& app);

}  // namespace orbc::cli
