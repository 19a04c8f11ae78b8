// Text → characters (code points with their places) → tokens (star, order, x, o) → Conway symbol → orbifold, or an error that says what the
// symbol is. Other notations are translated first (translate.h). Unusual but unambiguous spellings of Conway's symbols are read, with a
// note.
#include "compiler/notation/parse.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/notation/characters.h"
#include "compiler/notation/classify.h"
#include "compiler/notation/conway.h"
#include "compiler/notation/print.h"
#include "compiler/notation/scan.h"
#include "compiler/notation/translate.h"

namespace orbc::notation {
namespace {

using Kind = TokenKind;

class Reader {
 public:
  Reader(std::string_view text, const ParseOptions& options) : size_(text.size()), options_(options), text_(text, options.span) {}

  Result<Parsed> read() {
    if (size_ > SymbolText::kMaxBytes)
      return text_.error("notation.too-long", fmt::format("{} bytes are too long for a notation", size_), 0, 1);
    if (const auto translation = translate(ascii_of(text_.inner()))) return translated(*translation);
    Result<Tokens> tokens = scan(text_);
    if (!tokens) return misread(std::move(tokens).error());
    tokens_ = std::move(tokens->list);
    separated_ = tokens->separated;
    if (tokens_.empty())
      return text_.error("notation.empty", "the orbifold notation is empty", 0, 1,
                         "a room with mirrors is * followed by its corners: *22222");
    if (tokens_.size() == 2 && tokens_[0].kind == Kind::star && tokens_[1].kind == Kind::star) return noted({{{}, true}, {}});
    const bool kaleidoscopic = tokens_[0].kind == Kind::star &&
                               std::all_of(tokens_.begin() + 1, tokens_.end(), [](const Token& t) { return t.kind == Kind::order; });
    return kaleidoscopic ? orbifold() : refusal();
  }

 private:
  bool fail(Diagnostic diagnostic) {
    errors_.push_back(std::move(diagnostic));
    return false;
  }

  // A text that does not begin like a symbol may be meant as the name of a group.
  Diagnostics misread(Diagnostics errors) const {
    if (errors.front().span.column > text_.whole().column) return errors;
    const std::string near = nearest_group_name(ascii_of(text_.inner()));
    if (!near.empty()) errors.front().hint = fmt::format("did you mean {}?", near);
    return errors;
  }

  Result<Parsed> orbifold() {
    Parsed parsed;
    std::size_t endless = 0;  // corners of order ∞
    for (std::size_t i = 1; i < tokens_.size(); ++i) {
      const Token& token = tokens_[i];
      if (!token.value) {
        ++endless;
        continue;
      }
      const Rational& order = *token.value;
      if (order == 1)
        parsed.notes.push_back(make_note("notation.corner-of-order-one", "a corner of order 1 is a straight angle and is left out", "",
                                         text_.place(token.begin, token.length)));
      else if (check_order(token)) parsed.orbifold.corners.push_back(order);
    }
    if (parsed.orbifold.corners.size() > static_cast<std::size_t>(kMaxCorners)) {
      const Token& first = tokens_[static_cast<std::size_t>(kMaxCorners) + 1];
      fail(text_.error("notation.too-many-corners",
                       fmt::format("{} corners are more than the {} that are supported", parsed.orbifold.corners.size(), kMaxCorners),
                       first.begin, first.length));
    }
    if (!errors_.empty()) return errors_;
    if (endless > 0) return unbounded(std::move(parsed), endless);
    if (Result<geometry::Space> space = classify(parsed.orbifold, text_.whole()); !space) return std::move(space).error();
    return noted(std::move(parsed));
  }

  // Corners of order ∞: in E² their mirrors are parallel, and plain end walls close the room; in H² the corner is a cusp.
  Result<Parsed> unbounded(Parsed parsed, std::size_t endless) {
    const std::vector<Rational>& corners = parsed.orbifold.corners;
    const bool right = std::all_of(corners.begin(), corners.end(), [](const Rational& k) { return k == 2; });
    if (right && ((corners.empty() && endless == 2) || (corners.size() == 2 && endless == 1))) {
      parsed.orbifold.strip = true;
      text_.respelled = text_.respelled || corners.empty() || tokens_.back().value.has_value();
      return noted(std::move(parsed));
    }
    if (corners.size() + endless < 3)
      return text_.error("notation.bad-orbifold", text_.quoted() + " closes in no space of constant curvature", text_.begin,
                         text_.end - text_.begin, "two parallel mirrors are **, with a third across them *22∞");
    Orbifold near;
    for (std::size_t i = 1; i < tokens_.size(); ++i)
      if (tokens_[i].value != Rational(1)) near.corners.push_back(tokens_[i].value.value_or(Rational(60)));
    return text_.error(
        "notation.not-closed",
        text_.quoted() +
            " is kaleidoscopic, but some of its mirrors meet at infinity: its room is not closed there, and cusps are not drawn",
        text_.begin, text_.end - text_.begin, fmt::format("a large order comes close: {}", to_text(near)));
  }

