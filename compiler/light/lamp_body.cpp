// The bodies of visible lamps: geodesic triangles whose vertices lie exactly on the sphere, plate or tube.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/light/lamp.h"
#include "compiler/mesh/primitives.h"
#include "compiler/place/camera.h"
#include "compiler/surface/tangent_frame.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using geometry::Vector3;
using scene::LampKind;

constexpr int kFirstLampMark = -100;  // PlacedMesh::wall of the body of lamp 0; −101 of lamp 1, and so on

void add_vertex(place::PlacedMesh& mesh, const Position& p, double height) {
  mesh.floor.push_back(p.floor);
  mesh.z.push_back(std::clamp(p.z, 0.0, height));
}

/// Two unit vectors orthogonal to an axis, the first of them horizontal.
struct Across {
  Vector3 horizontal, other;
};

Across across(const Vector3& axis) {
  const double h = math::hypot(axis.x, axis.y);
  const Vector3 horizontal = h < 1e-9 ? Vector3{1, 0, 0} : Vector3{-axis.y / h, axis.x / h, 0};
  return {horizontal, geometry::cross(axis, horizontal)};
}

place::PlacedMesh sphere_body(Space space, const PlacedLamp& lamp, double radius, double height) {
  const mesh::Mesh ball = mesh::make_sphere(radius, 32, 16);
  const surface::TangentFrame frame = surface::tangent_frame(space, lamp.centre.floor);
  place::PlacedMesh mesh;
  for (const Vector3& v : ball.positions) add_vertex(mesh, surface::exponential(space, lamp.centre, frame, v), height);
  mesh.triangles = ball.triangles;
  return mesh;
}

// A plate across the lamp's axis, visible from both sides.
place::PlacedMesh plate_body(Space space, const PlacedLamp& lamp, const scene::Lamp& spec, double height) {
  const surface::TangentFrame frame = surface::tangent_frame(space, lamp.centre.floor);
  const Across side = across(surface::to_local(space, frame, lamp.axes.front()));
  place::PlacedMesh mesh;
  add_vertex(mesh, lamp.centre, height);
  const bool round = spec.kind == LampKind::disk;
  const int corners = round ? 32 : 4;
  for (int i = 0; i < corners; ++i) {
    const double phi = 2 * std::numbers::pi * i / corners;
    const double x = round ? spec.radius * math::cos(phi) : spec.size[0] * (i == 0 || i == 3 ? 0.5 : -0.5),
                 y = round ? spec.radius * math::sin(phi) : spec.size[1] * (i < 2 ? 0.5 : -0.5);
    add_vertex(mesh, surface::exponential(space, lamp.centre, frame, x * side.horizontal + y * side.other), height);
    mesh.triangles.push_back({0, static_cast<std::uint32_t>(1 + i), static_cast<std::uint32_t>(1 + (i + 1) % corners)});
  }
  return mesh;
}

place::PlacedMesh tube_body(Space space, const PlacedLamp& lamp, const scene::Lamp& spec, double height) {
  constexpr int kAround = 12, kAlong = 24;
  const double length = 2 * (lamp.extent - spec.radius);
  place::PlacedMesh mesh;
  const trace::Ray axis = trace::ray_from(space, lamp.centre, lamp.axes.front());
  for (int j = 0; j <= kAlong; ++j) {
    const double t = length * (static_cast<double>(j) / kAlong - 0.5);
    const Position at = trace::position_at(space, axis, t);
    const surface::TangentFrame frame = surface::tangent_frame(space, at.floor);
    const Across side = across(surface::to_local(space, frame, trace::direction_at(space, axis, t)));
    for (int i = 0; i < kAround; ++i) {
      const double phi = 2 * std::numbers::pi * i / kAround;
      const Vector3 offset = (spec.radius * math::cos(phi)) * side.horizontal + (spec.radius * math::sin(phi)) * side.other;
      add_vertex(mesh, surface::exponential(space, at, frame, offset), height);
    }
  }
  const auto id = [](int j, int i) { return static_cast<std::uint32_t>(j * kAround + i % kAround); };
  for (int j = 0; j < kAlong; ++j)
    for (int i = 0; i < kAround; ++i) {
      mesh.triangles.push_back({id(j, i), id(j, i + 1), id(j + 1, i)});
      mesh.triangles.push_back({id(j + 1, i), id(j, i + 1), id(j + 1, i + 1)});
    }
  for (int i = 1; i + 1 < kAround; ++i) {
    mesh.triangles.push_back({id(0, 0), id(0, i + 1), id(0, i)});
    mesh.triangles.push_back({id(kAlong, 0), id(kAlong, i), id(kAlong, i + 1)});
  }
  return mesh;
}

place::PlacedMesh body(Space space, const PlacedLamp& lamp, const scene::Lamp& spec, double height) {
  if (spec.kind == LampKind::sphere) return sphere_body(space, lamp, spec.radius, height);
  return spec.kind == LampKind::tube ? tube_body(space, lamp, spec, height) : plate_body(space, lamp, spec, height);
}

}  // namespace

int lamp_of_part(const place::PlacedMesh& part) {
  return part.kind == place::PartKind::object && part.wall <= kFirstLampMark ? kFirstLampMark - part.wall : -1;
}

Diagnostics lamps_inside_objects(const scene::Scene& scene, const std::vector<PlacedLamp>& lamps, const place::Interior& interior) {
  Diagnostics errors;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const place::PlacedMesh* around = place::enclosing_object(interior, lamps[i].centre);
    if (!around) continue;
    const scene::Lamp& lamp = scene.lamps[i];
    errors.push_back(make_error("light.lamp-inside-object",
                                fmt::format("lamp {} hangs inside {}, which would keep all its light", i + 1, around->name),
                                "move the lamp or the object; a body that shall glow itself takes `material: {kind: emissive}`",
                                lamp.place.span.source ? lamp.place.span : lamp.span));
  }
  return errors;
}

place::Interior with_lamp_bodies(const scene::Scene& scene, const std::vector<PlacedLamp>& lamps, place::Interior interior) {
  const Space space = interior.polygon.space;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const scene::Lamp& spec = scene.lamps[i];
    const PlacedLamp& lamp = lamps[i];
    if (!spec.visible || spec.kind == LampKind::point || spec.kind == LampKind::spot || interior.styles.size() >= 0xffff) continue;
    place::PlacedMesh mesh = body(space, lamp, spec, interior.height);
    mesh.kind = place::PartKind::object;
    mesh.name = fmt::format("lamp {}", i + 1);
    mesh.wall = kFirstLampMark - static_cast<int>(i);
    // A body shows its colour at full brightness. Its true radiance would be white in any picture of the room.
    const double channel = std::max({spec.color.r, spec.color.g, spec.color.b, 1e-9});
    place::SurfaceStyle style;
    style.color = style.material.color = (1 / channel) * spec.color;
    style.material.kind = scene::MaterialKind::emissive;
    style.material.emission = 1 / std::max(scene.exposure, 1e-9);
    mesh.style.assign(mesh.triangles.size(), static_cast<std::uint16_t>(interior.styles.size()));
    interior.styles.push_back(style);
    interior.parts.push_back(std::move(mesh));
  }
  return interior;
}

}  // namespace orbc::light
