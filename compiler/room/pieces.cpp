// The paper's rooms (Zheng, Zhang, Zhang 2023, "Room realisation"; Milley 1998): a polygon is cut along common perpendiculars of its walls
// into quads *22k₃k₄ and pentagons *2222k whose cut sides have free lengths. With walls as vertices, corners as sides and cuts as diagonals
// this is a triangulation of an N-gon: a piece is a triangle of walls, each pair of which meets in a corner (cos α) or is joined by a cut
// of length l (cosh l).
//
// Unit covectors have n·n' = −cos α or −cosh l, and this Gram matrix determines the piece. The paper's equations for quad and pentagon (the
// corner of the pentagon opposite to its free wall) are the generalised law of cosines
//   (c_bc + c_ab c_ac) / (√|1−c_ab²| √|1−c_ac²|) = cosh or sinh of the side on wall a,
// which covers right-angled hexagons (three cuts) as well. Pieces are assembled outwards from a middle cut, by solving for the third
// covector of each; in 50 digits the accumulated error stays below what a double can show.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "compiler/room/polygon.h"

namespace orbc::room {
namespace {

using scene::Cut;

constexpr double kMaxCutLength = 20;  // beyond it a piece reaches farther than doubles can hold

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
  if (!(cut.length > 0 && cut.length <= kMaxCutLength))
    return bad_cuts(fmt::format("the cut of walls {} and {} has the length {}", a, b, cut.length),
                    fmt::format("lengths of cuts are more than 0 and at most {}", kMaxCutLength));
  return std::nullopt;
}

using WallPair = std::array<int, 2>;

/// A triangulation of the dual polygon.
struct Decomposition {
  std::map<WallPair, double> cuts;         // with their lengths
  std::vector<std::array<int, 3>> pieces;  // by their walls
};

/// Two entries of a list.
struct Diagonal {
  std::size_t from = 0, to = 0;
};

/// The first cut that is a diagonal of the polygon `vertices`; nothing when there is none.
std::optional<Diagonal> diagonal_among(const std::map<WallPair, double>& cuts, const std::vector<int>& vertices) {
  for (const auto& [walls, length] : cuts) {
    const auto first = std::lower_bound(vertices.begin(), vertices.end(), walls[0]),
               second = std::lower_bound(vertices.begin(), vertices.end(), walls[1]);
    if (first == vertices.end() || second == vertices.end() || *first != walls[0] || *second != walls[1]) continue;
    const auto gap = static_cast<std::size_t>(second - first);
    if (gap == 1 || gap == vertices.size() - 1) continue;
    return Diagonal{static_cast<std::size_t>(first - vertices.begin()), static_cast<std::size_t>(second - vertices.begin())};
  }
  return std::nullopt;
}

/// Divides the dual polygon `vertices` (increasing walls) along the named cuts, and the rest by a fan around its last vertex.
Decomposition decomposed(const std::vector<int>& vertices, const std::map<WallPair, double>& named, double default_length) {
  const std::size_t n = vertices.size();
  if (n < 3) return {};
  if (n == 3) return {{}, {{vertices[0], vertices[1], vertices[2]}}};
  const std::optional<Diagonal> named_diagonal = diagonal_among(named, vertices);
  const auto [from, to] = named_diagonal.value_or(Diagonal{n - 3, n - 1});
  const WallPair walls{vertices[from], vertices[to]};
  const auto at = [&vertices](std::size_t i) { return vertices.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<int> inner(at(from), at(to + 1)), outer(vertices.begin(), at(from + 1));
  outer.insert(outer.end(), at(to), vertices.end());
  Decomposition result;
  result.cuts[walls] = named_diagonal ? named.at(walls) : default_length;
  for (const std::vector<int>& side : {inner, outer}) {
    const Decomposition part = decomposed(side, named, default_length);
    result.cuts.insert(part.cuts.begin(), part.cuts.end());
    result.pieces.insert(result.pieces.end(), part.pieces.begin(), part.pieces.end());
  }
  return result;
}

std::vector<int> all_walls(int walls) {
  std::vector<int> vertices;
  for (int i = 1; i <= walls; ++i) vertices.push_back(i);
  return vertices;
}

/// Computes the lines of all walls, piece by piece, from a middle cut outwards. Invariant: the lines of both walls of a cut are known
/// before the piece behind it is placed.
class PieceAssembly {
 public:
  PieceAssembly(const std::vector<CornerAngle>& angles, const std::vector<Cut>& cuts) : lines_(angles.size()) {
    const int n = static_cast<int>(angles.size());
    for (int i = 1; i <= n; ++i) {
      const int next = i % n + 1;  // walls i and i+1 meet in corner i+1
      cosine_[ordered(i, next)] = angles[static_cast<std::size_t>(next - 1)].cos;
    }
    std::map<WallPair, double> lengths;
    for (const Cut& cut : cuts) {
      lengths[cut.walls] = cut.length;
      cosine_[cut.walls] = cosh(Real(cut.length));
      sine_[cut.walls] = sinh(Real(cut.length));
    }
    for (const auto& t : decomposed(all_walls(n), lengths, 1).pieces)
      for (int i = 0; i < 3; ++i)
        third_[{t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>((i + 1) % 3)]}] = t[static_cast<std::size_t>((i + 2) % 3)];
  }

  // Nothing when a piece does not exist (only with corners wider than π/2).
  std::optional<std::vector<RealVector>> assemble(const Cut& middle) {
    const auto [a, b] = middle.walls;
    const Real s = sinh(Real(middle.length) / 2), c = cosh(Real(middle.length) / 2);
    line(a) = {s, 0, c};
    line(b) = {s, 0, -c};
    // Directed cuts whose piece is not placed yet: the piece (a, b, third) lies counter-clockwise.
    std::vector<WallPair> open = {{a, b}, {b, a}};
    while (!open.empty()) {
      const WallPair edge = open.back();
      open.pop_back();
      const int third = third_.at(edge);
      if (!place_third(edge[0], edge[1], third)) return std::nullopt;
      if (sine_.count(ordered(edge[1], third))) open.push_back({third, edge[1]});
      if (sine_.count(ordered(third, edge[0]))) open.push_back({edge[0], third});
    }
    return lines_;
  }

 private:
  static WallPair ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  RealVector& line(int wall) { return lines_[static_cast<std::size_t>(wall - 1)]; }

  // n_c = x n_a + y n_b − z m, where m is the line of the cut, with the new piece to its left.
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
  std::map<WallPair, Real> cosine_, sine_;  // cos of corners, cosh and sinh of cuts
  std::map<WallPair, int> third_;           // directed side of a piece → its third wall
};

}  // namespace

