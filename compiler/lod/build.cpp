// A part is simplified in the conformal chart around its centre, scaled by 2 so that lengths at the centre are true. Each level is then
// compared with the part: both surfaces are subdivided, as the geodesic triangles that they are, into pieces of length h, and the distance
// of each corner of the pieces to the other surface is measured. Two errors of that measurement are added. Lengths in the chart differ from
// intrinsic lengths by the factor 1 + κ|p|²/4. A piece differs from the straight triangle on its corners by at most |P''|h²/6, with
// |P''| ≤ 3|z| = 3|p|/2 (bend/edge_mesh.cpp).
#include "compiler/lod/build.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <tuple>

#include "compiler/bend/screen_size.h"
#include "compiler/geometry/chart.h"
#include "compiler/mesh/closest_point_tree.h"
#include "compiler/mesh/decimate.h"
#include "compiler/mesh/weld.h"

namespace orbc::lod {
namespace {

using geometry::Space;
using geometry::Vector3;
using place::PlacedMesh;

constexpr std::size_t kMinTriangles = 200;         // parts with fewer have no levels
constexpr std::size_t kSmallestLodTriangles = 24;  // no level has fewer
constexpr double kTriangleRatio = 0.4;             // of a level to the one before
constexpr std::size_t kMaxStyles = 256;            // the decimater's materials are bytes
constexpr int kMaxSubdivisions = 64;               // of an edge
// Parts in more pieces, for their triangles and beyond, have no levels.
constexpr std::size_t kMaxPiecesPerTriangle = 16, kMaxPieces = 20'000;
constexpr double kMaxChartRadius = 1.5;  // H²: the chart ends at 2
constexpr double kUnknownDistance = 1e9;

/// A coarser level of a part.
struct Lod {
  PlacedMesh mesh;
  double offset = 0;  ///< InteriorWithLods::surface_offset
};

/// The conformal chart around the centre of a part.
class LocalChart {
 public:
  LocalChart(Space space, const bend::BoundingCylinder& extent)
      : space_(space), chart_from_room_(inverse(geometry::translation_to(space, extent.centre))) {
    radius_ = space == Space::euclidean ? extent.radius : 2 * geometry::tan_k(space, extent.radius / 2);
  }
  [[nodiscard]] Vector3 operator()(const geometry::Ambient& v, double z) const {
    const auto p = (space_ == Space::euclidean ? 1.0 : 2.0) *
                   geometry::disk_from_point(space_, chart_from_room_ * geometry::normalised_point(space_, v));
    return {p.real(), p.imag(), z};
  }
  /// Upper bound of the intrinsic length of a curve that has the given length in the chart.
  [[nodiscard]] double intrinsic_length(double length) const {
    return space_ == Space::hyperbolic ? length / (1 - radius_ * radius_ / 4) : length;
  }
  /// Upper bound of the distance between a geodesic piece of length h and the chord between its ends.
  [[nodiscard]] double sag(double h) const { return space_ == Space::euclidean ? 0 : radius_ * h * h / 4; }
  [[nodiscard]] double radius() const { return radius_; }

 private:
  Space space_;
  geometry::Isometry chart_from_room_;
  double radius_ = 0;
};

/// A part in pieces, positions in its chart: the surface, and the lines on it where materials meet or the surface ends. Lines are triangles
/// without area.
struct SampledSurface {
  mesh::Mesh surface, lines;
};

/// Subdivides triangles and lines of a part into pieces no longer than h.
class Subdivider {
 public:
  Subdivider(const PlacedMesh& part, const std::vector<Vector3>& at, const LocalChart& chart, double h)
      : part_(part), at_(at), chart_(chart), h_(h) {}

  [[nodiscard]] std::size_t pieces(const mesh::Triangle& t) const {
    const auto n = static_cast<std::size_t>(subdivisions(t));
    return n * n;
  }

  void add_triangle(const mesh::Triangle& t, mesh::Mesh& into) const {
    const int n = subdivisions(t);
    if (n == 1) return into.triangles.push_back(t);
    auto row = static_cast<std::uint32_t>(into.positions.size());
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i + j <= n; ++i) into.positions.push_back(point(t, static_cast<double>(i) / n, static_cast<double>(j) / n));
    for (int j = 0; j < n; ++j) {
      const auto width = static_cast<std::uint32_t>(n - j);
      for (std::uint32_t i = 0; i < width; ++i) {
        into.triangles.push_back({row + i, row + i + 1, row + width + 1 + i});
        if (i + 1 < width) into.triangles.push_back({row + i + 1, row + width + 2 + i, row + width + 1 + i});
      }
      row += width + 1;
    }
  }

  void add_line(std::uint32_t a, std::uint32_t b, mesh::Mesh& into) const {
    const mesh::Triangle t{a, b, b};
    const int n = subdivisions(t);
    for (int i = 0; i <= n; ++i) into.positions.push_back(point(t, static_cast<double>(i) / n, 0));
    for (auto i = static_cast<std::uint32_t>(into.positions.size()) - static_cast<std::uint32_t>(n); i < into.positions.size(); ++i)
      into.triangles.push_back({i - 1, i, i});
  }

