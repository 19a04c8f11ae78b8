#include "compiler/cover/boundary.h"

#include <algorithm>

#include "compiler/cover/storeys.h"
#include "compiler/place/panels.h"
#include "compiler/room/room.h"

namespace orbc::cover {
namespace {

constexpr double kSameArcLength = 1e-9;  // as in the tracer and on the panels

/// A mirror, or mirrors of one throughput above each other.
struct MirrorBand {
  scene::Color throughput;
  double low = 0, high = 0;
};
using Bands = std::vector<MirrorBand>;

/// The mirror of a wall at arc length s and height z: the first one there, as in the tracer.
const place::PlacedMirror* mirror_at(const place::Interior& room, int wall, double s, double z) {
  for (const place::PlacedMirror& mirror : room.mirrors)
    if (mirror.wall == wall && mirror.span[0] < s && s < mirror.span[1] && mirror.height[0] < z && z < mirror.height[1]) return &mirror;
  return nullptr;
}

Bands joined(const Bands& bands) {
  Bands joined;
  for (const MirrorBand& band : bands) {
    if (joined.empty() || !(joined.back().throughput == band.throughput)) joined.push_back(band);
    else joined.back().high = band.high;
  }
  return joined;
}

/// The bands of a wall at arc length s, upwards.
Bands bands_at(const place::Interior& room, int wall, double s) {
  std::vector<double> heights;
  for (const place::PlacedMirror& mirror : room.mirrors)
    if (mirror.wall == wall && mirror.span[0] < s && s < mirror.span[1])
      heights.insert(heights.end(), {mirror.height[0], mirror.height[1]});
  std::sort(heights.begin(), heights.end());
  Bands bands;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    if (!(heights[i] < heights[i + 1])) continue;
    if (const auto* mirror = mirror_at(room, wall, s, (heights[i] + heights[i + 1]) / 2))
      bands.push_back({mirror->throughput, heights[i], heights[i + 1]});
  }
  return joined(bands);
}

/// The bands of all storeys. z ↦ sign·z + offset turns every other storey upside down.
Bands on_storeys(const Bands& bands, std::vector<WeightedStorey> storeys) {
  std::sort(storeys.begin(), storeys.end(),
            [](const WeightedStorey& a, const WeightedStorey& b) { return a.storey.number < b.storey.number; });
  Bands all;
  for (const auto& [storey, weight] : storeys) {
    for (std::size_t i = 0; i < bands.size(); ++i) {
      const MirrorBand& band = bands[storey.sign > 0 ? i : bands.size() - 1 - i];
      const double one = storey.sign * band.low + storey.offset, other = storey.sign * band.high + storey.offset;
      all.push_back({band.throughput, std::min(one, other), std::max(one, other)});
    }
  }
  return joined(all);
}

/// The index of a throughput in the boundary, which gets it if it is new.
int index_of_throughput(Boundary& boundary, const scene::Color& throughput) {
  const auto known = std::find(boundary.throughputs.begin(), boundary.throughputs.end(), throughput);
  const auto index = static_cast<int>(known - boundary.throughputs.begin());
  if (known == boundary.throughputs.end()) boundary.throughputs.push_back(throughput);
  return index;
}

/// Divides the heights between bands of different throughput. Plain wall needs no aperture of its own: it hides everything behind it.
std::vector<Aperture> apertures_of(Boundary& boundary, const Bands& bands) {
  std::vector<Aperture> apertures;
  for (const MirrorBand& band : bands) apertures.push_back({index_of_throughput(boundary, band.throughput)});
  for (std::size_t i = 0; i + 1 < bands.size(); ++i) {
    apertures[i].to = bands[i].high + (bands[i + 1].low - bands[i].high) / 2;
    apertures[i + 1].from = apertures[i].to;
  }
  return apertures;
}

/// A point of a wall by its arc length.
struct WallPoint {
  double s = 0;
  geometry::Point at;
};

/// Adds the ends of a wall's mirrors to the points of its outline and sorts all by arc length.
std::vector<WallPoint> with_mirror_ends(std::vector<WallPoint> points, const place::Interior& placed, int wall) {
  const double length = placed.polygon.walls[static_cast<std::size_t>(wall)].length;
  for (const place::PlacedMirror& mirror : placed.mirrors) {
    if (mirror.wall != wall) continue;
    for (const double s : mirror.span) {
      const auto is_there = [&](const WallPoint& p) { return std::abs(p.s - s) < kSameArcLength; };
      if (std::none_of(points.begin(), points.end(), is_there) && s < length - kSameArcLength)
        points.push_back({s, room::point_on_wall(placed.polygon, wall, s)});
    }
  }
  std::sort(points.begin(), points.end(), [](const WallPoint& a, const WallPoint& b) { return a.s < b.s; });
  return points;
}

void add_wall(Boundary& boundary, const place::Interior& placed, int wall, const std::vector<WallPoint>& points, int max_bounces) {
  const double length = placed.polygon.walls[static_cast<std::size_t>(wall)].length;
  boundary.first_edge[static_cast<std::size_t>(wall)] = static_cast<int>(boundary.edges.size());
  boundary.edge_count[static_cast<std::size_t>(wall)] = static_cast<int>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double next = i + 1 < points.size() ? points[i + 1].s : length;
    Bands bands = bands_at(placed, wall, (points[i].s + next) / 2);
    for (const MirrorBand& band : bands) index_of_throughput(boundary, band.throughput);  // numbered upwards in the room itself
    if (bands.size() > 1) bands = on_storeys(bands, storeys_within(placed, max_bounces));
    boundary.points.push_back(points[i].at);
    boundary.edges.push_back({wall, apertures_of(boundary, bands)});
  }
}

}  // namespace

Boundary make_boundary(const place::Interior& placed, int max_bounces) {
  const room::Room& room = placed.polygon;
  const std::size_t corners = room.outline.size();
  Boundary boundary;
  boundary.first_edge.assign(room.walls.size(), 0);
  boundary.edge_count.assign(room.walls.size(), 0);
  // Begin where a wall begins.
  std::size_t start = 0;
  while (start < corners && room.outline_wall[start] == room.outline_wall[(start + corners - 1) % corners]) ++start;
  if (start == corners) start = 0;  // `*`: one wall
  for (std::size_t k = 0; k < corners;) {
    const int wall = room.outline_wall[(start + k) % corners];
    std::vector<WallPoint> points{{0, room.outline[(start + k) % corners]}};
    for (++k; k < corners && room.outline_wall[(start + k) % corners] == wall; ++k) {
      const geometry::Point& at = room.outline[(start + k) % corners];
      points.push_back({place::arc_on_wall(room, wall, at), at});
    }
    add_wall(boundary, placed, wall, with_mirror_ends(std::move(points), placed, wall), max_bounces);
  }
  return boundary;
}

}  // namespace orbc::cover
