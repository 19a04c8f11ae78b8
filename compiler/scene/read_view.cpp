// Lamps, camera, bake and cover.
#include <fmt/format.h>

#include "compiler/scene/readers.h"

namespace orbc::scene {
namespace {

constexpr int kMaxPixels = 32768;                  // along an edge
constexpr double kMaxPictureArea = 268'435'456;    // 2^28 pixels: 1 GiB as RGBA

void warn_unused_keys(const Fields& fields, LampKind kind) {
  const bool round = kind == LampKind::sphere || kind == LampKind::disk || kind == LampKind::tube;
  if (!round) fields.no_effect("radius", "it belongs to spheres, disks and tubes");
  if (kind != LampKind::rectangle) fields.no_effect("size", "it belongs to `kind: rectangle`");
  if (kind == LampKind::point || kind == LampKind::spot) fields.no_effect("visible", "points and spots have no body");
  if (kind != LampKind::spot) fields.no_effect("cone", "it belongs to `kind: spot`");
  if (kind == LampKind::point || kind == LampKind::sphere) fields.no_effect("to", "this lamp shines to all sides");
}

Lamp read_lamp(Reader& reader, const Node& node, const RoomFacts& facts) {
  Lamp lamp;
  lamp.span = node.span;
  const Fields fields(reader, node, "a light",
                      {"kind", "at", "to", "radius", "size", "power", "color", "temperature", "cone", "visible", "falloff"});
  lamp.kind = fields.choice<LampKind>("kind", lamp.kind,
                                      {{"point", LampKind::point}, {"sphere", LampKind::sphere}, {"rectangle", LampKind::rectangle},
                                       {"disk", LampKind::disk}, {"tube", LampKind::tube}, {"spot", LampKind::spot}});
  fields.require("at", "say where it hangs: at: {polar: [0, 0deg], z: 1.1}");
  if (const Node* at = fields.find("at")) lamp.place = read_place(reader, *at, "`at`", facts);
  if (const Node* to = fields.find("to")) lamp.to = read_place(reader, *to, "`to`", facts);
  else if (lamp.kind == LampKind::tube) fields.require("to", "a tube reaches from `at` to `to`");
  lamp.radius = fields.number("radius", lamp.radius, kLength);
  if (const Node* size = fields.find("size"))
    lamp.size = reader.numbers<2>(*size, "`size`", lamp.size, kLength, "a list of two lengths: [width, depth]");
  lamp.power = fields.number("power", lamp.power, {0, 1e9, true});
  if (fields.only_one_of({"color", "temperature"}) == "temperature")
    lamp.color = color_of_temperature(fields.number("temperature", 6500, {1667, 25000}));
  else lamp.color = fields.color("color", lamp.color);
  lamp.cone = fields.angle("cone", lamp.cone, {0, 180, true});
  lamp.visible = fields.boolean("visible", lamp.visible);
  lamp.falloff = fields.choice<Falloff>(
      "falloff", lamp.falloff, {{"geodesic", Falloff::geodesic}, {"inverse_square", Falloff::inverse_square}, {"none", Falloff::none}});
  warn_unused_keys(fields, lamp.kind);
  return lamp;
}

std::array<int, 2> read_picture_size(Reader& reader, const Node& node, std::array<int, 2> size) {
  if (!reader.list(node, "`size`", 2, "width and height in pixels: [800, 600]")) return size;
  for (std::size_t i = 0; i < 2; ++i) size[i] = reader.integer(node.items[i], i == 0 ? "the width" : "the height", size[i], 1, kMaxPixels);
  if (static_cast<double>(size[0]) * size[1] > kMaxPictureArea)
    reader.error("scene.picture-too-large", node.span, fmt::format("a picture of {}×{} pixels is too large", size[0], size[1]),
                 fmt::format("at most {} pixels in all, 16384×16384", static_cast<long>(kMaxPictureArea)));
  return size;
}

std::variant<LookAtObject, Place, LookDirection> read_look_at(Reader& reader, const Node& node, const RoomFacts& facts) {
  if (node.kind == NodeKind::scalar && node.text != "centre" && node.text != "center") {
    if (auto name = reader.text(node, "`look_at`")) return LookAtObject{*name};
    return LookDirection{};
  }
  if (!node.find("azimuth") && !node.find("elevation")) {
    const std::size_t before = reader.diagnostics.size();
    const Place place = read_place(reader, node, "`look_at`", facts);
    if (reader.diagnostics.size() > before) return LookDirection{};  // so that a wrong place gives no further errors
    return place;
  }
  const Fields fields(reader, node, "a direction of view", {"azimuth", "elevation"});
  return LookDirection{fields.angle("azimuth", {}), fields.angle("elevation", {}, {-90, 90})};
}

std::variant<double, LookAtObject, Place> read_focus(Reader& reader, const Node& node, const RoomFacts& facts) {
  if (number_of(node) && !node.quoted) {
    reader.wrong_type(node, "`focus`", "the name of an object, or a place", "a distance is written focus_distance: 0.8");
  } else if (node.kind != NodeKind::scalar || node.text == "centre" || node.text == "center") {
    return read_place(reader, node, "`focus`", facts);
  } else if (auto name = reader.text(node, "`focus`")) {
    return LookAtObject{*name};
  }
  return 1.0;
}

Lens read_lens(Reader& reader, const Node& node, const RoomFacts& facts) {
  Lens lens;
  const Fields fields(reader, node, "the lens", {"radius", "focus", "focus_distance"});
  lens.radius_span = lens.focus.span = node.span;
  lens.focus.value = 1.0;
  lens.radius = fields.number("radius", lens.radius, kLength);
  if (const Node* radius = fields.find("radius")) lens.radius_span = radius->span;
  const std::string key = fields.only_one_of({"focus_distance", "focus"});
  if (key.empty()) {
    fields.require("focus", "say what is sharp: focus: statue or focus_distance: 0.8");
    return lens;
  }
  lens.focus.span = fields.find(key)->span;
  if (key == "focus") lens.focus.value = read_focus(reader, *fields.find(key), facts);
  else lens.focus.value = fields.number(key, 1, kLength);
  return lens;
}

}  // namespace

std::vector<Lamp> read_lamps(Reader& reader, const Node& node, const RoomFacts& facts) {
  std::vector<Lamp> lamps;
  if (node.kind != NodeKind::list) {
    reader.wrong_type(node, "`lights`", "a list of lights",
                      node.kind == NodeKind::map ? "start each light with a dash: - {kind: sphere, at: {…}}" : "");
    return lamps;
  }
  for (const Node& item : node.items) lamps.push_back(read_lamp(reader, item, facts));
  return lamps;
}

Camera read_camera(Reader& reader, const Node& node, const RoomFacts& facts) {
  Camera camera;
  camera.span = camera.place.span = node.span;
  const Fields fields(reader, node, "the camera", {"at", "look_at", "fov", "roll", "lens", "size", "projection", "eye_separation"});
  if (const Node* at = fields.find("at")) camera.place = read_place(reader, *at, "`at`", facts);
  camera.projection = fields.choice<Projection>("projection", camera.projection,
                                                {{"perspective", Projection::perspective},
                                                 {"panorama", Projection::panorama},
                                                 {"cylinder", Projection::cylinder},
                                                 {"stereo", Projection::stereo}});
  const bool perspective = camera.projection == Projection::perspective;
  if (const Node* fov = fields.find("fov")) camera.fov_span = fov->span;
  camera.fov = fields.angle("fov", camera.fov, perspective ? Range{1, 170} : Range{1, 360});
  const bool stereo = camera.projection == Projection::stereo;
  if (camera.projection == Projection::panorama || stereo) fields.no_effect("fov", "a panorama shows all directions");
  if (const Node* separation = fields.find("eye_separation")) {
    camera.eye_separation = fields.number("eye_separation", 0, kLength);
    camera.eye_separation_span = separation->span;
  }
  if (!stereo) fields.no_effect("eye_separation", "only `projection: stereo` has two eyes");
  camera.roll = fields.angle("roll", camera.roll);
  if (const Node* lens = fields.find("lens")) camera.lens = read_lens(reader, *lens, facts);
  if (!perspective) {
    fields.no_effect("roll", "a picture all around keeps its horizon level");
    fields.no_effect("lens", "only a perspective camera has one");
  }
  if (const Node* size = fields.find("size")) {
    camera.size_span = size->span;
    camera.size = read_picture_size(reader, *size, camera.size);
  }
  const Node* look_at = fields.find("look_at");
  if (look_at) camera.look_at = {read_look_at(reader, *look_at, facts), look_at->span};
  // A camera at the centre cannot look at the centre.
  else if (std::holds_alternative<AtCentre>(camera.place.floor)) camera.look_at.value = LookDirection{};
  else camera.look_at.value = Place{};
  return camera;
}

BakeSpec read_bake(Reader& reader, const Node& node, Integrator integrator) {
  BakeSpec bake;
  const Fields fields(reader, node, "the bake", {"atlas", "lights", "bounces", "mirrors", "samples", "quality", "seed"});
  bake.lights = fields.choice<LightMode>("lights", bake.lights, {{"baked", LightMode::baked}, {"native", LightMode::native}});
  bake.atlas =
      fields.choice<AtlasFormat>("atlas", bake.atlas, {{"8", AtlasFormat::srgb8}, {"16", AtlasFormat::srgb16}, {"exr", AtlasFormat::exr}});
  bake.indirect_bounces = fields.integer("bounces", bake.indirect_bounces, 0, 64);
  bake.mirror_bounces = fields.integer("mirrors", bake.mirror_bounces, 0, 12);
  if (const Node* mirrors = fields.find("mirrors")) bake.mirror_bounces_span = mirrors->span;
  if (fields.has("samples")) bake.samples = fields.integer("samples", 256, 1, 65536);
  bake.quality = fields.choice<BakeQuality>("quality", bake.quality,
                                            {{"draft", BakeQuality::draft}, {"normal", BakeQuality::normal}, {"fine", BakeQuality::fine}});
  bake.seed = fields.integer("seed", bake.seed, 0, 1'000'000'000);
  if (integrator == Integrator::path) return bake;
  for (const char* key : {"bounces", "samples", "seed"})
    fields.no_effect(key, "it belongs to `integrator: path`; without it surfaces pass no light on");
  return bake;
}

CoverSpec read_cover(Reader& reader, const Node& node, CoverSpec cover) {
  const Fields fields(reader, node, "the cover", {"max_bounces", "min_weight", "min_pixels", "background"});
  cover.max_bounces = fields.integer("max_bounces", cover.max_bounces, 0, 1000);
  cover.min_weight = fields.number("min_weight", cover.min_weight, kUnit);
  cover.min_pixels = fields.number("min_pixels", cover.min_pixels, kDistance);
  const Node* background = fields.find("background");
  if (background && background->kind == NodeKind::scalar && background->text == "expected") cover.background_expected = true;
  else cover.background = fields.color("background", cover.background);
  return cover;
}

}  // namespace orbc::scene
