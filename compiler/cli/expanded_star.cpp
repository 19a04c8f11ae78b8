#include "compiler/cli/expanded_star.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

namespace orbc::cli {
namespace {

constexpr std::size_t kNamed = 3;  // file names that are told

bool is_file(const std::string& word) {
  std::error_code error;
  return !word.empty() && std::filesystem::exists(word, error);
}

}  // namespace

bool told_expanded_star(int argc, char** argv) {
  constexpr std::array<std::string_view, 3> kTakeNotation = {"info", "new", "svg"};
  if (argc < 4 || std::find(kTakeNotation.begin(), kTakeNotation.end(), argv[1]) == kTakeNotation.end()) return false;
  std::vector<std::string> files;
  for (int i = 2; i < argc; ++i)
    if (argv[i][0] != '-' && is_file(argv[i])) files.emplace_back(argv[i]);
  if (files.size() < 2) return false;
  const std::size_t count = files.size();
  files.resize(std::min(count, kNamed));
  fmt::print(stderr, "orbc: the shell has put {} file names in place of the star: {}{}\n  hint: quote the notation: orbc {} '*237'\n",
             count, fmt::join(files, ", "), count > kNamed ? ", ..." : "", argv[1]);
  return true;
}

Diagnostics with_star_hint(Diagnostics errors, const std::string& notation) {
  if (!is_file(notation)) return errors;
  for (Diagnostic& error : errors)
    error.hint = "this is the name of a file here: if the shell has put it in place of a star, quote the notation: '*237'";
  return errors;
}

}  // namespace orbc::cli
