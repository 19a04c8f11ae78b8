#include "compiler/cli/isometries_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <nlohmann/json.hpp>

#include "compiler/cover/enumerate.h"
#include "compiler/geometry/chart.h"
#include "compiler/notation/growth.h"

namespace orbc::cli {
namespace {

std::string number(double value) { return nlohmann::json(value).dump(); }
std::string complex_json(std::complex<double> z) { return fmt::format("[{}, {}]", number(z.real()), number(z.imag())); }

/// The least word length up to which there are `count` copies, or all of them.
int length_for(const notation::Orbifold& orbifold, int count) {
  int length = 1;
  const auto longest = notation::longest_length(orbifold);
  while ((!longest || length < *longest) && notation::copies_up_to(orbifold, length) < count) ++length;
  return length;
}

}  // namespace

std::string corner_json(geometry::Space space, const geometry::Point& p) {
  return fmt::format("{{\"disk\": {}, \"ambient\": [{}, {}, {}]}}", complex_json(geometry::disk_from_point(space, p)), number(p.w),
                     number(p.x), number(p.y));
}

std::vector<cover::Copy> first_copies(const room::Room& room, int count) {
  std::vector<cover::Copy> copies;
  if (count < 1) return copies;
  std::vector<std::uint8_t> wall;
  for (std::size_t i = 0; i < room.walls.size(); ++i)
    if (room.walls[i].reflects) wall.push_back(static_cast<std::uint8_t>(i));
  const int length = length_for(room.orbifold, count);
  const cover::Automaton automaton(room.orbifold, length);
  cover::enumerate(automaton, room::generators(room), length,
                   [&](const cover::Element& element, const geometry::Isometry& cover_from_room) {
                     cover::Copy copy;
                     copy.cover_from_room = cover_from_room;
                     for (const std::uint8_t letter : element.word) copy.word.push_back(wall[letter]);
                     copies.push_back(std::move(copy));
                     return true;
                   });
  std::stable_sort(copies.begin(), copies.end(), [](const cover::Copy& a, const cover::Copy& b) { return a.word.size() < b.word.size(); });
  copies.resize(std::min(copies.size(), static_cast<std::size_t>(count)));
  return copies;
}

std::string copy_json(const cover::Copy& copy) {
  const geometry::Isometry& map = copy.cover_from_room;
  std::string word;
  for (const std::uint8_t wall : copy.word) word += (word.empty() ? "" : ", ") + std::to_string(wall + 1);
  std::string rows;
  for (const auto& row : geometry::matrix(map))
    rows += fmt::format("{}[{}, {}, {}]", rows.empty() ? "" : ", ", number(row[0]), number(row[1]), number(row[2]));
  const double k = geometry::curvature(map.space);
  return fmt::format(
      "\n    {{\"word\": [{}], \"reversing\": {}, \"moebius\": {{\"a\": {}, \"b\": {}, \"c\": {}, \"d\": {}}}, \"matrix\": [{}]}}", word,
      map.reversing, complex_json(map.a), complex_json(map.b), complex_json(-k * std::conj(map.b) + 0.0), complex_json(std::conj(map.a)),
      rows);
}

}  // namespace orbc::cli
