#pragma once
#include <string>
#include <vector>

namespace orbc::notation {

/// The features of a symbol of Conway's orbifold notation: wonder-rings, gyration points, mirror boundaries with their corners, cross-caps.
/// Order 0 stands for ∞.
struct ConwaySymbol {
  int handles = 0;
  std::vector<int> gyrations;
  std::vector<std::vector<int>> boundaries;
  int crosscaps = 0;
};

/// The usual name of its group: "the wallpaper group cmm", "the chiral icosahedral group", or "" where there is none.
/// Source: Conway, Huson, The orbifold notation for two-dimensional groups (2002); Conway, Burgiel, Goodman-Strauss, The symmetries of
/// things (2008).
[[nodiscard]] std::string usual_name(const ConwaySymbol& symbol);

/// The features that are not kaleidoscopic, as an object of "it has": "gyration points of order 2, 2 and a cross-cap".
[[nodiscard]] std::string features(const ConwaySymbol& symbol);

}  // namespace orbc::notation
