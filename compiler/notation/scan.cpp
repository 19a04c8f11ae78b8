// Characters → tokens (star, order, x, o). Every token stores its place in the text.
#include "compiler/notation/scan.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/notation/characters.h"
#include "compiler/notation/parse.h"

namespace orbc::notation {
namespace {

using Kind = TokenKind;

constexpr std::size_t kMaxDigits = 7;  // as many as kMaxOrder has; of a decimal number before and behind its point
// Large enough for the fraction that a decimal number is printed as, so that parse(to_text(o)) = o.
constexpr std::size_t kMaxAbove = 2 * kMaxDigits, kMaxBelow = kMaxDigits + 1;

bool is_digit(char32_t c) { return c >= U'0' && c <= U'9'; }
bool is_star(char32_t c) { return c == U'*'; }
bool is_cross(char32_t c) { return c == U'x' || c == U'X' || c == U'\u00D7'; }
bool is_ring(char32_t c) { return c == U'o' || c == U'O' || c == U'\u2218' || c == U'\u25CB'; }

constexpr const char* kCornerHint = "corners are digits, (10) or (3/2), as in *23(10) or *2 3 10";
constexpr const char* kRealHint = "put real corners into parentheses, *(3/2)(12)(12), *(2.5)44; two corners are written *22";
constexpr const char* kCommaHint = "a comma stands between two corners: *2,3,10";
constexpr const char* kPowerHint = "a power repeats a corner: *2^5 is *22222";

// The points between corners, *4.4.2: two or more, or one beside a parenthesis. A single point may belong to a real corner.
std::vector<std::size_t> points_between_corners(const SymbolText& text) {
  std::vector<std::size_t> points;
  std::size_t depth = 0;
  bool beside = false;
  for (std::size_t i = text.begin; i < text.end; ++i) {
    const char32_t c = text.characters[i];
    if (c == U'(') ++depth;
    if (c == U')' && depth > 0) --depth;
    if (depth > 0) continue;
    if (is_blank(c) || c == U',' || c == U'/') return {};
    if (c != U'.') continue;
    points.push_back(i);
    beside = beside || (i > text.begin && text.characters[i - 1] == U')') || (i + 1 < text.end && text.characters[i + 1] == U'(');
  }
  return points.size() < 2 && !beside ? std::vector<std::size_t>{} : points;
}

// Corners are separated when a comma stands outside of parentheses, or blanks stand between two digits.
bool is_separated(const std::u32string& characters) {
  bool inside = false;
  for (std::size_t i = 0; i < characters.size(); ++i) {
    const char32_t c = characters[i];
    if (c == U'(') inside = true;
    if (c == U')') inside = false;
    if (inside) continue;
    if (c == U',') return true;
    if (!is_blank(c) || i == 0 || !is_digit(characters[i - 1])) continue;
    while (i + 1 < characters.size() && is_blank(characters[i + 1])) ++i;
    if (i + 1 < characters.size() && (is_digit(characters[i + 1]) || characters[i + 1] == U'-')) return true;
  }
  return false;
}

// The length of a word for ∞: the sign itself, inf, infty, infinity, or oo if allowed. 0: there is none.
std::size_t infinity_length(const std::u32string& characters, std::size_t at, bool allow_oo) {
  if (characters[at] == kInfinity) return 1;
  std::u32string word = characters.substr(at, 8);
  for (char32_t& c : word)
    if (c >= U'A' && c <= U'Z') c += 32;
  for (const std::u32string_view name : {U"infinity", U"infty", U"inf"})
    if (word.compare(0, name.size(), name) == 0) return name.size();
  return allow_oo && word.compare(0, 2, U"oo") == 0 ? 2 : 0;
}

// The digits of a number without leading zeros.
std::string significant(std::string digits) { return digits.erase(0, digits.find_first_not_of('0')); }
// A leading zero would make the number octal.
Integer integer_of(const std::string& digits) { return Integer(significant(digits).empty() ? "0" : significant(digits)); }

/// Reads the tokens of a symbol from left to right. Invariant: everything before `at_` is in `tokens_`, or is a mark between them.
class Scanner {
 public:
  explicit Scanner(SymbolText& text) : text_(text), characters_(text.characters) {}

  Result<Tokens> run() {
    const std::vector<std::size_t> points = points_between_corners(text_);
    for (const std::size_t i : points) characters_[i] = U',';
    text_.respelled = text_.respelled || !points.empty();
    separated_ = is_separated(characters_);
    while (at_ < characters_.size())
      if (auto wrong = scan_next()) return *std::move(wrong);
    if (comma_) return unexpected(kCommaHint);
    return Tokens{std::move(tokens_), separated_};
  }

 private:
  using Fault = std::optional<Diagnostic>;

