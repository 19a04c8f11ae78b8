// Gnomonic charts make the floor part of curved rays straight. A chart covers less than half of S² and loses digits near the border of
// H²'s, so wide scenes get several. Enclosing disks: Bădoiu and Clarkson, Smaller core-sets for balls, 2003 (ever smaller steps towards the
// farthest point), applied along geodesics.
#include "compiler/trace/bvh/chart_tree.h"

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

constexpr double kMaxChartRadiusSpherical = 1.15, kMaxChartRadiusHyperbolic = 1.8;
constexpr double kMaxTriangleRadiusSpherical = 1.4, kMaxTriangleRadiusHyperbolic = 3.0;  // of a chart with one triangle
constexpr std::size_t kMaxCharts = 64;

/// A monotone function of the distance, without an inverse function.
double monotone_distance(Space space, const Point& c, const Vertex& v) {
  if (space == Space::euclidean) return (c.x - v.x) * (c.x - v.x) + (c.y - v.y) * (c.y - v.y);
  const double inner = c.x * v.x + c.y * v.y;
  return space == Space::spherical ? -(c.w * v.w + inner) : c.w * v.w - inner;
}

struct FarthestVertex {
  double monotone_distance = -1e300;
  Vertex vertex;
};

FarthestVertex farthest(Space space, const SceneTriangles& scene, const std::vector<std::uint32_t>& triangles, const Point& from) {
  FarthestVertex far;
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t i : scene.corners[t])
      if (const double f = monotone_distance(space, from, scene.vertices[i]); f > far.monotone_distance) far = {f, scene.vertices[i]};
  return far;
}

Point point_of(const Vertex& v) { return {v.w, v.x, v.y}; }

ChartCluster enclosing_cluster(Space space, const SceneTriangles& scene, std::vector<std::uint32_t> triangles) {
  ChartCluster cluster;
  cluster.triangles = std::move(triangles);
  cluster.centre = point_of(scene.vertices[scene.corners[cluster.triangles.front()][0]]);
  Ambient sum{0, 0, 0};
  for (const std::uint32_t t : cluster.triangles)
    for (const std::uint32_t i : scene.corners[t]) sum = sum + point_of(scene.vertices[i]);
  const double size = std::sqrt(sum.w * sum.w + sum.x * sum.x + sum.y * sum.y);
  if (size > 0.1 * static_cast<double>(cluster.triangles.size())) cluster.centre = geometry::normalised_point(space, sum);
  const auto distance = [&] {
    return geometry::distance(space, cluster.centre, point_of(farthest(space, scene, cluster.triangles, cluster.centre).vertex));
  };
  for (int i = 1; i <= 12; ++i) {
    const Point far = point_of(farthest(space, scene, cluster.triangles, cluster.centre).vertex);
    const double r = geometry::distance(space, cluster.centre, far);
    if (r < 1e-12 || r > 3.1) break;
    cluster.centre = geometry::normalised_point(
        space, geometry::point_along(space, cluster.centre, geometry::direction_to(space, cluster.centre, far), r / (i + 2)));
  }
  cluster.radius = distance();
  return cluster;
}