 private:
  /// Into how many parts each edge of a triangle is cut.
  [[nodiscard]] int subdivisions(const mesh::Triangle& t) const {
    double longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, length(at_[t[k]] - at_[t[(k + 1) % 3]]));
    return std::clamp(static_cast<int>(std::ceil(longest / h_)), 1, kMaxSubdivisions);
  }
  [[nodiscard]] Vector3 point(const mesh::Triangle& t, double b1, double b2) const {
    const double b0 = 1 - b1 - b2;
    return chart_(b0 * part_.floor[t[0]] + b1 * part_.floor[t[1]] + b2 * part_.floor[t[2]],
                  b0 * part_.z[t[0]] + b1 * part_.z[t[1]] + b2 * part_.z[t[2]]);
  }

  const PlacedMesh& part_;
  const std::vector<Vector3>& at_;
  const LocalChart& chart_;
  double h_;
};

/// The edges that belong to one triangle only or lie between two materials, as pairs of welded vertices.
std::vector<std::array<std::uint32_t, 2>> borders_of(const PlacedMesh& part, const std::vector<Vector3>& at) {
  const auto weld = mesh::weld_positions(at);
  struct EdgeUse {
    std::uint32_t a, b;
    std::uint16_t style;
  };
  std::vector<EdgeUse> uses;
  for (std::size_t i = 0; i < part.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto a = weld[part.triangles[i][k]], b = weld[part.triangles[i][(k + 1) % 3]];
      uses.push_back({std::min(a, b), std::max(a, b), part.style[i]});
    }
  std::sort(uses.begin(), uses.end(),
            [](const EdgeUse& p, const EdgeUse& q) { return std::tie(p.a, p.b, p.style) < std::tie(q.a, q.b, q.style); });
  std::vector<std::array<std::uint32_t, 2>> borders;
  for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
    for (end = i; end < uses.size() && uses[end].a == uses[i].a && uses[end].b == uses[i].b;) ++end;
    if (end - i == 1 || uses[end - 1].style != uses[i].style) borders.push_back({uses[i].a, uses[i].b});
  }
  return borders;
}

SampledSurface sample_surface(const PlacedMesh& part, const std::vector<Vector3>& at, const LocalChart& chart, double h) {
  SampledSurface pieces;
  pieces.surface.positions = at;
  const Subdivider subdivider(part, at, chart, h);
  for (const auto& t : part.triangles) subdivider.add_triangle(t, pieces.surface);
  for (const auto& [a, b] : borders_of(part, at)) subdivider.add_line(a, b, pieces.lines);
  return pieces;
}

/// Whether surfaces can be compared in pieces of length h, in time that follows from the number of triangles. Needles, such as those of
/// polygons with thousands of corners, would become thousands of pieces each.
bool is_comparable(const PlacedMesh& part, const std::vector<Vector3>& at, const LocalChart& chart, double h) {
  const Subdivider subdivider(part, at, chart, h);
  std::size_t pieces = 0;
  for (const auto& t : part.triangles) pieces += subdivider.pieces(t);
  return pieces <= kMaxPiecesPerTriangle * part.triangles.size() + kMaxPieces;
}

/// The largest distance of a vertex of `from` to the other surface, or `worst` where that is larger. By the triangle inequality a vertex is
/// no farther than the vertex before it plus the distance between the two: that bounds the search.
double one_sided_distance(const mesh::Mesh& from, const mesh::ClosestPointTree& to, double worst) {
  double last = kUnknownDistance;
  const Vector3* before = nullptr;
  for (const Vector3& p : from.positions) {
    const double upper_bound = before ? std::min(kUnknownDistance, (last + length(p - *before)) * (1 + 1e-9) + 1e-15) : kUnknownDistance;
    last = to.distance(p, upper_bound, worst);
    worst = std::max(worst, last);
    before = &p;
  }
  return worst;
}

double two_sided_distance(const mesh::Mesh& a, const mesh::ClosestPointTree& to_a, const mesh::Mesh& b) {
  if (a.triangles.empty() && b.triangles.empty()) return 0;
  if (a.triangles.empty() || b.triangles.empty()) return std::numeric_limits<double>::infinity();
  return one_sided_distance(b, to_a, one_sided_distance(a, mesh::ClosestPointTree(b), 0));
}

bool is_heavy(const PlacedMesh& part) {
  if (part.kind != place::PartKind::object || part.triangles.size() < kMinTriangles || !part.uv.empty()) return false;
  return std::set<std::uint16_t>(part.style.begin(), part.style.end()).size() <= kMaxStyles;
}

PlacedMesh lod_mesh(const PlacedMesh& part, const mesh::Decimated& coarse, const std::vector<std::uint16_t>& looks) {
  PlacedMesh mesh;
  mesh.kind = part.kind;
  mesh.name = part.name;
  mesh.wall = part.wall;
  for (const std::uint32_t v : coarse.origin) {
    mesh.floor.push_back(part.floor[v]);
    mesh.z.push_back(part.z[v]);
    if (!part.pattern_position.empty()) mesh.pattern_position.push_back(part.pattern_position[v]);
    if (!part.color.empty()) mesh.color.push_back(part.color[v]);
  }
  mesh.triangles = coarse.mesh.triangles;
  for (const std::uint16_t look : coarse.mesh.triangle_material) mesh.style.push_back(looks[look]);
  return mesh;
}

