#include "compiler/mesh/tokens.h"

#include <charconv>

namespace orbc::mesh {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' || c == '\0'; }

}  // namespace

std::string_view Tokens::word() {
  std::size_t n = 0;
  while (n < rest_.size() && rest_[n] != '\n' && !is_blank(rest_[n])) ++n;
  const auto found = rest_.substr(0, n);
  rest_.remove_prefix(n);
  return found;
}

std::string_view Tokens::next_in_line() {
  std::size_t n = 0;
  while (n < rest_.size() && is_blank(rest_[n])) ++n;
  rest_.remove_prefix(n);
  return word();
}

std::string_view Tokens::rest_of_line() {
  const auto end = rest_.find('\n');
  auto found = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (end != std::string_view::npos) ++line_;
  while (!found.empty() && is_blank(found.front())) found.remove_prefix(1);
  while (!found.empty() && is_blank(found.back())) found.remove_suffix(1);
  return found;
}

std::string_view Tokens::next(bool comments) {
  while (true) {
    const auto found = next_in_line();
    if (!found.empty() && !(comments && found.front() == '#')) return found;
    if (rest_.empty()) return {};
    rest_of_line();
  }
}

std::optional<double> to_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || result.ptr != word.data() + word.size()) return {};
  // Too small for a double is 0 to any mesh; too large stays an error of the caller's range check.
  if (result.ec == std::errc::result_out_of_range) return word.find("e-") != word.npos || word.find("E-") != word.npos ? 0.0 : 1e308;
  if (result.ec != std::errc()) return {};
  return value;
}

std::optional<std::int64_t> to_integer(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  std::int64_t value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || result.ec != std::errc() || result.ptr != word.data() + word.size()) return {};
  return value;
}

}  // namespace orbc::mesh
