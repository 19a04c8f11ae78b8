// Characters → tokens (star, order, x, o). Every token remembers where it stands.
#include "compiler/notation/scan.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/notation/characters.h"
#include "compiler/notation/parse.h"

namespace orbc::notation {
namespace {

using Kind = TokenKind;

constexpr std::size_t kMaxDigits = 7;    // as many as kMaxOrder has; of a decimal number before and behind its point
// A decimal number of so many digits is printed as a fraction: parse(to_text(o)) = o.
constexpr std::size_t kMaxAbove = 2 * kMaxDigits, kMaxBelow = kMaxDigits + 1;

bool is_digit(char32_t c) { return c >= U'0' && c <= U'9'; }
bool is_star(char32_t c) { return c == U'*'; }
bool is_cross(char32_t c) { return c == U'x' || c == U'X' || c == U'\u00D7'; }
bool is_ring(char32_t c) { return c == U'o' || c == U'O' || c == U'\u2218' || c == U'\u25CB'; }

constexpr const char* kCornerHint = "corners are digits, (10) or (3/2), as in *23(10) or *2 3 10";
constexpr const char* kRealHint = "put real corners into parentheses, *(3/2)(12)(12), *(2.5)44; two corners are written *22";
constexpr const char* kCommaHint = "a comma stands between two corners: *2,3,10";
constexpr const char* kPowerHint = "a power repeats a corner: *2^5 is *22222";

class Scanner {
 public:
  explicit Scanner(SymbolText& text) : text_(text), characters_(text.characters) {}

  Result<Tokens> run() {
    if (!scan()) return std::move(errors_);
    return Tokens{std::move(tokens_), separated_};
  }

 private:
  bool fail(Diagnostic diagnostic) {
    errors_.push_back(std::move(diagnostic));
    return false;
  }
  bool unexpected(std::size_t at, const std::string& hint = kCornerHint) { return fail(text_.unexpected(at, hint)); }

  // Points between corners, *4.4.2: two or more, or one beside a parenthesis. A single one may be meant as a real corner.
  void commas_for_points() {
    std::vector<std::size_t> points;
    std::size_t depth = 0;
    bool beside = false;
    for (std::size_t i = text_.begin; i < text_.end; ++i) {
      const char32_t c = characters_[i];
      if (c == U'(') ++depth;
      if (c == U')' && depth > 0) --depth;
      if (depth > 0) continue;
      if (is_blank(c) || c == U',' || c == U'/') return;
      if (c != U'.') continue;
      points.push_back(i);
      beside = beside || (i > text_.begin && characters_[i - 1] == U')') || (i + 1 < text_.end && characters_[i + 1] == U'(');
    }
    if (points.empty() || (points.size() < 2 && !beside)) return;
    for (const std::size_t i : points) characters_[i] = U',';
    text_.respelled = true;
  }

  // Corners are separated when a comma stands outside parentheses, or blanks stand between two digits.
  bool is_separated() const {
    bool inside = false;
    for (std::size_t i = 0; i < characters_.size(); ++i) {
      const char32_t c = characters_[i];
      if (c == U'(') inside = true;
      if (c == U')') inside = false;
      if (inside) continue;
      if (c == U',') return true;
      if (!is_blank(c) || i == 0 || !is_digit(characters_[i - 1])) continue;
      while (i + 1 < characters_.size() && is_blank(characters_[i + 1])) ++i;
      if (i + 1 < characters_.size() && (is_digit(characters_[i + 1]) || characters_[i + 1] == U'-')) return true;
    }
    return false;
  }

  bool scan() {
    commas_for_points();
    separated_ = is_separated();
    bool comma = false;  // seen since the last token: another order must follow
    for (std::size_t at = 0; at < characters_.size();) {
      const char32_t c = characters_[at];
      if (is_blank(c)) {
        ++at;
        continue;
      }
      if (c == U',') {
        if (comma || tokens_.empty() || tokens_.back().kind != Kind::order) return unexpected(at, kCommaHint);
        comma = true;
        ++at;
        continue;
      }
      if (c == U'\\') {
        if (!skip_backslash(at)) return false;
        continue;
      }
      if (is_power(at)) {
        if (!scan_power(at)) return false;
        continue;
      }
      const bool is_order = is_digit(c) || c == U'(' || c == U'-' || infinity_at(at) > 0;
      if (comma && !is_order) return unexpected(at, kCommaHint);
      comma = false;
      if (is_order) {
        if (!scan_order(at)) return false;
        continue;
      }
      if (!is_star(c) && !is_cross(c) && !is_ring(c)) return unexpected(at, c == U'.' || c == U'/' ? kRealHint : kCornerHint);
      tokens_.push_back({is_star(c) ? Kind::star : is_cross(c) ? Kind::cross_cap : Kind::wonder_ring, at, 1, {}});
      ++at;
    }
    if (comma) return unexpected(characters_.size(), kCommaHint);
    return true;
  }

