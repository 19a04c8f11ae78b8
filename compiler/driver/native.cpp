// Unfolding makes a lamp of every image: a copy with the word g shows the room's light times w(g), and what comes to it over mirrors h
// comes straight from the image of the lamp in g·h, times w(h). So every copy has lamps of its own, and no other copy's lamps may light it.
#include "compiler/driver/native.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/bend/log_map.h"
#include "compiler/cover/beam.h"
#include "compiler/driver/product_normals.h"
#include "compiler/light/lamp.h"
#include "compiler/light/lamp_image.h"
#include "compiler/light/lighting.h"
#include "compiler/surface/tangent_frame.h"

namespace orbc::driver {
namespace {

using geometry::Position;
using geometry::Space;
using geometry::Vector3;
using scene::LampKind;
using scene::MaterialKind;

bool glows(const place::Interior& room, std::uint16_t look) { return room.styles[look].material.kind == MaterialKind::emissive; }

/// The triangles of a part that glow, or the others.
place::PlacedMesh half_of(const place::Interior& room, const place::PlacedMesh& part, bool glowing) {
  place::PlacedMesh half = part;
  half.triangles.clear(), half.style.clear();
  for (std::size_t t = 0; t < part.triangles.size(); ++t)
    if (glows(room, part.style[t]) == glowing) half.triangles.push_back(part.triangles[t]), half.style.push_back(part.style[t]);
  return half;
}

/// From the coordinates of the room to those of the eye, by way of a copy.
struct IntoCopy {
  bend::LogMap map;
  cover::Storey storey;
  [[nodiscard]] Vector3 operator()(const Position& p) const { return bend::bent_position(map, p.floor, storey.sign * p.z + storey.offset); }
};

/// The points of a lamp that say where it is and how large: its middle, and one beside it along its axis and each of its two half extents.
struct Shape {
  Position middle, along, across, other;
  bool extended = false;
};

// The samples of a lamp's design (lamp.cpp) are (±a, ±b): differences of them are its sides.
Shape shape_of(Space space, const light::PlacedLamp& lamp, const light::LampImage& image) {
  Shape shape;
  shape.middle = image.samples[0];
  const surface::TangentFrame frame = surface::tangent_frame(space, shape.middle.floor);
  const auto beside = [&](const Vector3& v) { return surface::exponential(space, shape.middle, frame, v); };
  const Vector3 axis = surface::to_local(space, frame, image.axes[0]);
  shape.along = beside(1e-3 * axis);
  if (image.samples.size() < 5) return shape;
  shape.extended = true;
  const auto offset = [&](std::size_t i) {
    const trace::Segment s = trace::segment_between(space, shape.middle, image.samples[i]);
    return s.length * surface::to_local(space, frame, {s.ray.c * s.ray.along, s.ray.m});
  };
  Vector3 across{lamp.radius, 0, 0}, other{0, lamp.radius, 0};
  if (lamp.kind == LampKind::rectangle || lamp.kind == LampKind::disk) {
    const double to_edge = lamp.kind == LampKind::disk ? 2 : std::sqrt(3.0);  // samples lie at half the radius, at 1/√12 of the whole side
    across = 0.5 * to_edge * (offset(2) - offset(1));
    other = 0.5 * to_edge * (offset(3) - offset(1));
  } else if (lamp.kind == LampKind::tube) {
    across = 0.5 / (0.896 - 0.104) * (offset(4) - offset(1));
    other = {0, 0, 0};
  }
  shape.across = beside(across), shape.other = beside(other);
  return shape;
}

/// The one weight of all mirrors, or their mean.
struct MirrorWeight {
  scene::Color color{0, 0, 0};
  bool alike = true;
};
MirrorWeight weight_of(const place::Interior& room) {
  MirrorWeight mean;
  for (const place::PlacedMirror& m : room.mirrors) {
    const scene::Color own = m.throughput;
    mean.alike = mean.alike && own == room.mirrors[0].throughput;
    mean.color = mean.color + (1.0 / static_cast<double>(room.mirrors.size())) * own;
  }
  if (mean.alike && !room.mirrors.empty()) mean.color = room.mirrors[0].throughput;
  return mean;
}

NativeLamp lamp_in(const IntoCopy& eye_from_room, const light::PlacedLamp& lamp, const Shape& shape) {
  NativeLamp made;
  made.kind = lamp.kind;
  made.fades = lamp.falloff != scene::Falloff::none;
  made.at = eye_from_room(shape.middle);
  const Vector3 along = eye_from_room(shape.along) - made.at;
  if (geometry::length(along) > 0) made.axis = geometry::normalised(along);
  if (shape.extended) made.across = eye_from_room(shape.across) - made.at, made.other = eye_from_room(shape.other) - made.at;
  made.cone_inner = lamp.cone_inner, made.cone_outer = lamp.cone_outer;
  return made;
}

std::string why_approximate(const Opened& opened, bool mirrors_alike) {
  const scene::Scene& scene = opened.scene;
  const place::Interior& room = *opened.room;
  std::vector<std::string> why;
  if (room.polygon.space != Space::euclidean)
    why.push_back(fmt::format("light follows curves in {} rooms, but straight lines in renderers", name(room.polygon.space)));
  if (!mirrors_alike) why.push_back("mirrors that are not all alike give light their mean weight");
  if (cover::needs_beams(room)) why.push_back("copies are cut to what the eye sees of them, and so are their shadows");
  if (std::any_of(scene.lamps.begin(), scene.lamps.end(), [](const scene::Lamp& l) { return l.kind == LampKind::tube; }))
    why.push_back("tubes shine alike to all sides");
  if (scene.integrator == scene::Integrator::path) why.push_back("what surfaces pass on to each other is left out");
  const auto shiny = [](const place::SurfaceStyle& look) {
    return look.material.kind != MaterialKind::matte && look.material.kind != MaterialKind::emissive;
  };
  if (std::any_of(room.styles.begin(), room.styles.end(), shiny)) why.push_back("all surfaces are matte");
  return fmt::format("{}", fmt::join(why, "; "));
}

}  // namespace

bool lit_natively(const scene::Scene& scene) { return scene.bake.lights == scene::LightMode::native && !scene.lamps.empty(); }

Opened unlit_twin(const Opened& opened) {
  Opened twin;
  twin.scene = opened.scene, twin.eye = opened.eye, twin.expected_background = opened.expected_background;
  twin.room = std::make_unique<place::Interior>(*opened.room);
  twin.scene.lamps.clear();
  twin.scene.integrator = scene::Integrator::direct;
  twin.scene.exposure = 1;
  place::Interior& room = *twin.room;
  for (place::SurfaceStyle& look : room.styles) {
    scene::Material& m = look.material;
    if (m.kind != MaterialKind::emissive) {
      m.kind = MaterialKind::matte;
      continue;
    }
    m.emission *= opened.scene.exposure;  // lamps and ambient light bring it to what is lit
  }
  std::vector<place::PlacedMesh> parts;
  for (place::PlacedMesh& part : room.parts) {
    const auto count = std::count_if(part.style.begin(), part.style.end(), [&](std::uint16_t look) { return glows(room, look); });
    if (count == 0 || count == static_cast<std::ptrdiff_t>(part.style.size())) {
      parts.push_back(std::move(part));
      continue;
    }
    parts.push_back(half_of(room, part, false));
    parts.push_back(half_of(room, part, true));
  }
  room.parts = std::move(parts);
  return twin;
}

Shine shine_of(const place::Interior& room, const place::PlacedMesh& part) {
  if (part.style.empty() || !glows(room, part.style[0])) return Shine::lit;
  return light::lamp_of_part(part) >= 0 || part.kind != place::PartKind::object ? Shine::lamp : Shine::glowing;
}

Diagnostics add_native_light(const Opened& opened, const std::vector<cover::Copy>& copies, Product& product, const Executor& executor) {
  const place::Interior& room = *opened.room;
  const Space space = room.polygon.space;
  const auto hung = light::place_lamps(opened.scene, room.polygon);
  if (!hung) return hung.error();
  const light::LightOptions options = light::light_options(opened.scene);
  const auto found = light::lamp_images(hung->lamps, room, {options.bounces, opened.scene.exposure, options.cull_below});
  if (!found) return located(found.error(), opened.scene.bake.mirror_bounces_span);
  const std::vector<light::LampImage>& images = *found;
  const auto lit = static_cast<std::size_t>(
      std::count_if(product.copies.begin(), product.copies.end(), [](const DrawnCopy& c) { return c.shine == Shine::lit && !c.again_of; }));
  if (lit * images.size() > kMaxNativeLamps) {
    return {make_error("driver.too-many-lamps",
                       fmt::format("{} copies with {} images of lamps each are more lamps than the {} that a renderer is given", lit,
                                   images.size(), kMaxNativeLamps),
                       "lower bake.mirrors or cover.max_bounces, or let the light be baked (`lights: baked`)", opened.scene.span)};
  }
  const MirrorWeight mirror = weight_of(room);
  const double pi = std::numbers::pi;
  NativeLight light;
  light.ambient = opened.scene.exposure * opened.scene.ambient;
  std::vector<Shape> shapes;
  for (const light::LampImage& image : images) shapes.push_back(shape_of(space, hung->lamps[static_cast<std::size_t>(image.lamp)], image));
  for (std::size_t c = 0; c < product.copies.size(); ++c) {
    if (product.copies[c].shine != Shine::lit || product.copies[c].again_of) continue;
    const IntoCopy into{{space, geometry::matrix(geometry::inverse(opened.eye.room_from_eye) * copies[c].cover_from_room), copies[c].sheet},
                        copies[c].storey};
    for (std::size_t i = 0; i < images.size(); ++i) {
      const light::PlacedLamp& lamp = hung->lamps[static_cast<std::size_t>(images[i].lamp)];
      NativeLamp made = lamp_in(into, lamp, shapes[i]);
      made.copy = c, made.own = images[i].bounces == 0;
      scene::Color weight = copies[c].weight;
      for (int k = 0; k < images[i].bounces; ++k) weight = weight * mirror.color;
      const double gain = lamp.kind == LampKind::tube ? 1 : lamp.peak_intensity;
      made.intensity = (opened.scene.exposure * gain / (4 * pi * pi)) * (weight * lamp.power);
      light.lamps.push_back(made);
    }
  }
  product.native = std::move(light);
  add_normals(product, executor);
  Diagnostics notes;
  if (const std::string why = why_approximate(opened, mirror.alike); !why.empty())
    notes.push_back(make_warning("driver.native-lights-approximate", "native light is not the tracer's here: " + why,
                                 "bake it (`lights: baked`) where that matters", opened.scene.span));
  return notes;
}

}  // namespace orbc::driver
