#pragma once
#include <vector>

#include "compiler/base/rational.h"
#include "compiler/room/glued_polygon.h"

namespace orbc::room {

struct CountLimits {
  std::size_t elements = 200'000;  ///< that are enumerated
  std::size_t states = 4000;       ///< of the automaton
};

/// How many elements of the group of a polygon have each word length, from 0 to max_length: words in the crossings of its sides.
/// Makes: the counts of a finite group end with its longest element. Others are counted by the automaton of ShortLex normal forms, whose
///        word differences are the elements that share corners with the polygon (Epstein et al., Word Processing in Groups, chapter 2.5),
///        if it agrees with an enumeration up to half of the longest relator or further; else as far as the enumeration reaches.
/// Error: elements are told apart in double precision; the enumeration ends where that could fail.
[[nodiscard]] std::vector<Integer> elements_per_length(const GluedPolygon& polygon, int max_length, const CountLimits& limits = {});

}  // namespace orbc::room
