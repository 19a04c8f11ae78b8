#include "compiler/notation/symbol.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/notation/scan.h"

namespace orbc::notation {
namespace {

constexpr int kMaxFeatures = 64, kMaxSymbolOrder = 1'000'000;

std::string number(int order) { return order < 10 ? std::to_string(order) : fmt::format("({})", order); }

std::vector<int> largest_rotation(const std::vector<int>& corners) {
  std::vector<int> largest = corners, turned = corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    largest = std::max(largest, turned);
  }
  return largest;
}

std::vector<std::vector<int>> sorted_boundaries(std::vector<std::vector<int>> boundaries, bool is_reversed) {
  for (std::vector<int>& corners : boundaries) {
    if (is_reversed) std::reverse(corners.begin(), corners.end());
    corners = largest_rotation(corners);
  }
  std::sort(boundaries.begin(), boundaries.end(), std::greater<>());
  return boundaries;
}

}  // namespace

Result<Symbol> parse_symbol(std::string_view text, const SourceSpan& span) {
  // Handles stand first. Behind other features two of these letters are a way to write ∞.
  const auto handles = static_cast<int>(std::min(text.find_first_not_of('o'), text.size()));
  SourceSpan rest = span;
  rest.column += static_cast<std::size_t>(handles);
  rest.length -= std::min(rest.length, static_cast<std::size_t>(handles));
  SymbolText symbol_text(text.substr(static_cast<std::size_t>(handles)), rest);
  if (handles == 0 && symbol_text.begin == symbol_text.end)
    return make_error("notation.empty", "the notation is empty", "write a symbol such as *237, 22* or xx", span);
  Symbol symbol;
  symbol.handles = handles;
  int features = handles;
  if (symbol_text.begin == symbol_text.end) return symbol;
  const auto tokens = scan(symbol_text);
  if (!tokens) return tokens.error();
  for (const Token& token : tokens->list) {
    const auto wrong = [&](const std::string& code, const std::string& message, const std::string& hint) {
      return symbol_text.error(code, message, token.begin, token.length, hint);
    };
    if (++features > kMaxFeatures)
      return wrong("notation.too-many-corners", fmt::format("a symbol has at most {} features", kMaxFeatures), "");
    switch (token.kind) {
      case TokenKind::star:
        symbol.boundaries.emplace_back();
        break;
      case TokenKind::cross_cap:
        ++symbol.crosscaps;
        break;
      case TokenKind::wonder_ring:
        ++symbol.handles;
        break;
      case TokenKind::order: {
        if (!token.value || denominator(*token.value) != 1 || *token.value < 1 || *token.value > kMaxSymbolOrder)
          return wrong("notation.order-out-of-range", "an order of a symbol is an integer from 1 to 1,000,000",
                       "corners that are no integers belong to rooms of mirrors alone, such as *(3/2)(12)(12)");
        const int order = static_cast<int>(numerator(*token.value));
        if (order > 1) (symbol.boundaries.empty() ? symbol.cones : symbol.boundaries.back()).push_back(order);
        break;
      }
    }
  }
  return symbol;
}

std::string to_text(const Symbol& symbol) {
  std::string text(static_cast<std::size_t>(symbol.handles), 'o');
  for (const int order : symbol.cones) text += number(order);
  for (const std::vector<int>& corners : symbol.boundaries) {
    text += '*';
    for (const int order : corners) text += number(order);
  }
  text.append(static_cast<std::size_t>(symbol.crosscaps), 'x');
  return text.empty() ? "1" : text;
}

Symbol canonical(const Symbol& symbol) {
  Symbol same = symbol;
  std::sort(same.cones.begin(), same.cones.end(), std::greater<>());
  if (symbol.crosscaps == 0) {
    same.boundaries = std::max(sorted_boundaries(symbol.boundaries, false), sorted_boundaries(symbol.boundaries, true));
    return same;
  }
  same.crosscaps += 2 * symbol.handles;
  same.handles = 0;
  for (std::vector<int>& corners : same.boundaries) {
    const std::vector<int> reversed(corners.rbegin(), corners.rend());
    corners = std::max(largest_rotation(corners), largest_rotation(reversed));
  }
  std::sort(same.boundaries.begin(), same.boundaries.end(), std::greater<>());
  return same;
}

bool is_kaleidoscopic(const Symbol& symbol) {
  return symbol.handles == 0 && symbol.cones.empty() && symbol.boundaries.size() == 1 && symbol.crosscaps == 0;
}

Rational euler_characteristic(const Symbol& symbol) {
  Rational chi = 2 - 2 * symbol.handles - symbol.crosscaps - static_cast<int>(symbol.boundaries.size());
  for (const int m : symbol.cones) chi -= Rational(m - 1, m);
  for (const std::vector<int>& corners : symbol.boundaries)
    for (const int n : corners) chi -= Rational(n - 1, 2 * n);
  return chi;
}

bool is_orientable(const Symbol& symbol) { return symbol.crosscaps == 0 && symbol.boundaries.empty(); }

std::string why_bad(const Symbol& symbol) {
  if (symbol.handles > 0 || symbol.crosscaps > 0) return "";
  const bool has_mirrors = !symbol.boundaries.empty();
  if (symbol.boundaries.size() > 1 || (has_mirrors && !symbol.cones.empty())) return "";
  const std::vector<int>& orders = has_mirrors ? symbol.boundaries[0] : symbol.cones;
  const char* what = has_mirrors ? "mirror corner" : "cone point";
  if (orders.size() == 1) return fmt::format("a single {} of order {} has nothing that could balance it", what, orders[0]);
  if (orders.size() == 2 && orders[0] != orders[1])
    return fmt::format("two {}s alone must have the same order, and {} is not {}", what, orders[0], orders[1]);
  return "";
}

}  // namespace orbc::notation
