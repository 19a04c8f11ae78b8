// Token by token. Places are kept as offsets and made lines and columns when all is done: counting lines at each number would take hours.
#include <fmt/format.h>

#include "compiler/diff/compare.h"
#include "compiler/diff/tokens.h"

namespace orbc::diff {
namespace {

std::string shown(const Token& token) {
  constexpr std::size_t kMost = 60;
  if (token.kind == TokenKind::end) return "the end of the file";
  std::string text(token.text.substr(0, kMost));
  if (token.text.size() > kMost) text += "…";
  return token.kind == TokenKind::text ? '"' + text + '"' : text;
}

class TextComparison {
 public:
  TextComparison(Form form, const Source& a, const Source& b, const Limits& limits, Finding& finding)
      : a_(a), b_(b), limits_(limits), finding_(finding), grammar_(form == Form::svg ? Grammar::svg : Grammar::pov) {}

  Diagnostics run() {
    Tokens left(a_.bytes, grammar_), right(b_.bytes, grammar_);
    for (;;) {
      const Token x = left.next(), y = right.next();
      Diagnostics errors;
      if (!agree(x, y, errors)) return finding_.differ_in_structure(places(x, y)), place_largest(), errors;
      if (!errors.empty()) return errors;
      if (x.kind == TokenKind::end) return place_largest(), errors;
    }
  }

 private:
  [[nodiscard]] Difference places(const Token& x, const Token& y) const {
    return {line_and_column(a_.bytes, x.at), line_and_column(b_.bytes, y.at), shown(x) + " against " + shown(y)};
  }
  void place_largest() {
    if (finding_.largest > 0 && has_largest_) finding_.largest_at = line_and_column(a_.bytes, largest_);
  }

  /// Makes: whether the structure is the same so far.
  bool agree(const Token& x, const Token& y, Diagnostics& errors) {
    if (x.kind != y.kind) return false;
    switch (x.kind) {
      case TokenKind::number:
        return numbers(x, y, x, y);
      case TokenKind::comment:
        return x.text == y.text || comments(x, y);
      case TokenKind::text:
        if (!same_name(x.text, a_, y.text, b_)) return false;
        // A picture that the file carries along is compared where it stands.
        if (names_picture(x.text) && !(carries(a_, x.text) && carries(b_, y.text))) errors = pictures_beside(x.text, y.text);
        return true;
      case TokenKind::file:
        return same_name(x.text, a_, y.text, b_) && inlined(x, y, errors);
      default:
        return x.text == y.text;
    }
  }

  /// In: the tokens whose places are told: the numbers themselves, or the comments they stand in.
  bool numbers(const Token& x, const Token& y, const Token& at_x, const Token& at_y) {
    if (x.whole && y.whole && x.text != y.text && x.value != y.value) return false;
    const double before = finding_.largest;
    (void)take_numbers(x.value, y.value, limits_, finding_, [&] {
      if (finding_.differs || distance(x.value, y.value) <= limits_.within) return Difference{};
      Difference difference = places(at_x, at_y);
      difference.what = shown(x) + " against " + shown(y);
      return difference;
    });
    if (finding_.largest > before) largest_ = at_x.at, has_largest_ = true;
    return true;
  }

  bool comments(const Token& x, const Token& y) {
    const std::string left = without_stem(x.text, a_), right = without_stem(y.text, b_);
    // The first two characters begin a comment; inside the grammar of SVG knows none.
    Tokens in_left(std::string_view(left).substr(2), Grammar::svg), in_right(std::string_view(right).substr(2), Grammar::svg);
    for (;;) {
      const Token l = in_left.next(), r = in_right.next();
      if (l.kind != r.kind) return false;
      if (l.kind == TokenKind::number ? !numbers(l, r, x, y) : l.text != r.text) return false;
      if (l.kind == TokenKind::end) return true;
    }
  }

  Diagnostics pictures_beside(std::string_view x, std::string_view y) {
    const auto left = read_beside(a_, x), right = read_beside(b_, y);
    if (!left) return left.error();
    if (!right) return right.error();
    return compare_pictures({std::string(x), *left}, {std::string(y), *right}, limits_, finding_);
  }

  static bool carries(const Source& source, std::string_view name) {
    return source.bytes.find(fmt::format("/* orbc-file {} base64\n", name)) != std::string::npos;
  }

  bool inlined(const Token& x, const Token& y, Diagnostics& errors) {
    const auto left = decode_base64(x.bytes), right = decode_base64(y.bytes);
    if (!left || !right) {
      errors = {bad_file((left ? b_ : a_).name, fmt::format("what stands for {} is not base64", (left ? y : x).text))};
      return true;
    }
    if (!names_picture(x.text)) return *left == *right;
    errors = compare_pictures({std::string(x.text), *left}, {std::string(y.text), *right}, limits_, finding_);
    return true;
  }

  const Source& a_;
  const Source& b_;
  const Limits& limits_;
  Finding& finding_;
  Grammar grammar_;
  std::size_t largest_ = 0;
  bool has_largest_ = false;
};

}  // namespace

Diagnostics compare_text(Form form, const Source& a, const Source& b, const Limits& limits, Finding& finding) {
  return TextComparison(form, a, b, limits, finding).run();
}

}  // namespace orbc::diff
