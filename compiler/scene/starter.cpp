#include "compiler/scene/starter.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/notation/parse.h"
#include "compiler/scene/defaults.h"

namespace orbc::scene {
namespace {

constexpr const char* kText = R"(# A room with mirrors for walls. Draw it:   orbc render room.yaml -o room.png
# Check it:   orbc check room.yaml          Mesh it for Blender:   orbc compile room.yaml -o room.glb
# Lengths are radii of curvature (in flat rooms: whatever unit you like); angles are degrees, or 0.5rad.
orbc: 1
orbifold: {notation}{about}{allow}

room:
  height: {height}
  floor:   {{checker: ["#f2ebdd", slategray], cell: {cell}}}    # or {{color: tan}}, wood, {{texture: tiles.png}}
  ceiling: {{color: "#e6ecf2"}}
  walls:
    all: {{mirror: {{reflectance: 0.9}}, frame: {{width: {frame}, color: goldenrod}}}}
    # A single wall may differ. {wall_hint}
    # 1: {{mirror: none, color: brown}}
    # 1: {{mirrors: [{{span: [{span_from}, {span_to}], height: [{mirror_from}, {mirror_to}], tint: "#ffeedd"}}]}}

objects:
  - torus_knot: {{p: 2, q: 3, radius: {knot_radius}, tube: {knot_tube}}}
    name: knot
    at: {{polar: [{knot_at}, 100deg]}}        # from the centre of the room; corner 1 lies at 0deg
    turn: 20deg
    material: {{kind: glossy, color: tomato}}
  - sphere: {{radius: {sphere_radius}}}
    at: {{polar: [{sphere_at}, 200deg]}}      # or {{disk: [x, y]}}, {{toward: wall 1, distance: {sphere_at}}}
    material: marble                    # or wood, granite, glass, gold, silver, copper, chrome, mirror, …
  # - mesh: statue.obj                  # OBJ, PLY, OFF, STL, glTF or GLB, beside this file
  #   size: {mesh_size}                        # its longest horizontal extent

lights:
  - {{kind: sphere, at: {{polar: [0, 0deg], z: {lamp_z}}}, radius: {lamp_radius}, power: {power}, temperature: 4500}}
ambient: "#3c3c40"                      # light from everywhere

camera:
  at: {{polar: [{eye_at}, 300deg], z: {eye_z}}}
  look_at: knot                         # an object, a place, or {{azimuth: 30deg, elevation: 0deg}}
  fov: 80deg
  size: [800, 600]

cover: {{max_bounces: {bounces}, background: "#20242a"}}    # how far the mirrors are followed, and what is seen beyond
)";

std::string quoted(std::string_view text) {
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

// Comments behind values start in one column, wherever the values end.
std::string aligned(const std::string& text) {
  constexpr std::size_t kColumn = 58;
  std::string all;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    std::string line = text.substr(begin, end - begin);
    const std::size_t mark = line.find("  # ", std::min(line.size(), line.find_first_not_of(' ')));
    const std::size_t code_end = mark == std::string::npos ? mark : line.find_last_not_of(' ', mark);
    if (code_end != std::string::npos && code_end + 1 < kColumn)
      line = line.substr(0, code_end + 1) + std::string(kColumn - code_end - 1, ' ') + line.substr(line.find('#', mark));
    all += line + "\n";
    begin = end + 1;
  }
  return all;
}

}  // namespace

std::string starter_scene(std::string_view notation, int walls, double inradius) {
  using fmt::arg;
  const double r = inradius > 0 ? std::clamp(inradius, 1e-3, 1.0) : 0.5;
  const auto orbifold = notation::parse(notation, {{}, true});
  const int bounces = orbifold ? default_max_bounces(*orbifold) : 12;
  const bool real = notation.find_first_of("/.") != std::string_view::npos;
  return aligned(fmt::format(fmt::runtime(kText), arg("notation", quoted(notation)), arg("about", about(notation)),
                             arg("allow", real ? "\nallow_non_orbifold: true" : ""), arg("height", shown(1.5 * r)),
                             arg("cell", shown(0.25 * r)), arg("frame", shown(0.06 * r)), arg("wall_hint", wall_hint(notation, walls)),
                             arg("span_from", shown(0.2 * r)), arg("span_to", shown(0.8 * r)), arg("mirror_from", shown(0.3 * r)),
                             arg("mirror_to", shown(1.2 * r)), arg("knot_radius", shown(0.18 * r)), arg("knot_tube", shown(0.05 * r)),
                             arg("knot_at", shown(0.25 * r)), arg("sphere_radius", shown(0.14 * r)), arg("sphere_at", shown(0.5 * r)),
                             arg("mesh_size", shown(0.4 * r)), arg("lamp_z", shown(1.3 * r)), arg("lamp_radius", shown(0.07 * r)),
                             arg("power", shown(20 * r * r)), arg("eye_at", shown(0.62 * r)), arg("eye_z", shown(0.7 * r)),
                             arg("bounces", bounces)));
}

}  // namespace orbc::scene
