#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/bend/screen_size.h"
#include "compiler/cover/copy.h"
#include "compiler/place/interior.h"

namespace orbc::driver {

/// A coarser stand-in of a part of the room. Its vertices are vertices of the part.
struct Level {
  place::PlacedMesh mesh;
  /// Largest distance found between the two surfaces, both ways, and between their borders and the borders of their looks: intrinsic length
  double error = 0;
};

/// Stand-ins per part, coarser and coarser; none of parts that are light already, and of those with pictures, which would be shifted.
using Levels = std::vector<std::vector<Level>>;

/// Simplifies the heavy objects of a room, once for all copies.
/// Makes: levels of about 2/5 of the triangles of the one before.
/// Error: measured at points a few triangles' edges of the part apart (levels.cpp).
[[nodiscard]] Levels make_levels(const place::Interior& room, const Executor& executor);

/// Which level of each part a copy is drawn from (0 = the part itself); copies with the same choice share it.
struct Choice {
  std::vector<std::vector<std::uint16_t>> models;  ///< distinct ones; at least one
  std::vector<std::uint32_t> model_of_copy;
  double error_px = 0;                             ///< bound of what the coarser levels displace in the picture
};

/// For each copy and part the coarsest level that is displaced by at most the tolerance of `options`.
[[nodiscard]] Choice choose_levels(const place::Interior& room, const Levels& levels, const std::vector<cover::Copy>& copies,
                                   const place::Camera& eye, const bend::BendOptions& options);
/// Every copy whole.
[[nodiscard]] Choice no_levels(const place::Interior& room, std::size_t copies);

/// A stand-in of the room for questions about all of it at once: each part at its coarsest level within `error` (intrinsic length), without
/// pictures.
[[nodiscard]] place::Interior rough(const place::Interior& room, const Levels& levels, double error);

/// What a choice comes to, before bending.
struct LevelTally {
  std::vector<int> level_of_copy;   ///< the coarsest of its parts
  std::uint64_t saved = 0;          ///< triangles
  std::uint64_t triangles = 0;      ///< of all copies
};
[[nodiscard]] LevelTally tally(const place::Interior& room, const Levels& levels, const Choice& choice);

/// The room with the levels that a choice uses as further parts, to be given colours all at once.
struct Stock {
  place::Interior room;                                 ///< the parts of the room come first
  std::vector<std::vector<std::uint32_t>> part_of_level;  ///< [part][level]: index in `room.parts`
  std::vector<double> beside;                             ///< per part of `room`: Level::error, 0 of the parts themselves
};
[[nodiscard]] Stock stock_of(const place::Interior& room, const Levels& levels, const Choice& choice);

}  // namespace orbc::driver
