// N − 3 sides are given, three are free. The walls between two free walls form a rigid chain, whose angles and lengths are known. So the
// inner products of the free lines are known, and the polygon follows from their Gram matrix in closed form, as a triangle follows from its
// angles (a generalised triangle: lines may cross, be parallel or have a common perpendicular). Of the two mirror images of the third line
// at most one closes a convex room.
#include <array>
#include <cmath>

#include "compiler/room/polygon.h"

namespace orbc::room {
namespace {

// The lines of consecutive walls, in coordinates of the end of the first wall.
struct Chain {
  std::vector<RealVector> lines;
};

Chain chain_between(const std::vector<CornerAngle>& angles, const std::map<int, Real>& lengths, std::size_t from, std::size_t to) {
  const std::size_t n = angles.size();
  RealVector at{1, 0, 0}, along{0, 1, 0}, left{0, 0, 1};
  Chain chain{{dual(-1, left)}};
  for (std::size_t wall = from; wall != to;) {
    wall = (wall + 1) % n;
    // At the corner the border turns left by π − α.
    const Real &c = angles[wall].cos, &s = angles[wall].sin;
    const RealVector turned = s * left - c * along;
    left = (-s) * along - c * left;
    along = turned;
    chain.lines.push_back(dual(-1, left));
    if (wall == to) break;
    const Real length = lengths.at(static_cast<int>(wall) + 1), ch = cosh(length), sh = sinh(length);
    const RealVector moved = ch * at + sh * along;
    along = sh * at + ch * along;
    at = moved;
  }
  return chain;
}

// Moves a chain so that its first and last line become `first` and `last`. All its lines keep their coordinates in the basis
// (first, last, first × last).
std::vector<RealVector> moved(const Chain& chain, const RealVector& first, const RealVector& last) {
  const RealVector &f = chain.lines.front(), &l = chain.lines.back(), m = dual(-1, cross(f, l)), image = dual(-1, cross(first, last));
  const Real g = inner(-1, f, l), det = 1 - g * g;
  std::vector<RealVector> lines;
  for (const RealVector& line : chain.lines) {
    const Real p = inner(-1, line, f), q = inner(-1, line, l), r = inner(-1, line, m);
    lines.push_back(((p - g * q) / det) * first + ((q - g * p) / det) * last - (r / det) * image);
  }
  return lines;
}

std::optional<Polygon> assembled(std::size_t n, const std::array<std::size_t, 3>& free, const std::array<Chain, 3>& chains,
                                 const std::array<RealVector, 3>& free_lines) {
  std::vector<RealVector> lines(n);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<RealVector> placed = moved(chains[i], free_lines[i], free_lines[(i + 1) % 3]);
    for (std::size_t j = 0; j + 1 < placed.size(); ++j) lines[(free[i] + j) % n] = placed[j];
  }
  return closed_polygon(std::move(lines));
}

}  // namespace

std::optional<Polygon> polygon_with_lengths(const std::vector<CornerAngle>& angles, const std::map<int, Real>& lengths) {
  const std::size_t n = angles.size();
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < n; ++i)
    if (!lengths.count(static_cast<int>(i) + 1)) open.push_back(i);

  // Begin with the pair of free lines that is farthest from parallel: for |g| = 1 they are no basis.
  std::array<std::size_t, 3> best{};
  std::array<Chain, 3> best_chains;
  Real best_gap = -1;
  for (std::size_t start = 0; start < 3; ++start) {
    const std::array<std::size_t, 3> free{open[start], open[(start + 1) % 3], open[(start + 2) % 3]};
    Chain first = chain_between(angles, lengths, free[0], free[1]);
    const Real g = inner(-1, first.lines.front(), first.lines.back()), gap = abs(1 - g * g);
    if (gap <= best_gap) continue;
    best = free;
    best_gap = gap;
    best_chains = {std::move(first), chain_between(angles, lengths, free[1], free[2]), chain_between(angles, lengths, free[2], free[0])};
  }
  const auto product = [&](std::size_t i) { return inner(-1, best_chains[i].lines.front(), best_chains[i].lines.back()); };
  const Real g = product(0), g12 = product(1), g02 = product(2), det = 1 - g * g;
  const RealVector n0 = best_chains[0].lines.front(), n1 = best_chains[0].lines.back(), m = dual(-1, cross(n0, n1));
  const Real x = (g02 - g * g12) / det, y = (g12 - g * g02) / det, z2 = (x * g02 + y * g12 - 1) / det;
  if (z2 > 0)
    for (const int sign : {1, -1}) {
      const RealVector n2 = x * n0 + y * n1 + (sign * sqrt(z2)) * m;
      if (auto polygon = assembled(n, best, best_chains, {n0, n1, n2})) return polygon;
    }
  return std::nullopt;
}

}  // namespace orbc::room
