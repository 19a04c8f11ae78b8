#include "compiler/driver/unlit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "compiler/base/elementary.h"
#include "compiler/light/lamp.h"

namespace orbc::driver {
namespace {

// How far it is from the middle of the room to its walls, about. The strip has no inscribed circle: its mirrors lie `scale` away.
double reach(const Opened& opened) {
  const room::Room& room = opened.room->polygon;
  const double wide = room.inradius > 0 ? room.inradius : room.orbifold.strip ? opened.scene.room.shape.scale : room.circumradius / 2;
  return wide;
}

// Values as the hint writes them: to two digits.
double rounded(double value) {
  if (value <= 0) return 0;
  const double scale = math::pow(10.0, 1 - std::floor(math::log10(value)));
  return std::round(value * scale) / scale;
}

// What a lamp at height z over the middle must give to light floor and walls: at their foot its light is Φz/(4π(z²+ρ²)^(3/2)), where
// ρ measures how light spreads in this space, and the images in near walls add to it; but no more than 5 times white just below it.
// The factors are those for which pictures of rooms of all kinds come out right (measured).
double power_of(const Opened& opened, double z) {
  const double spread = geometry::sin_k(opened.room->polygon.space, reach(opened));
  const double slant = math::hypot(z, spread), steep = std::min(z / spread, 3.0);
  return std::min(28 * slant * slant * slant / (z * (1 + 1.5 * steep * steep)), 60 * z * z) / opened.scene.exposure;
}

bool hangs_freely(const Opened& opened, const scene::Lamp& lamp) {
  scene::Scene lit;
  lit.orbifold = opened.scene.orbifold, lit.room = opened.scene.room, lit.objects = opened.scene.objects, lit.lamps = {lamp};
  const auto hung = light::place_lamps(lit, opened.room->polygon);
  return hung.has_value() && hung->warnings.empty() && light::lamps_inside_objects(lit, *hung, *opened.room).empty();
}

// The first free place: the middle below the ceiling, else aside or lower. Nothing when the room is crammed.
std::optional<scene::Lamp> free_lamp(const Opened& opened) {
  const double height = opened.scene.room.height, near = reach(opened);
  scene::Lamp lamp;
  lamp.radius = rounded(std::min(0.06 * near, 0.08 * height));
  for (const double aside : {0.0, 0.3, 0.6})
    for (const double turn : {0.0, 90.0, 180.0, 270.0})
      for (const double part : {0.8, 0.65, 0.5}) {
        const double z = rounded(part * height);
        lamp.place.floor = scene::AtPolar{rounded(aside * near), Angle::from_degrees(turn)};
        lamp.place.z = z;
        lamp.power = rounded(power_of(opened, z));
        if (hangs_freely(opened, lamp)) return lamp;
      }
  return std::nullopt;
}

}  // namespace

Diagnostics unlit_note(const Opened& opened) {
  if (!opened.scene.lamps.empty() || opened.scene.integrator == scene::Integrator::path) return {};
  std::string hint = "add `lights:`";
  if (const auto lamp = free_lamp(opened)) {
    const auto& at = std::get<scene::AtPolar>(lamp->place.floor);
    hint = fmt::format("for light and shadow add the line   lights: [{{at: {{polar: [{}, {:.0f}deg], z: {}}}, radius: {}, power: {}}}]",
                       at.r, at.angle.degrees(), *lamp->place.z, lamp->radius, lamp->power);
  }
  return {make_note("driver.no-lights", "the scene has no lights: it is shown in its plain colours, which looks flat", hint,
                    opened.scene.orbifold_span)};
}

}  // namespace orbc::driver
