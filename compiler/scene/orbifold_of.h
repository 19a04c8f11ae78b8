#pragma once
#include <optional>
#include <string>

#include "compiler/base/diagnostic.h"
#include "compiler/notation/orbifold.h"

namespace orbc::scene {

/// A notation as it stands in a scene: the orbifold, if it is one that has a room, and what its author should know.
struct OrbifoldOf {
  std::optional<notation::Orbifold> orbifold;
  Diagnostics diagnostics;
};
[[nodiscard]] OrbifoldOf orbifold_of(const std::string& text, bool allow_non_orbifold, const SourceSpan& span);

}  // namespace orbc::scene
