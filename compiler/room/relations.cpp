// Side lengths as targets: some walls have a given length, others one that is a multiple of another wall's. With N − 3 of both together the
// polygon is found by Newton's method from the tangential one; the path from there (homotopy, Allgower and Georg, Numerical Continuation
// Methods, chapter 2) is followed in steps that are halved when Newton's method fails.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "compiler/room/polygon.h"

namespace orbc::room {
namespace {

using Vector = std::vector<Real>;

const Real& wanted_residual() {
  static const Real residual("1e-30");
  return residual;
}

/// What a room of these angles is to obey. Unknowns are the lengths of the walls of `relations`, in their order.
struct Wanted {
  const std::vector<CornerAngle>* angles = nullptr;
  std::map<int, Real> given;
  std::vector<scene::LengthRelation> relations;
};

/// The polygon at these unknowns, and by how much each relation fails: length − factor · length of the other wall.
struct Trial {
  Polygon polygon;
  Vector residuals;
};

std::optional<Trial> trial(const Wanted& wanted, const std::map<int, Real>& given, const Vector& unknowns) {
  std::map<int, Real> lengths = given;
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (!(unknowns[i] > 0) || unknowns[i] > 40) return std::nullopt;
    lengths[wanted.relations[i].wall] = unknowns[i];
  }
  auto polygon = polygon_with_lengths(*wanted.angles, lengths);
  if (!polygon) return std::nullopt;
  Trial made{*std::move(polygon), {}};
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const scene::LengthRelation& relation = wanted.relations[i];
    const auto known = lengths.find(relation.of);
    const Real other = known != lengths.end() ? known->second : side_length(made.polygon, static_cast<std::size_t>(relation.of - 1));
    made.residuals.push_back(unknowns[i] - Real(relation.factor) * other);
  }
  return made;
}

/// Solves a small linear system by Gaussian elimination with row pivoting. Nothing when it is singular.
std::optional<Vector> solved(std::vector<Vector> matrix, Vector right) {
  const std::size_t n = right.size();
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < n; ++row)
      if (abs(matrix[row][column]) > abs(matrix[pivot][column])) pivot = row;
    if (matrix[pivot][column] == 0) return std::nullopt;
    std::swap(matrix[pivot], matrix[column]);
    std::swap(right[pivot], right[column]);
    for (std::size_t row = column + 1; row < n; ++row) {
      const Real factor = matrix[row][column] / matrix[column][column];
      for (std::size_t k = column; k < n; ++k) matrix[row][k] -= factor * matrix[column][k];
      right[row] -= factor * right[column];
    }
  }
  for (std::size_t row = n; row-- > 0;) {
    for (std::size_t k = row + 1; k < n; ++k) right[row] -= matrix[row][k] * right[k];
    right[row] /= matrix[row][row];
  }
  return right;
}

Real largest(const Vector& values) {
  Real most = 0;
  for (const Real& value : values)
    if (abs(value) > most) most = abs(value);
  return most;
}

/// Newton's method for residuals = `target`, from `unknowns`. Derivatives are forward differences, good to half of the digits.
std::optional<Vector> newton(const Wanted& wanted, const std::map<int, Real>& given, Vector unknowns, const Vector& target) {
  constexpr int kSteps = 12;  // each doubles the digits; the first differences have 25
  static const Real difference("1e-22");
  const std::size_t n = unknowns.size();
  for (int step = 0; step < kSteps; ++step) {
    const auto here = trial(wanted, given, unknowns);
    if (!here) return std::nullopt;
    Vector error = here->residuals;
    for (std::size_t i = 0; i < n; ++i) error[i] -= target[i];
    if (largest(error) < wanted_residual()) return unknowns;
    std::vector<Vector> jacobian(n, Vector(n));
    for (std::size_t k = 0; k < n; ++k) {
      Vector beside = unknowns;
      beside[k] += difference;
      const auto there = trial(wanted, given, beside);
      if (!there) return std::nullopt;
      for (std::size_t i = 0; i < n; ++i) jacobian[i][k] = (there->residuals[i] - here->residuals[i]) / difference;
    }
    const auto move = solved(std::move(jacobian), std::move(error));
    if (!move) return std::nullopt;
    for (std::size_t i = 0; i < n; ++i) unknowns[i] -= (*move)[i];
  }
  return std::nullopt;
}

