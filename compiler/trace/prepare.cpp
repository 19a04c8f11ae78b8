// From the furnished room to what rays need: the prism's lines, the mirrors per wall, and one soup of all triangles that are not panels.
#include <algorithm>
#include <cmath>

#include "compiler/place/texel.h"
#include "compiler/trace/bvh.h"
#include "compiler/trace/scene.h"

namespace orbc::trace {

using place::PartKind;

namespace {

/// Ends of a mirror within this of the wall's own end mean "to the end": a mirror is placed by lengths that were computed, not copied.
constexpr double kEnd = 1e-9;

MirrorArea area_of(const place::PlacedMirror& mirror, int index, double length, double height) {
  MirrorArea area;
  area.mirror = index;
  area.weight = mirror.throughput;
  area.glow = mirror.glow;
  if (mirror.wall < 0) {
    area.whole = true;
    return area;
  }
  if (mirror.span[0] > kEnd) area.span[0] = mirror.span[0];
  if (mirror.span[1] < length - kEnd) area.span[1] = mirror.span[1];
  if (mirror.height[0] > kEnd) area.height[0] = mirror.height[0];
  if (mirror.height[1] < height - kEnd) area.height[1] = mirror.height[1];
  area.whole = area.span[0] == -kEndless && area.span[1] == kEndless && area.height[0] == -kEndless && area.height[1] == kEndless;
  return area;
}

void add_mirrors(TraceScene& scene) {
  scene.mirrors.resize(scene.prism.walls.size());
  for (int i = 0; i < static_cast<int>(scene.room->mirrors.size()); ++i) {
    const place::PlacedMirror& mirror = scene.room->mirrors[i];
    if (mirror.wall == kFloor) scene.floor_mirror = area_of(mirror, i, 0, 0);
    if (mirror.wall == kCeiling) scene.ceiling_mirror = area_of(mirror, i, 0, 0);
    if (mirror.wall >= 0)
      scene.mirrors[mirror.wall].push_back(area_of(mirror, i, scene.prism.walls[mirror.wall].length, scene.prism.height));
  }
}

void add_panels(TraceScene& scene) {
  scene.walls.resize(scene.prism.walls.size());
  for (int i = 0; i < static_cast<int>(scene.room->parts.size()); ++i) {
    const place::PlacedMesh& part = scene.room->parts[i];
    Panel* panel = part.kind == PartKind::floor     ? &scene.floor
                   : part.kind == PartKind::ceiling ? &scene.ceiling
                   : part.kind == PartKind::wall    ? &scene.walls[part.wall]
                                                    : nullptr;
    if (panel && panel->part < 0) *panel = {i, part.look.empty() ? -1 : part.look.front()};
  }
}

bool inside(const Prism& prism, const Vertex& v) {
  for (const room::Wall& wall : prism.walls)
    if (geometry::value_at(wall.line, {v.w, v.x, v.y}) < -kEnd) return false;
  return v.z >= -kEnd && v.z <= prism.height + kEnd;
}

}  // namespace

TraceScene prepare(const place::PlacedRoom& room, const Executor& execute) {
  TraceScene scene;
  scene.room = &room;
  scene.prism = {room.room.space, room.height, room.room.walls};
  add_mirrors(scene);
  add_panels(scene);
  Soup soup;
  for (std::size_t part = 0; part < room.parts.size(); ++part) {
    const place::PlacedMesh& mesh = room.parts[part];
    if (mesh.kind != PartKind::object && mesh.kind != PartKind::frame) continue;
    soup.parts.push_back({static_cast<std::uint32_t>(soup.triangles.size()), static_cast<std::int32_t>(part)});
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (std::size_t i = 0; i < mesh.floor.size(); ++i)
      soup.vertices.push_back({mesh.floor[i].w, mesh.floor[i].x, mesh.floor[i].y, mesh.z[i]});
    for (const mesh::Triangle& t : mesh.triangles) soup.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  scene.masked = place::has_holes(room);
  scene.all_inside = std::all_of(soup.vertices.begin(), soup.vertices.end(), [&](const Vertex& v) { return inside(scene.prism, v); });
  scene.objects = std::make_shared<Bvh>(room.room.space, std::move(soup), execute);
  return scene;
}

}  // namespace orbc::trace
