#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/cover/automaton.h"
#include "compiler/cover/copy.h"
#include "compiler/place/interior.h"

namespace orbc::cover {

/// A copy as one beam (beam.h) reaches it.
struct BeamHit {
  Word word;  ///< orbifolds: letters of the normal form; other rooms: the walls on the path
  int bounces = 0, sheet = 0;
  std::vector<std::uint16_t> crossings;  ///< by index into Boundary::throughputs: mirrors of this throughput on the path
  Wedge wedge;
  geometry::Isometry cover_from_room;
  std::uint64_t eye_facing_walls = 0;  ///< of rooms that are no orbifolds
  std::vector<HeightBound> height_bounds;
};

/// The reflections of a room; of an orbifold also its automaton.
struct Reflections {
  std::vector<geometry::Isometry> in_wall;
  std::optional<Automaton> automaton;  ///< of orbifolds
  std::vector<int> letter_of_wall;     ///< orbifolds: letter of the automaton, −1 for end walls of strips
  std::vector<int> wall_of_letter;
};
/// In: the length of the longest word that the automaton must know.
[[nodiscard]] Reflections reflections_of(const place::Interior& room, int max_length);

/// The isometry of a group element. Exact: it depends on the normal form alone, so that all copies of an element fit together bit by bit.
/// In: a word in letters of the automaton.
[[nodiscard]] geometry::Isometry isometry_of(const Reflections& reflections, const Word& word);

/// The product of the throughputs of all crossings. Exact: it does not depend on the order of the mirrors on the path.
[[nodiscard]] scene::Color weight_of(const std::vector<std::uint16_t>& crossings, const std::vector<scene::Color>& throughputs);

/// The copies that beams have reached, without the room itself.
/// In:    `all_found`: no beam was left out for its weight, so an element that was reached with one weight is visible as a whole.
/// Makes: copies as unfold_by_beams promises.
[[nodiscard]] std::vector<Copy> copies_of(std::vector<BeamHit> hits, const Reflections& reflections,
                                          const std::vector<scene::Color>& throughputs, bool all_found);

}  // namespace orbc::cover
