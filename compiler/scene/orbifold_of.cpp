// Stand-in until the notation room is there.
#include "compiler/scene/orbifold_of.h"

#include <cctype>

namespace orbc::scene {

OrbifoldOf orbifold_of(const std::string& text, bool allow_non_orbifold, const SourceSpan& span) {
  OrbifoldOf made;
  const auto refuse = [&](const char* code) {
    made.diagnostics.push_back(make_error(code, "bad notation", "", span));
    return made;
  };
  if (text == "**") return {notation::Orbifold{{}, true}, {}};
  if (text.empty() || text[0] != '*') return refuse("notation.not-kaleidoscopic");
  notation::Orbifold orbifold;
  bool whole = true;
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == ' ' || text[i] == ',') continue;
    if (std::isdigit(static_cast<unsigned char>(text[i]))) {
      orbifold.corners.emplace_back(text[i] - '0');
    } else if (text[i] == '(') {
      const std::size_t end = text.find(')', i);
      if (end == std::string::npos || end == i + 1) return refuse("notation.bad-syntax");
      const std::string inside = text.substr(i + 1, end - i - 1);
      if (inside.find_first_not_of("0123456789/") != std::string::npos || inside.back() == '/' || inside.front() == '/' || inside.front() == '0') return refuse("notation.bad-syntax");
      orbifold.corners.emplace_back(inside);
      whole = whole && inside.find('/') == std::string::npos;
      i = end;
    } else {
      return refuse("notation.bad-syntax");
    }
    if (orbifold.corners.back() == 0) return refuse("notation.bad-corner");
    if (orbifold.corners.back() == 1) orbifold.corners.pop_back(), made.diagnostics.push_back(make_note("notation.dropped-corner", "corner of order 1", "", span));
  }
  if (!whole && !allow_non_orbifold) return refuse("notation.not-an-orbifold");
  const auto& k = orbifold.corners;
  if (k.size() == 1 || (k.size() == 2 && k[0] != k[1])) return refuse("notation.bad-orbifold");
  made.orbifold = std::move(orbifold);
  return made;
}

}  // namespace orbc::scene
