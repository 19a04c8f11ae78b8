#include "compiler/notation/parse.h"
#include "compiler/scene/orbifold_of.h"

namespace orbc::scene {

OrbifoldOf orbifold_of(const std::string& text, bool allow_non_orbifold, const SourceSpan& span) {
  notation::ParseOptions options;
  options.span = span;
  options.allow_non_orbifold = allow_non_orbifold;
  Result<notation::Parsed> parsed = notation::parse_with_notes(text, options);
  if (!parsed) return {std::nullopt, located(std::move(parsed).error(), span)};
  return {std::move(parsed->orbifold), located(std::move(parsed->notes), span)};
}

}  // namespace orbc::scene
