#include "compiler/driver/unlit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "compiler/base/elementary.h"
#include "compiler/light/lamp.h"

namespace orbc::driver {
namespace {

/// About the distance from the centre of the room to its walls. The strip has no inscribed circle: its mirrors lie `scale` away.
double distance_to_walls(const LoadedScene& loaded) {
  const room::Room& room = loaded.interior->polygon;
  if (room.inradius > 0) return room.inradius;
  return room.orbifold.strip ? loaded.scene.room.shape.scale : room.circumradius / 2;
}

/// A value with two digits, as the hint writes it.
double rounded(double value) {
  if (value <= 0) return 0;
  const double scale = math::pow(10.0, 1 - std::floor(math::log10(value)));
  return std::round(value * scale) / scale;
}

/// The power of a lamp at height z over the centre that lights floor and walls well. At the foot of the walls its light is
/// Φz/(4π(z²+ρ²)^(3/2)), where ρ = sinκ(distance) measures how light spreads in this space; its images in near walls add to that. The floor
/// just below gets at most 5 times white. The factors are measured: with them the pictures of rooms of all kinds are well exposed.
double power_of(const LoadedScene& loaded, double z) {
  const double spread = geometry::sin_k(loaded.interior->polygon.space, distance_to_walls(loaded));
  const double slant = math::hypot(z, spread), steep = std::min(z / spread, 3.0);
  return std::min(28 * slant * slant * slant / (z * (1 + 1.5 * steep * steep)), 60 * z * z) / loaded.scene.exposure;
}

bool is_free(const LoadedScene& loaded, const scene::Lamp& lamp) {
  scene::Scene lit;
  lit.orbifold = loaded.scene.orbifold;
  lit.room = loaded.scene.room;
  lit.objects = loaded.scene.objects;
  lit.lamps = {lamp};
  const auto placed = light::place_lamps(lit, loaded.interior->polygon);
  return placed.has_value() && placed->warnings.empty() && light::lamps_inside_objects(lit, placed->lamps, *loaded.interior).empty();
}

/// A length as the hint writes it: with two digits in the author's unit. Makes: the same in the scene's unit.
double rounded_length(const LoadedScene& loaded, double length) { return loaded.unit_of_length * rounded(length / loaded.unit_of_length); }

/// A lamp in the first free place: at the centre below the ceiling, or beside it or lower. Nothing when there is none.
std::optional<scene::Lamp> free_lamp(const LoadedScene& loaded) {
  const double height = loaded.scene.room.height, near = distance_to_walls(loaded);
  scene::Lamp lamp;
  lamp.radius = rounded_length(loaded, std::min(0.06 * near, 0.08 * height));
  for (const double aside : {0.0, 0.3, 0.6})
    for (const double turn : {0.0, 90.0, 180.0, 270.0})
      for (const double part : {0.8, 0.65, 0.5}) {
        const double z = rounded_length(loaded, part * height);
        lamp.place.floor = scene::AtPolar{rounded_length(loaded, aside * near), Angle::from_degrees(turn)};
        lamp.place.z = z;
        lamp.power = power_of(loaded, z);
        if (is_free(loaded, lamp)) return lamp;
      }
  return std::nullopt;
}

}  // namespace

Diagnostics unlit_note(const LoadedScene& loaded) {
  if (!loaded.scene.lamps.empty() || loaded.scene.integrator == scene::Integrator::path) return {};
  std::string hint = "add `lights:`";
  if (const auto lamp = free_lamp(loaded)) {
    const auto& at = std::get<scene::AtPolar>(lamp->place.floor);
    const double unit = loaded.unit_of_length;
    hint = fmt::format("for light and shadow add the line   lights: [{{at: {{polar: [{}, {:.0f}deg], z: {}}}, radius: {}, power: {}}}]",
                       rounded(at.r / unit), at.angle.degrees(), rounded(*lamp->place.z / unit), rounded(lamp->radius / unit),
                       rounded(lamp->power / (unit * unit)));
  }
  return {make_note("driver.no-lights", "the scene has no lights: it is shown in its plain colours, which looks flat", hint,
                    loaded.scene.orbifold_span)};
}

}  // namespace orbc::driver
