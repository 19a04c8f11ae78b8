#include "compiler/scene/starter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/notation/parse.h"
#include "compiler/scene/defaults.h"

namespace orbc::scene {
namespace {

constexpr const char* kTemplate = R"(# A room with mirrors for walls. Draw it:   orbc render room.yaml -o room.png
# Check it:   orbc check room.yaml          Mesh it for Blender:   orbc compile room.yaml -o room.glb
# Lengths are radii of curvature (in flat rooms: whatever unit you like); angles are degrees, or 0.5rad.
orbc: 1
orbifold: {notation}{about}{allow}

room:
  height: {height}
  floor:   {{checker: ["#f3e3c3", "#3d5f86"], cell: {cell}}}    # or {{color: tan}}, wood, {{texture: tiles.png}}
  ceiling: {{color: "#f4ead6"}}
  walls:
    all: {{mirror: {{reflectance: 0.94}}, frame: {{width: {frame}, color: "#d39a35"}}}}
    # A single wall may differ. {wall_hint}
    # 1: {{mirror: none, color: brown}}
    # 1: {{mirrors: [{{span: [{span_from}, {span_to}], height: [{mirror_from}, {mirror_to}], tint: "#ffeedd"}}]}}

objects:
  - cylinder: {{radius: {column_radius}, height: {column_height}}}
    name: column
    at: {{polar: {column_at}}}        # from the centre of the room; corner 1 lies at 0deg
    material: {{marble: ["#f1e8da", "#8a7a6a"], cell: {marble_cell}}}    # or wood, granite, gold, glass, mirror, …
  - torus_knot: {{p: 2, q: 3, radius: {knot_radius}, tube: {knot_tube}}}
    name: knot                          # every other image of it is left-handed
    at: {{polar: {column_at}, z: {column_height}}}
    turn: 20deg
    material: {{kind: glossy, color: tomato}}
  - sphere: {{radius: {ball_radius}}}
    name: ball
    at: {{polar: {ball_at}}}          # or {{disk: [x, y]}}, {{toward: wall 1, distance: {ball_distance}}}
    material: {{kind: glossy, color: "#3f8f8f"}}
  # - mesh: statue.obj                  # OBJ, PLY, OFF, STL, glTF or GLB, beside this file
  #   size: {mesh_size}                        # its longest horizontal extent

lights:
  - {{kind: sphere, at: {{polar: {lamp_at}, z: {lamp_z}}}, radius: {lamp_radius}, power: {power}, temperature: 3500}}
ambient: "#57524a"                      # light from everywhere
white: 4300                             # the colour of light, in kelvin, that looks white
exposure: 1.3
bake: {{mirrors: 1}}                      # over how many mirrors lamps shine: 2 is truer, and takes longer

camera:
  at: {{polar: {eye_at}, z: {eye_z}}}
  look_at: {{polar: {goal_at}, z: {goal_z}}}    # a place, an object (look_at: knot), or {{azimuth: 30deg, elevation: 0deg}}
  fov: 80deg
  size: [800, 600]

cover: {{max_bounces: {bounces}, background: expected}}    # how far mirrors are followed; beyond it the colour expected there
)";

// A position relative to the middle of the scene: `ahead` in the direction of view, and to its `left`, in units of the frame.
struct FloorOffset {
  double ahead = 0, left = 0;
};
constexpr FloorOffset kEye{-0.84, 0}, kGoal{0.4, 0}, kColumn{0.12, 0.22}, kBall{0.22, -0.28}, kLamp{0.3, -0.38};

// The coordinate frame of the scene on the floor. Large rooms are furnished on the side of the view, so that the wall there is near.
struct StarterFrame {
  double unit = 1;                  // of lengths: the inradius, at most 1
  double shift = 0;                 // from the centre of the room to the middle of the scene
  double view = 0;                  // degrees
};

std::string in_quotes(std::string_view text) {
  std::string all = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') all += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) all += c;
  }
  return all + "\"";
}

const char* about(std::string_view notation) {
  if (notation == "*") return "            # half a sphere: one mirror, no corner";
  if (notation == "**") return "           # a strip between two parallel mirrors (walls 1 and 3)";
  if (notation == "*22∞") return "         # half a strip: mirrors 2 and 4 are parallel, 1 stands across";
  return "    # each number k is a corner of angle π/k";
}

