// Charts: where the floor is looked at so that curved rays become straight. A gnomonic chart sees less than half of S² and loses digits
// near the border of H²'s, so scenes that are too wide get several. Enclosing centres: Bădoiu and Clarkson, Smaller core-sets for balls,
// 2003 (a step towards the farthest point, ever smaller), which works along geodesics as well.
#include "compiler/trace/chart.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compiler/base/check.h"
#include "compiler/base/elementary.h"

namespace orbc::trace {

using geometry::Ambient;
using geometry::Point;
using geometry::Space;

namespace {

constexpr double kWideSphere = 1.15, kWideHyperbolic = 1.8;   // one chart reaches so far
constexpr double kLargeSphere = 1.4, kLargeHyperbolic = 3.0;  // a single triangle may reach so far
constexpr std::size_t kMostCharts = 64;

/// Grows with the distance; no inverse function.
double farness(Space space, const Point& c, const Vertex& v) {
  if (space == Space::euclidean) return (c.x - v.x) * (c.x - v.x) + (c.y - v.y) * (c.y - v.y);
  const double inner = c.x * v.x + c.y * v.y;
  return space == Space::spherical ? -(c.w * v.w + inner) : c.w * v.w - inner;
}

struct Far {
  double farness = -1e300;
  Vertex vertex;
};

Far farthest(Space space, const Soup& soup, const std::vector<std::uint32_t>& triangles, const Point& from) {
  Far far;
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t i : soup.triangles[t])
      if (const double f = farness(space, from, soup.vertices[i]); f > far.farness) far = {f, soup.vertices[i]};
  return far;
}

Point point_of(const Vertex& v) { return {v.w, v.x, v.y}; }

ChartPlan enclose(Space space, const Soup& soup, std::vector<std::uint32_t> triangles) {
  ChartPlan plan;
  plan.triangles = std::move(triangles);
  plan.centre = point_of(soup.vertices[soup.triangles[plan.triangles.front()][0]]);
  Ambient sum{0, 0, 0};
  for (const std::uint32_t t : plan.triangles)
    for (const std::uint32_t i : soup.triangles[t]) sum = sum + point_of(soup.vertices[i]);
  const double size = std::sqrt(sum.w * sum.w + sum.x * sum.x + sum.y * sum.y);
  if (size > 0.1 * static_cast<double>(plan.triangles.size())) plan.centre = geometry::normalised_point(space, sum);
  const auto distance = [&] {
    return geometry::distance(space, plan.centre, point_of(farthest(space, soup, plan.triangles, plan.centre).vertex));
  };
  for (int i = 1; i <= 12; ++i) {
    const Point far = point_of(farthest(space, soup, plan.triangles, plan.centre).vertex);
    const double r = geometry::distance(space, plan.centre, far);
    if (r < 1e-12 || r > 3.1) break;
    plan.centre = geometry::normalised_point(
        space, geometry::point_along(space, plan.centre, geometry::direction_to(space, plan.centre, far), r / (i + 2)));
  }
  plan.radius = distance();
  return plan;
}

/// Halves the triangles by which of two far points is nearer.
std::array<std::vector<std::uint32_t>, 2> halve(Space space, const Soup& soup, const ChartPlan& plan) {
  const Point a = point_of(farthest(space, soup, plan.triangles, plan.centre).vertex);
  const Point b = point_of(farthest(space, soup, plan.triangles, a).vertex);
  std::array<std::vector<std::uint32_t>, 2> halves;
  for (const std::uint32_t t : plan.triangles) {
    double sum = 0;
    for (const std::uint32_t i : soup.triangles[t]) sum += farness(space, a, soup.vertices[i]) - farness(space, b, soup.vertices[i]);
    halves[sum > 0].push_back(t);
  }
  if (halves[0].empty() || halves[1].empty()) {
    const auto middle = plan.triangles.begin() + static_cast<std::ptrdiff_t>(plan.triangles.size() / 2);
    halves = {std::vector<std::uint32_t>(plan.triangles.begin(), middle), std::vector<std::uint32_t>(middle, plan.triangles.end())};
  }
  return halves;
}

double tan_by_arc(Space space, double y) {  // tanκ(√y)/√y
  const double a = std::sqrt(y);
  return a < 1e-4 ? 1 + geometry::curvature(space) * y / 3 : geometry::tan_k(space, a) / a;
}

double arc_by_tan(Space space, double y) {  // atanκ(√y)/√y
  const double t = std::sqrt(y);
  return t < 1e-4 ? 1 - geometry::curvature(space) * y / 3 : (space == Space::spherical ? math::atan(t) : math::atanh(t)) / t;
}

/// Odd polynomial through the Chebyshev nodes of y = a² ∈ [0, end²] of `by`(y) = f(a)/a; Newton's form expanded into powers.
template <class By>
void fit(Space space, const By& by, double end, int terms, double out[7]) {
  double node[7], difference[7];
  const double top = end * end;
  for (int i = 0; i < terms; ++i) {
    node[i] = top * 0.5 * (1 - math::cos((2 * i + 1) * 3.14159265358979 / (2 * terms)));
    difference[i] = by(space, node[i]);
  }
  for (int level = 1; level < terms; ++level)
    for (int i = terms - 1; i >= level; --i) difference[i] = (difference[i] - difference[i - 1]) / (node[i] - node[i - level]);
  std::fill(out, out + 7, 0.0);
  for (int i = terms - 1; i >= 0; --i) {  // out ← out·(y − node) + difference
    for (int k = 6; k > 0; --k) out[k] = out[k - 1] - node[i] * out[k];
    out[0] = difference[i] - node[i] * out[0];
  }
}

bool is_increasing(const float poly[7], int terms, double radius) {
  for (double y = 0; y < 1e7 * radius * radius; y = 1.01 * y + 1e-3 * radius * radius) {
    double slope = 0;
    for (int k = terms - 1; k >= 0; --k) slope = slope * y + (2 * k + 1) * double(poly[k]);
    if (!(slope > 0)) return false;
  }
  return poly[terms - 1] > 0;
}

template <class By>
double error_of(Space space, const By& by, const float poly[7], int terms, double end) {
  double error = 0;
  for (int i = 0; i <= 4096; ++i) {
    const double a = end * i / 4096, y = a * a;
    double p = 0;
    for (int k = terms - 1; k >= 0; --k) p = p * y + double(poly[k]);
    error = std::max(error, a * std::fabs(p - by(space, y)));
  }
  return error;
}

/// Fewest terms whose error costs no node visits (measured in the study: 1e-3 and 1e-6 visit the same nodes); H² needs odd counts, an even
/// one turns back beyond the chart and loses hits.
void choose_polynomial(Space space, double radius, Chart& chart) {
  if (space == Space::euclidean) {  // tanκ is the identity: only rounding
    chart.poly_error = static_cast<float>(4e-6 * radius);
    return;
  }
  for (const int terms : space == Space::spherical ? std::vector<int>{2, 4, 7} : std::vector<int>{3, 5, 7}) {
    double poly[7];
    fit(space, tan_by_arc, radius, terms, poly);
    for (int k = 0; k < 7; ++k) chart.poly[k] = static_cast<float>(poly[k]);
    chart.terms = terms;
    const double error = error_of(space, tan_by_arc, chart.poly, terms, radius);
    chart.poly_error = static_cast<float>(1.01 * error + 4e-6 * (1 + geometry::tan_k(space, radius)));
    if (is_increasing(chart.poly, terms, radius) && (error < 4e-3 * radius || terms == 7)) return;
  }
  ORBC_CHECK(is_increasing(chart.poly, chart.terms, radius), ==, true);
}

/// The leaf test's arc: 4 terms where they do, 7 in wider charts, else the general functions, good to some ulp.
void choose_arc(Space space, Chart& chart) {
  const double end = chart.tangent;
  chart.arc_terms = 0;
  chart.arc_error = static_cast<float>(1e-6 * (1 + chart.radius));
  for (const int terms : {4, 7}) {
    double poly[7];
    fit(space, arc_by_tan, end, terms, poly);
    for (int k = 0; k < 7; ++k) chart.arc_poly[k] = static_cast<float>(poly[k]);
    const double error = error_of(space, arc_by_tan, chart.arc_poly, terms, end);
    if (error > 1e-6 * end) continue;
    chart.arc_terms = terms;
    chart.arc_error = static_cast<float>(1.01 * error + 1e-6 * chart.radius);
    return;
  }
}

/// Bounds for the leaf test: along a segment z(u) is projective, its weights 1/w in a ratio of at most ρ, so |z″| ≤ 2ρ|Δz|·|Δ(1/w)|·w; a
/// curve leaves its chord by at most |z″|/8.
void add_leaf_bounds(Space space, Chart& chart) {
  choose_arc(space, chart);
  const double ratio = space == Space::spherical ? 1 / math::cos(chart.radius) : math::cosh(chart.radius);
  chart.ratio = static_cast<float>(1.001 * ratio);
  const double end = chart.tangent, last_slope = 1 / (1 + geometry::curvature(space) * end * end);
  chart.last_slope = static_cast<float>(last_slope);
  chart.sharpest_arc = static_cast<float>(1.01 * (space == Space::spherical ? std::min(0.65, 2 * end) : 2 * end * last_slope * last_slope));
  chart.bend_of_height = static_cast<float>(1.05 * 2 * ratio * double(chart.largest_w) / 8);
}

}  // namespace

