// The paper's rooms (Zheng, Zhang, Zhang 2023, "Room realisation"; Milley 1998): cut along common perpendiculars into quads *22k₃k₄ and
// pentagons *2222k whose cut sides are free. With walls as vertices, corners as sides and cuts as diagonals this is a triangulation
// of an N-gon: a piece is a triangle of walls, each pair of which meets in a corner (cos α) or is joined by a cut of length l (cosh l).
// Unit covectors have n·n' = −cos α or −cosh l, and this Gram matrix is the piece: the paper's equations for quad and pentagon (the corner
// of the pentagon opposite to its free wall) are the generalised law of cosines
//   (c_bc + c_ab c_ac) / (√|1−c_ab²| √|1−c_ac²|) = cosh or sinh of the side on wall a,
// and right-angled hexagons (three cuts) come for free. Pieces are placed outwards from a middle cut by solving for the third
// covector; in 50 digits this walk loses nothing that a double could show.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "compiler/room/polygon.h"

namespace orbc::room {
namespace {

using scene::Cut;

constexpr double kLongestCut = 20;  // beyond it a piece reaches farther than doubles can hold

Diagnostic bad_cuts(std::string message, std::string hint = "each cut joins two walls that share no corner, and cuts must not cross") {
  return make_error("room.bad-cuts", std::move(message), std::move(hint));
}

bool crossing(const Cut& a, const Cut& b) {
  const auto between = [&](int wall) { return a.walls[0] < wall && wall < a.walls[1]; };
  const bool shared = b.walls[0] == a.walls[0] || b.walls[0] == a.walls[1] || b.walls[1] == a.walls[0] || b.walls[1] == a.walls[1];
  return !shared && between(b.walls[0]) != between(b.walls[1]);
}

std::optional<Diagnostic> fault(int walls, const Cut& cut) {
  const auto [a, b] = cut.walls;
  if (a < 1 || b > walls || a == b)
    return bad_cuts(fmt::format("a cut joins two different walls between 1 and {}, not {} and {}", walls, a, b));
  if (b - a == 1 || b - a == walls - 1)
    return bad_cuts(fmt::format("walls {} and {} share a corner: no cut is perpendicular to both", a, b));
  if (!(cut.length > 0 && cut.length <= kLongestCut))
    return bad_cuts(fmt::format("the cut of walls {} and {} has the length {}", a, b, cut.length),
                    fmt::format("lengths of cuts are more than 0 and at most {}", kLongestCut));
  return std::nullopt;
}

// Splits the dual polygon `vertices` (increasing walls) along the cuts, and fans what is left at its last vertex.
void fill(const std::vector<int>& vertices, std::map<std::array<int, 2>, double>& cuts, double default_length,
          std::vector<std::array<int, 3>>* triangles) {
  const std::size_t n = vertices.size();
  if (n < 3) return;
  if (n == 3) {
    if (triangles) triangles->push_back({vertices[0], vertices[1], vertices[2]});
    return;
  }
  std::size_t from = 0, to = 0;
  for (const auto& [walls, length] : cuts) {
    const auto first = std::lower_bound(vertices.begin(), vertices.end(), walls[0]),
               second = std::lower_bound(vertices.begin(), vertices.end(), walls[1]);
    if (first == vertices.end() || second == vertices.end() || *first != walls[0] || *second != walls[1]) continue;
    const auto gap = static_cast<std::size_t>(second - first);
    if (gap == 1 || gap == n - 1) continue;
    from = static_cast<std::size_t>(first - vertices.begin()), to = static_cast<std::size_t>(second - vertices.begin());
    break;
  }
  if (to == 0) {
    from = n - 3, to = n - 1;
    cuts[{vertices[from], vertices[to]}] = default_length;
  }
  const auto at = [&](std::size_t i) { return vertices.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<int> inner(at(from), at(to + 1)), outer(vertices.begin(), at(from + 1));
  outer.insert(outer.end(), at(to), vertices.end());
  fill(inner, cuts, default_length, triangles);
  fill(outer, cuts, default_length, triangles);
}

std::vector<int> all_walls(int walls) {
  std::vector<int> vertices;
  for (int i = 1; i <= walls; ++i) vertices.push_back(i);
  return vertices;
}

// The lines of all walls, placed from the middle cut outwards.
class Placing {
 public:
  Placing(const std::vector<CornerAngle>& angles, const std::vector<Cut>& cuts) : lines_(angles.size()) {
    const int n = static_cast<int>(angles.size());
    for (int i = 1; i <= n; ++i) {
      const int next = i % n + 1;  // walls i and i+1 meet in corner i+1
      cosine_[ordered(i, next)] = angles[static_cast<std::size_t>(next - 1)].cos;
    }
    std::map<std::array<int, 2>, double> lengths;
    for (const Cut& cut : cuts) {
      lengths[cut.walls] = cut.length;
      cosine_[cut.walls] = cosh(Real(cut.length));
      sine_[cut.walls] = sinh(Real(cut.length));
    }
    std::vector<std::array<int, 3>> triangles;
    fill(all_walls(n), lengths, 1, &triangles);
    for (const auto& t : triangles)
      for (int i = 0; i < 3; ++i)
        third_[{t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>((i + 1) % 3)]}] = t[static_cast<std::size_t>((i + 2) % 3)];
  }

  // Nothing when three lines cannot lie like that (corners wider than π/2 only).
  std::optional<std::vector<RealVector>> place(const Cut& middle) {
    const auto [a, b] = middle.walls;
    const Real s = sinh(Real(middle.length) / 2), c = cosh(Real(middle.length) / 2);
    line(a) = {s, 0, c};
    line(b) = {s, 0, -c};
    // The two sides of every placed cut wait here: the triangle (a, b, third) lies counter-clockwise.
    std::vector<std::array<int, 2>> open = {{a, b}, {b, a}};
    while (!open.empty()) {
      const std::array<int, 2> edge = open.back();
      open.pop_back();
      const int third = third_.at(edge);
      if (!place_third(edge[0], edge[1], third)) return std::nullopt;
      if (sine_.count(ordered(edge[1], third))) open.push_back({third, edge[1]});
      if (sine_.count(ordered(third, edge[0]))) open.push_back({edge[0], third});
    }
    return lines_;
  }

 private:
  static std::array<int, 2> ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  RealVector& line(int wall) { return lines_[static_cast<std::size_t>(wall - 1)]; }

  // n_c = x n_a + y n_b − z m, where m is the cut's own line with the new piece to its left.
  bool place_third(int a, int b, int c) {
    const Real &g = cosine_.at(ordered(a, b)), &s = sine_.at(ordered(a, b)), &ca = cosine_.at(ordered(a, c)),
               &cb = cosine_.at(ordered(b, c));
    const RealVector m = (-1 / s) * dual(-1, cross(line(a), line(b)));
    const Real x = (ca + g * cb) / (s * s), y = (cb + g * ca) / (s * s), z2 = 1 + x * ca + y * cb;
    if (!(z2 > 0)) return false;
    line(c) = x * line(a) + y * line(b) - sqrt(z2) * m;
    return true;
  }

  std::vector<RealVector> lines_;
  std::map<std::array<int, 2>, Real> cosine_, sine_;  // cos of corners, cosh and sinh of cuts
  std::map<std::array<int, 2>, int> third_;           // directed side of a triangle → its third wall
};

}  // namespace

Result<std::vector<Cut>> complete_cuts(int walls, const std::vector<Cut>& named, double default_length) {
  if (!(default_length > 0 && default_length <= kLongestCut))
    return bad_cuts(fmt::format("the length of cuts is {}", default_length),
                    fmt::format("lengths of cuts are more than 0 and at most {}", kLongestCut));
  Diagnostics faults;
  std::map<std::array<int, 2>, double> cuts;
  std::vector<Cut> good;
  for (Cut cut : named) {
    if (cut.walls[0] > cut.walls[1]) std::swap(cut.walls[0], cut.walls[1]);
    if (auto wrong = fault(walls, cut)) {
      faults.push_back(std::move(*wrong));
      continue;
    }
    const auto [a, b] = cut.walls;
    if (cuts.count(cut.walls)) faults.push_back(bad_cuts(fmt::format("the cut of walls {} and {} is named twice", a, b)));
    for (const Cut& other : good)
      if (crossing(cut, other))
        faults.push_back(bad_cuts(fmt::format("the cuts {}–{} and {}–{} cross", a, b, other.walls[0], other.walls[1])));
    cuts[cut.walls] = cut.length;
    good.push_back(cut);
  }
  if (!faults.empty()) return faults;
  fill(all_walls(walls), cuts, default_length, nullptr);
  std::vector<Cut> complete;
  for (const auto& [pair, length] : cuts) complete.push_back({pair, length});
  return complete;
}

Result<Polygon> glued_polygon(const std::vector<CornerAngle>& angles, const std::vector<Cut>& cuts) {
  // The middle cut is the one with the most even numbers of walls to its sides.
  const int n = static_cast<int>(angles.size());
  const auto evenness = [&](const Cut& cut) {
    const int d = cut.walls[1] - cut.walls[0];
    return std::min(d, n - d);
  };
  const Cut& middle = *std::max_element(cuts.begin(), cuts.end(), [&](const Cut& a, const Cut& b) { return evenness(a) < evenness(b); });
  if (auto lines = Placing(angles, cuts).place(middle))
    if (auto polygon = closed_polygon(std::move(*lines))) return *std::move(polygon);
  // With corners up to π/2 the pieces always fit; only 50 digits can have been too few.
  if (std::all_of(angles.begin(), angles.end(), [](const CornerAngle& angle) { return angle.cos >= 0; }))
    return make_error("room.no-certificate",
                      "the room reaches more than 50 curvature radii from its centre, far more than double precision carries",
                      "longer cuts, a decomposition with cuts on several walls, or the shape tangential reach less far");
  return make_error("room.no-such-shape", "corners this wide leave no room between cuts of these lengths",
                    "choose other cuts or lengths, or the shape tangential");
}

}  // namespace orbc::room