  [[nodiscard]] Diagnostic unexpected(const std::string& hint) const { return text_.unexpected(at_, hint); }
  [[nodiscard]] Diagnostic error(const std::string& code, const std::string& message, std::size_t begin,
                                 const std::string& hint = "") const {
    return text_.error(code, message, begin, at_ - begin, hint);
  }
  [[nodiscard]] char32_t here() const { return at_ < characters_.size() ? characters_[at_] : U' '; }
  [[nodiscard]] std::size_t infinity_here() const {
    return at_ < characters_.size() ? infinity_length(characters_, at_, !tokens_.empty()) : 0;
  }
  void skip_blanks() {
    while (at_ < characters_.size() && is_blank(characters_[at_])) ++at_;
  }
  void add_order(std::size_t begin, std::optional<Rational> value) {
    tokens_.push_back({Kind::order, begin, at_ - begin, std::move(value)});
  }

  Fault scan_next() {
    const char32_t c = characters_[at_];
    if (is_blank(c)) {
      ++at_;
      return std::nullopt;
    }
    if (c == U',') {
      if (comma_ || tokens_.empty() || tokens_.back().kind != Kind::order) return unexpected(kCommaHint);
      comma_ = true;
      ++at_;
      return std::nullopt;
    }
    if (c == U'\\') return scan_backslash();
    if (c == U'^' || raised_digit(c) >= 0) return scan_power();
    const bool is_order = is_digit(c) || c == U'(' || c == U'-' || infinity_here() > 0;
    if (comma_ && !is_order) return unexpected(kCommaHint);
    comma_ = false;
    if (is_order) return scan_order();
    if (!is_star(c) && !is_cross(c) && !is_ring(c)) return unexpected(c == U'.' || c == U'/' ? kRealHint : kCornerHint);
    tokens_.push_back({is_star(c) ? Kind::star : is_cross(c) ? Kind::cross_cap : Kind::wonder_ring, at_, 1, {}});
    ++at_;
    return std::nullopt;
  }

  // A backslash before a star, as shells need it, or a command of TeX. The character that is meant is scanned next.
  Fault scan_backslash() {
    text_.respelled = true;
    if (at_ + 1 < characters_.size() && is_star(characters_[at_ + 1])) {
      ++at_;
      return std::nullopt;
    }
    struct Command {
      std::u32string_view name;
      char32_t meant;
    };
    for (const Command& command : {Command{U"ast", U'*'}, Command{U"star", U'*'}, Command{U"infty", kInfinity}, Command{U"times", U'x'}}) {
      if (characters_.compare(at_ + 1, command.name.size(), command.name) != 0) continue;
      std::fill_n(characters_.begin() + static_cast<std::ptrdiff_t>(at_), command.name.size(), U' ');
      at_ += command.name.size();
      characters_[at_] = command.meant;
      return std::nullopt;
    }
    return unexpected(kCornerHint);
  }

  // The digits of an exponent: ^5, ^{12}, ^(12) or ⁵.
  Result<std::string> scan_exponent() {
    std::string digits;
    if (characters_[at_] != U'^') {
      for (; at_ < characters_.size() && raised_digit(characters_[at_]) >= 0; ++at_)
        digits += static_cast<char>('0' + raised_digit(characters_[at_]));
      return digits;
    }
    const std::size_t begin = at_++;
    const char32_t open = here();
    const bool enclosed = open == U'{' || open == U'(';
    if (enclosed) ++at_;
    digits = scan_digits();
    const bool closed = !enclosed || here() == (open == U'{' ? U'}' : U')');
    if (digits.empty() || !closed) return unexpected(kPowerHint);
    if (enclosed) ++at_;
    if (!enclosed && !separated_ && digits.size() > 1) {
      return text_.error("notation.unexpected-character", "it is not clear where this exponent ends", begin, digits.size() + 1,
                         "put it into braces or separate the corners: *2^{10}, *2^5 3");
    }
    return digits;
  }

  // A power repeats the last order, or the list in parentheses before it: *2^5, *2⁵, *(2,3)^2.
  Fault scan_power() {
    const std::size_t begin = at_;
    if (tokens_.empty() || tokens_.back().kind != Kind::order || powered_) return unexpected(kPowerHint);
    const Result<std::string> digits = scan_exponent();
    if (!digits) return digits.error().front();
    const std::size_t count = digits->size() > 4 ? 10000 : static_cast<std::size_t>(std::stoi(*digits));
    if (count < 1) return error("notation.order-out-of-range", "a corner cannot be repeated 0 times", begin);
    const std::vector<Token> repeated(tokens_.begin() + static_cast<std::ptrdiff_t>(group_), tokens_.end());
    if (count * repeated.size() > static_cast<std::size_t>(kMaxCorners))
      return error("notation.too-many-corners", fmt::format("these are more corners than the {} that are supported", kMaxCorners), begin);
    for (std::size_t i = 1; i < count; ++i) tokens_.insert(tokens_.end(), repeated.begin(), repeated.end());
    powered_ = text_.respelled = true;
    return std::nullopt;
  }

