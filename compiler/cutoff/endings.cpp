#include "compiler/cutoff/endings.h"

#include <utility>

#include "compiler/bend/screen_size.h"
#include "compiler/cover/projected_size.h"

namespace orbc::cutoff {
namespace {

constexpr double kSizeSlack = 1e-6;  // relative

}  // namespace

CullTest cull_below(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec, double cull_px) {
  if (!(spec.min_pixels > 0) && !(cull_px > 0)) return {};
  const bend::BoundingCylinder whole{{}, room.polygon.circumradius, 0, room.height};
  return [spec, cull_px, whole, size = cover::ProjectedSize(room, eye), detail = bend::ScreenSize(eye, {})](const cover::Copy& copy) {
    if (copy.bounces == 0) return false;
    if (spec.min_pixels > 0 && cover::is_culled(size.of(copy.cover_from_room), spec, kSizeSlack)) return true;
    return cull_px > 0 && detail.smaller_side_px(copy, whole) < cull_px * (1 + kSizeSlack);
  };
}

Endings::Endings(const place::Interior& room, const scene::CoverSpec& spec, CullTest is_culled)
    : room_(room), spec_(spec), is_culled_(std::move(is_culled)) {
  for (const place::PlacedMirror& mirror : room.mirrors)
    reflections_.push_back(mirror.wall < 0 ? geometry::identity(room.polygon.space) : room::reflection_in_wall(room.polygon, mirror.wall));
}

std::vector<Ending> Endings::of(const cover::Copy& copy) const {
  std::vector<Ending> endings(room_.mirrors.size(), Ending::none);
  for (std::size_t i = 0; i < endings.size(); ++i) {
    const place::PlacedMirror& mirror = room_.mirrors[i];
    const bool last = copy.bounces >= spec_.max_bounces || max_channel(mirror.throughput * copy.weight) < spec_.min_weight;
    if (mirror.wall < 0) {
      // Storeys above the room are seen from below: through their ceiling, or through their floor where they are upside down.
      const int up = mirror.wall == -2 ? 1 : -1, direction = copy.storey.sign > 0 ? up : -up;
      if (last && copy.storey.number * direction >= 0) endings[i] = Ending::depth;
      continue;
    }
    if (last) {
      endings[i] = Ending::depth;
    } else if (is_culled_ && !cover::faces_eye(copy, mirror.wall)) {
      cover::Copy next;
      next.cover_from_room = copy.cover_from_room * reflections_[i];
      next.bounces = copy.bounces + 1;
      next.sheet = copy.sheet;
      next.storey = copy.storey;
      if (is_culled_(next)) endings[i] = Ending::size;
    }
  }
  return endings;
}

}  // namespace orbc::cutoff
