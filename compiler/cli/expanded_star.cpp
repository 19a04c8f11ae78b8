#include "compiler/cli/expanded_star.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace orbc::cli {
namespace {

constexpr std::size_t kNamed = 3;  // of the file names, in the message

bool is_file(const std::string& word) {
  std::error_code error;
  return !word.empty() && std::filesystem::exists(word, error);
}

}  // namespace

std::string expanded_star_message(const std::string& command, const std::vector<std::string>& words) {
  std::vector<std::string> files;
  std::copy_if(words.begin(), words.end(), std::back_inserter(files), is_file);
  const std::size_t count = files.size();
  if (count < 2) return "";
  files.resize(std::min(count, kNamed));
  return fmt::format("the shell has put {} file names in place of the star: {}{}\n  hint: quote the notation: orbc {} '*237'", count,
                     fmt::join(files, ", "), count > kNamed ? ", ..." : "", command);
}

Diagnostics with_star_hint(Diagnostics errors, const std::string& notation) {
  if (!is_file(notation)) return errors;
  for (Diagnostic& error : errors)
    error.hint = "this is the name of a file here: if the shell has put it in place of a star, quote the notation: '*237'";
  return errors;
}

}  // namespace orbc::cli
