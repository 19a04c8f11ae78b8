#pragma once
#include <vector>

#include "compiler/base/result.h"
#include "compiler/place/interior.h"
#include "compiler/trace/ray.h"

namespace orbc::light {

/// The first samples of a lamp with an extent, behind its centre, are a quadrature of the whole lamp by themselves: they have its mean and
/// its second moments. There are this many.
inline constexpr int kQuadratureSamples = 4;

/// The place on floor, ceiling or a plain wall that a lamp lights most.
struct HotSpot {
  geometry::Position at;
  double distance = 0;           ///< of the lamp
  double angular_intensity = 1;  ///< of the lamp in that direction
  bool horizontal = true;        ///< on floor or ceiling; false: on a wall
};

/// A lamp at its place in the room.
/// Samples are fixed points of the lamp, so the tracer and the bake see the same shadows. Every first part of the list is spread over the
/// whole lamp.
struct PlacedLamp {
  scene::LampKind kind = scene::LampKind::point;
  scene::Falloff falloff = scene::Falloff::geodesic;
  scene::Color power;                       ///< Φ × colour
  double radius = 0;                        ///< the falloff does not rise any more within this distance
  double extent = 0;                        ///< distance of the farthest sample from the centre
  double cone_inner = -1, cone_outer = -1;  ///< of spots: cosines between which the light fades out
  double peak_intensity = 1;                ///< maximum of `angular_intensity`
  geometry::Position centre;
  std::vector<geometry::Position> samples;  ///< the centre, then points of the lamp; points and spots have the centre alone
  std::vector<trace::Direction> axes;       ///< per sample: the unit direction that the lamp faces; of tubes that along them
  std::vector<HotSpot> hot_spots;           ///< filled by prepare_lamps
};

/// The intensity of a lamp in a direction, relative to an isotropic lamp of the same power. Its mean over all directions is 1.
/// In:      cosine of the direction to the axis of the sample.
/// Formula: spheres and points 1; rectangles and disks, which shine to one side, 4·cosθ (Lambert); tubes (4/π)·sinθ (Lambert); spots:
///          constant inside, a smooth step over the outer tenth of the cone.
[[nodiscard]] double angular_intensity(const PlacedLamp& lamp, double cos_axis);

/// The lamps of a scene, in its order.
struct PlacedLamps {
  std::vector<PlacedLamp> lamps;
  Diagnostics warnings;
};
/// Places the lamps of a scene. The default height is 9/10 of the room's height; lamps without `to` face the floor.
/// Diagnostics: those of place::locate; light.lamp-in-wall when a part of a lamp is outside of the room; light.no-power (in `warnings`).
[[nodiscard]] Result<PlacedLamps> place_lamps(const scene::Scene& scene, const room::Room& room);

/// Refuses lamps with their centre inside a closed object, which would keep all their light. In: the room without lamp bodies.
/// Diagnostics: light.lamp-inside-object (names the object).
[[nodiscard]] Diagnostics lamps_inside_objects(const scene::Scene& scene, const std::vector<PlacedLamp>& lamps,
                                               const place::Interior& interior);

/// The room with the bodies of visible lamps as its last parts: emissive spheres, plates and tubes, which cast no shadow. Points and spots
/// have no bodies.
[[nodiscard]] place::Interior with_lamp_bodies(const scene::Scene& scene, const std::vector<PlacedLamp>& lamps, place::Interior interior);
/// The lamp of the scene (from 0) whose body a part is, or −1.
[[nodiscard]] int lamp_of_part(const place::PlacedMesh& part);

}  // namespace orbc::light
