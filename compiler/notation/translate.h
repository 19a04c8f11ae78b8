#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace orbc::notation {

/// The translation of a symbol of another notation.
struct Translation {
  std::string conway;   ///< "*632", "4*2", "*22∞"; "" when there is none
  std::string trouble;  ///< then: why there is none, as a predicate: "acts on a space of three dimensions"
  std::string hint;     ///< what to write instead
};

/// Translates symbols of other notations into Conway's: wallpaper groups (p6m, p31m), point groups (Ih, D3h, m-3m, 4/mmm), Schläfli's
/// {7,3}, Coxeter's [3,7], triangle groups (2,3,7) and Δ(2,3,7), Wythoff's 3 | 2 7, finite Coxeter groups by name (H3).
/// In:     ASCII text without blanks at its ends; ∞ as "inf", Δ as "Delta", an overlined digit as "-3", subscripts as plain characters.
/// Makes:  nothing when the text is none of these. Orders are not checked here.
/// Source: International Tables for Crystallography A (2016); Conway, Burgiel, Goodman-Strauss, The symmetries of things (2008), ch. 8;
///         Coxeter, Moser, Generators and relations for discrete groups (1980).
[[nodiscard]] std::optional<Translation> translate(std::string_view text);

/// The name among all those of groups that is nearest to `text`, with its symbol: "p6m (*632)"; "" when none is near.
[[nodiscard]] std::string nearest_group_name(std::string_view text);

}  // namespace orbc::notation
