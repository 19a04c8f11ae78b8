// The unfolding of light: a path from a surface point over mirrors to the lamp is a straight geodesic to the lamp's image. Plain walls bar
// a letter altogether for the reason given at cover::walk_reach. Images are many more than matter: in H² their number grows like e^L, and
// each gives e^-L. So copies come as a stream, and of each only what can be seen somewhere in the room is kept.
#include "compiler/light/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "compiler/base/elementary.h"
#include "compiler/cover/enumerate.h"
#include "compiler/cover/reach.h"
#include "compiler/light/falloff.h"
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

/// Is told of every copy; false: no more.
using TakeCopy = std::function<bool(const FloorCopy&)>;

void group_copies(const place::PlacedRoom& room, const Mirrors& mirrors, int bounces, const TakeCopy& take) {
  std::vector<int> wall;
  for (std::size_t i = 0; i < room.room.walls.size(); ++i)
    if (room.room.walls[i].reflects) wall.push_back(static_cast<int>(i));
  std::vector<Isometry> reflections;
  bool all_open = true;
  for (const int w : wall) {
    reflections.push_back(room::reflection_in_wall(room.room, w));
    all_open = all_open && mirrors.wall[static_cast<std::size_t>(w)];
  }
  const bool around = room.room.space == Space::spherical && all_open;
  const int half_turn = around ? notation::longest_length(room.room.orbifold).value() : 0;
  const cover::Automaton automaton(room.room.orbifold, std::max(1, bounces));
  cover::enumerate(automaton, reflections, bounces, [&](const cover::Element& element, const Isometry& cover_from_room) {
    const int length = static_cast<int>(element.word.size());
    if (length > 0 && !mirrors.wall[static_cast<std::size_t>(wall[element.word.back()])]) return cover::Walk::back;
    if (!take({cover_from_room, length, 0, {}, false})) return cover::Walk::stop;
    for (int sheet = 1; around && sheet * half_turn <= bounces; ++sheet) {
      const int more = sheet % 2 == 0 ? sheet * half_turn + length : (sheet + 1) * half_turn - length;
      if (more <= bounces && !take({cover_from_room, more, sheet, {}, false})) return cover::Walk::stop;
    }
    return cover::Walk::deeper;
  });
}

