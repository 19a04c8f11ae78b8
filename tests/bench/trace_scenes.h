#pragma once
// The rooms of the benchmarks: right-angled corners and equal size in the three spaces, a torus knot tube in the middle, and a camera's
// rays.
#include <string>
#include <vector>

#include "tests/unit/trace/support.h"

namespace orbc::trace::bench {

using namespace testing;

struct Case {
  std::string name;
  place::Interior placed;
  TraceScene scene;
  std::vector<Ray> rays;            ///< 800 × 600, in tiles of 16 × 16 as pictures are drawn
};

inline std::vector<Ray> camera_rays(geometry::Space space, int width, int height) {
  // Half a unit from the centre, at half height, looking at it with 75°.
  const auto room_from_eye = geometry::translation_by(space, -0.5 * std::cos(0.7), -0.5 * std::sin(0.7)) * geometry::rotation(space, 0.7);
  const double half = std::tan(75 * kPi / 360);
  const geometry::Point eye = room_from_eye * geometry::Point();
  std::vector<Ray> rays;
  constexpr int kTile = 16;
  for (int tile = 0; tile < (height + kTile - 1) / kTile * (width / kTile); ++tile)
    for (int i = 0; i < kTile * kTile; ++i) {
      const int x = tile % (width / kTile) * kTile + i % kTile, y = tile / (width / kTile) * kTile + i / kTile;
      if (y >= height) continue;
      const double u = (2 * (x + 0.5) / width - 1) * half, v = (1 - 2 * (y + 0.5) / height) * half * height / width;
      rays.push_back(ray_from(space, {eye, 0.5}, {room_from_eye * geometry::Tangent(0, 1, -u), v}));
    }
  return rays;
}

/// In: curvature by `space`; the knot has 2·steps·around triangles.
inline Case make_case(geometry::Space space, int steps, int around, const Executor& execute = serial_executor()) {
  using geometry::Space;
  Case c;
  c.name = space == Space::spherical ? "S2" : space == Space::euclidean ? "E2" : "H2";
  room::Room room = space == Space::spherical   ? regular_room(space, 3, 2)
                    : space == Space::euclidean ? regular_room(space, 4, 2, 0.62 * std::numbers::sqrt2)
                                                : regular_room(space, 5, 2);
  c.placed = furnished(std::move(room), 1, 0.9);
  c.placed.parts.push_back(torus_knot(space, {}, 0.21, 0.065, 0.5, steps, around));
  c.placed.styles.resize(1);
  c.rays = camera_rays(space, 800, 600);
  (void)execute;
  return c;
}

}  // namespace orbc::trace::bench
