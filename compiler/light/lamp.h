#pragma once
#include <vector>

#include "compiler/base/result.h"
#include "compiler/place/placed.h"
#include "compiler/trace/ray.h"

namespace orbc::light {

/// So many samples of a lamp with an extent, from its second on, give the light of all of it by themselves: their mean and their spread are
/// those of the lamp.
inline constexpr int kDesign = 4;

/// A place near a lamp where a surface is lit most: the point of floor, ceiling or a plain wall next to it.
struct Foot {
  geometry::Position at;
  double reach = 0;                         ///< distance of the lamp
  double share = 1;                         ///< the lamp's profile that way
  bool upright = true;                      ///< on floor or ceiling
};

/// A lamp of a scene, hung in its room: where its light starts, and how much of it goes where.
/// Samples are fixed points of the lamp, so that two roads and two runs see the same shadow; every beginning of the list is spread over the
/// whole lamp.
struct HungLamp {
  scene::LampKind kind = scene::LampKind::point;
  scene::Falloff falloff = scene::Falloff::geodesic;
  scene::Color power;                       ///< Φ × colour
  double radius = 0;                        ///< where its falloff is clamped
  double extent = 0;                        ///< farthest sample from the centre
  double cone_inner = -1, cone_outer = -1;  ///< spot: cosines between which it fades out
  double gain = 1;                          ///< largest factor that `profile` gives
  geometry::Position centre;
  std::vector<geometry::Position> samples;  ///< at least one; a point has one
  std::vector<trace::Direction> axes;       ///< per sample: unit direction that it faces (tube: along it)
  std::vector<Foot> feet;                   ///< filled when light is prepared
};

/// How much brighter than a lamp that shines alike to all sides it is in a direction at angle θ to its axis; its mean over all directions
/// is 1.
/// Formula: sphere, point 1; rectangle and disk, lit on one side, 4·cosθ (Lambert); tube (4/π)·sinθ (Lambert); spot: constant inside, a
///          smooth step over the outer tenth of its cone.
[[nodiscard]] double profile(const HungLamp& lamp, double cos_axis);

/// Hangs the lamps of a scene.
/// Makes:       in the order of the scene. Without a height they hang at 9/10 of the room's height; without `to` they face the floor.
/// Diagnostics: those of place::locate; light.lamp-in-wall when part of a lamp is outside of the room; light.no-power (a warning in
///              `warnings`).
struct HungLamps {
  std::vector<HungLamp> lamps;
  Diagnostics warnings;
};
[[nodiscard]] Result<HungLamps> hang_lamps(const scene::Scene& scene, const room::Room& room);

/// Lamps whose middle is inside a closed object, which would keep all their light. In: the room before add_fixtures.
/// Diagnostics: light.lamp-inside-object (names the object).
[[nodiscard]] Diagnostics lamps_inside_objects(const scene::Scene& scene, const HungLamps& lamps, const place::PlacedRoom& room);

/// Puts the bodies of the visible lamps into the room, as its last parts: spheres, plates and tubes that glow and cast no shadow. Points
/// and spots have none.
void add_fixtures(const scene::Scene& scene, const HungLamps& lamps, place::PlacedRoom& room);
/// Which lamp of the scene a part is the body of (from 0), or −1.
[[nodiscard]] int lamp_of(const place::PlacedMesh& part);

}  // namespace orbc::light