  // A star or a word of TeX behind a backslash, which is what shells and TeX want of it.
  bool skip_backslash(std::size_t& at) {
    text_.respelled = true;
    if (at + 1 < characters_.size() && is_star(characters_[at + 1])) {
      ++at;
      return true;
    }
    struct Word {
      std::u32string_view name;
      char32_t meant;
    };
    for (const Word& word : {Word{U"ast", U'*'}, Word{U"star", U'*'}, Word{U"infty", kInfinity}, Word{U"times", U'x'}}) {
      if (characters_.compare(at + 1, word.name.size(), word.name) != 0) continue;
      std::fill_n(characters_.begin() + static_cast<std::ptrdiff_t>(at), word.name.size(), U' ');
      at += word.name.size();
      characters_[at] = word.meant;
      return true;
    }
    return unexpected(at);
  }

  // How many characters at `at` say ∞: the sign itself, inf, infinity, or behind a star or an order oo; 0: none.
  std::size_t infinity_at(std::size_t at) const {
    if (characters_[at] == kInfinity) return 1;
    std::u32string word = characters_.substr(at, 8);
    for (char32_t& c : word)
      if (c >= U'A' && c <= U'Z') c += 32;
    for (const std::u32string_view name : {U"infinity", U"infty", U"inf"})
      if (word.compare(0, name.size(), name) == 0) return name.size();
    return !tokens_.empty() && word.compare(0, 2, U"oo") == 0 ? 2 : 0;
  }

  bool is_power(std::size_t at) const { return characters_[at] == U'^' || raised_digit(characters_[at]) >= 0; }

  // The digits of an exponent, ^5, ^{12}, ^(12) or ⁵; "" after an error.
  std::string scan_exponent(std::size_t& at) {
    std::string digits;
    if (characters_[at] != U'^') {
      for (; at < characters_.size() && raised_digit(characters_[at]) >= 0; ++at)
        digits += static_cast<char>('0' + raised_digit(characters_[at]));
      return digits;
    }
    const std::size_t begin = at++;
    const char32_t open = at < characters_.size() ? characters_[at] : U' ';
    const bool enclosed = open == U'{' || open == U'(';
    if (enclosed) ++at;
    digits = scan_digits(at);
    const bool closed = !enclosed || (at < characters_.size() && characters_[at] == (open == U'{' ? U'}' : U')'));
    if (digits.empty() || !closed) {
      unexpected(at, kPowerHint);
      return "";
    }
    if (enclosed) ++at;
    if (!enclosed && !separated_ && digits.size() > 1) {
      fail(text_.error("notation.unexpected-character", "it is not clear where this exponent ends", begin, digits.size() + 1,
                       "put it into braces or separate the corners: *2^{10}, *2^5 3"));
      return "";
    }
    return digits;
  }

  // A power repeats the last order, or the list in parentheses: *2^5, *2⁵, *(2,3)^2.
  bool scan_power(std::size_t& at) {
    const std::size_t begin = at;
    if (tokens_.empty() || tokens_.back().kind != Kind::order || powered_) return unexpected(at, kPowerHint);
    const std::string digits = scan_exponent(at);
    if (digits.empty()) return false;
    const std::size_t count = digits.size() > 4 ? 10000 : static_cast<std::size_t>(std::stoi(digits));
    if (count < 1) return fail(text_.error("notation.order-out-of-range", "a corner cannot be repeated 0 times", begin, at - begin));
    const std::vector<Token> repeated(tokens_.begin() + static_cast<std::ptrdiff_t>(group_), tokens_.end());
    if (count * repeated.size() > static_cast<std::size_t>(kMaxCorners))
      return fail(text_.error("notation.too-many-corners",
                              fmt::format("these are more corners than the {} that are supported", kMaxCorners), begin, at - begin));
    for (std::size_t i = 1; i < count; ++i) tokens_.insert(tokens_.end(), repeated.begin(), repeated.end());
    powered_ = text_.respelled = true;
    return true;
  }

