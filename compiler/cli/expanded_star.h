#pragma once
#include <string>

#include "compiler/base/diagnostic.h"

namespace orbc::cli {

/// Shells replace a word with a star by the names of the files that match it: `orbc info *22` without quotation marks becomes
/// `orbc info a22 b22`. Tells so when the words behind a command that takes a notation are files.
/// Makes: whether that is what happened; then it has been told.
[[nodiscard]] bool told_expanded_star(int argc, char** argv);

/// The same for a star that was replaced by one name: what is wrong with it as a notation, and the hint to quote it.
[[nodiscard]] Diagnostics with_star_hint(Diagnostics errors, const std::string& notation);

}  // namespace orbc::cli
