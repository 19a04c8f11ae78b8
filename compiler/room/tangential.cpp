// The polygon around a circle. Incentre, touching point and corner form a right triangle with the angles θ (at the centre) and β = α/2:
//   cos β = cosκ r · sin θ   and   sinκ r = sinκ R · sin β        (Thurston, Three-Dimensional Geometry and Topology, §2.4; Napier's rules)
// so tan θᵢ = cos βᵢ / √Dᵢ with Dᵢ = sin² βᵢ − κu, u = sinκ² r, and the circle closes when Σ θᵢ = π. One unknown, one monotone function:
// bracketed Newton, in double for the start and in 50 digits for the end. Corners are computed from the centre, so that errors do not
// accumulate along the border.
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/room/polygon.h"

namespace orbc::room {
namespace {

using geometry::Space;

struct Value {
  Real excess, slope;  // Σ θ − π and its derivative by u
};

// Σ θ(u) − π, over groups of equal corners.
struct CircleEquation {
  struct Group {
    Real sin_half, cos_half;
    int count = 0;
  };
  int k = 0;
  std::vector<Group> groups;
  std::size_t narrowest = 0;
  bool beyond = false;  // S²: at the centre, the narrowest corner has an angle θ > π/2

  // dθ/du = κ cos β / (2 √D (1 − κu)). Instead of adding angles, the complex numbers √D + i cos β are multiplied, so that one arc tangent
  // is enough. The sum in double gives the number of full turns of the product.
  [[nodiscard]] Value at(const Real& u) const {
    Real x = -1, y = 0, slope = 0;
    double sum = -std::numbers::pi;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const Group& g = groups[i];
      const Real d = g.sin_half * g.sin_half - k * u;
      Real root = d > 0 ? sqrt(d) : Real(0);
      if (beyond && i == narrowest) root = -root;
      sum += g.count * math::atan2(static_cast<double>(g.cos_half), static_cast<double>(root));
      if (root != 0) slope += g.count * k * g.cos_half / (2 * root * (1 - k * u));
      for (int j = 0; j < g.count; ++j) {
        const Real turned = x * root - y * g.cos_half;
        y = x * g.cos_half + y * root;
        x = turned;
      }
    }
    const Real excess = atan2(y, x);
    return {excess + 2 * real_pi() * std::round((sum - static_cast<double>(excess)) / (2 * std::numbers::pi)), slope};
  }
};

// The same in double, for a start value.
struct EquationInDouble {
  const CircleEquation& fine;
  struct Value {
    double excess, slope;
  };
  [[nodiscard]] Value at(double u) const {
    Value value{-std::numbers::pi, 0};
    for (std::size_t i = 0; i < fine.groups.size(); ++i) {
      const auto& g = fine.groups[i];
      const double s = static_cast<double>(g.sin_half), c = static_cast<double>(g.cos_half), d = s * s - fine.k * u;
      double root = d > 0 ? std::sqrt(d) : 0;
      if (fine.beyond && i == fine.narrowest) root = -root;
      value.excess += g.count * math::atan2(c, root);
      if (root != 0) value.slope += g.count * fine.k * c / (2 * root * (1 - fine.k * u));
    }
    return value;
  }
};

// Newton's method that never leaves the bracket [low, high]; `rising`: the excess rises with u.
template <class Number, class Equation>
Number solve(const Equation& equation, Number low, Number high, Number u, bool rising, const Number& precision) {
  for (int i = 0; i < 400; ++i) {
    const auto value = equation.at(u);
    if (value.excess == 0) return u;
    if ((value.excess < 0) == rising) low = u;
    else high = u;
    Number next = value.slope != 0 ? Number(u - value.excess / value.slope) : low;
    if (!(next > low && next < high)) next = (low + high) / 2;
    const Number step = next > u ? next - u : u - next;
    u = next;
    // Newton's method squares the error: after a step this small the error is below the precision.
    if (step <= precision * u) return u;
  }
  return u;
}

CircleEquation equation_of(Space space, const std::vector<CornerAngle>& angles) {
  CircleEquation equation{geometry::curvature(space), {}, 0, false};
  std::vector<const CornerAngle*> kinds;
  for (const CornerAngle& angle : angles) {
    std::size_t i = 0;
    while (i < kinds.size() && kinds[i]->angle != angle.angle) ++i;
    if (i == kinds.size()) {
      kinds.push_back(&angle);
      equation.groups.push_back({angle.sin_half, angle.cos_half, 0});
    }
    ++equation.groups[i].count;
  }
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (kinds[i]->angle < kinds[equation.narrowest]->angle) equation.narrowest = i;
  return equation;
}

struct Circle {
  Real u;  // sinκ² of the inradius
  bool beyond = false;
};

std::optional<Circle> inscribed_circle(Space space, const std::vector<CornerAngle>& angles) {
  CircleEquation fine = equation_of(space, angles);
  // H²: Σ θ falls from more than π at u = 0; asin x ≤ πx/2 shows that cosh r = N/2 is beyond the root.
  // S²: Σ θ rises from less than π until the narrowest corner's θ reaches π/2; from there its other branch leads back to u = 0.
  const double n = static_cast<double>(angles.size());
  bool rising = false;
  Real high = Real(n) * n / 4;
  if (space == Space::spherical) {
    const Real& s = fine.groups[fine.narrowest].sin_half;
    high = s * s;
    rising = fine.at(high).excess >= 0;
    if (!rising) {
      if (fine.groups[fine.narrowest].count > 1) return std::nullopt;
      fine.beyond = true;
      if (fine.at(0).excess <= 0) return std::nullopt;
    }
  }
  const double top = static_cast<double>(high);
  double start = solve<double>(EquationInDouble{fine}, 0, top, top / 16, rising, 1e-14);
  if (!(start > 0 && start < top)) start = top / 16;
  return Circle{solve<Real>(fine, 0, high, start, rising, ldexp(Real(1), -80)), fine.beyond};
}

struct Direction {
  Real x, y;
};
Direction turned(const Direction& a, const Direction& by) { return {a.x * by.x - a.y * by.y, a.x * by.y + a.y * by.x}; }

}  // namespace