ChartPlans plan_charts(Space space, const Soup& soup) {
  ChartPlans plans;
  if (soup.triangles.empty()) return plans;
  std::vector<std::vector<std::uint32_t>> open(1);
  open[0].resize(soup.triangles.size());
  std::iota(open[0].begin(), open[0].end(), 0u);
  const double wide = space == Space::spherical ? kWideSphere : space == Space::hyperbolic ? kWideHyperbolic : kEndless;
  const double large = space == Space::spherical ? kLargeSphere : space == Space::hyperbolic ? kLargeHyperbolic : kEndless;
  while (!open.empty()) {
    ChartPlan plan = enclose(space, soup, std::move(open.back()));
    open.pop_back();
    if (plan.radius <= wide || ((plan.triangles.size() == 1 || plans.charts.size() + open.size() >= kMostCharts) && plan.radius <= large)) {
      plans.charts.push_back(std::move(plan));
    } else if (plan.triangles.size() == 1) {
      plans.large.push_back(plan.triangles[0]);
    } else {
      auto halves = halve(space, soup, plan);
      for (auto& half : halves) open.push_back(std::move(half));
    }
  }
  return plans;
}

Chart make_chart(Space space, const ChartPlan& plan, const Soup& soup) {
  Chart chart;
  if (geometry::distance(space, plan.centre, Point()) > 1e-3 || space == Space::euclidean)
    chart.chart_from_room = geometry::matrix(geometry::inverse(geometry::translation_to(space, plan.centre))), chart.moved = true;
  for (const std::uint32_t t : plan.triangles)
    for (const std::uint32_t i : soup.triangles[t]) {
      const Vertex& v = soup.vertices[i];
      const Ambient x = chart.chart_from_room * Ambient{v.w, v.x, v.y};
      const double rho = math::hypot(x.x, x.y);
      chart.radius = std::max(chart.radius, geometry::arc_k(space, x.w, rho));
      chart.extent = std::max(chart.extent, static_cast<float>(1.000001 * rho / x.w));
      chart.largest_w = std::max(chart.largest_w, static_cast<float>(1.000001 * x.w));
    }
  chart.radius = std::max(chart.radius * 1.000001, 1e-3);
  chart.tangent = geometry::tan_k(space, chart.radius);
  chart.nearest_foot2 = math::pow(geometry::cos_k(space, chart.radius * 1.0001), 2);
  choose_polynomial(space, chart.radius, chart);
  if (space != Space::euclidean) add_leaf_bounds(space, chart);
  return chart;
}

}  // namespace orbc::trace
