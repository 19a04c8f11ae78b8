#include "compiler/notation/parse.h"
#include "compiler/scene/parsed_notation.h"

namespace orbc::scene {

ParsedNotation parse_notation(const std::string& text, bool allow_non_orbifold, const SourceSpan& span) {
  notation::ParseOptions options;
  options.span = span;
  options.allow_non_orbifold = allow_non_orbifold;
  Result<notation::Parsed> parsed = notation::parse_with_notes(text, options);
  if (!parsed) return {std::nullopt, located(std::move(parsed).error(), span)};
  return {std::move(parsed->orbifold), located(std::move(parsed->notes), span)};
}

}  // namespace orbc::scene