  // Adds a note on how an unusual spelling was read.
  Parsed noted(Parsed parsed) const {
    if (text_.respelled)
      parsed.notes.push_back(
          make_note("notation.read-as", fmt::format("{} is read as {}", text_.quoted(), to_text(parsed.orbifold)), "", text_.whole()));
    return parsed;
  }

  Result<Parsed> translated(const Translation& translation) const {
    if (translation.conway.empty())
      return make_error("notation.no-room", fmt::format("{} {}", text_.quoted(), translation.trouble), translation.hint, text_.whole());
    ParseOptions options;
    options.allow_non_orbifold = options_.allow_non_orbifold;
    Result<Parsed> parsed = parse_with_notes(translation.conway, options);
    if (!parsed) {
      Diagnostics errors = std::move(parsed).error();
      for (Diagnostic& error : errors) {
        error.message = fmt::format("{} is written {}: {}", text_.quoted(), translation.conway, error.message);
        error.span = text_.whole();
      }
      return errors;
    }
    parsed->notes = {
        make_note("notation.read-as", fmt::format("{} is read as {}", text_.quoted(), to_text(parsed->orbifold)), "", text_.whole())};
    return parsed;
  }

  bool check_order(const Token& token) {
    const Rational& order = *token.value;
    const bool whole_number = denominator(order) == 1;
    if (order < 1) {
      const std::string angle =
          order > 0 ? "its angle would be larger than a straight one" : "a corner has the angle π/k with k of at least 2";
      return fail(text_.error("notation.order-out-of-range", fmt::format("a corner cannot have order {}: {}", to_string(order), angle),
                              token.begin, token.length,
                              separated_ || order != 0 ? "" : "write 10 as (10) or separate all corners: *2 3 10"));
    }
    if (order > kMaxOrder)
      return fail(text_.error("notation.order-out-of-range", fmt::format("order {} is larger than {}", to_string(order), kMaxOrder),
                              token.begin, token.length));
    if (!whole_number && !options_.allow_non_orbifold)
      return fail(text_.error("notation.non-orbifold-corner",
                              fmt::format("order {} is no integer: the mirror images of this corner do not close", to_string(order)),
                              token.begin, token.length, "rooms that are no orbifolds need allow_non_orbifold: true"));
    return true;
  }

  // The error of a symbol that is not kaleidoscopic says what the symbol is. Conway's order is o…, gyration points, *corners…, x….
  Result<Parsed> refusal() {
    ConwaySymbol symbol;
    const Token* culprit = nullptr;
    for (const Token& token : tokens_) {
      if (token.kind == Kind::order && token.value && (*token.value < 1 || denominator(*token.value) != 1 || *token.value > kMaxOrder))
        return text_.error("notation.order-out-of-range",
                           fmt::format("a gyration point or corner cannot have order {}", to_string(*token.value)), token.begin,
                           token.length);
      const int order = token.value ? static_cast<int>(numerator(*token.value)) : 0;
      const bool late = token.kind == Kind::wonder_ring ? !symbol.gyrations.empty() || !symbol.boundaries.empty() || symbol.crosscaps > 0
                                                        : token.kind != Kind::cross_cap && symbol.crosscaps > 0;
      if (late) {
        return text_.unexpected(token.begin, "Conway's order is: o, gyration points, * with its corners, x");
      }
      bool foreign = true;  // whether the token makes the symbol other than kaleidoscopic
      if (token.kind == Kind::star) {
        foreign = !symbol.boundaries.empty();
        symbol.boundaries.emplace_back();
      } else if (token.kind == Kind::cross_cap) {
        ++symbol.crosscaps;
      } else if (token.kind == Kind::wonder_ring) {
        ++symbol.handles;
      } else if (symbol.boundaries.empty()) {
        symbol.gyrations.push_back(order);
      } else {
        symbol.boundaries.back().push_back(order);
        foreign = !token.value;
      }
      if (foreign && !culprit) culprit = &token;
    }
    const std::string name = usual_name(symbol);
    return text_.error(
        "notation.not-kaleidoscopic",
        fmt::format("{}{} is not kaleidoscopic: it has {}", text_.quoted(), name.empty() ? "" : " (" + name + ")", features(symbol)),
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
    return "a room is closed by mirrors alone, * followed by its corners; turns and glide reflections are not drawn yet";
  }

  std::size_t size_;
  ParseOptions options_;
  SymbolText text_;
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