// Words of mirrors without repeats side by side, from `at` on.
bool word_copies(const place::PlacedRoom& room, const Mirrors& mirrors, int bounces, const FloorCopy& at, const TakeCopy& take) {
  if (!take(at)) return false;
  if (at.bounces == bounces) return true;
  for (std::size_t w = 0; w < mirrors.wall.size(); ++w) {
    if (!mirrors.wall[w] || (!at.walls.empty() && at.walls.back() == static_cast<std::int16_t>(w))) continue;
    FloorCopy next = at;
    next.cover_from_room = geometry::renormalised(next.cover_from_room * room::reflection_in_wall(room.room, static_cast<int>(w)));
    next.walls.push_back(static_cast<std::int16_t>(w));
    ++next.bounces;
    if (!word_copies(room, mirrors, bounces, next, take)) return false;
  }
  return true;
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

/// The room as a ball: no point of it is farther from its centre.
double reach_of(const room::Room& room) {
  double reach = 0;
  for (const geometry::Point& p : room.outline) reach = std::max(reach, geometry::distance(room.space, {}, p));
  return reach;
}

class Collector {
 public:
  Collector(const std::vector<HungLamp>& lamps, const place::PlacedRoom& room, const ImageOptions& options)
      : lamps_(lamps), room_(room), options_(options), mirrors_(mirrors_of(room)), reach_(reach_of(room.room)) {}

  /// Nothing when they are too many.
  std::optional<std::vector<LampImage>> images(int bounces) const {
    const std::vector<Storey> levels = storeys(mirrors_, room_.height, bounces);
    std::vector<LampImage> images;
    std::uint64_t considered = 0;
    bool all = true;
    const auto take = [&](const FloorCopy& copy) {
      for (std::size_t l = 0; l < lamps_.size(); ++l)
        for (const Storey& storey : levels) {
          if (copy.bounces + storey.bounces > bounces) continue;
          if (++considered > kMostConsidered || images.size() > kMostImages) return all = false;
          if (matters(lamps_[l], copy, storey)) images.push_back(image(static_cast<int>(l), copy, storey));
        }
      return true;
    };
    if (is_orbifold(room_)) group_copies(room_, mirrors_, bounces, take);
    else word_copies(room_, mirrors_, bounces, {geometry::identity(room_.room.space), 0, 0, {}, true}, take);
    if (!all || images.size() > kMostImages) return std::nullopt;
    return images;
  }

 private:
  double weight_of(const FloorCopy& copy, const Storey& storey) const { return math::pow(mirrors_.best, copy.bounces + storey.bounces); }

  // Whether any point of the room could get as much as the cut. On S² light grows again with distance, and images are few.
  bool matters(const HungLamp& lamp, const FloorCopy& copy, const Storey& storey) const {
    const Space space = room_.room.space;
    if (options_.cut <= 0 || space == Space::spherical) return true;
    const double arc = std::max(0.0, geometry::distance(space, {}, copy.cover_from_room * lamp.centre.floor) - reach_);
    const double z = storey.sign * lamp.centre.z + storey.shift, rise = std::max({0.0, -z, z - room_.height});
    return at_most(space, lamp, weight_of(copy, storey), options_.exposure, math::hypot(arc, rise), arc) >= options_.cut;
  }

  LampImage image(int l, const FloorCopy& copy, const Storey& storey) const {
    const HungLamp& lamp = lamps_[static_cast<std::size_t>(l)];
    LampImage image;
    image.bounces = copy.bounces + storey.bounces;
    image.lamp = l, image.sheet = copy.sheet, image.walls = copy.walls, image.exact = copy.exact;
    image.weight = weight_of(copy, storey);
    for (std::size_t i = 0; i < lamp.samples.size(); ++i) {
      const Position& p = lamp.samples[i];
      image.samples.push_back({copy.cover_from_room * p.floor, storey.sign * p.z + storey.shift});
      image.axes.push_back(image_of(copy.cover_from_room, storey, lamp.axes[i]));
    }
    image.feet = lamp.feet;
    for (Foot& foot : image.feet) foot.at = {copy.cover_from_room * foot.at.floor, storey.sign * foot.at.z + storey.shift};
    return image;
  }

  const std::vector<HungLamp>& lamps_;
  const place::PlacedRoom& room_;
  const ImageOptions& options_;
  Mirrors mirrors_;
  double reach_ = 0;
};

}  // namespace

double at_most(Space space, const HungLamp& lamp, double weight, double exposure, double length, double arc) {
  return largest(lamp.power) / std::numbers::pi * exposure * weight * lamp.gain *
         falloff(lamp.falloff, space, std::max(length - lamp.extent, lamp.radius), arc, lamp.radius);
}

Result<std::vector<LampImage>> lamp_images(const std::vector<HungLamp>& lamps, const place::PlacedRoom& room, const ImageOptions& options) {
  const Collector collector(lamps, room, options);
  if (auto images = collector.images(options.bounces)) return std::move(*images);
  int fits = -1;
  while (fits + 1 < options.bounces && collector.images(fits + 1)) ++fits;
  return make_error(
      "light.too-many-images",
      fmt::format(
          "over {} mirrors {} lamp{} of this scene {} too many images: more than {} would add light, or {} would have to be looked at",
          options.bounces, lamps.size(), lamps.size() == 1 ? "" : "s", lamps.size() == 1 ? "has" : "have", kMostImages, kMostConsidered),
      fits >= 0 ? fmt::format("`bake: {{mirrors: {}}}` has few enough", fits) : "use fewer lamps");
}

}  // namespace orbc::light
