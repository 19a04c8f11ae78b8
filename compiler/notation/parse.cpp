// Text → characters (code points with their places) → tokens (star, order, x, o) → Conway symbol → orbifold or its refusal.
// In compact text each digit is a token; where corners are separated, a run of digits is. Every token remembers where it stands.
#include "compiler/notation/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "compiler/notation/classify.h"
#include "compiler/notation/conway.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/print.h"

namespace orbc::notation {
namespace {

constexpr std::size_t kMaxBytes = 8192;  // 256 corners, each the longest fraction in parentheses
constexpr std::size_t kMaxDigits = 7;    // as many as kMaxOrder has; of a decimal number before and behind its point
// A decimal number of so many digits is printed as a fraction: parse(to_text(o)) = o.
constexpr std::size_t kMaxAbove = 2 * kMaxDigits, kMaxBelow = kMaxDigits + 1;
constexpr std::size_t kQuotedCharacters = 40;

enum class Kind { star, order, cross_cap, wonder_ring };

struct Token {
  Kind kind;
  std::size_t begin = 0, length = 1;  // in characters
  std::optional<Rational> value;      // orders only; nothing: ∞
};

// The code points of UTF-8 text; bytes that are none stand for themselves above the range of Unicode, so that nothing matches them.
std::u32string characters_of(std::string_view text) {
  std::u32string characters;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
    const std::size_t length = byte(i) < 0x80 ? 1 : byte(i) >= 0xC2 && byte(i) < 0xE0 ? 2 : byte(i) >= 0xE0 && byte(i) < 0xF0 ? 3 : 0;
    bool whole = length > 0 && i + length <= text.size();
    char32_t code = length == 1 ? byte(i) : length == 2 ? byte(i) & 0x1Fu : byte(i) & 0x0Fu;
    for (std::size_t k = 1; whole && k < length; ++k) {
      whole = (byte(i + k) & 0xC0) == 0x80;
      code = code << 6 | (byte(i + k) & 0x3Fu);
    }
    characters += whole ? code : char32_t{0x110000} + byte(i);
    i += whole ? length : 1;
  }
  return characters;
}

bool is_blank(char32_t c) { return c == U' ' || c == U'\t' || c == U'\n' || c == U'\r'; }
bool is_digit(char32_t c) { return c >= U'0' && c <= U'9'; }
bool is_star(char32_t c) { return c == U'*' || c == U'\u2217'; }
bool is_cross(char32_t c) { return c == U'x' || c == U'X' || c == U'\u00D7'; }
bool is_ring(char32_t c) { return c == U'o' || c == U'O' || c == U'\u2218' || c == U'\u25CB'; }
constexpr char32_t kInfinity = U'\u221E';

class Reader {
 public:
  Reader(std::string_view text, const ParseOptions& options)
      : text_(text), options_(options), characters_(characters_of(text.substr(0, kMaxBytes))) {
    if (!options_.span.source)
      options_.span = {std::make_shared<SourceText>(SourceText{"notation", std::string(text.substr(0, kMaxBytes))}), 1, 1, 1};
    else skip_quote();
  }

  Result<Parsed> read() {
    if (text_.size() > kMaxBytes)
      return error("notation.too-long", fmt::format("{} bytes are too long for a notation", text_.size()), 0, 1);
    if (!scan()) return errors_;
    if (tokens_.empty())
      return error("notation.empty", "the orbifold notation is empty", 0, 1, "a room with mirrors is * followed by its corners: *22222");
    if (tokens_.size() == 2 && tokens_[0].kind == Kind::star && tokens_[1].kind == Kind::star) return Parsed{{{}, true}, {}};
    const bool kaleidoscopic = tokens_[0].kind == Kind::star && std::all_of(tokens_.begin() + 1, tokens_.end(), [](const Token& t) {
                                 return t.kind == Kind::order && t.value;
                               });
    return kaleidoscopic ? orbifold() : refusal();
  }

