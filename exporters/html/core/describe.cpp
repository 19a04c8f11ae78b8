#include "exporters/html/core/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "compiler/notation/classify.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/print.h"
#include "compiler/place/furnish.h"
#include "compiler/room/summary.h"

namespace orbc::html {
namespace {

using scene::Color;

void add(Reply& reply, const char* name, const geometry::Ambient& v) { reply.key(name).numbers(std::array{v.w, v.x, v.y}); }
void add(Reply& reply, const char* name, const geometry::Vector3& v) { reply.key(name).numbers(std::array{v.x, v.y, v.z}); }
void add(Reply& reply, const char* name, const Color& c) { reply.key(name).numbers(std::array{c.r, c.g, c.b}); }

const char* name_of(scene::Pattern pattern) {
  static const char* const names[] = {"plain", "checker", "marble", "wood", "granite", "texture"};
  return names[static_cast<int>(pattern)];
}
const char* name_of(scene::MaterialKind kind) {
  static const char* const names[] = {"matte", "glossy", "metal", "mirror", "glass", "emissive"};
  return names[static_cast<int>(kind)];
}
const char* name_of(scene::LampKind kind) {
  static const char* const names[] = {"point", "sphere", "rectangle", "disk", "tube", "spot"};
  return names[static_cast<int>(kind)];
}
const char* name_of(const scene::Object& object) {
  static const char* const names[] = {"mesh", "sphere", "cylinder", "box", "torus", "torus_knot", "beam"};
  return names[object.shape.index()];
}

// Members of an object that is open.
void add_material(const scene::Material& material, int texture, Reply& reply) {
  add(reply, "color", material.color);
  add(reply, "second", material.second);
  reply.key("pattern").value(name_of(material.pattern)).key("kind").value(name_of(material.kind)).key("cell").value(material.cell);
  reply.key("texture").value(texture).key("emission").value(material.kind == scene::MaterialKind::emissive ? material.emission : 1.0);
}

void add_mirrors(const place::Interior& interior, int wall, Reply& reply) {
  reply.key("mirrors").array();
  for (const place::PlacedMirror& mirror : interior.mirrors) {
    if (mirror.wall != wall) continue;
    reply.object().key("span").numbers(mirror.span).key("height").numbers(mirror.height);
    add(reply, "throughput", mirror.throughput);
    reply.end_object();
  }
  reply.end_array();
}

/// The texture of a part of the shell, or −1.
int texture_of(const place::Interior& interior, place::PartKind kind, int wall) {
  for (const place::PlacedMesh& part : interior.parts)
    if (part.kind == kind && part.wall == wall && !part.style.empty()) return interior.styles[part.style.front()].texture;
  return -1;
}

void add_surface(const place::Interior& interior, const scene::Material& material, place::PartKind kind, int wall, Reply& reply) {
  reply.object();
  add_material(material, texture_of(interior, kind, kind == place::PartKind::wall ? wall : -1), reply);
  add_mirrors(interior, wall, reply);
  reply.end_object();
}

void add_nodes(const scene::Node& node, const SourceSpan& key, const std::string& path, Reply& reply) {
  reply.array().value(path).value(static_cast<int>(node.kind));
  for (const std::size_t number : {node.span.line, node.span.column, node.span.length, key.line, key.column}) reply.value(number);
  reply.end_array();
  const std::string prefix = path.empty() ? "" : path + ".";
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const bool is_map = node.kind == scene::NodeKind::map;
    add_nodes(node.items[i], is_map ? node.keys[i].span : node.items[i].span, prefix + (is_map ? node.keys[i].text : fmt::format("{}", i)),
              reply);
  }
}

}  // namespace

void describe_diagnostics(const Diagnostics& diagnostics, Reply& reply) {
  reply.array();
  for (const Diagnostic& d : diagnostics) {
    reply.object().key("severity").value(d.severity == Severity::error ? "error" : d.severity == Severity::warning ? "warning" : "note");
    reply.key("code").value(d.code).key("message").value(d.message).key("hint").value(d.hint);
    reply.key("line").value(d.span.line).key("column").value(d.span.column).key("length").value(d.span.length);
    reply.key("text").value(to_text(d)).end_object();
  }
  reply.end_array();
}

void describe_nodes(const scene::Node& root, Reply& reply) {
  reply.array();
  add_nodes(root, root.span, "", reply);
  reply.end_array();
}

void describe_orbifold(const notation::Orbifold& orbifold, Reply& reply) {
  const Rational chi = notation::euler_characteristic(orbifold);
  const auto space = notation::classify(orbifold);
  reply.object().key("notation").value(notation::to_text(orbifold)).key("chi").value(to_string(chi));
  reply.key("chi_value").value(static_cast<double>(chi)).key("space").value(space ? geometry::name(*space) : "none");
  reply.key("strip").value(orbifold.strip).key("real").value(!notation::is_orbifold(orbifold)).key("orders").array();
  for (const Rational& order : orbifold.corners) reply.value(to_string(order));
  reply.end_array().end_object();
}

