// Level of detail. A part is simplified in the conformal chart around it (twice the disk: lengths at its middle are true), and each level
// is held to the part itself: both surfaces are divided into pieces of length h as the geodesic triangles that they are, and each piece's
// corners are looked up on the other surface. In the chart lengths differ from true ones by the factor 1 + κ|p|²/4, and a piece from the
// straight triangle on its corners by at most |P''|h²/6, |P''| ≤ 3|z| = 3|p|/2 (edge_mesh.cpp); both are added.
#include "compiler/driver/levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "compiler/geometry/chart.h"
#include "compiler/mesh/decimate.h"
#include "compiler/mesh/closest_point_tree.h"
#include "compiler/mesh/weld.h"

namespace orbc::driver {
namespace {

using geometry::Space;
using geometry::Vector3;
using place::PlacedMesh;

constexpr std::size_t kHeavy = 200;     // triangles
constexpr std::size_t kLightest = 24;   // triangles of the last level
constexpr double kStep = 0.4;           // of the triangles of the level before
constexpr double kAnything = 1e5;        // pixels: larger than pictures are; then even what is around the eye may be coarse
constexpr double kWhole = std::numeric_limits<double>::infinity();

/// The conformal chart around a part.
class Chart {
 public:
  Chart(Space space, const bend::BoundingCylinder& extent)
      : space_(space), chart_from_room_(inverse(geometry::translation_to(space, extent.centre))) {
    reach_ = space == Space::euclidean ? extent.radius : 2 * geometry::tan_k(space, extent.radius / 2);
  }
  [[nodiscard]] Vector3 operator()(const geometry::Ambient& v, double z) const {
    const auto p = (space_ == Space::euclidean ? 1.0 : 2.0) *
                   geometry::disk_from_point(space_, chart_from_room_ * geometry::normalised_point(space_, v));
    return {p.real(), p.imag(), z};
  }
  /// Intrinsic length of what is `length` long in the chart, at most.
  [[nodiscard]] double true_length(double length) const {
    return space_ == Space::hyperbolic ? length / (1 - reach_ * reach_ / 4) : length;
  }
  /// How far a geodesic piece of length h is from straight.
  [[nodiscard]] double sag(double h) const { return space_ == Space::euclidean ? 0 : reach_ * h * h / 4; }
  [[nodiscard]] double reach() const { return reach_; }

 private:
  Space space_;
  geometry::Isometry chart_from_room_;
  double reach_ = 0;
};

/// A surface, or the lines on it that must stay where they are, in pieces: positions in the chart. Lines are triangles without area.
struct Pieces {
  mesh::Mesh surface, lines;
};

/// Divides triangles and lines of a part into pieces no longer than h.
class Divider {
 public:
  Divider(const PlacedMesh& part, const std::vector<Vector3>& at, const Chart& chart, double h)
      : part_(part), at_(at), chart_(chart), h_(h) {}

  void add(const mesh::Triangle& t, mesh::Mesh& into) const {
    const int n = count(t);
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
    const int n = count(t);
    for (int i = 0; i <= n; ++i) into.positions.push_back(point(t, static_cast<double>(i) / n, 0));
    for (auto i = static_cast<std::uint32_t>(into.positions.size()) - static_cast<std::uint32_t>(n); i < into.positions.size(); ++i)
      into.triangles.push_back({i - 1, i, i});
  }

 private:
  [[nodiscard]] int count(const mesh::Triangle& t) const {
    double longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, length(at_[t[k]] - at_[t[(k + 1) % 3]]));
    return std::clamp(static_cast<int>(std::ceil(longest / h_)), 1, 64);
  }
  [[nodiscard]] Vector3 point(const mesh::Triangle& t, double b1, double b2) const {
    const double b0 = 1 - b1 - b2;
    return chart_(b0 * part_.floor[t[0]] + b1 * part_.floor[t[1]] + b2 * part_.floor[t[2]],
                  b0 * part_.z[t[0]] + b1 * part_.z[t[1]] + b2 * part_.z[t[2]]);
  }

  const PlacedMesh& part_;
  const std::vector<Vector3>& at_;
  const Chart& chart_;
  double h_;
};

/// Edges of one triangle, or between looks, by their ends' first vertices.
std::vector<std::array<std::uint32_t, 2>> borders_of(const PlacedMesh& part, const std::vector<Vector3>& at) {
  const auto weld = mesh::weld_positions(at);
  struct Side {
    std::uint32_t a, b;
    std::uint16_t look;
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < part.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto a = weld[part.triangles[i][k]], b = weld[part.triangles[i][(k + 1) % 3]];
      sides.push_back({std::min(a, b), std::max(a, b), part.style[i]});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& p, const Side& q) { return std::tie(p.a, p.b, p.look) < std::tie(q.a, q.b, q.look); });
  std::vector<std::array<std::uint32_t, 2>> borders;
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    for (end = i; end < sides.size() && sides[end].a == sides[i].a && sides[end].b == sides[i].b;) ++end;
    if (end - i == 1 || sides[end - 1].look != sides[i].look) borders.push_back({sides[i].a, sides[i].b});
  }
  return borders;
}

