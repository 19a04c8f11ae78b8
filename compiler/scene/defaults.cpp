#include "compiler/scene/defaults.h"

#include "compiler/notation/euler.h"
#include "compiler/notation/growth.h"
#include "compiler/scene/check.h"

#include <algorithm>

namespace orbc::scene {

int wall_count(const notation::Orbifold& orbifold) {
  return orbifold.strip ? 4 : std::max<int>(1, static_cast<int>(orbifold.corners.size()));
}

int corner_count(const notation::Orbifold& orbifold) { return orbifold.strip ? 4 : static_cast<int>(orbifold.corners.size()); }

Surface default_floor() {
  Surface floor;
  floor.material.pattern = Pattern::checker;
  floor.material.color = from_hex(0xF2EBDD);   // ivory and slate, light enough to show the tints of mirrors
  floor.material.second = from_hex(0x6E7F91);
  return floor;
}

Surface default_ceiling() {
  Surface ceiling;
  ceiling.material.color = from_hex(0xE6ECF2);
  return ceiling;
}

bool is_end_wall(const notation::Orbifold& orbifold, int number) {
  return orbifold.strip && (notation::is_half_strip(orbifold) ? number == 3 : number % 2 == 0);
}

Wall default_wall(bool is_end) {
  Wall wall;
  wall.material.color = from_hex(0xC9B8A0);
  if (!is_end) wall.mirrors.emplace_back();
  return wall;
}

Frame default_frame() {
  Frame frame;
  frame.material.color = from_hex(0xB8862F);
  return frame;
}

namespace {

constexpr int kMinDefaultBounces = 12;               // bounces
constexpr int kMaxDefaultCopiesHyperbolic = 200;
constexpr int kMaxDefaultCopiesSpherical = 1000;   // more than the largest group with three corners below *22(250) has

/// The largest number of bounces, at least 1, that gives at most `max_copies` copies.
/// In: the number of copies by word length; the number of mirrors among floor and ceiling.
int bounces_within(const std::vector<Integer>& copies, int horizontal_mirrors, const Integer& max_copies) {
  // The number of vertical images that are n reflections away.
  const auto vertical_images = [&](std::size_t n) {
    return n == 0 ? 1 : horizontal_mirrors == 2 ? 2 : horizontal_mirrors == 1 && n == 1 ? 1 : 0;
  };
  Integer sum = 1;
  int bounces = 0;
  for (std::size_t n = 1; n < copies.size(); ++n) {
    for (std::size_t walls = 0; walls <= n; ++walls) sum += vertical_images(n - walls) * copies[walls];
    if (sum > max_copies) break;
    bounces = static_cast<int>(n);
  }
  return std::max(1, bounces);
}

/// The orbifold whose corners are rounded up to integers; it has more copies.
notation::Orbifold rounded_up(const notation::Orbifold& orbifold) {
  notation::Orbifold whole = orbifold;
  for (Rational& corner : whole.corners) corner = Rational(Integer((numerator(corner) + denominator(corner) - 1) / denominator(corner)));
  return whole;
}

}  // namespace

int default_max_bounces(const notation::Orbifold& orbifold, int horizontal_mirrors) {
  constexpr int kMaxBouncesHyperbolic = 64;   // *237, whose copies grow most slowly, has 198 at 11
  const int sign = curvature_sign(orbifold);
  if (sign < 0)
    return bounces_within(notation::copies_per_length(rounded_up(orbifold), kMaxBouncesHyperbolic), horizontal_mirrors,
                          kMaxDefaultCopiesHyperbolic);
  if (sign == 0 || !notation::is_orbifold(orbifold)) return kMinDefaultBounces;
  const int whole = notation::longest_length(orbifold).value();
  if (whole <= kMinDefaultBounces || *notation::group_order(orbifold) <= kMaxDefaultCopiesSpherical)
    return std::max(kMinDefaultBounces, whole);
  return bounces_within(notation::copies_per_length(orbifold, kMaxDefaultCopiesSpherical), 0, kMaxDefaultCopiesSpherical);
}

Scene default_scene(const notation::Orbifold& orbifold) {
  Scene scene;
  scene.orbifold = orbifold;
  scene.cover.max_bounces = default_max_bounces(orbifold);
  scene.room.floor = default_floor();
  scene.room.ceiling = default_ceiling();
  for (int i = 1; i <= wall_count(orbifold); ++i) scene.room.walls.push_back(default_wall(is_end_wall(orbifold, i)));
  scene.camera.look_at.value = LookDirection{};
  return scene;
}

}  // namespace orbc::scene
