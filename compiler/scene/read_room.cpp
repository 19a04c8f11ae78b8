// The room: shape, height, floor, ceiling and walls. A wall's own entry replaces the values of the entry `all`.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/scene/defaults.h"
#include "compiler/scene/readers.h"

namespace orbc::scene {
namespace {

std::vector<std::string> with_material_keys(std::vector<std::string> keys) {
  keys.insert(keys.end(), material_keys().begin(), material_keys().end());
  return keys;
}

constexpr const char* kPlainWallHint = "`mirror: none` makes the wall plain, `span` and `height` make the mirror smaller";

bool is_none(const Node& node) { return node.kind == NodeKind::scalar && node.text == "none"; }

std::vector<Cut> read_cuts(Reader& reader, const Node& node, double length, const RoomFacts& facts) {
  std::vector<Cut> cuts;
  if (node.kind != NodeKind::list) {
    reader.wrong_type(node, "`cuts`", "a list of cuts", "write [{walls: [2, 4], length: 1.4}]");
    return cuts;
  }
  for (const Node& item : node.items) {
    const Fields fields(reader, item, "a cut", {"walls", "length"});
    fields.require("walls", "write {walls: [2, 4], length: 1.4}");
    Cut cut;
    cut.length = fields.number("length", length, kLength);
    if (const Node* walls = fields.find("walls"); walls && reader.list(*walls, "`walls`", 2, "a list of two wall numbers")) {
      for (std::size_t i = 0; i < 2; ++i) {
        cut.walls[i] = reader.integer(walls->items[i], "a wall number", 1, 1, 999'999);
        if (facts.walls > 0 && cut.walls[i] > facts.walls)
          reader.error("scene.no-such-wall", walls->items[i].span, fmt::format("there is no wall {}", cut.walls[i]),
                       fmt::format("this room has walls 1 to {}", facts.walls));
      }
    }
    cuts.push_back(cut);
  }
  return cuts;
}

/// "wall 3", "1.5 wall 3" or "1.5 * wall 3": the length of a wall as a multiple of another's. Nothing if the text is of another form.
std::optional<LengthRelation> relation_of(int wall, const std::string& text) {
  const auto trimmed = [](std::string_view part, std::string_view marks) {
    part.remove_prefix(std::min(part.find_first_not_of(" "), part.size()));
    return part.substr(0, part.find_last_not_of(marks) + 1);
  };
  const auto number = [](std::string_view part) {
    Node node;
    node.kind = NodeKind::scalar;
    node.text = part;
    return number_of(node);
  };
  const std::size_t name = text.find("wall");
  if (name == std::string::npos) return std::nullopt;
  const std::string_view before = trimmed(std::string_view(text).substr(0, name), " *"),
                         after = trimmed(std::string_view(text).substr(name + 4), " ");
  const auto factor = before.empty() ? std::optional<double>(1) : number(before), of = number(after);
  if (!factor || !of || !(*factor > 0 && *factor <= 1000) || !(*of >= 1 && *of <= 999'999) || *of != static_cast<int>(*of))
    return std::nullopt;
  return LengthRelation{wall, *factor, static_cast<int>(*of)};
}

void read_lengths(Reader& reader, const Node& node, const RoomFacts& facts, Shape& shape) {
  if (node.kind != NodeKind::map) {
    reader.wrong_type(node, "`lengths`", "a map of wall numbers to side lengths", "write {1: 0.8, 2: 1.1}");
    return;
  }
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const int wall = read_wall_number(reader, node.keys[i], facts);
    const Node& item = node.items[i];
    if (item.kind != NodeKind::scalar || item.text.find("wall") == std::string::npos) {
      shape.lengths[wall] = reader.number(item, fmt::format("the length of wall {}", wall), 1, kLength);
      continue;
    }
    const auto relation = relation_of(wall, item.text);
    if (!relation)
      reader.wrong_type(item, fmt::format("the length of wall {}", wall), "a number, or a multiple of another wall's length",
                        "write 0.8, wall 3 or 1.5 wall 3");
    else if (facts.walls > 0 && (relation->of < 1 || relation->of > facts.walls))
      reader.error("scene.no-such-wall", item.span, fmt::format("there is no wall {}", relation->of),
                   fmt::format("this room has walls 1 to {}", facts.walls));
    else shape.relations.push_back(*relation);
  }
  std::sort(shape.relations.begin(), shape.relations.end(), [](const auto& a, const auto& b) { return a.wall < b.wall; });
}

// Keys that have no effect in this room give a warning and are reset to their defaults, so that one scene can be tried with many notations.
void reset_unused_keys(const Fields& room, const RoomFacts& facts, Shape& shape) {
  const Shape standard;
  if (!facts.flat)
  {
    room.no_effect("scale", "in spherical and hyperbolic rooms the angles fix all lengths; the unit is the curvature radius");
    shape.scale = standard.scale;
  }
  if (!facts.rectangle) {
    room.no_effect("aspect", "only `*2222` may be stretched");
    shape.aspect = standard.aspect;
  }
  if (!facts.orbifold.strip) {
    room.no_effect("length", "it belongs to the strips `**` and `*22∞`");
    shape.strip_length = standard.strip_length;
  }
  if (shape.kind != ShapeKind::paper) {
    for (const char* key : {"cut", "cuts"}) room.no_effect(key, "it belongs to `shape: paper`");
    shape.cuts.clear();
  }
  if (shape.kind != ShapeKind::lengths) {
    room.no_effect("lengths", "it belongs to `shape: lengths`");
    shape.lengths.clear();
    shape.relations.clear();
  }
}

Shape read_shape(const Fields& room, const RoomFacts& facts) {
  Shape shape;
  shape.span = room.has("shape") ? room.find("shape")->span : room.node().span;
  shape.kind = room.choice<ShapeKind>(
      "shape", shape.kind, {{"tangential", ShapeKind::tangential}, {"paper", ShapeKind::paper}, {"lengths", ShapeKind::lengths}});
  shape.cut = room.number("cut", shape.cut, kLength);
  if (const Node* cuts = room.find("cuts")) shape.cuts = read_cuts(room.reader(), *cuts, shape.cut, facts);
  if (const Node* lengths = room.find("lengths")) read_lengths(room.reader(), *lengths, facts, shape);
  shape.scale = room.number("scale", shape.scale, kLength);
  shape.aspect = room.number("aspect", shape.aspect, {0.001, 1000});
  shape.strip_length = room.number("length", shape.strip_length, kLength);
  if (facts.walls > 0) reset_unused_keys(room, facts, shape);
  if (shape.kind == ShapeKind::lengths) room.require("lengths", "give the side lengths of all walls but three: lengths: {1: 0.8, 2: 1.1}");
  return shape;
}

// A mirror as given in the file.
struct MirrorEntry {
  Mirror mirror;
  bool frame_given = false;         // then the wall's frame is not used, even with `frame: none`
};

// The keys of a wall as given in the file; the others come from `all` and the defaults.
struct WallEntry {
  std::optional<Material> material;
  std::optional<std::vector<MirrorEntry>> mirrors;
  std::optional<std::optional<Frame>> frame;
  SourceSpan span;
};

std::optional<Frame> read_frame(Reader& reader, const Node& node) {
  if (is_none(node)) return std::nullopt;
  Frame frame = default_frame();
  const Fields fields(reader, node, "a frame", with_material_keys({"width"}));
  frame.width = fields.number("width", frame.width, kLength);
  if (has_material_key(fields)) frame.material = read_material_keys(fields, frame.material);
  return frame;
}

std::optional<std::array<double, 2>> read_interval(const Fields& fields, const char* key, const char* wanted) {
  const Node* node = fields.find(key);
  if (!node) return std::nullopt;
  const auto interval = fields.reader().numbers<2>(*node, fmt::format("`{}`", key), {0, 1}, kDistance, wanted);
  if (interval[0] < interval[1]) return interval;
  fields.reader().error("scene.bad-interval", node->span,
                        fmt::format("`{}` goes from {} to {}: the first must be smaller", key, interval[0], interval[1]), wanted);
  return std::nullopt;
}

MirrorEntry read_mirror(Reader& reader, const Node& node, bool on_wall) {
  MirrorEntry entry;
  Mirror& mirror = entry.mirror;
  mirror.span = node.span;
  const std::vector<std::string> keys = {"reflectance", "tint", "glow", "span", "height", "frame"};
  const Fields fields(reader, node, on_wall ? "a mirror" : "a mirror on floor or ceiling",
                      {keys.begin(), keys.begin() + (on_wall ? 6 : 3)});
  mirror.reflectance = fields.number("reflectance", mirror.reflectance, kUnit);
  mirror.tint = fields.color("tint", mirror.tint);
  mirror.emission = fields.color("glow", mirror.emission);
  if (!on_wall) return entry;
  mirror.arc = read_interval(fields, "span", "a list of two lengths along the wall, from its first corner: [0.1, 0.5]");
  mirror.height = read_interval(fields, "height", "a list of two heights above the floor: [0.2, 0.9]");
  if (const Node* frame = fields.find("frame")) {
    mirror.frame = read_frame(reader, *frame);
    entry.frame_given = true;
  }
  return entry;
}

std::vector<MirrorEntry> read_mirrors(Reader& reader, const Node& node) {
  std::vector<MirrorEntry> mirrors;
  if (is_none(node)) return mirrors;
  if (node.kind != NodeKind::list) {
    reader.wrong_type(node, "`mirrors`", "a list of mirrors", "one mirror alone is `mirror: {…}`");
    return mirrors;
  }
  for (const Node& item : node.items) mirrors.push_back(read_mirror(reader, item, true));
  return mirrors;
}

WallEntry read_wall(Reader& reader, const Node& node, const std::string& what) {
  WallEntry wall;
  wall.span = node.span;
  const Fields fields(reader, node, what, with_material_keys({"mirror", "mirrors", "frame"}));
  if (has_material_key(fields)) wall.material = read_material_keys(fields, default_wall(false).material);
  const std::string key = fields.only_one_of({"mirror", "mirrors"});
  if (key == "mirror") {
    const Node& mirror = *fields.find("mirror");
    wall.mirrors.emplace();
    if (!is_none(mirror)) wall.mirrors->push_back(read_mirror(reader, mirror, true));
  } else if (key == "mirrors") {
    wall.mirrors = read_mirrors(reader, *fields.find("mirrors"));
  }
  if (const Node* frame = fields.find("frame")) wall.frame = read_frame(reader, *frame);
  return wall;
}

// Whether one mirror covers all of the wall, so that its material is not visible.
bool is_hidden_by_mirror(const Wall& wall) { return wall.mirrors.size() == 1 && !wall.mirrors[0].arc && !wall.mirrors[0].height; }

bool overlap(const std::optional<std::array<double, 2>>& a, const std::optional<std::array<double, 2>>& b) {
  return !a || !b || ((*a)[0] < (*b)[1] && (*b)[0] < (*a)[1]);
}

void check_mirrors(Reader& reader, const std::vector<MirrorEntry>& mirrors, double height) {
  for (std::size_t i = 0; i < mirrors.size(); ++i) {
    const Mirror& mirror = mirrors[i].mirror;
    if (mirror.height && (*mirror.height)[0] >= height)
      reader.error("scene.above-ceiling", mirror.span,
                   fmt::format("this mirror starts at height {}, but the room is only {} high", (*mirror.height)[0], height));
    else if (mirror.height && (*mirror.height)[1] > height)
      reader.warning(
          "scene.cut-off", mirror.span,
          fmt::format("this mirror reaches up to {}, but the room is only {} high: it is cut off there", (*mirror.height)[1], height));
    for (std::size_t j = 0; j < i; ++j)
      if (const Mirror& other = mirrors[j].mirror; overlap(mirror.arc, other.arc) && overlap(mirror.height, other.height)) {
        reader.error("scene.mirrors-overlap", mirror.span, fmt::format("this mirror overlaps the one of line {}", other.span.line),
                     "move one of them: mirrors of a wall may touch, not overlap");
        break;
      }
  }
}

Wall merge_wall_entries(const WallEntry& all, const WallEntry* own, bool end) {
  Wall wall = default_wall(end);
  wall.span = own ? own->span : all.span;
  for (const WallEntry* entry : {&all, own}) {
    if (!entry) continue;
    if (entry->material) wall.material = *entry->material;
  }
  const std::vector<MirrorEntry> standard = [&] {
    std::vector<MirrorEntry> entrys;
    for (Mirror& mirror : wall.mirrors) entrys.push_back({std::move(mirror), false});
    return entrys;
  }();
  const auto& mirrors = own && own->mirrors ? *own->mirrors : all.mirrors && !end ? *all.mirrors : standard;
  const auto& frame = own && own->frame ? own->frame : all.frame;
  wall.mirrors.clear();
  for (const MirrorEntry& entry : mirrors) {
    wall.mirrors.push_back(entry.mirror);
    if (!entry.frame_given && frame) wall.mirrors.back().frame = *frame;
  }
  return wall;
}

/// The entry of one wall in the file.
struct OwnEntry {
  const Node* node = nullptr;
  WallEntry entry;
};

void check_wall(Reader& reader, const OwnEntry& own_entry, const Wall& wall, const RoomFacts& facts, int number, double height) {
  const Node* own = own_entry.node;
  const WallEntry* entry = &own_entry.entry;
  if (own->kind != NodeKind::map) return;
  if (is_end_wall(facts.orbifold, number) && entry->mirrors && !entry->mirrors->empty()) {
    const bool half = notation::is_half_strip(facts.orbifold);
    reader.error("scene.end-wall-mirror", own->span,
                 fmt::format("wall {} closes the {} and cannot be a mirror", number, half ? "half strip `*22∞`" : "strip `**`"),
                 half ? "only walls 1, 2 and 4 of `*22∞` are mirrors; `*2222` has mirrors on all four"
                      : "only walls 1 and 3 of `**` are mirrors; `*22∞` has a third one across, `*2222` mirrors on all four");
  }
  if (entry->material && is_hidden_by_mirror(wall))
    reader.warning("scene.no-effect", entry->material->span,
                   fmt::format("nothing is seen of the material of wall {}: a mirror covers all of it", number), kPlainWallHint);
  if (entry->frame && *entry->frame && wall.mirrors.empty())
    reader.warning("scene.no-effect", own->span, fmt::format("wall {} has a frame but no mirror", number), "remove the frame");
  if (entry->mirrors) check_mirrors(reader, *entry->mirrors, height);
}

std::vector<Wall> read_walls(Reader& reader, const Node* node, const RoomFacts& facts, double height) {
  WallEntry all;
  std::map<int, OwnEntry> own;
  if (node && node->kind != NodeKind::map)
    reader.wrong_type(*node, "`walls`", "a map", "its keys are `all` and wall numbers: walls: {all: {…}, 2: {…}}");
  else if (node) {
    for (std::size_t i = 0; i < node->keys.size(); ++i) {
      if (node->keys[i].text == "all") {
        all = read_wall(reader, node->items[i], "`all`");
        if (all.mirrors) check_mirrors(reader, *all.mirrors, height);
      } else if (const int number = read_wall_number(reader, node->keys[i], facts)) {
        own[number] = {&node->items[i], read_wall(reader, node->items[i], fmt::format("wall {}", number))};
      }
    }
  }
  std::vector<Wall> walls;
  for (int number = 1; number <= facts.walls; ++number) {
    const auto found = own.find(number);
    const WallEntry* entry = found == own.end() ? nullptr : &found->second.entry;
    walls.push_back(merge_wall_entries(all, entry, is_end_wall(facts.orbifold, number)));
    if (found != own.end()) check_wall(reader, found->second, walls.back(), facts, number, height);
  }
  if (all.material && facts.walls > 0 && std::all_of(walls.begin(), walls.end(), is_hidden_by_mirror))
    reader.warning("scene.no-effect", all.material->span, "nothing is seen of the material of the walls: mirrors cover all of them",
                   kPlainWallHint);
  return walls;
}

// `floor: {cell: 0.5}` changes the default checker, `floor: {color: tan}` replaces it.
const Material& base_of_surface(const Fields& fields, const Surface& fallback) {
  static const std::vector<std::string> kStyleKeys = {"second", "cell", "kind", "roughness", "index", "emission"};
  static const Material kPlain;
  const bool kept = std::all_of(fields.node().keys.begin(), fields.node().keys.end(), [](const Node& key) {
    return std::find(kStyleKeys.begin(), kStyleKeys.end(), key.text) != kStyleKeys.end();
  });
  return kept ? fallback.material : kPlain;
}

Surface read_surface(Reader& reader, const Node& node, const std::string& what, const Surface& fallback) {
  Surface surface = fallback;
  surface.span = node.span;
  if (node.kind != NodeKind::map) {
    surface.material = read_material(reader, node, what, Material{});
    return surface;
  }
  const Fields fields(reader, node, what, with_material_keys({"mirror"}));
  if (has_material_key(fields)) surface.material = read_material_keys(fields, base_of_surface(fields, fallback));
  const Node* mirror = fields.find("mirror");
  if (!mirror || is_none(*mirror)) return surface;
  surface.mirror = read_mirror(reader, *mirror, false).mirror;
  for (const std::string& key : material_keys()) fields.no_effect(key, "a mirror covers all of it");
  return surface;
}

}  // namespace

RoomSpec read_room(Reader& reader, const Node& node, const RoomFacts& facts) {
  RoomSpec room;
  room.span = node.span;
  const Fields fields(reader, node, "the room",
                      {"shape", "cut", "cuts", "lengths", "scale", "aspect", "length", "height", "floor", "ceiling", "walls"});
  room.shape = read_shape(fields, facts);
  room.height = fields.number("height", room.height, kLength);
  room.floor = default_floor();
  room.ceiling = default_ceiling();
  if (const Node* floor = fields.find("floor")) room.floor = read_surface(reader, *floor, "`floor`", room.floor);
  if (const Node* ceiling = fields.find("ceiling")) room.ceiling = read_surface(reader, *ceiling, "`ceiling`", room.ceiling);
  room.walls = read_walls(reader, fields.find("walls"), facts, room.height);
  return room;
}

}  // namespace orbc::scene
