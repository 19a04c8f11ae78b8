// The bodies of visible lamps: geodesic triangles whose vertices lie exactly on the sphere, plate or tube around the lamp's geodesic.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/light/lamp.h"
#include "compiler/mesh/primitives.h"
#include "compiler/place/eye.h"
#include "compiler/surface/frame.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using geometry::Vector3;
using scene::LampKind;

constexpr int kFirstMark = -100;  // PlacedMesh::wall of the body of lamp 0, −101 of lamp 1, …: objects belong to no wall

void add_vertex(place::PlacedMesh& mesh, const Position& p, double height) {
  mesh.floor.push_back(p.floor);
  mesh.z.push_back(std::clamp(p.z, 0.0, height));
}

place::PlacedMesh sphere(Space space, const HungLamp& lamp, double radius, double height) {
  const mesh::Mesh ball = mesh::make_sphere(radius, 32, 16);
  const surface::Frame frame = surface::frame_at(space, lamp.centre.floor);
  place::PlacedMesh mesh;
  for (const Vector3& v : ball.positions) add_vertex(mesh, surface::exponential(space, lamp.centre, frame, v), height);
  mesh.triangles = ball.triangles;
  return mesh;
}

// Across the axis; seen from both sides.
place::PlacedMesh plate(Space space, const HungLamp& lamp, const scene::Lamp& spec, double height) {
  const surface::Frame frame = surface::frame_at(space, lamp.centre.floor);
  const Vector3 axis = surface::local(space, frame, lamp.axes.front());
  const double h = math::hypot(axis.x, axis.y);
  const Vector3 across = h < 1e-9 ? Vector3{1, 0, 0} : Vector3{-axis.y / h, axis.x / h, 0}, other = geometry::cross(axis, across);
  place::PlacedMesh mesh;
  add_vertex(mesh, lamp.centre, height);
  const bool round = spec.kind == LampKind::disk;
  const int around = round ? 32 : 4;
  for (int i = 0; i < around; ++i) {
    const double turn = 2 * std::numbers::pi * i / around;
    const double x = round ? spec.radius * math::cos(turn) : spec.size[0] * (i == 0 || i == 3 ? 0.5 : -0.5),
                 y = round ? spec.radius * math::sin(turn) : spec.size[1] * (i < 2 ? 0.5 : -0.5);
    add_vertex(mesh, surface::exponential(space, lamp.centre, frame, x * across + y * other), height);
    mesh.triangles.push_back({0, static_cast<std::uint32_t>(1 + i), static_cast<std::uint32_t>(1 + (i + 1) % around)});
  }
  return mesh;
}

place::PlacedMesh tube(Space space, const HungLamp& lamp, const scene::Lamp& spec, double height) {
  constexpr int kAround = 12, kAlong = 24;
  const double length = 2 * (lamp.extent - spec.radius);
  place::PlacedMesh mesh;
  const trace::Ray axis = trace::ray_from(space, lamp.centre, lamp.axes.front());
  for (int j = 0; j <= kAlong; ++j) {
    const double t = length * (static_cast<double>(j) / kAlong - 0.5);
    const Position at = trace::position_at(space, axis, t);
    const surface::Frame frame = surface::frame_at(space, at.floor);
    const Vector3 d = surface::local(space, frame, trace::direction_at(space, axis, t));
    const double h = math::hypot(d.x, d.y);
    const Vector3 across = h < 1e-9 ? Vector3{1, 0, 0} : Vector3{-d.y / h, d.x / h, 0}, other = geometry::cross(d, across);
    for (int i = 0; i < kAround; ++i) {
      const double turn = 2 * std::numbers::pi * i / kAround;
      add_vertex(mesh,
                 surface::exponential(space, at, frame, (spec.radius * math::cos(turn)) * across + (spec.radius * math::sin(turn)) * other),
                 height);
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

}  // namespace

int lamp_of(const place::PlacedMesh& part) {
  return part.kind == place::PartKind::object && part.wall <= kFirstMark ? kFirstMark - part.wall : -1;
}

Diagnostics lamps_inside_objects(const scene::Scene& scene, const HungLamps& lamps, const place::PlacedRoom& room) {
  Diagnostics errors;
  for (std::size_t i = 0; i < lamps.lamps.size(); ++i) {
    const place::PlacedMesh* around = place::object_around(room, lamps.lamps[i].centre);
    if (!around) continue;
    const scene::Lamp& lamp = scene.lamps[i];
    errors.push_back(make_error("light.lamp-inside-object",
                                fmt::format("lamp {} hangs inside {}, which would keep all its light", i + 1, around->name),
                                "move the lamp or the object; a body that shall glow itself takes `material: {kind: emissive}`",
                                lamp.place.span.source ? lamp.place.span : lamp.span));
  }
  return errors;
}

void add_fixtures(const scene::Scene& scene, const HungLamps& lamps, place::PlacedRoom& room) {
  const Space space = room.room.space;
  for (std::size_t i = 0; i < lamps.lamps.size(); ++i) {
    const scene::Lamp& spec = scene.lamps[i];
    const HungLamp& lamp = lamps.lamps[i];
    if (!spec.visible || spec.kind == LampKind::point || spec.kind == LampKind::spot || room.looks.size() >= 0xffff) continue;
    place::PlacedMesh mesh = spec.kind == LampKind::sphere ? sphere(space, lamp, spec.radius, room.height)
                             : spec.kind == LampKind::tube ? tube(space, lamp, spec, room.height)
                                                           : plate(space, lamp, spec, room.height);
    mesh.kind = place::PartKind::object;
    mesh.name = fmt::format("lamp {}", i + 1);
    mesh.wall = kFirstMark - static_cast<int>(i);
    // Its hue at full brightness: what it radiates would be white in any picture of the room.
    const double largest = std::max({spec.color.r, spec.color.g, spec.color.b, 1e-9});
    place::Look look;
    look.color = look.material.color = (1 / largest) * spec.color;
    look.material.kind = scene::MaterialKind::emissive;
    look.material.emission = 1 / std::max(scene.exposure, 1e-9);
    mesh.look.assign(mesh.triangles.size(), static_cast<std::uint16_t>(room.looks.size()));
    room.looks.push_back(look);
    room.parts.push_back(std::move(mesh));
  }
}

}  // namespace orbc::light