/// The part as a flat mesh in its chart; materials number the styles in `styles`.
mesh::Mesh chart_mesh(const PlacedMesh& part, const LocalChart& chart, const std::vector<std::uint16_t>& styles) {
  mesh::Mesh flat;
  for (std::size_t i = 0; i < part.floor.size(); ++i) flat.positions.push_back(chart(part.floor[i], part.z[i]));
  flat.triangles = part.triangles;
  for (const std::uint16_t look : part.style)
    flat.triangle_material.push_back(static_cast<std::uint16_t>(std::lower_bound(styles.begin(), styles.end(), look) - styles.begin()));
  return flat;
}

std::vector<std::uint16_t> styles_of(const PlacedMesh& part) {
  std::vector<std::uint16_t> styles(part.style);
  std::sort(styles.begin(), styles.end());
  styles.erase(std::unique(styles.begin(), styles.end()), styles.end());
  return styles;
}

/// The length of pieces at which surfaces are compared: an eighth of the chart's radius, or about 4 edges where that is less.
double sample_spacing(const mesh::Mesh& flat, const LocalChart& chart) {
  double area = 0;
  for (const auto& t : flat.triangles)
    area += length(cross(flat.positions[t[1]] - flat.positions[t[0]], flat.positions[t[2]] - flat.positions[t[0]])) / 2;
  return std::min(std::max(chart.radius(), 1e-9) / 8, 4 * std::sqrt(area / static_cast<double>(flat.triangles.size()))) + 1e-12;
}

/// The coarser levels of a part, finest first.
std::vector<Lod> chain_of(Space space, const PlacedMesh& part, const Executor& executor) {
  const LocalChart chart(space, bend::bounding_cylinder(space, part));
  if (space == Space::hyperbolic && !(chart.radius() < kMaxChartRadius)) return {};
  const std::vector<std::uint16_t> styles = styles_of(part);
  const mesh::Mesh flat = chart_mesh(part, chart, styles);
  std::vector<std::size_t> triangle_counts;
  for (double n = kTriangleRatio * static_cast<double>(part.triangles.size()); n >= kSmallestLodTriangles; n *= kTriangleRatio)
    triangle_counts.push_back(static_cast<std::size_t>(n));
  const double h = sample_spacing(flat, chart);
  if (!is_comparable(part, flat.positions, chart, h)) return {};
  std::vector<mesh::Decimated> decimated;
  SampledSurface given;
  std::optional<mesh::ClosestPointTree> to_surface, to_lines;
  executor(2, [&](std::size_t task) {
    if (task == 0) {
      decimated = mesh::decimate_in_steps(flat, triangle_counts);
    } else {
      given = sample_surface(part, flat.positions, chart, h);
      to_surface.emplace(given.surface);
      to_lines.emplace(given.lines);
    }
  });
  std::vector<Lod> chain(decimated.size());
  executor(chain.size(), [&](std::size_t i) {
    Lod& lod = chain[i];
    lod.mesh = lod_mesh(part, decimated[i], styles);
    const SampledSurface coarse = sample_surface(lod.mesh, decimated[i].mesh.positions, chart, h);
    const double distance =
        std::max(two_sided_distance(given.surface, *to_surface, coarse.surface), two_sided_distance(given.lines, *to_lines, coarse.lines));
    lod.offset = chart.intrinsic_length(distance + 2 * chart.sag(h));
  });
  // Selection walks up the chain until the tolerance is exceeded: offsets must not decrease.
  for (std::size_t i = 1; i < chain.size(); ++i) chain[i].offset = std::max(chain[i].offset, chain[i - 1].offset);
  return chain;
}

}  // namespace

InteriorWithLods without_lods(const place::Interior& room) {
  InteriorWithLods lods{room, {}, std::vector<double>(room.parts.size(), 0.0)};
  for (std::size_t p = 0; p < room.parts.size(); ++p) lods.part_of_level.emplace_back(1, static_cast<std::uint32_t>(p));
  return lods;
}

InteriorWithLods build_lods(const place::Interior& room, const Executor& executor) {
  std::vector<std::vector<Lod>> chains(room.parts.size());
  executor(room.parts.size(), [&](std::size_t p) {
    if (is_heavy(room.parts[p])) chains[p] = chain_of(room.polygon.space, room.parts[p], executor);
  });
  InteriorWithLods lods = without_lods(room);
  for (std::size_t p = 0; p < chains.size(); ++p)
    for (Lod& lod : chains[p]) {
      lods.part_of_level[p].push_back(static_cast<std::uint32_t>(lods.interior.parts.size()));
      lods.surface_offset.push_back(lod.offset);
      lods.interior.parts.push_back(std::move(lod.mesh));
    }
  return lods;
}

}  // namespace orbc::lod