std::string wall_hint(std::string_view notation, int walls) {
  if (notation == "**") return "Walls 1 and 3 are the mirrors, 2 and 4 the plain ends:";
  if (notation == "*22∞") return "Walls 1, 2 and 4 are the mirrors, 3 is the plain end:";
  if (walls < 2) return "Here is only wall 1:";
  return fmt::format("Walls are numbered 1 to {}; wall 1 joins corner 1 to corner 2:", walls);
}

std::string shown(double value) { return fmt::format("{:.2g}", value); }

// Moves comments behind values to one column.
std::string aligned(const std::string& text) {
  constexpr std::size_t kCommentColumn = 58;
  std::string all;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    std::string line = text.substr(begin, end - begin);
    const std::size_t mark = line.find("  # ", std::min(line.size(), line.find_first_not_of(' ')));
    const std::size_t code_end = mark == std::string::npos ? mark : line.find_last_not_of(' ', mark);
    if (code_end != std::string::npos && code_end + 1 < kCommentColumn)
      line = line.substr(0, code_end + 1) + std::string(kCommentColumn - code_end - 1, ' ') + line.substr(line.find('#', mark));
    all += line + "\n";
    begin = end + 1;
  }
  return all;
}

// A place as `[distance, direction]`. Both components are added as in flat geometry. In curved rooms that moves a place a little, but never
// beyond the incircle.
std::string polar(const StarterFrame& frame, const FloorOffset& spot) {
  const double x = frame.shift + frame.unit * spot.ahead, y = frame.unit * spot.left;
  const int direction = static_cast<int>(std::lround(frame.view + math::atan2(y, x) * 180 / std::numbers::pi));
  return fmt::format("[{}, {}deg]", shown(math::hypot(x, y)), (direction % 360 + 360) % 360);
}

StarterFrame starter_frame(const StarterRoom& room) {
  const double inradius = room.inradius > 0 ? room.inradius : room.notation == "**" ? 1.0 : 0.5;
  const double unit = std::min(inradius, 1.0);
  return {unit, room.notation == "*" ? 0 : inradius - unit, room.view};
}

}  // namespace

std::string starter_scene(const StarterRoom& room) {
  using fmt::arg;
  constexpr double kMinCell = 1e-4;       // smallest cell that scenes may have
  constexpr double kMinFloorCell = 0.005;  // the thinnest triangles are long, and a floor has at most 200,000 cells
  const StarterFrame frame = starter_frame(room);
  const double r = frame.unit, height = 1.4 * r;
  const auto orbifold = notation::parse(room.notation, {{}, true});
  const int bounces = orbifold ? default_max_bounces(*orbifold) : 12;
  const bool real = room.notation.find_first_of("/.") != std::string::npos;
  return aligned(fmt::format(
      fmt::runtime(kTemplate), arg("notation", in_quotes(room.notation)), arg("about", about(room.notation)),
      arg("allow", real ? "\nallow_non_orbifold: true" : ""), arg("height", shown(height)),
      arg("cell", shown(std::max(0.3 * r, kMinFloorCell))), arg("frame", shown(0.05 * r)),
      arg("wall_hint", wall_hint(room.notation, room.walls)), arg("span_from", shown(0.2 * r)), arg("span_to", shown(0.8 * r)),
      arg("mirror_from", shown(0.3 * r)), arg("mirror_to", shown(1.2 * r)), arg("column_radius", shown(0.1 * r)),
      arg("column_height", shown(0.36 * r)),
      arg("column_at", polar(frame, kColumn)), arg("marble_cell", shown(std::max(0.22 * r, kMinCell))),
      arg("knot_radius", shown(0.11 * r)), arg("knot_tube", shown(0.042 * r)), arg("ball_radius", shown(0.13 * r)),
      arg("ball_at", polar(frame, kBall)), arg("ball_distance", shown(0.5 * r)), arg("mesh_size", shown(0.4 * r)),
      arg("lamp_at", polar(frame, kLamp)), arg("lamp_z", shown(0.56 * height)), arg("lamp_radius", shown(0.06 * r)),
      arg("power", shown(15 * r * r)), arg("eye_at", polar(frame, kEye)), arg("eye_z", shown(0.44 * height)),
      arg("goal_at", polar(frame, kGoal)), arg("goal_z", shown(0.37 * height)), arg("bounces", bounces)));
}

}  // namespace orbc::scene