 private:
  // ---- places ----------------------------------------------------------------------------------------------------------------

  SourceSpan place(std::size_t begin, std::size_t length) const {
    SourceSpan span = options_.span;
    if (span.line == 0) return span;
    span.column += begin;
    span.length = length;
    return span;
  }

  SourceSpan whole() const {
    std::size_t begin = 0, end = characters_.size();
    while (begin < end && is_blank(characters_[begin])) ++begin;
    while (end > begin && is_blank(characters_[end - 1])) --end;
    return place(begin, std::max<std::size_t>(end - begin, 1));
  }

  // Spans of YAML scalars begin at the quotation mark; the text behind it does not contain it.
  void skip_quote() {
    SourceSpan& span = options_.span;
    std::string_view rest = span.source->text;
    for (std::size_t line = 1; line < span.line && !rest.empty(); ++line)
      rest.remove_prefix(std::min(rest.size(), rest.find('\n') == std::string_view::npos ? rest.size() : rest.find('\n') + 1));
    const std::u32string line = characters_of(rest.substr(0, std::min(rest.find('\n'), kMaxBytes)));
    if (span.line == 0 || span.column == 0 || span.column > line.size()) return;
    const char32_t quote = line[span.column - 1];
    if ((quote == U'"' || quote == U'\'') && (characters_.empty() || characters_[0] != quote)) ++span.column;
  }

  Diagnostic error(const std::string& code, const std::string& message, std::size_t begin, std::size_t length,
                   const std::string& hint = {}) const {
    return make_error(code, message, hint, place(begin, length));
  }

  bool fail(Diagnostic diagnostic) {
    errors_.push_back(std::move(diagnostic));
    return false;
  }

  std::string shown(std::size_t at) const {
    const char32_t c = characters_[at];
    if (c >= 0x110000) return fmt::format("byte {:02X}", static_cast<unsigned>(c - 0x110000));
    if (c < 0x20 || (c >= 0x7F && c < 0xA0)) return fmt::format("control character {:02X}", static_cast<unsigned>(c));
    std::string utf8;
    if (c < 0x80) utf8 = static_cast<char>(c);
    else if (c < 0x800) utf8 = {static_cast<char>(0xC0 | c >> 6), static_cast<char>(0x80 | (c & 0x3F))};
    else utf8 = {static_cast<char>(0xE0 | c >> 12), static_cast<char>(0x80 | (c >> 6 & 0x3F)), static_cast<char>(0x80 | (c & 0x3F))};
    return "'" + utf8 + "'";
  }

  bool unexpected(std::size_t at, const std::string& hint = "corners are digits, (10) or (3/2), as in *23(10) or *2 3 10") {
    if (at >= characters_.size()) return fail(error("notation.unexpected-character", "the notation ends too early", at, 1, hint));
    return fail(error("notation.unexpected-character", shown(at) + " does not belong into an orbifold notation", at, 1, hint));
  }

  // ---- tokens ----------------------------------------------------------------------------------------------------------------

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
    separated_ = is_separated();
    bool comma = false;  // seen since the last token: another order must follow
    for (std::size_t at = 0; at < characters_.size();) {
      const char32_t c = characters_[at];
      if (is_blank(c)) {
        ++at;
        continue;
      }
      if (c == U',') {
        if (comma || tokens_.empty() || tokens_.back().kind != Kind::order)
          return unexpected(at, "a comma stands between two corners: *2,3,10");
        comma = true, ++at;
        continue;
      }
      const bool is_order = is_digit(c) || c == U'(' || c == U'-' || c == kInfinity;
      if (comma && !is_order) return unexpected(at, "a comma stands between two corners: *2,3,10");
      comma = false;
      if (is_order) {
        if (!scan_order(at)) return false;
        continue;
      }
      if (!is_star(c) && !is_cross(c) && !is_ring(c))
        return unexpected(at, c == U'.' || c == U'/' ? "put real corners into parentheses: *(3/2)(12)(12), *(2.5)44"
                                                     : "corners are digits, (10) or (3/2), as in *23(10) or *2 3 10");
      tokens_.push_back({is_star(c) ? Kind::star : is_cross(c) ? Kind::cross_cap : Kind::wonder_ring, at, 1, {}});
      ++at;
    }
    if (comma) return unexpected(characters_.size(), "a comma stands between two corners: *2,3,10");
    return true;
  }

