#include "compiler/bake/shiny_parts.h"

#include <algorithm>
#include <cmath>

#include "compiler/base/elementary.h"

namespace orbc::bake {
namespace {

constexpr double kSmallestShiny = 3;    // pixels: highlights of smaller things are left out
constexpr double kSmallestGlass = 0.5;  // but glass, mirrors and metals are nothing without what is seen in them

Ball ball_of(geometry::Space space, const place::PlacedMesh& part) {
  geometry::Ambient sum{0, 0, 0};
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < part.floor.size(); ++i)
    sum = sum + part.floor[i], low = std::min(low, part.z[i]), high = std::max(high, part.z[i]);
  Ball ball{{geometry::normalised_point(space, sum), (low + high) / 2}, 0};
  for (std::size_t i = 0; i < part.floor.size(); ++i)
    ball.radius =
        std::max(ball.radius, math::hypot(geometry::distance(space, ball.centre.floor, part.floor[i]), part.z[i] - ball.centre.z));
  return ball;
}

}  // namespace

bool shines(const scene::Material& material) { return material.kind == scene::MaterialKind::glossy; }

std::vector<ShinyPart> shiny_parts(const place::PlacedRoom& room, const light::LightingContext& lighting, const DrawnParts& drawn,
                                   bool seen_in) {
  const auto own_light = [&](const scene::Material& m) { return shines(m) || (seen_in && shows_room(m, lighting.lit)); };
  std::vector<ShinyPart> parts;
  const std::size_t count = drawn.models.empty() ? std::min(room.parts.size(), lighting.normals.size()) : room.parts.size();
  for (std::size_t p = 0; p < count; ++p) {
    const place::PlacedMesh& mesh = room.parts[p];
    if (std::none_of(mesh.look.begin(), mesh.look.end(), [&](std::uint16_t look) { return own_light(room.looks[look].material); }))
      continue;
    ShinyPart part{p, ball_of(room.room.space, mesh), kSmallestShiny, {}, {}};
    const auto glassy = [&](std::uint16_t look) { return seen_in && shows_room(room.looks[look].material, lighting.lit); };
    if (std::any_of(mesh.look.begin(), mesh.look.end(), glassy)) part.smallest_px = kSmallestGlass;
    for (const auto& model : drawn.models) part.in_model.push_back(std::find(model.begin(), model.end(), p) != model.end());
    if (p >= lighting.normals.size()) part.own = surface::part_normals(room, mesh);
    parts.push_back(std::move(part));
  }
  return parts;
}

bool needs_highlights(const place::PlacedRoom& room, const light::LightingContext& lighting) {
  if (shows_room(room, lighting.lit)) return true;
  if (!lighting.lit || lighting.images.empty()) return false;
  return std::any_of(room.looks.begin(), room.looks.end(), [](const place::Look& look) { return shines(look.material); });
}

}  // namespace orbc::bake