void describe_room(const place::Interior& interior, Reply& reply) {
  const room::Room& room = interior.polygon;
  reply.object().key("curvature").value(geometry::curvature(room.space)).key("height").value(interior.height).key("corners").array();
  for (const room::Corner& corner : room.corners) reply.numbers(std::array{corner.at.w, corner.at.x, corner.at.y, corner.angle});
  reply.end_array().key("walls").array();
  for (const room::Wall& wall : room.walls) {
    reply.object().key("line").numbers(std::array{wall.line.w, wall.line.x, wall.line.y});
    add(reply, "start", wall.start);
    add(reply, "along", wall.along);
    reply.key("length").value(wall.length).key("reflects").value(wall.reflects).end_object();
  }
  reply.end_array().key("inradius").value(room.inradius).key("circumradius").value(room.circumradius).key("area").value(room.area);
  reply.key("moduli").value(room::summarise(room).moduli).end_object();
}

void describe_shell(const scene::Scene& scene, const place::Interior& interior, Reply& reply) {
  reply.object().key("floor");
  add_surface(interior, scene.room.floor.material, place::PartKind::floor, -1, reply);
  reply.key("ceiling");
  add_surface(interior, scene.room.ceiling.material, place::PartKind::ceiling, -2, reply);
  reply.key("walls").array();
  for (std::size_t i = 0; i < interior.polygon.walls.size(); ++i)
    add_surface(interior, i < scene.room.walls.size() ? scene.room.walls[i].material : scene::Material{}, place::PartKind::wall,
                static_cast<int>(i), reply);
  reply.end_array().end_object();
}

void describe_styles(const place::Interior& interior, Reply& reply) {
  reply.key("styles").array();
  for (const place::SurfaceStyle& style : interior.styles) {
    reply.object();
    add_material(style.material, style.texture, reply);
    reply.key("roughness").value(style.material.roughness).key("index").value(style.material.index);
    reply.key("cutoff").value(style.alpha_cutoff).end_object();
  }
  reply.end_array().key("textures").array();
  for (const image::Image& texture : interior.textures)
    reply.object().key("width").value(texture.width).key("height").value(texture.height).key("pixels").block(texture.rgba).end_object();
  reply.end_array();
}

void describe_meshes(const place::Interior& interior, const DrawnMeshes& drawn, Reply& reply) {
  reply.key("meshes").object().key("positions").block(drawn.positions).key("normals").block(drawn.normals);
  reply.key("colors").block(drawn.colors).key("coordinates").block(drawn.coordinates).key("parts").array();
  for (const DrawnMesh& mesh : drawn.meshes) {
    reply.object().key("style").value(mesh.style).key("part").value(mesh.part);
    reply.key("name").value(mesh.part < 0 ? std::string_view("frames") : interior.parts[static_cast<std::size_t>(mesh.part)].name);
    reply.key("lamp").value(mesh.part < 0 ? -1 : light::lamp_of_part(interior.parts[static_cast<std::size_t>(mesh.part)]));
    reply.key("indices").block(mesh.indices).end_object();
  }
  reply.end_array().end_object();
}

void describe_things(const scene::Scene& scene, const place::Interior& interior, const std::vector<light::PlacedLamp>& lamps,
                     Reply& reply) {
  const geometry::Space space = interior.polygon.space;
  reply.key("objects").array();
  for (const scene::Object& object : scene.objects) {
    geometry::Ambient sum{0, 0, 0};
    double low = interior.height, high = 0, extent = 0;
    const auto part = std::find_if(interior.parts.begin(), interior.parts.end(),
                                   [&](const place::PlacedMesh& p) { return p.kind == place::PartKind::object && p.name == object.name; });
    if (part == interior.parts.end() || part->floor.empty()) continue;
    for (const geometry::Point& p : part->floor) sum = sum + p;
    const geometry::Point at = geometry::normalised_point(space, (1.0 / static_cast<double>(part->floor.size())) * sum);
    for (const geometry::Point& p : part->floor) extent = std::max(extent, geometry::distance(space, at, p));
    for (const double z : part->z) low = std::min(low, z), high = std::max(high, z);
    reply.object().key("name").value(object.name).key("shape").value(name_of(object)).key("at").numbers(std::array{at.w, at.x, at.y, low});
    reply.key("extent").value(extent).key("top").value(high);
    reply.key("material").value(object.material ? name_of(object.material->kind) : "own");
    reply.key("pattern").value(object.material ? name_of(object.material->pattern) : "plain").end_object();
  }
  reply.end_array().key("lamps").array();
  for (const light::PlacedLamp& lamp : lamps) {
    const geometry::Position& c = lamp.centre;
    reply.object().key("kind").value(name_of(lamp.kind)).key("at").numbers(std::array{c.floor.w, c.floor.x, c.floor.y, c.z});
    add(reply, "power", lamp.power);
    reply.end_object();
  }
  reply.end_array();
}

void describe_eye(const place::Camera& eye, Reply& reply) {
  reply.key("eye").object().key("room_from_eye").array();
  for (const auto& row : geometry::matrix(eye.room_from_eye))
    for (const double number : row) reply.value(number);
  reply.end_array().key("z").value(eye.z);
  add(reply, "forward", eye.forward);
  add(reply, "right", eye.right);
  add(reply, "up", eye.up);
  reply.key("fov").value(eye.fov.radians).key("size").numbers(std::array<double, 2>{double(eye.width), double(eye.height)}).end_object();
}

}  // namespace orbc::html
