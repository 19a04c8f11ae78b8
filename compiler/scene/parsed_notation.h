#pragma once
#include <optional>
#include <string>

#include "compiler/base/diagnostic.h"
#include "compiler/notation/orbifold.h"

namespace orbc::scene {

/// A parsed notation: the orbifold, if it has a room, and the diagnostics, placed at `span`.
struct ParsedNotation {
  std::optional<notation::Orbifold> orbifold;
  Diagnostics diagnostics;
};
[[nodiscard]] ParsedNotation parse_notation(const std::string& text, bool allow_non_orbifold, const SourceSpan& span);

}  // namespace orbc::scene
