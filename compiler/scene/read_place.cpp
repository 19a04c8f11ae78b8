// Places: {toward: corner 2, distance: 0.3}, {xy: [x, y]}, {disk: [x, y]}, {polar: [r, 30deg]}, {walls: {1: 0.3, 2: 0.4}}, centre; each
// with an optional z.
#include <fmt/format.h>

#include "compiler/scene/readers.h"

namespace orbc::scene {
namespace {

constexpr const char* kPlaceForms =
    "centre, {xy: [x, y]}, {disk: [x, y]}, {polar: [r, 30deg]}, {toward: corner 2, distance: 0.3} or {walls: {1: 0.3, 2: 0.4}}";

// "7" → 7; 0 for words that are no wall or corner numbers.
int positive_integer(std::string_view digits) {
  if (digits.empty() || digits.size() > 6 || digits[0] == '0') return 0;
  int value = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') return 0;
    value = value * 10 + (c - '0');
  }
  return value;
}

std::string numbered(std::string_view noun, int count) {
  if (count == 0) return fmt::format("this room has no {}s", noun);
  return count == 1 ? fmt::format("this room has only {} 1", noun) : fmt::format("this room has {}s 1 to {}", noun, count);
}

AtToward read_toward(const Fields& fields, const RoomFacts& facts) {
  Reader& reader = fields.reader();
  AtToward toward;
  const Node& node = *fields.find("toward");
  fields.require("distance", "say how far from the centre: {toward: corner 2, distance: 0.3}");
  toward.distance = fields.number("distance", 0, kDistance);
  const std::string_view text = node.kind == NodeKind::scalar ? std::string_view(node.text) : std::string_view();
  const std::size_t blank = text.find(' ');
  const std::string_view noun = text.substr(0, blank);
  const int number = blank == std::string_view::npos ? 0 : positive_integer(text.substr(blank + 1));
  if ((noun != "corner" && noun != "wall") || number == 0) {
    if (node.kind != NodeKind::scalar) reader.wrong_type(node, "`toward`", "corner or wall and its number", "write corner 2 or wall 1");
    else reader.error("scene.unknown-value", node.span, "`toward` must be corner or wall and its number", "write corner 2 or wall 1");
    return toward;
  }
  toward.corner = noun == "corner";
  toward.number = number;
  const int count = toward.corner ? facts.corners : facts.walls;
  if (facts.walls > 0 && number > count)
    reader.error(toward.corner ? "scene.no-such-corner" : "scene.no-such-wall", node.span, fmt::format("there is no {} {}", noun, number),
                 numbered(noun, count));
  return toward;
}

AtWalls read_at_walls(Reader& reader, const Node& node, const RoomFacts& facts) {
  AtWalls at;
  if (node.kind != NodeKind::map) {
    reader.wrong_type(node, "`walls`", "two wall numbers with their distances", "write {walls: {1: 0.3, 2: 0.4}}");
    return at;
  }
  if (node.keys.size() != 2)
    reader.error("scene.wrong-count", node.span,
                 fmt::format("`walls` must name two walls with their distances, but names {}", node.keys.size()),
                 "write {walls: {1: 0.3, 2: 0.4}}");
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const int wall = read_wall_number(reader, node.keys[i], facts);
    const double distance = reader.number(node.items[i], fmt::format("the distance from wall {}", wall), 0, kDistance);
    if (i >= 2) continue;
    at.walls[i] = wall;
    at.distances[i] = distance;
  }
  return at;
}

AtPolar read_polar(Reader& reader, const Node& node) {
  AtPolar polar;
  if (!reader.list(node, "`polar`", 2, "a distance and a direction: [r, 30deg]")) return polar;
  polar.r = reader.number(node.items[0], "the distance", 0, kDistance);
  polar.angle = reader.angle(node.items[1], "the direction", {});
  return polar;
}

}  // namespace

int read_wall_number(Reader& reader, const Node& key, const RoomFacts& facts) {
  const int wall = positive_integer(key.text);
  if (wall == 0) {
    const std::string nearest = nearest_word(key.text, {"all"});
    reader.error("scene.unknown-key", key.span, "a wall is named by its number, counted from 1",
                 nearest.empty() ? numbered("wall", facts.walls) : "did you mean `all`?");
  } else if (facts.walls > 0 && wall > facts.walls) {
    reader.error("scene.no-such-wall", key.span, fmt::format("there is no wall {}", wall), numbered("wall", facts.walls));
  }
  return wall;
}

Place read_place(Reader& reader, const Node& node, const std::string& what, const RoomFacts& facts) {
  Place place;
  place.span = node.span;
  if (node.kind == NodeKind::scalar) {
    if (node.text != "centre" && node.text != "center")
      reader.error("scene.bad-place", node.span, fmt::format("{} must be a place", what), std::string("places are ") + kPlaceForms);
    return place;
  }
  if (node.kind != NodeKind::map) {
    reader.wrong_type(node, what, "a place", std::string("places are ") + kPlaceForms);
    return place;
  }
  const Fields fields(reader, node, what, {"xy", "disk", "polar", "toward", "distance", "walls", "z"});
  const std::string kind = fields.only_one_of({"xy", "disk", "polar", "toward", "walls"});
  if (kind == "xy") {
    const auto xy = reader.numbers<2>(*fields.find("xy"), "`xy`", {0, 0}, {-kMaxLength, kMaxLength}, "two lengths: [x, y]");
    place.floor = AtXy{xy[0], xy[1]};
  } else if (kind == "disk") {
    const auto xy = reader.numbers<2>(*fields.find("disk"), "`disk`", {0, 0}, {-kMaxLength, kMaxLength}, "two coordinates: [x, y]");
    place.floor = AtDisk{{xy[0], xy[1]}};
  } else if (kind == "polar") {
    place.floor = read_polar(reader, *fields.find("polar"));
  } else if (kind == "toward") {
    place.floor = read_toward(fields, facts);
  } else if (kind == "walls") {
    place.floor = read_at_walls(reader, *fields.find("walls"), facts);
  }
  if (kind != "toward" && fields.has("distance"))
    reader.error("scene.conflict", fields.key_span("distance"), "`distance` belongs to `toward`",
                 "write {toward: corner 2, distance: 0.3}");
  if (fields.has("z")) place.z = fields.number("z", 0, kDistance);
  else if (kind.empty() && fields.is_map() && node.keys.empty())
    reader.error("scene.bad-place", node.span, fmt::format("{} must be a place, but is empty", what),
                 std::string("places are ") + kPlaceForms);
  return place;
}

}  // namespace orbc::scene
