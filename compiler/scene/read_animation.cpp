// The key `animation`: frames, and how values move.
#include <fmt/format.h>

#include "compiler/scene/animation.h"
#include "compiler/scene/readers.h"

namespace orbc::scene {
namespace {

constexpr int kMaxFrames = 1'000'000;
constexpr int kMaxLaps = 1000;

std::vector<Keyframe> read_keys(Reader& reader, const Node& node) {
  std::vector<Keyframe> keys;
  const char* wanted = "a list of moments with their values: [[0, 0.9], [0.5, 0.1]]";
  if (node.kind != NodeKind::list || node.items.empty()) {
    reader.wrong_type(node, "`keys`", wanted);
    return keys;
  }
  for (const Node& item : node.items) {
    if (!reader.list(item, "a key", 2, "a moment and a value: [0.5, 0.1]")) continue;
    const double t = reader.number(item.items[0], "the moment", 0, kUnit);
    if (!keys.empty() && t <= keys.back().t)
      reader.error("scene.animation-keys", item.items[0].span, fmt::format("moment {} does not come after {}", t, keys.back().t),
                   "moments ascend, from 0 to 1");
    keys.push_back({t, item.items[1]});
  }
  return keys;
}

Keyframes read_keyframes(const Fields& fields) {
  Keyframes motion;
  motion.interpolation =
      fields.choice<Interpolation>("interpolate", Interpolation::linear,
                                   {{"linear", Interpolation::linear}, {"smooth", Interpolation::smooth}, {"step", Interpolation::step}});
  if (const Node* keys = fields.find("keys")) {
    if (fields.has("to"))
      fields.reader().error("scene.conflict", fields.key_span("to"), "`to` belongs to `from`", "give `keys` or `from` and `to`");
    motion.keys = read_keys(fields.reader(), *keys);
  } else {
    fields.require("to", "say where it ends: {from: 0deg, to: 360deg}");
    motion.keys.push_back({0, *fields.find("from")});
    if (const Node* to = fields.find("to")) motion.keys.push_back({1, *to});
  }
  return motion;
}

WallWalk read_walk(const Fields& fields, const RoomFacts& facts) {
  Reader& reader = fields.reader();
  WallWalk walk;
  const Node& what = *fields.find("walk");
  if (what.kind != NodeKind::scalar || what.text != "walls") reader.unknown_value(what, "`walk`", {"walls"});
  walk.distance = fields.number("distance", walk.distance, kLength);
  walk.laps = fields.integer("laps", walk.laps, -kMaxLaps, kMaxLaps);
  if (const Node* laps = fields.find("laps"); laps && walk.laps == 0)
    reader.error("scene.out-of-range", laps->span, "a walk of 0 laps stands still",
                 "give the whole number of laps; negative ones go clockwise");
  if (fields.has("z")) walk.z = fields.number("z", 0, kDistance);
  if (const Node* start = fields.find("start")) {
    const std::string text = start->kind == NodeKind::scalar ? start->text : "";
    for (int corner = 1; corner <= facts.corners; ++corner)
      if (text == fmt::format("corner {}", corner)) return walk.start = corner, walk;
    if (facts.walls > 0)
      reader.error("scene.no-such-corner", start->span, "`start` must be a corner of the room",
                   fmt::format("corner 1 to corner {}", facts.corners));
  }
  return walk;
}

PlacePath read_path(const Fields& fields, const RoomFacts& facts) {
  PlacePath path;
  const Node& node = *fields.find("path");
  const std::string hint = "a closed curve goes through at least three: path: [{polar: [0.2, 0deg]}, …]";
  if (node.kind != NodeKind::list) {
    fields.reader().wrong_type(node, "`path`", "a list of places", hint);
    return path;
  }
  if (node.items.size() < 3) {
    fields.reader().error("scene.out-of-range", node.span, fmt::format("a path of {} places", node.items.size()), hint);
    return path;
  }
  for (const Node& place : node.items) path.places.push_back(read_place(fields.reader(), place, "a place of the path", facts));
  return path;
}

Ahead read_ahead(Reader& reader, const Node& node) {
  Ahead ahead;
  if (node.kind == NodeKind::scalar) return ahead;
  const Fields fields(reader, *node.find("ahead"), "`ahead`", {"lead", "offset", "elevation"});
  ahead.lead = fields.number("lead", ahead.lead, kLength);
  ahead.offset = fields.angle("offset", ahead.offset);
  ahead.elevation = fields.angle("elevation", ahead.elevation, {-90, 90});
  return ahead;
}

Track read_track(Reader& reader, const Node& key, const Node& node, const RoomFacts& facts) {
  Track track{key.text, {}, key.span, node.span};
  if (node.kind == NodeKind::scalar && node.text == "ahead") return track.motion = Ahead{}, track;
  if (node.kind != NodeKind::map) {
    reader.wrong_type(node, fmt::format("the motion of `{}`", key.text), "a map, or `ahead`",
                      "write {from: …, to: …}, {keys: [[0, …], [0.5, …]]}, {walk: walls, distance: 0.15}, {path: […]} or ahead");
    return track;
  }
  const std::vector<std::string> kinds = {"from", "keys", "walk", "path", "ahead"};
  if (node.find("walk")) {
    track.motion = read_walk(Fields(reader, node, "a walk", {"walk", "distance", "start", "laps", "z"}), facts);
  } else if (node.find("path")) {
    track.motion = read_path(Fields(reader, node, "a path", {"path"}), facts);
  } else if (node.find("ahead")) {
    const Fields fields(reader, node, "a motion", {"ahead"});
    track.motion = read_ahead(reader, node);
  } else {
    const Fields fields(reader, node, "a motion", {"from", "to", "keys", "interpolate", "walk", "path", "ahead"});
    if (fields.only_one_of({"from", "keys"}).empty())
      reader.error("scene.missing-key", node.span, fmt::format("the motion of `{}` says nothing", key.text), "give " + listed(kinds));
    else track.motion = read_keyframes(fields);
  }
  return track;
}

}  // namespace

Animation read_animation(Reader& reader, const Node& node, const RoomFacts& facts) {
  Animation animation;
  animation.span = node.span;
  const Fields fields(reader, node, "the animation", {"frames", "rate", "seed", "set"});
  animation.frames = fields.integer("frames", animation.frames, 1, kMaxFrames);
  animation.rate = fields.number("rate", animation.rate, {0, 1000, true});
  animation.fixed_noise = fields.choice<bool>("seed", false, {{"per-frame", false}, {"locked", true}});
  fields.require("set", "say what moves: set: {camera.fov: {from: 60deg, to: 90deg}}");
  const Node* set = fields.find("set");
  if (!set) return animation;
  if (set->kind != NodeKind::map) {
    reader.wrong_type(*set, "`set`", "a map of values and their motions", "set: {camera.fov: {from: 60deg, to: 90deg}}");
    return animation;
  }
  for (std::size_t i = 0; i < set->keys.size(); ++i) animation.tracks.push_back(read_track(reader, set->keys[i], set->items[i], facts));
  return animation;
}

}  // namespace orbc::scene
