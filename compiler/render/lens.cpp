// Thin lens along geodesics: a lens maps the rays of a point of the picture to rays that meet in one point (Kolb, Mitchell, Hanrahan, A
// realistic camera model for computer graphics, 1995, §2, there with a plane in focus; here the sphere at the focus distance is in
// focus, since planes have no meaning in curved space). Lens and focus are given in geodesic polar coordinates about the eye, in its frame.
#include "compiler/render/lens.h"

#include <cmath>
#include <numbers>

#include "compiler/base/check.h"
#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "compiler/surface/sampling.h"

namespace orbc::render {

using geometry::Point;
using geometry::Vector3;

trace::Ray lens_ray(const place::Camera& eye, double x, double y, const std::array<double, 2>& on_lens) {
  ORBC_CHECK(eye.lens.has_value(), ==, true);
  const geometry::Space space = eye.room_from_eye.space;
  const Vector3 d = place::direction_through(eye, x, y), there = eye.lens->focus_distance * d;
  const Vector3 here = eye.lens->radius * (on_lens[0] * eye.right + on_lens[1] * eye.up);
  const Point from = geometry::point_from_log(space, {here.x, here.y}), to = geometry::point_from_log(space, {there.x, there.y});
  const double run = geometry::distance(space, from, to);
  trace::Direction direction{{0, 0, 0}, there.z - here.z};
  if (run > 0) direction.floor = run * (eye.room_from_eye * geometry::direction_to(space, from, to));
  return trace::ray_from(space, {eye.room_from_eye * from, eye.z + here.z}, direction);
}

std::array<double, 2> lens_point(std::uint64_t seed, std::uint64_t pixel, int k) {
  constexpr std::uint64_t kLensStream = 0x6c656e73;  // random numbers that nothing else of the pixel uses
  surface::Random random(seed, pixel, kLensStream);
  const auto at = surface::r3_point(k, random.next_three());
  // Maps the square onto the disk and keeps areas (Shirley, Chiu, A low distortion map between disk and square, 1997).
  const double a = 2 * at[0] - 1, b = 2 * at[1] - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool flat = std::fabs(a) > std::fabs(b);
  const double r = flat ? a : b, angle = flat ? std::numbers::pi / 4 * (b / a) : std::numbers::pi / 2 - std::numbers::pi / 4 * (a / b);
  return {r * math::cos(angle), r * math::sin(angle)};
}

}  // namespace orbc::render
