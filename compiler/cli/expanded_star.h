#pragma once
#include <string>
#include <vector>

#include "compiler/base/diagnostic.h"

namespace orbc::cli {

/// Shells replace a word with a star by the names of the files that match it: `orbc info *22` without quotation marks becomes
/// `orbc info a22 b22`.
/// In:    the words behind `command`, which takes one notation.
/// Makes: the message for it when two or more of the words are files; "" otherwise.
[[nodiscard]] std::string expanded_star_message(const std::string& command, const std::vector<std::string>& words);

/// The same for a star that was replaced by one name: what is wrong with it as a notation, and the hint to quote it.
[[nodiscard]] Diagnostics with_star_hint(Diagnostics errors, const std::string& notation);

}  // namespace orbc::cli
