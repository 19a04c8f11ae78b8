// Objects: each is a mesh file or a primitive at a place.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compiler/scene/readers.h"

namespace orbc::scene {
namespace {

const std::vector<std::string>& shape_keys() {
  static const std::vector<std::string> keys = {"mesh", "sphere", "cylinder", "box", "torus", "torus_knot", "beam"};
  return keys;
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

// "meshes/Statue.obj" → "Statue" and "obj"
struct FileName {
  std::string stem, ending;
};

FileName split(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  const std::size_t dot = name.find_last_of('.');
  if (dot == std::string::npos || dot == 0) return {name, ""};
  return {name.substr(0, dot), lower(name.substr(dot + 1))};
}

MeshFile read_mesh(Reader& reader, const Node& node) {
  MeshFile mesh;
  const auto path = reader.text(node, "`mesh`");
  if (!path) return mesh;
  mesh.path = {*path, node.span};
  static const std::vector<std::string> kEndings = {"obj", "ply", "off", "stl", "gltf", "glb"};
  const std::string ending = split(*path).ending;
  if (std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end()) return mesh;
  const std::string nearest = nearest_word(ending, kEndings);
  reader.error("scene.unknown-format", node.span,
               fmt::format("the mesh's name must end in {}", listed({".obj", ".ply", ".off", ".stl", ".gltf", ".glb"})),
               nearest.empty() ? "" : fmt::format("did you mean `.{}`?", nearest));
  return mesh;
}

TorusSpec read_torus(Reader& reader, const Node& node) {
  TorusSpec torus;
  const Fields fields(reader, node, "a torus", {"radius", "tube"});
  torus.radius = fields.number("radius", torus.radius, kLength);
  torus.tube = fields.number("tube", std::min(torus.tube, torus.radius / 3), kLength);
  if (torus.tube >= torus.radius)
    reader.error("scene.bad-torus", fields.key_span("tube"),
                 fmt::format("the tube ({}) must be thinner than the torus's radius ({})", torus.tube, torus.radius));
  return torus;
}

TorusKnotSpec read_torus_knot(Reader& reader, const Node& node) {
  TorusKnotSpec knot;
  const Fields fields(reader, node, "a torus knot", {"p", "q", "radius", "tube"});
  knot.p = fields.integer("p", knot.p, 1, 50);
  knot.q = fields.integer("q", knot.q, 1, 50);
  knot.radius = fields.number("radius", knot.radius, kLength);
  knot.tube = fields.number("tube", std::min(knot.tube, knot.radius * 4 / 15), kLength);
  if (std::gcd(knot.p, knot.q) != 1)
    reader.error("scene.bad-torus", fields.key_span("q"),
                 fmt::format("p = {} and q = {} have a common divisor: that is no single knot", knot.p, knot.q),
                 "take 2 and 3, 2 and 5, 3 and 4, …");
  if (knot.tube >= knot.radius)
    reader.error("scene.bad-torus", fields.key_span("tube"),
                 fmt::format("the tube ({}) must be thinner than the knot's radius ({})", knot.tube, knot.radius));
  return knot;
}

BarSpec read_bar(Reader& reader, const Node& node, const RoomFacts& facts) {
  BarSpec bar;
  const Fields fields(reader, node, "a beam", {"from", "to", "width"});
  fields.require("from", "write {from: {…}, to: {…}}");
  fields.require("to", "write {from: {…}, to: {…}}");
  if (const Node* from = fields.find("from")) bar.from = read_place(reader, *from, "`from`", facts);
  if (const Node* to = fields.find("to")) bar.to = read_place(reader, *to, "`to`", facts);
  bar.width = fields.number("width", bar.width, kLength);
  return bar;
}

void read_shape(const Fields& fields, const std::string& key, const RoomFacts& facts, Object& object) {
  Reader& reader = fields.reader();
  const Node& node = *fields.find(key);
  if (key == "mesh") {
    object.shape = read_mesh(reader, node);
  } else if (key == "sphere") {
    const Fields sphere(reader, node, "a sphere", {"radius"});
    object.shape = SphereSpec{sphere.number("radius", SphereSpec{}.radius, kLength)};
  } else if (key == "cylinder") {
    const Fields cylinder(reader, node, "a cylinder", {"radius", "height"});
    object.shape =
        CylinderSpec{cylinder.number("radius", CylinderSpec{}.radius, kLength), cylinder.number("height", CylinderSpec{}.height, kLength)};
  } else if (key == "box") {
    const Fields box(reader, node, "a box", {"size"});
    BoxSpec spec;
    if (const Node* size = box.find("size"))
      spec.size = reader.numbers<3>(*size, "`size`", spec.size, kLength, "a list of three lengths: [x, y, z]");
    object.shape = spec;
  } else if (key == "torus") {
    object.shape = read_torus(reader, node);
  } else if (key == "torus_knot") {
    object.shape = read_torus_knot(reader, node);
  } else if (key == "beam") {
    object.shape = read_bar(reader, node, facts);
  }
}

void read_material_of(const Fields& fields, Object& object) {
  const std::string key = fields.only_one_of({"material", "color"});
  if (key == "material") object.material = read_material(fields.reader(), *fields.find("material"), "`material`", Material{});
  if (key != "color") return;
  object.material.emplace();
  object.material->color = fields.color("color", object.material->color);
  object.material->span = fields.find("color")->span;
}

// Factors of 0, and factors so small that a mesh would vanish, are errors.
void read_scale(Reader& reader, const Node& node, Object& object) {
  constexpr double kMinScaleFactor = 1e-6;
  const std::size_t before = reader.diagnostics.size();
  object.scale = reader.numbers<3>(node, "`scale`", object.scale, {-kMaxLength, kMaxLength}, "a list of three factors: [x, y, z]");
  if (reader.diagnostics.size() > before) return;
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(object.scale[i]) >= kMinScaleFactor) continue;
    reader.error("scene.out-of-range", node.items[i].span, fmt::format("a factor of `scale` must not be 0, nor below {}", kMinScaleFactor),
                 "1 leaves a length as it is, -1 makes a mirror image");
    object.scale[i] = 1;
  }
}

void read_rotate(Reader& reader, const Node& node, Object& object) {
  if (!reader.list(node, "`rotate`", 3, "a list of three angles, about x, y and z: [90deg, 0, 0]")) return;
  for (std::size_t i = 0; i < 3; ++i) object.rotate[i] = reader.angle(node.items[i], "the angle", {});
}

// Reads `up`, `scale` and `rotate`.
void read_pose(const Fields& fields, Object& object) {
  const auto* mesh = std::get_if<MeshFile>(&object.shape);
  const std::string ending = mesh ? split(mesh->path.value).ending : "";
  object.up = fields.choice<Axis>("up", ending == "gltf" || ending == "glb" ? Axis::plus_y : Axis::plus_z,
                                  {{"x", Axis::plus_x}, {"-x", Axis::minus_x}, {"y", Axis::plus_y}, {"-y", Axis::minus_y},
                                   {"z", Axis::plus_z}, {"-z", Axis::minus_z}});
  if (const Node* scale = fields.find("scale")) read_scale(fields.reader(), *scale, object);
  if (const Node* rotate = fields.find("rotate")) read_rotate(fields.reader(), *rotate, object);
}

// A bar (key `beam`) is placed by its ends alone.
void refuse_pose_of_bar(const Fields& fields) {
  for (const char* key : {"up", "scale", "rotate"})
    if (fields.has(key))
      fields.reader().error("scene.conflict", fields.key_span(key), fmt::format("a beam has no `{}`: it reaches from `from` to `to`", key),
                            "move its ends, or set its `width`");
  for (const char* key : {"at", "size", "turn", "embedding"}) fields.no_effect(key, "a beam reaches from `from` to `to`");
}

Object read_object(Reader& reader, const Node& node, const RoomFacts& facts) {
  Object object;
  object.span = node.span;
  std::vector<std::string> keys = {"name", "size", "embedding", "up", "scale", "rotate", "at", "turn", "material", "color"};
  keys.insert(keys.begin() + 1, shape_keys().begin(), shape_keys().end());
  const Fields fields(reader, node, "an object", keys);
  const std::string shape = fields.only_one_of(shape_keys());
  if (shape.empty() && fields.is_map())
    reader.error("scene.missing-key", node.span, "an object needs one of the keys " + listed(shape_keys()),
                 "write - mesh: meshes/statue.obj or - sphere: {radius: 0.1}");
  if (!shape.empty()) read_shape(fields, shape, facts, object);
  if (const Node* size = fields.find("size")) {
    object.size = fields.number("size", 1, kLength);
    object.size_span = size->span;
  }
  // The exponential embedding preserves lengths along straight lines from the axis, as the primitives' dimensions are meant.
  object.embedding = fields.choice<Embedding>("embedding", shape == "mesh" ? Embedding::conformal : Embedding::exponential,
                                              {{"conformal", Embedding::conformal}, {"exponential", Embedding::exponential}});
  read_pose(fields, object);
  if (const Node* at = fields.find("at")) object.place = read_place(reader, *at, "`at`", facts);
  else object.place.span = node.span;
  object.turn = fields.angle("turn", {});
  read_material_of(fields, object);
  if (shape == "beam") refuse_pose_of_bar(fields);
  const auto* mesh = std::get_if<MeshFile>(&object.shape);
  object.name = mesh ? split(mesh->path.value).stem : shape;
  const Node* name = fields.find("name");
  if (!name) return object;
  object.name_span = name->span;
  if (auto text = reader.text(*name, "`name`")) object.name = *text;
  return object;
}

// Given names must be different. Other names avoid them: "sphere", "sphere-2", …
void make_names_unique(Reader& reader, std::vector<Object>& objects) {
  std::map<std::string, SourceSpan> taken = {{"centre", {}}, {"center", {}}};
  for (const Object& object : objects) {
    if (!object.name_span.source) continue;
    const auto [first, fresh] = taken.emplace(object.name, object.name_span);
    if (fresh) continue;
    if (first->second.source)
      reader.error("scene.duplicate-name", object.name_span, fmt::format("the name is taken: line {} has it too", first->second.line),
                   "give each object its own name");
    else reader.error("scene.duplicate-name", object.name_span, "this word means the centre of the room", "give the object another name");
  }
  std::map<std::string, int> next;
  for (Object& object : objects) {
    if (object.name_span.source) continue;
    const std::string base = object.name;
    int& number = next[base];
    do object.name = ++number == 1 ? base : fmt::format("{}-{}", base, number);
    while (!taken.emplace(object.name, object.span).second);
  }
}

}  // namespace

std::vector<std::string> object_names(const Node& node) {
  std::vector<Object> objects;
  for (const Node& item : node.items) {
    Object& object = objects.emplace_back();
    for (const std::string& shape : shape_keys())
      if (const Node* found = item.find(shape); found && object.name.empty())
        object.name = shape == "mesh" ? split(found->text).stem : shape;
    const Node* name = item.find("name");
    if (!name || name->text.empty()) continue;
    object.name = name->text;
    object.name_span = name->span;
  }
  Reader discarded;
  make_names_unique(discarded, objects);
  std::vector<std::string> names;
  for (const Object& object : objects) names.push_back(object.name);
  return names;
}

std::vector<Object> read_objects(Reader& reader, const Node& node, const RoomFacts& facts) {
  std::vector<Object> objects;
  if (node.kind != NodeKind::list) {
    reader.wrong_type(node, "`objects`", "a list of objects",
                      node.kind == NodeKind::map ? "start each object with a dash: - sphere: {radius: 0.1}" : "");
    return objects;
  }
  for (const Node& item : node.items) objects.push_back(read_object(reader, item, facts));
  make_names_unique(reader, objects);
  return objects;
}

}  // namespace orbc::scene