  // One order at `at`, which moves behind it: a digit, a number where corners are separated, (number), ∞.
  bool scan_order(std::size_t& at) {
    const std::size_t begin = at;
    if (characters_[at] == kInfinity) {
      tokens_.push_back({Kind::order, begin, 1, {}});
      ++at;
      return true;
    }
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
    if (parenthesis && at < characters_.size() && characters_[at] == kInfinity) ++at;
    else if (!scan_number(at, begin, value)) return false;
    if (parenthesis) {
      skip_blanks(at);
      if (at >= characters_.size())
        return fail(
            error("notation.unclosed-parenthesis", "this parenthesis is not closed", begin, 1, "write (10) for a corner of order 10"));
      if (characters_[at] != U')') return unexpected(at, "a parenthesis holds one corner: (10), (3/2) or (2.5)");
      ++at;
    }
    tokens_.push_back({Kind::order, begin, at - begin, value});
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
      return fail(error("notation.order-out-of-range", "this corner has too many digits", token, at - token,
                        fmt::format("orders are at most {}", kMaxOrder)));
    // A leading zero would make the number octal.
    const auto number = [&](const std::string& s) { return Integer(significant(s).empty() ? "0" : significant(s)); };
    const Integer scale =
        mark == U'/' ? number(below) : boost::multiprecision::pow(Integer(10), static_cast<unsigned>(mark == U'.' ? below.size() : 0));
    if (scale == 0) return fail(error("notation.order-out-of-range", "this corner divides by zero", token, at - token));
    Rational result(mark == U'.' ? Integer(number(digits) * scale + number(below)) : number(digits), scale);
    value = negative ? Rational(-result) : result;
    return true;
  }

  std::string scan_digits(std::size_t& at) const {
    std::string digits;
    for (; at < characters_.size() && is_digit(characters_[at]); ++at) digits += static_cast<char>(characters_[at]);
    return digits;
  }

  // ---- meaning ---------------------------------------------------------------------------------------------------------------

  Result<Parsed> orbifold() {
    Parsed parsed;
    for (std::size_t i = 1; i < tokens_.size(); ++i) {
      const Token& token = tokens_[i];
      const Rational& order = *token.value;
      if (order == 1)
        parsed.notes.push_back(make_note("notation.corner-of-order-one", "a corner of order 1 is a straight angle and is left out", "",
                                         place(token.begin, token.length)));
      else if (check_order(token)) parsed.orbifold.corners.push_back(order);
    }
    if (parsed.orbifold.corners.size() > static_cast<std::size_t>(kMaxCorners)) {
      const Token& first = tokens_[static_cast<std::size_t>(kMaxCorners) + 1];
      fail(error("notation.too-many-corners",
                 fmt::format("{} corners are more than the {} that are supported", parsed.orbifold.corners.size(), kMaxCorners),
                 first.begin, first.length));
    }
    if (!errors_.empty()) return errors_;
    if (Result<geometry::Space> space = classify(parsed.orbifold, whole()); !space) return std::move(space).error();
    return parsed;
  }