Pieces pieces_of(const PlacedMesh& part, const std::vector<Vector3>& at, const Chart& chart, double h) {
  Pieces pieces;
  pieces.surface.positions = at;
  const Divider divider(part, at, chart, h);
  for (const auto& t : part.triangles) divider.add(t, pieces.surface);
  for (const auto& [a, b] : borders_of(part, at)) divider.add_line(a, b, pieces.lines);
  return pieces;
}

/// The largest distance of a corner of `from` to the other, at least `worst`. A corner is no farther than the one before and the way
/// between.
double farthest(const mesh::Mesh& from, const mesh::ClosestPointTree& to, double worst) {
  double last = 1e9;
  const Vector3* before = nullptr;
  for (const Vector3& p : from.positions) {
    const double known = before ? std::min(1e9, (last + length(p - *before)) * (1 + 1e-9) + 1e-15) : 1e9;
    last = to.distance(p, known, worst);
    worst = std::max(worst, last);
    before = &p;
  }
  return worst;
}

double largest_distance(const mesh::Mesh& a, const mesh::ClosestPointTree& to_a, const mesh::Mesh& b) {
  if (a.triangles.empty() && b.triangles.empty()) return 0;
  if (a.triangles.empty() || b.triangles.empty()) return kWhole;
  return farthest(b, to_a, farthest(a, mesh::ClosestPointTree(b), 0));
}

bool is_heavy(const PlacedMesh& part) {
  if (part.kind != place::PartKind::object || part.triangles.size() < kHeavy || !part.uv.empty()) return false;
  return std::set<std::uint16_t>(part.style.begin(), part.style.end()).size() <= 256;
}

PlacedMesh stand_in(const PlacedMesh& part, const mesh::Decimated& coarse, const std::vector<std::uint16_t>& looks) {
  PlacedMesh mesh;
  mesh.kind = part.kind, mesh.name = part.name, mesh.wall = part.wall;
  for (const std::uint32_t v : coarse.origin) {
    mesh.floor.push_back(part.floor[v]);
    mesh.z.push_back(part.z[v]);
    if (!part.color.empty()) mesh.color.push_back(part.color[v]);
    if (!part.pattern_position.empty()) mesh.pattern_position.push_back(part.pattern_position[v]);
  }
  mesh.triangles = coarse.mesh.triangles;
  for (const std::uint16_t look : coarse.mesh.triangle_material) mesh.style.push_back(looks[look]);
  return mesh;
}

std::vector<Level> levels_of(Space space, const PlacedMesh& part, const Executor& executor) {
  const Chart chart(space, bend::bounding_cylinder(space, part));
  if (space == Space::hyperbolic && !(chart.reach() < 1.5)) return {};
  mesh::Mesh flat;
  for (std::size_t i = 0; i < part.floor.size(); ++i) flat.positions.push_back(chart(part.floor[i], part.z[i]));
  flat.triangles = part.triangles;
  std::vector<std::uint16_t> looks(part.style);
  std::sort(looks.begin(), looks.end());
  looks.erase(std::unique(looks.begin(), looks.end()), looks.end());
  for (const std::uint16_t look : part.style)
    flat.triangle_material.push_back(static_cast<std::uint16_t>(std::lower_bound(looks.begin(), looks.end(), look) - looks.begin()));
  std::vector<std::size_t> numbers;
  for (double n = kStep * static_cast<double>(part.triangles.size()); n >= kLightest; n *= kStep)
    numbers.push_back(static_cast<std::size_t>(n));
  double area = 0;
  for (const auto& t : flat.triangles)
    area += length(cross(flat.positions[t[1]] - flat.positions[t[0]], flat.positions[t[2]] - flat.positions[t[0]])) / 2;
  const double h = std::min(std::max(chart.reach(), 1e-9) / 8, 4 * std::sqrt(area / static_cast<double>(flat.triangles.size()))) + 1e-12;
  std::vector<mesh::Decimated> chain;
  Pieces given;
  std::optional<mesh::ClosestPointTree> to_surface, to_lines;
  executor(2, [&](std::size_t task) {
    if (task == 0) {
      chain = mesh::decimate_in_steps(flat, numbers);
    } else {
      given = pieces_of(part, flat.positions, chart, h);
      to_surface.emplace(given.surface);
      to_lines.emplace(given.lines);
    }
  });
  std::vector<Level> levels(chain.size());
  executor(chain.size(), [&](std::size_t i) {
    Level& level = levels[i];
    level.mesh = stand_in(part, chain[i], looks);
    const Pieces coarse = pieces_of(level.mesh, chain[i].mesh.positions, chart, h);
    const double off =
        std::max(largest_distance(given.surface, *to_surface, coarse.surface), largest_distance(given.lines, *to_lines, coarse.lines));
    level.error = chart.true_length(off + 2 * chart.sag(h));
  });
  // A coarser level is never better.
  for (std::size_t i = 1; i < levels.size(); ++i) levels[i].error = std::max(levels[i].error, levels[i - 1].error);
  return levels;
}