Result<std::vector<Cut>> complete_cuts(int walls, const std::vector<Cut>& named, double default_length) {
  if (!(default_length > 0 && default_length <= kMaxCutLength))
    return bad_cuts(fmt::format("the length of cuts is {}", default_length),
                    fmt::format("lengths of cuts are more than 0 and at most {}", kMaxCutLength));
  Diagnostics faults;
  std::map<WallPair, double> cuts;
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
  const Decomposition decomposition = decomposed(all_walls(walls), cuts, default_length);
  cuts.insert(decomposition.cuts.begin(), decomposition.cuts.end());
  std::vector<Cut> complete;
  for (const auto& [pair, length] : cuts) complete.push_back({pair, length});
  return complete;
}

Result<Polygon> polygon_with_cuts(const std::vector<CornerAngle>& angles, const std::vector<Cut>& cuts) {
  // The middle cut divides the walls most evenly.
  const int n = static_cast<int>(angles.size());
  const auto evenness = [&](const Cut& cut) {
    const int d = cut.walls[1] - cut.walls[0];
    return std::min(d, n - d);
  };
  const Cut& middle = *std::max_element(cuts.begin(), cuts.end(), [&](const Cut& a, const Cut& b) { return evenness(a) < evenness(b); });
  if (auto lines = PieceAssembly(angles, cuts).assemble(middle))
    if (auto polygon = closed_polygon(std::move(*lines))) return *std::move(polygon);
  // With corners up to π/2 the pieces always exist. So 50 digits were too few.
  if (std::all_of(angles.begin(), angles.end(), [](const CornerAngle& angle) { return angle.cos >= 0; }))
    return make_error("room.no-certificate",
                      "the room reaches more than 50 curvature radii from its centre, far more than double precision carries",
                      "longer cuts, a decomposition with cuts on several walls, or the shape tangential reach less far");
  return make_error("room.no-such-shape", "corners this wide leave no room between cuts of these lengths",
                    "choose other cuts or lengths, or the shape tangential");
}

}  // namespace orbc::room
