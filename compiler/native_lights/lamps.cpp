// Unfolding makes a lamp of every image: a copy with the word g shows the room's light times w(g), and the light that reaches the room over
// mirrors h reaches the copy on a straight path from the lamp's image in g·h, times w(h). So every copy has lamps of its own, and no other
// copy's lamps may light it.
#include "compiler/native_lights/lamps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/bend/log_map.h"
#include "compiler/cover/beam.h"
#include "compiler/surface/tangent_frame.h"
#include "compiler/trace/ray.h"

namespace orbc::native_lights {
namespace {

using geometry::Position;
using geometry::Space;
using geometry::Vector3;
using scene::LampKind;
using scene::MaterialKind;

constexpr double kAxisStep = 1e-3;  // length along the axis at which the direction of its image is measured
// The outermost samples of a lamp's design (light/lamp.cpp) lie at half the radius of a disk, at 1/√3 of half the side of a rectangle, and
// at these shares of the length of a tube.
constexpr double kDiskEdge = 2;
const double kRectangleEdge = std::sqrt(3.0);
constexpr double kTubeSampleSpan = 0.896 - 0.104;

/// From the coordinates of the room to those of the eye, through a copy.
struct EyeFromRoom {
  bend::LogMap map;
  cover::Storey storey;
  [[nodiscard]] Vector3 operator()(const Position& p) const { return bend::bent_position(map, p.floor, storey.sign * p.z + storey.offset); }
};

/// The position and extent of a lamp as points: its centre, one on its axis, and the ends of its two half extents.
struct LampShape {
  Position centre, on_axis, end_u, end_v;
  bool has_extent = false;
};

// The samples of a lamp's design are at (±a, ±b): differences of two are along its sides.
LampShape shape_of(Space space, const light::PlacedLamp& lamp, const light::LampImage& image) {
  LampShape shape;
  shape.centre = image.samples[0];
  const surface::TangentFrame frame = surface::tangent_frame(space, shape.centre.floor);
  const auto moved_by = [&](const Vector3& v) { return surface::exponential(space, shape.centre, frame, v); };
  const Vector3 axis = surface::to_local(space, frame, image.axes[0]);
  shape.on_axis = moved_by(kAxisStep * axis);
  if (image.samples.size() < 5) return shape;
  shape.has_extent = true;
  const auto offset = [&](std::size_t i) {
    const trace::Segment s = trace::segment_between(space, shape.centre, image.samples[i]);
    return s.length * surface::to_local(space, frame, {s.ray.c * s.ray.along, s.ray.m});
  };
  Vector3 half_u{lamp.radius, 0, 0}, half_v{0, lamp.radius, 0};
  if (lamp.kind == LampKind::rectangle || lamp.kind == LampKind::disk) {
    const double to_edge = lamp.kind == LampKind::disk ? kDiskEdge : kRectangleEdge;
    half_u = 0.5 * to_edge * (offset(2) - offset(1));
    half_v = 0.5 * to_edge * (offset(3) - offset(1));
  } else if (lamp.kind == LampKind::tube) {
    half_u = 0.5 / kTubeSampleSpan * (offset(4) - offset(1));
    half_v = {0, 0, 0};
  }
  shape.end_u = moved_by(half_u);
  shape.end_v = moved_by(half_v);
  return shape;
}

/// The throughput of the room's mirrors: their mean where they differ.
struct MirrorThroughput {
  scene::Color color{0, 0, 0};
  bool all_equal = true;
};
MirrorThroughput throughput_of(const place::Interior& room) {
  MirrorThroughput mean;
  for (const place::PlacedMirror& m : room.mirrors) {
    const scene::Color throughput = m.throughput;
    mean.all_equal = mean.all_equal && throughput == room.mirrors[0].throughput;
    mean.color = mean.color + (1.0 / static_cast<double>(room.mirrors.size())) * throughput;
  }
  if (mean.all_equal && !room.mirrors.empty()) mean.color = room.mirrors[0].throughput;
  return mean;
}

NativeLamp native_lamp(const EyeFromRoom& eye_from_room, const light::PlacedLamp& lamp, const LampShape& shape) {
  NativeLamp native;
  native.kind = lamp.kind;
  native.inverse_square = lamp.falloff != scene::Falloff::none;
  native.at = eye_from_room(shape.centre);
  const Vector3 axis = eye_from_room(shape.on_axis) - native.at;
  if (geometry::length(axis) > 0) native.axis = geometry::normalised(axis);
  if (shape.has_extent) {
    native.half_u = eye_from_room(shape.end_u) - native.at;
    native.half_v = eye_from_room(shape.end_v) - native.at;
  }
  native.cone_inner = lamp.cone_inner;
  native.cone_outer = lamp.cone_outer;
  return native;
}

scene::Color power_of(scene::Color weight, const scene::Color& mirror, int bounces) {
  for (int k = 0; k < bounces; ++k) weight = weight * mirror;
  return weight;
}

/// Why native light differs from the tracer's; empty: it does not.
std::string approximations(const scene::Scene& scene, const place::Interior& room, bool mirrors_equal) {
  std::vector<std::string> reasons;
  if (room.polygon.space != Space::euclidean)
    reasons.push_back(fmt::format("light follows curves in {} rooms, but straight lines in renderers", name(room.polygon.space)));
  if (!mirrors_equal) reasons.push_back("mirrors that are not all alike give light their mean weight");
  if (cover::needs_beams(room)) reasons.push_back("copies are cut to what the eye sees of them, and so are their shadows");
  if (std::any_of(scene.lamps.begin(), scene.lamps.end(), [](const scene::Lamp& l) { return l.kind == LampKind::tube; }))
    reasons.push_back("tubes shine alike to all sides");
  if (scene.integrator == scene::Integrator::path) reasons.push_back("what surfaces pass on to each other is left out");
  const auto is_shiny = [](const place::SurfaceStyle& look) {
    return look.material.kind != MaterialKind::matte && look.material.kind != MaterialKind::emissive;
  };
  if (std::any_of(room.styles.begin(), room.styles.end(), is_shiny)) reasons.push_back("all surfaces are matte");
  return fmt::format("{}", fmt::join(reasons, "; "));
}

}  // namespace

Result<NativeLights> place_native_lights(const LampScene& lit, const std::vector<cover::Copy>& copies,
                                         const std::vector<std::size_t>& lit_copies) {
  if (lit_copies.size() * lit.images.size() > kMaxNativeLamps) {
    return make_error("driver.too-many-lamps",
                      fmt::format("{} copies with {} images of lamps each are more lamps than the {} that a renderer is given",
                                  lit_copies.size(), lit.images.size(), kMaxNativeLamps),
                      "lower bake.mirrors or cover.max_bounces, or let the light be baked (`lights: baked`)", lit.scene.span);
  }
  const Space space = lit.interior.polygon.space;
  const geometry::Isometry eye_from_cover = geometry::inverse(lit.eye.room_from_eye);
  const MirrorThroughput mirror = throughput_of(lit.interior);
  const double pi = std::numbers::pi;
  NativeLights lights;
  lights.light.ambient = lit.scene.exposure * lit.scene.ambient;
  std::vector<LampShape> shapes;
  for (const light::LampImage& image : lit.images)
    shapes.push_back(shape_of(space, lit.lamps[static_cast<std::size_t>(image.lamp)], image));
  for (const std::size_t c : lit_copies) {
    const EyeFromRoom eye_from_room{{space, geometry::matrix(eye_from_cover * copies[c].cover_from_room), copies[c].sheet},
                                    copies[c].storey};
    for (std::size_t i = 0; i < lit.images.size(); ++i) {
      const light::PlacedLamp& lamp = lit.lamps[static_cast<std::size_t>(lit.images[i].lamp)];
      NativeLamp native = native_lamp(eye_from_room, lamp, shapes[i]);
      native.copy = c;
      native.direct = lit.images[i].bounces == 0;
      const scene::Color weight = power_of(copies[c].weight, mirror.color, lit.images[i].bounces);
      const double gain = lamp.kind == LampKind::tube ? 1 : lamp.peak_intensity;
      native.intensity = (lit.scene.exposure * gain / (4 * pi * pi)) * (weight * lamp.power);
      lights.light.lamps.push_back(native);
    }
  }
  if (const std::string reasons = approximations(lit.scene, lit.interior, mirror.all_equal); !reasons.empty())
    lights.warnings.push_back(make_warning("driver.native-lights-approximate", "native light is not the tracer's here: " + reasons,
                                           "bake it (`lights: baked`) where that matters", lit.scene.span));
  return lights;
}

}  // namespace orbc::native_lights