std::optional<Polygon> tangential_polygon(Space space, const std::vector<CornerAngle>& angles, double scale) {
  Circle circle{Real(scale) * scale, false};
  if (space != Space::euclidean) {
    const std::optional<Circle> found = inscribed_circle(space, angles);
    if (!found) return std::nullopt;
    circle = *found;
  }
  const int k = geometry::curvature(space);
  const Real sin_r = sqrt(circle.u), cos_r = sqrt(1 - k * circle.u);
  std::size_t narrowest = 0;
  for (std::size_t i = 0; i < angles.size(); ++i)
    if (angles[i].angle < angles[narrowest].angle) narrowest = i;

  // e^{iθ} = (√D + i cos β)/cosκ r needs no trigonometry; directions are multiplied up.
  std::vector<Direction> turns;
  std::vector<Real> cos_radius;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const CornerAngle& a = angles[i];
    Real d = a.sin_half * a.sin_half - k * circle.u;
    if (d < 0) d = 0;
    const Real root = circle.beyond && i == narrowest ? -sqrt(d) : sqrt(d);
    turns.push_back({root / cos_r, a.cos_half / cos_r});
    cos_radius.push_back(k == 0 ? Real(1) : Real(root / a.sin_half));  // cosκ R = cot θ cot β
  }
  Polygon polygon{space, {}, {}, k == 0 ? Real(scale) : k > 0 ? asin(sin_r) : asinh(sin_r)};
  Direction direction{1, 0};
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const Real rho = sin_r / angles[i].sin_half;
    polygon.corners.push_back({cos_radius[i], rho * direction.x, rho * direction.y});
    direction = turned(direction, turns[i]);
    polygon.lines.push_back({sin_r, -cos_r * direction.x, -cos_r * direction.y});
    direction = turned(direction, turns[(i + 1) % angles.size()]);
  }
  return polygon;
}

}  // namespace orbc::room