/// Splits the triangles in two by which of two far points is nearer.
std::array<std::vector<std::uint32_t>, 2> split_cluster(Space space, const SceneTriangles& scene, const ChartCluster& cluster) {
  const Point a = point_of(farthest(space, scene, cluster.triangles, cluster.centre).vertex);
  const Point b = point_of(farthest(space, scene, cluster.triangles, a).vertex);
  std::array<std::vector<std::uint32_t>, 2> halves;
  for (const std::uint32_t t : cluster.triangles) {
    double sum = 0;
    for (const std::uint32_t i : scene.corners[t])
      sum += monotone_distance(space, a, scene.vertices[i]) - monotone_distance(space, b, scene.vertices[i]);
    halves[sum > 0].push_back(t);
  }
  if (halves[0].empty() || halves[1].empty()) {
    const auto middle = cluster.triangles.begin() + static_cast<std::ptrdiff_t>(cluster.triangles.size() / 2);
    halves = {std::vector<std::uint32_t>(cluster.triangles.begin(), middle), std::vector<std::uint32_t>(middle, cluster.triangles.end())};
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
void fit_odd_polynomial(Space space, const By& reciprocal, double end, int terms, double out[7]) {
  double node[7], difference[7];
  const double top = end * end;
  for (int i = 0; i < terms; ++i) {
    node[i] = top * 0.5 * (1 - math::cos((2 * i + 1) * 3.14159265358979 / (2 * terms)));
    difference[i] = reciprocal(space, node[i]);
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
double error_of(Space space, const By& reciprocal, const float poly[7], int terms, double end) {
  double error = 0;
  for (int i = 0; i <= 4096; ++i) {
    const double a = end * i / 4096, y = a * a;
    double p = 0;
    for (int k = terms - 1; k >= 0; --k) p = p * y + double(poly[k]);
    error = std::max(error, a * std::fabs(p - reciprocal(space, y)));
  }
  return error;
}

/// Chooses the fewest terms whose error costs no node visits (measured in the study: errors of 1e-3 and 1e-6 visit the same nodes). H²
/// needs an odd number of terms: an even one decreases beyond the chart and loses hits.
void choose_polynomial(Space space, double radius, ChartTree& chart) {
  if (space == Space::euclidean) {  // tanκ is the identity: only rounding
    chart.tan_error = static_cast<float>(4e-6 * radius);
    return;
  }
  for (const int terms : space == Space::spherical ? std::vector<int>{2, 4, 7} : std::vector<int>{3, 5, 7}) {
    double poly[7];
    fit_odd_polynomial(space, tan_by_arc, radius, terms, poly);
    for (int k = 0; k < 7; ++k) chart.tan_poly[k] = static_cast<float>(poly[k]);
    chart.tan_terms = terms;
    const double error = error_of(space, tan_by_arc, chart.tan_poly, terms, radius);
    chart.tan_error = static_cast<float>(1.01 * error + 4e-6 * (1 + geometry::tan_k(space, radius)));
    if (is_increasing(chart.tan_poly, terms, radius) && (error < 4e-3 * radius || terms == 7)) return;
  }
  ORBC_CHECK(is_increasing(chart.tan_poly, chart.tan_terms, radius), ==, true);
}

/// The arc function of the leaf test: 4 terms if they suffice, 7 in wider charts, else the general functions, with an error of some ulp.
void choose_arc(Space space, ChartTree& chart) {
  const double end = chart.tan_radius;
  chart.arc_terms = 0;
  chart.arc_error = static_cast<float>(1e-6 * (1 + chart.radius));
  for (const int terms : {4, 7}) {
    double poly[7];
    fit_odd_polynomial(space, arc_by_tan, end, terms, poly);
    for (int k = 0; k < 7; ++k) chart.arc_poly[k] = static_cast<float>(poly[k]);
    const double error = error_of(space, arc_by_tan, chart.arc_poly, terms, end);
    if (error > 1e-6 * end) continue;
    chart.arc_terms = terms;
    chart.arc_error = static_cast<float>(1.01 * error + 1e-6 * chart.radius);
    return;
  }
}

/// Bounds for the leaf test. Along a segment z(u) is projective with weights 1/w whose ratio is at most ρ, so |z″| ≤ 2ρ|Δz|·|Δ(1/w)|·w. A
/// curve deviates from its chord by at most |z″|/8.
void add_leaf_bounds(Space space, ChartTree& chart) {
  choose_arc(space, chart);
  const double ratio = space == Space::spherical ? 1 / math::cos(chart.radius) : math::cosh(chart.radius);
  chart.w_ratio_bound = static_cast<float>(1.001 * ratio);
  const double end = chart.tan_radius, arc_slope_at_end = 1 / (1 + geometry::curvature(space) * end * end);
  chart.arc_slope_at_end = static_cast<float>(arc_slope_at_end);
  chart.max_arc_curvature =
      static_cast<float>(1.01 * (space == Space::spherical ? std::min(0.65, 2 * end) : 2 * end * arc_slope_at_end * arc_slope_at_end));
  chart.height_bend_bound = static_cast<float>(1.05 * 2 * ratio * double(chart.max_w) / 8);
}

}  // namespace

ChartClusters cluster_into_charts(Space space, const SceneTriangles& scene) {
  ChartClusters clusters;
  if (scene.corners.empty()) return clusters;
  std::vector<std::vector<std::uint32_t>> open(1);
  open[0].resize(scene.corners.size());
  std::iota(open[0].begin(), open[0].end(), 0u);
  const double wide = space == Space::spherical    ? kMaxChartRadiusSpherical
                      : space == Space::hyperbolic ? kMaxChartRadiusHyperbolic
                                                   : kInfinity;
  const double uncharted = space == Space::spherical    ? kMaxTriangleRadiusSpherical
                           : space == Space::hyperbolic ? kMaxTriangleRadiusHyperbolic
                                                        : kInfinity;
  while (!open.empty()) {
    ChartCluster cluster = enclosing_cluster(space, scene, std::move(open.back()));
    open.pop_back();
    if (cluster.radius <= wide ||
        ((cluster.triangles.size() == 1 || clusters.charts.size() + open.size() >= kMaxCharts) && cluster.radius <= uncharted)) {
      clusters.charts.push_back(std::move(cluster));
    } else if (cluster.triangles.size() == 1) {
      clusters.uncharted.push_back(cluster.triangles[0]);
    } else {
      auto halves = split_cluster(space, scene, cluster);
      for (auto& half : halves) open.push_back(std::move(half));
    }
  }
  return clusters;
}

ChartTree make_chart(Space space, const ChartCluster& cluster, const SceneTriangles& scene) {
  ChartTree chart;
  if (geometry::distance(space, cluster.centre, Point()) > 1e-3 || space == Space::euclidean) {
    chart.chart_from_room = geometry::matrix(geometry::inverse(geometry::translation_to(space, cluster.centre)));
    chart.moved = true;
  }
  for (const std::uint32_t t : cluster.triangles)
    for (const std::uint32_t i : scene.corners[t]) {
      const Vertex& v = scene.vertices[i];
      const Ambient x = chart.chart_from_room * Ambient{v.w, v.x, v.y};
      const double rho = math::hypot(x.x, x.y);
      chart.radius = std::max(chart.radius, geometry::arc_k(space, x.w, rho));
      chart.extent = std::max(chart.extent, static_cast<float>(1.000001 * rho / x.w));
      chart.max_w = std::max(chart.max_w, static_cast<float>(1.000001 * x.w));
    }
  chart.radius = std::max(chart.radius * 1.000001, 1e-3);
  chart.tan_radius = geometry::tan_k(space, chart.radius);
  chart.foot_bound2 = math::pow(geometry::cos_k(space, chart.radius * 1.0001), 2);
  choose_polynomial(space, chart.radius, chart);
  if (space != Space::euclidean) add_leaf_bounds(space, chart);
  return chart;
}

}  // namespace orbc::trace