  // One order at `at`, which moves behind it: a digit, a number where corners are separated, (number), (list), ∞.
  bool scan_order(std::size_t& at) {
    std::size_t begin = at;
    group_ = tokens_.size();
    powered_ = false;
    if (const std::size_t length = infinity_at(at); length > 0) {
      tokens_.push_back({Kind::order, begin, length, {}});
      text_.respelled = text_.respelled || length > 1;
      at += length;
      return true;
    }
    const std::size_t opened = at;
    const bool parenthesis = characters_[at] == U'(';
    if (!parenthesis && !separated_ && is_digit(characters_[at])) {
      tokens_.push_back({Kind::order, begin, 1, Rational(static_cast<int>(characters_[at] - U'0'))});
      ++at;
      return true;
    }
    if (parenthesis) {
      ++at;
      skip_blanks(at);
    }
    std::optional<Rational> value;
    if (!scan_value(at, begin, parenthesis, value)) return false;
    if (parenthesis) {
      skip_blanks(at);
      while (at < characters_.size() && characters_[at] == U',' && !tokens_.empty())
        if (!scan_listed(at, begin, value)) return false;
      if (at >= characters_.size())
        return fail(text_.error("notation.unclosed-parenthesis", "this parenthesis is not closed", opened, 1,
                                "write (10) for a corner of order 10"));
      if (characters_[at] != U')') return unexpected(at, "a parenthesis holds one corner: (10), (3/2) or (2.5)");
      ++at;
    }
    tokens_.push_back({Kind::order, begin, at - begin, value});
    return true;
  }

  // The next order of a list in parentheses, *(4,4,2); the one before, which began at `begin`, becomes a token.
  bool scan_listed(std::size_t& at, std::size_t& begin, std::optional<Rational>& value) {
    tokens_.push_back({Kind::order, begin, at - begin, value});
    text_.respelled = true;
    skip_blanks(++at);
    begin = at;
    value.reset();
    if (!scan_value(at, begin, true, value)) return false;
    skip_blanks(at);
    return true;
  }

  // A number, or where it may stand ∞, which leaves no value.
  bool scan_value(std::size_t& at, std::size_t token, bool may_be_infinite, std::optional<Rational>& value) {
    const std::size_t length = may_be_infinite && at < characters_.size() ? infinity_at(at) : 0;
    if (length == 0) return scan_number(at, token, value);
    text_.respelled = text_.respelled || length > 1;
    at += length;
    return true;
  }

  void skip_blanks(std::size_t& at) const {
    while (at < characters_.size() && is_blank(characters_[at])) ++at;
  }

  // [-]digits, [-]digits/digits or [-]digits.digits as an exact rational.
  bool scan_number(std::size_t& at, std::size_t token, std::optional<Rational>& value) {
    const bool negative = at < characters_.size() && characters_[at] == U'-';
    if (negative) ++at;
    std::string digits = scan_digits(at), below;
    if (digits.empty()) return unexpected(at, "a corner is a number: 3, (10), (3/2) or (2.5)");
    const char32_t mark = at < characters_.size() ? characters_[at] : U' ';
    if (mark == U'/' || mark == U'.') {
      below = scan_digits(++at);
      if (below.empty()) return unexpected(at, "a real corner is a fraction or a decimal number: (3/2) or (2.5)");
    }
    const auto significant = [](std::string s) { return s.erase(0, s.find_first_not_of('0')); };
    const bool fraction = mark == U'/';
    if (significant(digits).size() > (fraction ? kMaxAbove : kMaxDigits) ||
        (fraction ? significant(below).size() > kMaxBelow : below.size() > kMaxDigits))
      return fail(text_.error("notation.order-out-of-range", "this corner has too many digits", token, at - token,
                              fmt::format("orders are at most {}", kMaxOrder)));
    // A leading zero would make the number octal.
    const auto number = [&](const std::string& s) { return Integer(significant(s).empty() ? "0" : significant(s)); };
    const Integer scale =
        mark == U'/' ? number(below) : pow(Integer(10), static_cast<unsigned>(mark == U'.' ? below.size() : 0));
    if (scale == 0) return fail(text_.error("notation.order-out-of-range", "this corner divides by zero", token, at - token));
    Rational result(mark == U'.' ? Integer(number(digits) * scale + number(below)) : number(digits), scale);
    value = negative ? Rational(-result) : result;
    return true;
  }

  std::string scan_digits(std::size_t& at) const {
    std::string digits;
    for (; at < characters_.size() && is_digit(characters_[at]); ++at) digits += static_cast<char>(characters_[at]);
    return digits;
  }

  SymbolText& text_;
  std::u32string& characters_;
  bool separated_ = false;
  bool powered_ = false;   // the last order has an exponent
  std::size_t group_ = 0;  // first token of what an exponent would repeat
  std::vector<Token> tokens_;
  Diagnostics errors_;
};

}  // namespace

Result<Tokens> scan(SymbolText& text) { return Scanner(text).run(); }

}  // namespace orbc::notation
