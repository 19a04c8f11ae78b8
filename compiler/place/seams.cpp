#include "compiler/place/seams.h"

#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "compiler/place/panels.h"

namespace orbc::place {
namespace {

using geometry::Position;

constexpr double kSame = 1e-9;   // of the room's size

/// A straight border of the room: the foot or head of a wall (parameter: arc length), or the upright edge where a wall starts (parameter:
///                                height).
struct Seam {
  const room::Room* room = nullptr;
  int wall = 0;
  bool upright = false;
  double z = 0;
  double same = kSame;

  [[nodiscard]] std::optional<double> parameter(const PlacedMesh& mesh, std::uint32_t v) const {
    const geometry::Point& x = mesh.floor[v];
    if (upright) {
      const geometry::Point& start = room->walls[wall].start;
      if (std::fabs(x.w - start.w) + std::fabs(x.x - start.x) + std::fabs(x.y - start.y) > same * (1 + std::fabs(x.w))) return std::nullopt;
      return mesh.z[v];
    }
    if (std::fabs(mesh.z[v] - z) > same || std::fabs(geometry::signed_distance(room->space, room->walls[wall].line, x)) > same)
      return std::nullopt;
    return arc_on_wall(*room, wall, x);
  }
  // How far along in b, from a to b, the parameter p lies.
  [[nodiscard]] double share(double a, double b, double p) const {
    if (upright) return (p - a) / (b - a);
    const double before = geometry::sin_k(room->space, p - a), after = geometry::sin_k(room->space, b - p);
    return before / (before + after);
  }
  // On the seam of a closed wall the start is also the end.
  [[nodiscard]] double period() const { return !upright && room->corners.empty() ? room->walls[wall].length : 0; }
};

using Places = std::map<double, Position>;

Places::iterator find(Places& places, double p, double same) {
  const auto at = places.lower_bound(p - same);
  return at != places.end() && at->first <= p + same ? at : places.end();
}

// The parameters of an edge's ends, the smaller first if `a` comes first; across the start of a closed wall the later end counts on.
struct Run {
  double from = 0, to = 0;
};

Run run_of(const Seam& seam, double a, double b) {
  const double period = seam.period();
  if (period > 0 && std::fabs(a - b) > period / 2) (a < b ? a : b) += period;
  return {a, b};
}

void gather(const Seam& seam, PlacedMesh& mesh, Places& places) {
  for (std::uint32_t v = 0; v < mesh.floor.size(); ++v) {
    const auto p = seam.parameter(mesh, v);
    if (!p) continue;
    const double wrapped = seam.period() > 0 && *p > seam.period() - seam.same ? 0 : *p;
    auto at = find(places, wrapped, seam.same);
    if (at == places.end()) at = places.emplace(wrapped, Position{mesh.floor[v], seam.upright ? mesh.z[v] : seam.z}).first;
    mesh.floor[v] = at->second.floor;
    mesh.z[v] = at->second.z;
  }
}

std::uint32_t insert(const Seam& seam, PlacedMesh& mesh, const Position& at, std::uint32_t a, std::uint32_t b, const Run& run, double p) {
  const auto t = static_cast<float>(seam.share(run.from, run.to, p));
  mesh.floor.push_back(at.floor);
  mesh.z.push_back(at.z);
  if (!mesh.uv.empty()) mesh.uv.push_back({(1 - t) * mesh.uv[a][0] + t * mesh.uv[b][0], (1 - t) * mesh.uv[a][1] + t * mesh.uv[b][1]});
  return static_cast<std::uint32_t>(mesh.floor.size() - 1);
}

// Divides the triangles of one panel at the places their edges pass.
void divide(const Seam& seam, PlacedMesh& mesh, const Places& places) {
  std::vector<std::optional<double>> parameter;
  for (std::uint32_t v = 0; v < mesh.floor.size(); ++v) parameter.push_back(seam.parameter(mesh, v));
  std::vector<mesh::Triangle> triangles;
  std::vector<std::uint16_t> look;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const mesh::Triangle t = mesh.triangles[i];
    std::vector<std::uint32_t> border;
    int k = 0;
    while (k < 3 && !(parameter[t[k]] && parameter[t[(k + 1) % 3]])) ++k;
    if (k < 3) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const Run run = run_of(seam, *parameter[a], *parameter[b]);
      const double low = std::fmin(run.from, run.to) + seam.same, high = std::fmax(run.from, run.to) - seam.same;
      std::map<double, Position> between;
      for (const double shift : {0.0, seam.period()}) {
        for (auto at = places.lower_bound(low - shift); at != places.end() && at->first < high - shift; ++at)
          between.emplace(at->first + shift, at->second);
        if (seam.period() == 0) break;
      }
      for (const auto& [p, at] : between) border.push_back(insert(seam, mesh, at, a, b, run, p));
      if (run.from > run.to) border = {border.rbegin(), border.rend()};
      border.insert(border.begin(), a);
      border.push_back(b);
    }
    if (border.size() < 3) {
      triangles.push_back(t), look.push_back(mesh.look[i]);
      continue;
    }
    for (std::size_t j = 0; j + 1 < border.size(); ++j)
      triangles.push_back({border[j], border[j + 1], t[(k + 2) % 3]}), look.push_back(mesh.look[i]);
  }
  mesh.triangles = std::move(triangles);
  mesh.look = std::move(look);
}

}  // namespace

std::vector<PlacedMesh> sewn(const room::Room& room, double height, std::vector<PlacedMesh> panels) {
  const int n = static_cast<int>(room.walls.size());
  const double same = kSame * std::fmin(room.circumradius, height);
  const auto sew = [&panels](const Seam& seam, const auto& belongs) {
    Places places;
    for (PlacedMesh& panel : panels)
      if (belongs(panel)) gather(seam, panel, places);
    for (PlacedMesh& panel : panels)
      if (belongs(panel)) divide(seam, panel, places);
  };
  for (int i = 0; i < n; ++i) {
    sew({&room, i, false, 0, same},
        [i](const PlacedMesh& p) { return p.kind == PartKind::floor || (p.kind == PartKind::wall && p.wall == i); });
    sew({&room, i, false, height, same},
        [i](const PlacedMesh& p) { return p.kind == PartKind::ceiling || (p.kind == PartKind::wall && p.wall == i); });
    sew({&room, i, true, 0, same},
        [i, n](const PlacedMesh& p) { return p.kind == PartKind::wall && (p.wall == i || p.wall == (i + n - 1) % n); });
  }
  return panels;
}

}  // namespace orbc::place