  // One order: a digit, a number where corners are separated, or parentheses around a number or a list; also ∞.
  Fault scan_order() {
    const std::size_t begin = at_;
    group_ = tokens_.size();
    powered_ = false;
    if (const std::size_t length = infinity_here(); length > 0) {
      text_.respelled = text_.respelled || length > 1;
      at_ += length;
      add_order(begin, {});
      return std::nullopt;
    }
    if (here() == U'(') return scan_parenthesis();
    if (!separated_ && is_digit(here())) {
      const Rational value(static_cast<int>(characters_[at_++] - U'0'));
      add_order(begin, value);
      return std::nullopt;
    }
    Result<Rational> value = scan_number(begin);
    if (!value) return value.error().front();
    add_order(begin, *std::move(value));
    return std::nullopt;
  }

  // (10), (3/2), (2.5), (∞) or a list (4,4,2).
  Fault scan_parenthesis() {
    const std::size_t opened = at_++;
    std::size_t begin = opened;  // of the token: the first one includes the parenthesis before it, the last one that behind it
    skip_blanks();
    for (;;) {
      Result<std::optional<Rational>> value = scan_value(begin);
      if (!value) return value.error().front();
      skip_blanks();
      if (at_ >= characters_.size())
        return text_.error("notation.unclosed-parenthesis", "this parenthesis is not closed", opened, 1,
                           "write (10) for a corner of order 10");
      // Parentheses around several corners are a list only behind a star or an order.
      const bool is_list = here() == U',' && !tokens_.empty();
      if (!is_list && here() != U')') return unexpected("a parenthesis holds one corner: (10), (3/2) or (2.5)");
      if (is_list) {
        add_order(begin, *std::move(value));
        text_.respelled = true;
        ++at_;
        skip_blanks();
        begin = at_;
        continue;
      }
      ++at_;
      add_order(begin, *std::move(value));
      return std::nullopt;
    }
  }

  // A number, or ∞, which has no value.
  Result<std::optional<Rational>> scan_value(std::size_t token) {
    if (const std::size_t length = infinity_here(); length > 0) {
      text_.respelled = text_.respelled || length > 1;
      at_ += length;
      return std::optional<Rational>();
    }
    Result<Rational> value = scan_number(token);
    if (!value) return std::move(value).error();
    return std::optional<Rational>(*std::move(value));
  }

  // [-]digits, [-]digits/digits or [-]digits.digits as an exact rational.
  Result<Rational> scan_number(std::size_t token) {
    const bool negative = here() == U'-';
    if (negative) ++at_;
    const std::string digits = scan_digits();
    if (digits.empty()) return unexpected("a corner is a number: 3, (10), (3/2) or (2.5)");
    const char32_t mark = here();
    const bool fraction = mark == U'/', decimal = mark == U'.';
    std::string below;
    if (fraction || decimal) {
      ++at_;
      below = scan_digits();
      if (below.empty()) return unexpected("a real corner is a fraction or a decimal number: (3/2) or (2.5)");
    }
    if (significant(digits).size() > (fraction ? kMaxAbove : kMaxDigits) ||
        (fraction ? significant(below).size() > kMaxBelow : below.size() > kMaxDigits))
      return error("notation.order-out-of-range", "this corner has too many digits", token,
                   fmt::format("orders are at most {}", kMaxOrder));
    const Integer scale = fraction ? integer_of(below) : pow(Integer(10), static_cast<unsigned>(decimal ? below.size() : 0));
    if (scale == 0) return error("notation.order-out-of-range", "this corner divides by zero", token);
    const Rational value(decimal ? Integer(integer_of(digits) * scale + integer_of(below)) : integer_of(digits), scale);
    return negative ? Rational(-value) : value;
  }

  std::string scan_digits() {
    std::string digits;
    for (; at_ < characters_.size() && is_digit(characters_[at_]); ++at_) digits += static_cast<char>(characters_[at_]);
    return digits;
  }

  SymbolText& text_;
  std::u32string& characters_;
  std::size_t at_ = 0;  // the next character
  bool separated_ = false;
  bool comma_ = false;     // since the last token: another order must follow
  bool powered_ = false;   // the last order has an exponent
  std::size_t group_ = 0;  // the first token that an exponent would repeat
  std::vector<Token> tokens_;
};

}  // namespace

Result<Tokens> scan(SymbolText& text) { return Scanner(text).run(); }

}  // namespace orbc::notation