/// Gathers choices: the same one once.
class Gatherer {
 public:
  std::uint32_t index_of(const std::vector<std::uint16_t>& model) {
    const auto [at, is_new] = known_.try_emplace(model, static_cast<std::uint32_t>(choice_.models.size()));
    if (is_new) choice_.models.push_back(model);
    return at->second;
  }
  void add(const std::vector<std::uint16_t>& model) { choice_.model_of_copy.push_back(index_of(model)); }
  Choice choice_;

 private:
  std::map<std::vector<std::uint16_t>, std::uint32_t> known_;
};

}  // namespace

Levels make_levels(const place::Interior& room, const Executor& executor) {
  Levels levels(room.parts.size());
  executor(room.parts.size(), [&](std::size_t i) {
    if (is_heavy(room.parts[i])) levels[i] = levels_of(room.polygon.space, room.parts[i], executor);
  });
  return levels;
}

Choice no_levels(const place::Interior& room, std::size_t copies) {
  return {{std::vector<std::uint16_t>(room.parts.size(), 0)}, std::vector<std::uint32_t>(copies, 0), 0};
}

Choice choose_levels(const place::Interior& room, const Levels& levels, const std::vector<cover::Copy>& copies, const place::Camera& eye,
                     const bend::BendOptions& options) {
  const bend::ScreenSize detail(eye, options);
  std::vector<bend::BoundingCylinder> extents;
  for (const PlacedMesh& part : room.parts) extents.push_back(bend::bounding_cylinder(room.polygon.space, part));
  Gatherer gatherer;
  std::vector<std::uint16_t> model(room.parts.size(), 0);
  for (const cover::Copy& copy : copies) {
    for (std::size_t p = 0; p < levels.size(); ++p) {
      model[p] = 0;
      if (levels[p].empty()) continue;
      // Displacements reach no farther than the error of a level: most are small against the part, which tells more.
      double margin = extents[p].radius / 10, pixels = detail.pixels_per_length(copy, extents[p], margin);
      for (std::size_t l = 0; l < levels[p].size(); ++l) {
        const double error = levels[p][l].error;
        if (error > margin) margin = error, pixels = detail.pixels_per_length(copy, extents[p], margin);
        if (!(pixels * error <= options.tolerance_px) && options.tolerance_px < kAnything) break;
        model[p] = static_cast<std::uint16_t>(l + 1);
        gatherer.choice_.error_px = std::max(gatherer.choice_.error_px, std::min(pixels * error, options.tolerance_px));
      }
    }
    gatherer.add(model);
  }
  if (gatherer.choice_.models.empty()) gatherer.index_of(std::vector<std::uint16_t>(room.parts.size(), 0));
  return std::move(gatherer.choice_);
}

place::Interior rough(const place::Interior& room, const Levels& levels, double error) {
  place::Interior stand_in;
  stand_in.polygon = room.polygon, stand_in.height = room.height, stand_in.mirrors = room.mirrors, stand_in.styles = room.styles;
  for (place::SurfaceStyle& look : stand_in.styles) look.texture = -1;
  for (std::size_t p = 0; p < room.parts.size(); ++p) {
    const Level* coarsest = nullptr;
    for (const Level& level : levels[p])
      if (level.error <= error) coarsest = &level;
    stand_in.parts.push_back(coarsest ? coarsest->mesh : room.parts[p]);
  }
  return stand_in;
}

LevelTally tally(const place::Interior& room, const Levels& levels, const Choice& choice) {
  LevelTally all;
  std::uint64_t whole = 0;
  for (const PlacedMesh& part : room.parts) whole += part.triangles.size();
  for (const std::uint32_t m : choice.model_of_copy) {
    int coarsest = 0;
    for (std::size_t p = 0; p < levels.size(); ++p) {
      const std::uint16_t level = choice.models[m][p];
      coarsest = std::max<int>(coarsest, level);
      if (level > 0) all.saved += room.parts[p].triangles.size() - levels[p][level - 1U].mesh.triangles.size();
    }
    all.level_of_copy.push_back(coarsest);
  }
  all.triangles = whole * choice.model_of_copy.size() - all.saved;
  return all;
}

Stock stock_of(const place::Interior& room, const Levels& levels, const Choice& choice) {
  Stock stock{room, {}, std::vector<double>(room.parts.size(), 0.0)};
  for (std::size_t p = 0; p < room.parts.size(); ++p) {
    stock.part_of_level.emplace_back(1, static_cast<std::uint32_t>(p));
    for (std::size_t l = 0; p < levels.size() && l < levels[p].size(); ++l) {
      const bool used = std::any_of(choice.models.begin(), choice.models.end(), [&](const auto& model) { return model[p] == l + 1; });
      stock.part_of_level[p].push_back(used ? static_cast<std::uint32_t>(stock.room.parts.size()) : static_cast<std::uint32_t>(p));
      if (used) stock.room.parts.push_back(levels[p][l].mesh), stock.beside.push_back(levels[p][l].error);
    }
  }
  return stock;
}

}  // namespace orbc::driver
