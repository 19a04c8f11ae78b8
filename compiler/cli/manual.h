#pragma once
#include <string>

namespace CLI {
class App;
}

namespace orbc::cli {

/// The man page (roff, section 1) of the program, from the same options as --help.
[[nodiscard]] std::string man_page(const CLI::App& app);
/// Shell completion for "bash", "zsh" or "fish"; "" for another shell.
[[nodiscard]] std::string completion(const CLI::App& app, const std::string& shell);

}  // namespace orbc::cli
