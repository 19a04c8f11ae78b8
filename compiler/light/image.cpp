// The unfolding of light: a path from a surface point over mirrors to the lamp is a straight geodesic to the lamp's image. Plain walls bar
//                         a letter altogether for
// the reason given at cover::walk_reach.
#include "compiler/light/image.h"

#include <algorithm>
#include <cmath>

#include "compiler/cover/enumerate.h"
#include "compiler/cover/reach.h"
#include "compiler/notation/growth.h"
#include "compiler/room/room.h"

namespace orbc::light {
namespace {

using geometry::Isometry;
using geometry::Position;
using geometry::Space;

/// A copy of the floor, reached over walls.
struct FloorCopy {
  Isometry cover_from_room;
  int bounces = 0, sheet = 0;
  std::vector<std::int16_t> walls;
  bool exact = false;
};
/// z ↦ sign·z + shift after some mirrors on floor and ceiling.
struct Storey {
  double sign = 1, shift = 0;
  int bounces = 0;
};

struct Mirrors {
  std::vector<bool> wall;           ///< has a mirror
  bool floor = false, ceiling = false;
  double best = 0;                  ///< the largest channel of any mirror
};

Mirrors mirrors_of(const place::PlacedRoom& room) {
  Mirrors mirrors;
  mirrors.wall.assign(room.room.walls.size(), false);
  for (const place::PlacedMirror& m : room.mirrors) {
    if (m.wall >= 0) mirrors.wall[static_cast<std::size_t>(m.wall)] = true;
    else (m.wall == -1 ? mirrors.floor : mirrors.ceiling) = true;
    mirrors.best = std::max({mirrors.best, m.reflectance * m.tint.r, m.reflectance * m.tint.g, m.reflectance * m.tint.b});
  }
  return mirrors;
}

std::vector<FloorCopy> group_copies(const place::PlacedRoom& room, const Mirrors& mirrors, int bounces) {
  std::vector<int> wall;
  if (room.room.orbifold.strip) wall = {0, 2};
  else for (std::size_t i = 0; i < room.room.walls.size(); ++i) wall.push_back(static_cast<int>(i));
  std::vector<Isometry> reflections;
  bool all_open = true;
  for (const int w : wall) {
    reflections.push_back(room::reflection_in_wall(room.room, w));
    all_open = all_open && mirrors.wall[static_cast<std::size_t>(w)];
  }
  const bool around = room.room.space == Space::spherical && all_open;
  const int half_turn = around ? notation::longest_length(room.room.orbifold).value() : 0;
  std::vector<FloorCopy> copies;
  const cover::Automaton automaton(room.room.orbifold, std::max(1, bounces));
  cover::enumerate(automaton, reflections, bounces, [&](const cover::Element& element, const Isometry& cover_from_room) {
    const int length = static_cast<int>(element.word.size());
    if (length > 0 && !mirrors.wall[static_cast<std::size_t>(wall[element.word.back()])]) return false;
    copies.push_back({cover_from_room, length, 0, {}, false});
    for (int sheet = 1; around && sheet * half_turn <= bounces; ++sheet) {
      const int more = sheet % 2 == 0 ? sheet * half_turn + length : (sheet + 1) * half_turn - length;
      if (more <= bounces) copies.push_back({cover_from_room, more, sheet, {}, false});
    }
    return true;
  });
  return copies;
}

// Words of mirrors without repeats side by side.
std::vector<FloorCopy> word_copies(const place::PlacedRoom& room, const Mirrors& mirrors, int bounces) {
  std::vector<FloorCopy> copies{{geometry::identity(room.room.space), 0, 0, {}, true}};
  for (std::size_t i = 0; i < copies.size(); ++i) {
    if (copies[i].bounces == bounces) continue;
    for (std::size_t w = 0; w < mirrors.wall.size(); ++w) {
      if (!mirrors.wall[w] || (!copies[i].walls.empty() && copies[i].walls.back() == static_cast<std::int16_t>(w))) continue;
      FloorCopy next = copies[i];
      next.cover_from_room = geometry::renormalised(next.cover_from_room * room::reflection_in_wall(room.room, static_cast<int>(w)));
      next.walls.push_back(static_cast<std::int16_t>(w));
      ++next.bounces;
      copies.push_back(std::move(next));
    }
  }
  return copies;
}

std::vector<Storey> storeys(const Mirrors& mirrors, double height, int bounces) {
  std::vector<Storey> all{{}};
  for (const bool floor_first : {true, false}) {
    Storey at;
    bool floor = floor_first;
    for (int k = 1; k <= bounces && (floor ? mirrors.floor : mirrors.ceiling); ++k, floor = !floor) {
      // The mirror met k-th lies, in the cover, where the k−1 before it put it: conjugate, i.e. multiply from the right.
      const double shift = floor ? 0 : 2 * height;
      at = {-at.sign, at.sign * shift + at.shift, k};
      all.push_back(at);
    }
  }
  return all;
}

trace::Direction image_of(const Isometry& map, const Storey& storey, const trace::Direction& d) {
  const double k = geometry::curvature(map.space),
               h = std::sqrt(std::max(0.0, d.floor.x * d.floor.x + d.floor.y * d.floor.y + k * d.floor.w * d.floor.w));
  if (h < 1e-12) return {{0, 0, 0}, storey.sign * d.z};
  const geometry::Tangent t = map * geometry::Tangent(d.floor.w / h, d.floor.x / h, d.floor.y / h);
  return {h * t, storey.sign * d.z};
}

bool is_orbifold(const place::PlacedRoom& room) {
  return std::all_of(room.room.orbifold.corners.begin(), room.room.orbifold.corners.end(),
                     [](const Rational& k) { return denominator(k) == 1; });
}

}  // namespace

std::vector<LampImage> lamp_images(const std::vector<HungLamp>& lamps, const place::PlacedRoom& room, int bounces) {
  const Mirrors mirrors = mirrors_of(room);
  const std::vector<FloorCopy> copies = is_orbifold(room) ? group_copies(room, mirrors, bounces) : word_copies(room, mirrors, bounces);
  const std::vector<Storey> levels = storeys(mirrors, room.height, bounces);
  std::vector<LampImage> images;
  for (std::size_t l = 0; l < lamps.size(); ++l)
    for (const Storey& storey : levels)
      for (const FloorCopy& copy : copies) {
        LampImage image;
        image.bounces = copy.bounces + storey.bounces;
        if (image.bounces > bounces) continue;
        image.lamp = static_cast<int>(l), image.sheet = copy.sheet, image.walls = copy.walls, image.exact = copy.exact;
        image.weight = std::pow(mirrors.best, image.bounces);
        for (std::size_t i = 0; i < lamps[l].samples.size(); ++i) {
          const Position& p = lamps[l].samples[i];
          image.samples.push_back({copy.cover_from_room * p.floor, storey.sign * p.z + storey.shift});
          image.axes.push_back(image_of(copy.cover_from_room, storey, lamps[l].axes[i]));
        }
        image.feet = lamps[l].feet;
        for (Foot& foot : image.feet) foot.at = {copy.cover_from_room * foot.at.floor, storey.sign * foot.at.z + storey.shift};
        images.push_back(std::move(image));
      }
  return images;
}

}  // namespace orbc::light
