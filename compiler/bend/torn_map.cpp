#include "compiler/bend/torn_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"

namespace orbc::bend {

using geometry::Ambient;
using geometry::Space;
using geometry::Vector3;

namespace {

constexpr double kAxisRadians = 1e-9;      // directions as seen from the axis are good to 1e-7 here
constexpr double kDiskCircleRadius = 100;  // View::disk: where the drawn plane ends, the image of the antipode; times the chart's scale

}  // namespace

Corner lerp(const Corner& a, const Corner& b, double t) {
  Corner c;
  c.v = (1 - t) * a.v + t * b.v;
  c.z = (1 - t) * a.z + t * b.z;
  c.uv = {(1 - t) * a.uv[0] + t * b.uv[0], (1 - t) * a.uv[1] + t * b.uv[1]};
  return c;
}

TornMap::TornMap(const CopyMap& map, const ScreenMetric& metric) : map_(map) {
  double radius = 0;
  for (const Axis axis : {Axis::foot, Axis::antipode}) radius = std::max(radius, circle_radius(axis));
  // The chords of the polygon are measured like any other, at their own distance.
  const double pixels = map.view == View::eye ? max_pixels_per_radian(metric) : 1;
  const double tolerances = map.view == View::disk ? radius / std::max(1.0, radius) / metric.tolerance : pixels / metric.tolerance;
  while (circle_steps_ < 65536 && tolerances * (1 - math::cos(std::numbers::pi / circle_steps_)) > 0.5) circle_steps_ *= 2;
}

double TornMap::circle_radius(Axis axis) const {
  if (!has_axes() || axis == Axis::none) return 0;
  if (map_.view == View::disk) return axis == Axis::antipode ? map_.chart_scale * kDiskCircleRadius : 0;
  const int half_turns = axis == Axis::antipode ? map_.log.sheet | 1 : (map_.log.sheet + 1) & ~1;
  return axis == Axis::foot && map_.log.sheet == 0 ? 0 : half_turns * std::numbers::pi;
}

double TornMap::circle_step() const { return 2 * std::numbers::pi / circle_steps_; }

Corner TornMap::on_circle(Corner corner, double angle) const {
  const double radius = circle_radius(corner.axis);
  corner.image = {radius * math::cos(angle), radius * math::sin(angle), corner.z};
  return corner;
}

Axis TornMap::axis_of(const Ambient& p) const {
  if (!has_axes() || math::hypot(p.x, p.y) > kAxisRadians * std::fabs(p.w)) return Axis::none;
  const Axis axis = p.w < 0 ? Axis::antipode : Axis::foot;
  return circle_radius(axis) > 0 ? axis : Axis::none;
}

Corner TornMap::corner(const Ambient& v, double z, const std::array<double, 2>& uv) const {
  Corner c{v, z, uv, {}, Axis::none, map_.log.eye_from_copy * v, 0, 1};
  c.axis = axis_of(c.eye_ambient);
  c.image = c.axis == Axis::none ? image_of(map_, v, z) : Vector3{circle_radius(c.axis), 0, z};
  c.norm = std::sqrt(std::fabs(v.w * v.w + geometry::curvature(map_.log.space) * (v.x * v.x + v.y * v.y)));
  // The log map keeps distances, up to the half turns of the sheet.
  c.distance = std::sqrt(c.image.x * c.image.x + c.image.y * c.image.y);
  const int sheet = map_.log.sheet;
  if (sheet > 0) c.distance = sheet % 2 == 1 ? (sheet + 1) * std::numbers::pi - c.distance : c.distance - sheet * std::numbers::pi;
  return c;
}

Corner TornMap::on_axis(Corner corner, Axis axis) const {
  corner.axis = axis;
  corner.image = {circle_radius(axis), 0, corner.z};
  return corner;
}

Vector3 TornMap::image_towards(const Corner& c, const Corner& from) const {
  if (c.axis == Axis::none) return c.image;
  const double rho = math::hypot(from.image.x, from.image.y), phi = math::atan2(from.image.y, from.image.x);
  if (rho == 0) return c.image;
  const double step = circle_step(), middle = (std::floor(phi / step) + 0.5) * step;
  const double radius = circle_radius(c.axis) * math::cos(step / 2) / math::cos(phi - middle);
  return {radius * from.image.x / rho, radius * from.image.y / rho, c.z};
}

std::optional<Corner> TornMap::axis_crossing(const Corner& a, const Corner& b) const {
  if (!has_axes() || a.axis != Axis::none || b.axis != Axis::none) return std::nullopt;
  const Ambient &p = a.eye_ambient, &q = b.eye_ambient;
  if (p.x * q.x + p.y * q.y >= 0) return std::nullopt;
  const double nw = p.x * q.y - p.y * q.x, nx = p.y * q.w - p.w * q.y, ny = p.w * q.x - p.x * q.w;
  if (std::fabs(nw) > kAxisRadians * std::sqrt(nw * nw + nx * nx + ny * ny)) return std::nullopt;
  const double pr = math::hypot(p.x, p.y), qr = math::hypot(q.x, q.y), t = pr / (pr + qr);
  if (circle_radius((1 - t) * p.w + t * q.w < 0 ? Axis::antipode : Axis::foot) == 0) return std::nullopt;
  Corner crossing = lerp(a, b, t);
  crossing.eye_ambient = map_.log.eye_from_copy * crossing.v;
  return on_axis(crossing, crossing.eye_ambient.w < 0 ? Axis::antipode : Axis::foot);
}

std::optional<Corner> TornMap::axis_crossing(const Corner& first, const Corner& second, const Corner& third) const {
  if (!has_axes()) return std::nullopt;
  const Corner* corners[3] = {&first, &second, &third};
  for (const Corner* c : corners)
    if (c->axis != Axis::none) return std::nullopt;
  double b[3], sum = 0, w = 0;
  for (int k = 0; k < 3; ++k) {
    const Ambient &q = corners[(k + 1) % 3]->eye_ambient, &r = corners[(k + 2) % 3]->eye_ambient;
    b[k] = q.x * r.y - q.y * r.x;
  }
  if (!((b[0] > 0 && b[1] > 0 && b[2] > 0) || (b[0] < 0 && b[1] < 0 && b[2] < 0))) return std::nullopt;
  for (int k = 0; k < 3; ++k) {
    sum += b[k];
    w += b[k] * corners[k]->eye_ambient.w;
  }
  const Axis axis = w * sum < 0 ? Axis::antipode : Axis::foot;
  if (circle_radius(axis) == 0) return std::nullopt;
  Corner crossing;
  crossing.v = {0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    const double weight = b[k] / sum;
    crossing.v = crossing.v + weight * corners[k]->v;
    crossing.z += weight * corners[k]->z;
    for (int j = 0; j < 2; ++j) crossing.uv[j] += weight * corners[k]->uv[j];
  }
  return on_axis(crossing, axis);
}

std::optional<double> TornMap::bisection(const Corner& a, const Corner& b) const {
  if (!has_axes() || a.axis != Axis::none || b.axis != Axis::none) return std::nullopt;
  const double p = math::hypot(a.eye_ambient.x, a.eye_ambient.y), q = math::hypot(b.eye_ambient.x, b.eye_ambient.y);
  int exponent = 0;
  const double digits = std::frexp(std::min(p, q) / (p + q), &exponent), smaller = std::ldexp(std::round(digits * 256), exponent - 8);
  const double t = p < q ? smaller : 1 - smaller;
  if (!(t > 0)) return std::nullopt;
  return t;
}

}  // namespace orbc::bend
