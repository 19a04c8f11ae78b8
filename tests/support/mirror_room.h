#pragma once
#include <catch2/catch.hpp>
#include <string>

#include "compiler/notation/parse.h"
#include "compiler/place/interior.h"
#include "compiler/room/realise.h"

namespace orbc::test {

/// A room of height 1, each wall that reflects one whole mirror of reflectance 0.9. `real`: corners may be real numbers.
inline place::Interior mirror_room(const std::string& text, bool real = false) {
  const auto orbifold = notation::parse(text, {{}, real});
  REQUIRE(orbifold);
  auto room = room::realise(*orbifold, {}, real);
  if (!room) FAIL(text + ": " + to_text(room.error()));
  place::Interior placed;
  placed.polygon = std::move(room).value();
  for (std::size_t i = 0; i < placed.polygon.walls.size(); ++i) {
    if (placed.polygon.walls[i].reflects)
      placed.mirrors.push_back({static_cast<int>(i), {0, placed.polygon.walls[i].length}, {0, 1}, {0.9, 0.9, 0.9}});
  }
  return placed;
}

}  // namespace orbc::test
