#pragma once
#include <string>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/room/room.h"
#include "compiler/scene/scene.h"

namespace orbc::room {

/// The facts that `orbc info` prints about a room. Lengths in curvature radii (E²: scene units), angles in radians.
struct Summary {
  std::vector<double> sides;   ///< length of wall 1, 2, …
  std::vector<double> angles;  ///< interior angle of corner 1, 2, …
  double inradius = 0;         ///< 0 when no circle touches all walls
  double circumradius = 0;
  double area = 0;
  int moduli = 0;                         ///< number of free lengths of rooms with these corners; E²: besides `scale`
  std::vector<std::string> moduli_names;  ///< one for each: "cut of walls 2 and 5" of the paper's forward reading, "aspect"
  Certificate certificate;
  bool certified = true;        ///< false: the room is too wide for doubles; these numbers are right, but the room cannot be drawn
  int translational_cover = 0;  ///< E² orbifolds: rooms in a smallest cover that is a torus (4, 6, 8, 12); else 0
};

[[nodiscard]] Summary summarise(const Room& room);

/// The same from the orbifold: sides, angles and area are computed in 50 digits, also for rooms that are too wide for doubles.
/// Diagnostics: those of realise, but for room.no-certificate where the summary says `certified = false`.
[[nodiscard]] Result<Summary> summarise(const notation::Orbifold& orbifold, const scene::Shape& shape = {},
                                        bool allow_non_orbifold = false);

}  // namespace orbc::room