std::optional<Polygon> reached(const Wanted& wanted, const Polygon& tangential) {
  constexpr double kSmallestStep = 1.0 / 256;
  const auto begin_of = [&](int wall) { return side_length(tangential, static_cast<std::size_t>(wall - 1)); };
  Vector unknowns;
  for (const scene::LengthRelation& relation : wanted.relations) unknowns.push_back(begin_of(relation.wall));
  std::map<int, Real> given;
  for (const auto& [wall, length] : wanted.given) given[wall] = begin_of(wall);
  const auto begin = trial(wanted, given, unknowns);
  if (!begin) return std::nullopt;
  double done = 0, step = 1;
  while (done < 1) {
    const double next = std::min(1.0, done + step);
    for (const auto& [wall, length] : wanted.given)
      given[wall] = next == 1 ? length : begin_of(wall) + Real(next) * (length - begin_of(wall));
    Vector target = begin->residuals;
    for (Real& residual : target) residual *= Real(1 - next);
    if (const auto found = newton(wanted, given, unknowns, target)) {
      unknowns = *found;
      done = next;
      continue;
    }
    step /= 2;
    if (step < kSmallestStep) return std::nullopt;
  }
  auto end = trial(wanted, wanted.given, unknowns);
  if (!end) return std::nullopt;
  return std::move(end->polygon);
}

std::optional<Diagnostic> fault(int walls, const scene::Shape& shape) {
  const std::size_t count = shape.lengths.size() + shape.relations.size();
  if (static_cast<int>(count) != walls - 3)
    return make_error("room.bad-lengths",
                      fmt::format("{} side lengths are given, a room of {} walls has {} free ones", count, walls, walls - 3));
  const auto no_wall = [&](int wall) {
    return make_error("room.bad-lengths", fmt::format("there is no wall {}: walls are numbered from 1 to {}", wall, walls));
  };
  const auto is_wall = [&](int wall) { return wall >= 1 && wall <= walls; };
  for (const auto& [wall, length] : shape.lengths) {
    if (!is_wall(wall)) return no_wall(wall);
    if (!(length > 0 && length <= 40))
      return make_error("room.bad-lengths", fmt::format("wall {} has the length {}", wall, length),
                        "lengths are more than 0 and at most 40");
  }
  for (const scene::LengthRelation& relation : shape.relations) {
    if (!is_wall(relation.wall)) return no_wall(relation.wall);
    if (!is_wall(relation.of)) return no_wall(relation.of);
    if (!(relation.factor > 0 && relation.factor <= 1000))
      return make_error("room.bad-lengths", fmt::format("wall {} is {} times wall {}", relation.wall, relation.factor, relation.of),
                        "factors are more than 0 and at most 1000");
  }
  return std::nullopt;
}

/// Lengths that follow from given ones by relations become given ones. What is left over of `relations` leads to walls without a length.
/// Diagnostics: room.bad-lengths, if relations lead back to where they began.
Result<Wanted> wanted_of(const std::vector<CornerAngle>& angles, const scene::Shape& shape) {
  Wanted wanted{&angles, {}, {}};
  for (const auto& [wall, length] : shape.lengths) wanted.given[wall] = length;
  for (const scene::LengthRelation& relation : shape.relations) {
    scene::LengthRelation whole = relation;
    std::set<int> met{relation.wall};
    while (true) {
      if (!met.insert(whole.of).second)
        return make_error("room.bad-lengths", fmt::format("the length of wall {} is told by itself", relation.wall),
                          "one wall of the circle needs a length, or must be left out");
      const auto given = shape.lengths.find(whole.of);
      if (given != shape.lengths.end()) {
        wanted.given[relation.wall] = Real(whole.factor) * Real(given->second);
        break;
      }
      const auto next = std::find_if(shape.relations.begin(), shape.relations.end(),
                                     [&](const scene::LengthRelation& other) { return other.wall == whole.of; });
      if (next == shape.relations.end()) {
        wanted.relations.push_back(whole);
        break;
      }
      whole.factor *= next->factor;
      whole.of = next->of;
    }
  }
  return wanted;
}

}  // namespace

Result<Polygon> polygon_with_wanted_lengths(const std::vector<CornerAngle>& angles, const scene::Shape& shape, const Polygon& tangential) {
  if (auto wrong = fault(static_cast<int>(angles.size()), shape)) return *std::move(wrong);
  auto wanted = wanted_of(angles, shape);
  if (!wanted) return std::move(wanted).error();
  auto polygon = wanted->relations.empty() ? polygon_with_lengths(angles, wanted->given) : reached(*wanted, tangential);
  if (!polygon) return make_error("room.no-such-shape", "no room with these corners has walls of these lengths");
  return *std::move(polygon);
}

}  // namespace orbc::room