  bool check_order(const Token& token) {
    const Rational& order = *token.value;
    const bool whole_number = denominator(order) == 1;
    if (order < 1) {
      const std::string angle =
          order > 0 ? "its angle would be larger than a straight one" : "a corner has the angle π/k with k of at least 2";
      return fail(error("notation.order-out-of-range", fmt::format("a corner cannot have order {}: {}", to_string(order), angle),
                        token.begin, token.length, separated_ || order != 0 ? "" : "write 10 as (10) or separate all corners: *2 3 10"));
    }
    if (order > kMaxOrder)
      return fail(error("notation.order-out-of-range", fmt::format("order {} is larger than {}", to_string(order), kMaxOrder), token.begin,
                        token.length));
    if (!whole_number && !options_.allow_non_orbifold)
      return fail(error("notation.non-orbifold-corner",
                        fmt::format("order {} is no integer: the mirror images of this corner do not close", to_string(order)), token.begin,
                        token.length, "rooms that are no orbifolds need allow_non_orbifold: true"));
    return true;
  }

  // A symbol that is not kaleidoscopic: names what it is. Conway's order is o…, gyration points, *corners…, x….
  Result<Parsed> refusal() {
    ConwaySymbol symbol;
    const Token* culprit = nullptr;
    for (const Token& token : tokens_) {
      if (token.kind == Kind::order && token.value && (*token.value < 1 || denominator(*token.value) != 1 || *token.value > kMaxOrder))
        return error("notation.order-out-of-range", fmt::format("a gyration point or corner cannot have order {}", to_string(*token.value)),
                     token.begin, token.length);
      const int order = token.value ? static_cast<int>(numerator(*token.value)) : 0;
      const bool late = token.kind == Kind::wonder_ring ? !symbol.gyrations.empty() || !symbol.boundaries.empty() || symbol.crosscaps > 0
                                                        : token.kind != Kind::cross_cap && symbol.crosscaps > 0;
      if (late) {
        unexpected(token.begin, "Conway's order is: o, gyration points, * with its corners, x");
        return errors_;
      }
      bool foreign = true;
      if (token.kind == Kind::star) foreign = !symbol.boundaries.empty(), symbol.boundaries.emplace_back();
      else if (token.kind == Kind::cross_cap) ++symbol.crosscaps;
      else if (token.kind == Kind::wonder_ring) ++symbol.handles;
      else if (symbol.boundaries.empty()) symbol.gyrations.push_back(order);
      else symbol.boundaries.back().push_back(order), foreign = !token.value;
      if (foreign && !culprit) culprit = &token;
    }
    const std::string name = usual_name(symbol);
    std::string text(text_);
    if (characters_.size() > kQuotedCharacters) text = "this symbol";
    return error("notation.not-kaleidoscopic",
                 fmt::format("{}{} is not kaleidoscopic: it has {}", text, name.empty() ? "" : " (" + name + ")", features(symbol)),
                 culprit->begin, culprit->length, hint_for(symbol));
  }

  std::string hint_for(const ConwaySymbol& symbol) const {
    if (symbol.handles == 0 && symbol.crosscaps == 0 && symbol.boundaries.empty() &&
        std::count(symbol.gyrations.begin(), symbol.gyrations.end(), 0) == 0) {
      Orbifold mirrored;
      for (const int order : symbol.gyrations)
        if (order > 1) mirrored.corners.emplace_back(order);
      if (classify(mirrored)) return fmt::format("with mirrors it is {}", to_text(mirrored));
    }
    if (symbol.gyrations.empty() && symbol.crosscaps == 0 && symbol.boundaries.size() == 1 &&
        symbol.boundaries[0] == std::vector<int>{0, 0})
      return "two parallel mirrors are written **";
    return "a room is closed by mirrors alone: * followed by its corners; other orbifolds are not supported yet";
  }

  std::string_view text_;
  ParseOptions options_;
  std::u32string characters_;
  bool separated_ = false;
  std::vector<Token> tokens_;
  Diagnostics errors_;
};

}  // namespace

Result<Parsed> parse_with_notes(std::string_view text, const ParseOptions& options) { return Reader(text, options).read(); }

Result<Orbifold> parse(std::string_view text, const ParseOptions& options) {
  Result<Parsed> parsed = parse_with_notes(text, options);
  if (!parsed) return std::move(parsed).error();
  return std::move(parsed)->orbifold;
}

}  // namespace orbc::notation
