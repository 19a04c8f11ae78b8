// From the interior to the tracer's data: the prism, the mirrors per wall, and one list of the triangles of all objects and frames.
#include <algorithm>
#include <cmath>

#include "compiler/place/alpha_mask.h"
#include "compiler/trace/bvh/bvh.h"
#include "compiler/trace/scene.h"

namespace orbc::trace {

using place::PartKind;

namespace {

/// A mirror that ends within this of the wall's end reaches the end: its lengths were computed, not copied.
constexpr double kEndTolerance = 1e-9;

MirrorRect mirror_rect(geometry::Space space, const place::PlacedMirror& mirror, int index, double length, double height) {
  MirrorRect area;
  area.mirror = index;
  area.throughput = mirror.throughput;
  area.emission = mirror.emission;
  if (mirror.wall < 0) {
    area.covers_surface = true;
    return area;
  }
  if (mirror.span[0] > kEndTolerance) area.span[0] = mirror.span[0];
  if (mirror.span[1] < length - kEndTolerance) area.span[1] = mirror.span[1];
  if (mirror.height[0] > kEndTolerance) area.height[0] = mirror.height[0];
  if (mirror.height[1] < height - kEndTolerance) area.height[1] = mirror.height[1];
  for (int i = 0; i < 2; ++i) area.tan_span[i] = std::fabs(area.span[i]) == kInfinity ? area.span[i] : geometry::tan_k(space, area.span[i]);
  area.covers_surface =
      area.span[0] == -kInfinity && area.span[1] == kInfinity && area.height[0] == -kInfinity && area.height[1] == kInfinity;
  return area;
}

void add_mirrors(TraceScene& scene) {
  const geometry::Space space = scene.prism.space;
  scene.mirrors.resize(scene.prism.walls.size());
  for (int i = 0; i < static_cast<int>(scene.interior->mirrors.size()); ++i) {
    const place::PlacedMirror& mirror = scene.interior->mirrors[i];
    if (mirror.wall == kFloor) scene.floor_mirror = mirror_rect(space, mirror, i, 0, 0);
    if (mirror.wall == kCeiling) scene.ceiling_mirror = mirror_rect(space, mirror, i, 0, 0);
    if (mirror.wall >= 0)
      scene.mirrors[mirror.wall].push_back(mirror_rect(space, mirror, i, scene.prism.walls[mirror.wall].length, scene.prism.height));
  }
}

void add_shell_styles(TraceScene& scene) {
  scene.walls.resize(scene.prism.walls.size());
  for (int i = 0; i < static_cast<int>(scene.interior->parts.size()); ++i) {
    const place::PlacedMesh& part = scene.interior->parts[i];
    ShellStyle* panel = part.kind == PartKind::floor     ? &scene.floor
                        : part.kind == PartKind::ceiling ? &scene.ceiling
                        : part.kind == PartKind::wall    ? &scene.walls[part.wall]
                                                         : nullptr;
    if (panel && panel->part < 0) *panel = {i, part.style.empty() ? -1 : part.style.front()};
  }
}

bool inside(const Prism& prism, const Vertex& v) {
  for (const room::Wall& wall : prism.walls)
    if (geometry::value_at(wall.line, {v.w, v.x, v.y}) < -kEndTolerance) return false;
  return v.z >= -kEndTolerance && v.z <= prism.height + kEndTolerance;
}

}  // namespace

TraceScene prepare(const place::Interior& room, const Executor& execute) {
  TraceScene scene;
  scene.interior = &room;
  scene.prism = {room.polygon.space, room.height, room.polygon.walls};
  add_mirrors(scene);
  add_shell_styles(scene);
  SceneTriangles triangles;
  for (std::size_t part = 0; part < room.parts.size(); ++part) {
    const place::PlacedMesh& mesh = room.parts[part];
    if (mesh.kind != PartKind::object && mesh.kind != PartKind::frame) continue;
    triangles.parts.push_back({static_cast<std::uint32_t>(triangles.corners.size()), static_cast<std::int32_t>(part)});
    const auto first = static_cast<std::uint32_t>(triangles.vertices.size());
    for (std::size_t i = 0; i < mesh.floor.size(); ++i)
      triangles.vertices.push_back({mesh.floor[i].w, mesh.floor[i].x, mesh.floor[i].y, mesh.z[i]});
    for (const mesh::Triangle& t : mesh.triangles) triangles.corners.push_back({first + t[0], first + t[1], first + t[2]});
  }
  scene.masked = place::has_alpha_mask(room);
  scene.all_inside =
      std::all_of(triangles.vertices.begin(), triangles.vertices.end(), [&](const Vertex& v) { return inside(scene.prism, v); });
  scene.objects = std::make_shared<Bvh>(room.polygon.space, std::move(triangles), execute);
  return scene;
}

}  // namespace orbc::trace
