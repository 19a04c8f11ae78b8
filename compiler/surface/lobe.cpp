// Everything local is that of Euclidean space: in an orthonormal frame with the surface's normal upwards.
#include "compiler/surface/lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/surface/frame.h"
#include "compiler/surface/random.h"

namespace orbc::surface {
namespace {

using geometry::Vector3;
using scene::Color;

constexpr double kSmoothest = 0.002;  // α: of what is smoother no float can tell the lobe
constexpr double kPolished = 0.003;   // α: of what is smoother the lobe is finer than a pixel

// The binary digits of k behind the point, in reverse.
double mirrored_digits(unsigned k) {
  double v = 0;
  for (double digit = 0.5; k > 0; k >>= 1, digit /= 2)
    if (k & 1) v += digit;
  return v;
}

// A facet's normal, chosen among those that are seen from `eye`.
Vector3 seen_facet(const Vector3& eye, double alpha, const std::array<double, 2>& u) {
  const Vector3 stretched = geometry::normalised({alpha * eye.x, alpha * eye.y, eye.z});
  const double flat = math::hypot(stretched.x, stretched.y);
  const Vector3 across = flat > 1e-12 ? Vector3{-stretched.y / flat, stretched.x / flat, 0} : Vector3{1, 0, 0};
  const Vector3 other = cross(stretched, across);
  const double r = std::sqrt(u[0]), phi = 2 * std::numbers::pi * u[1], half = 0.5 * (1 + stretched.z);
  const double x = r * math::cos(phi), y = (1 - half) * std::sqrt(std::max(0.0, 1 - x * x)) + half * r * math::sin(phi);
  const Vector3 n = x * across + y * other + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * stretched;
  return geometry::normalised({alpha * n.x, alpha * n.y, std::max(1e-9, n.z)});
}

// What a surface of facets that mirror all sends back by single ones.
double by_single_facets(double cosine, double alpha) {
  constexpr int kWays = 256;
  const Vector3 eye{std::sqrt(std::max(0.0, 1 - cosine * cosine)), 0, cosine};
  double sum = 0;
  for (int k = 0; k < kWays; ++k) {
    const Vector3 facet = seen_facet(eye, alpha, facet_numbers(k, kWays, 0));
    const double z = 2 * dot(eye, facet) * facet.z - eye.z;
    if (z > 0) sum += facets_seen(z, alpha * alpha);
  }
  return sum / kWays;
}

/// The same at a grid of cosines and roughnesses √α.
struct Kept {
  static constexpr int kSide = 33;
  std::array<std::array<double, kSide>, kSide> at{};
  Kept() {
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const double roughness = static_cast<double>(i) / (kSide - 1), cosine = std::max(1e-3, static_cast<double>(j) / (kSide - 1));
        at[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
            by_single_facets(cosine, std::max(roughness * roughness, kSmoothest));
      }
  }
  [[nodiscard]] double operator()(double cosine, double alpha) const {
    const double x = (kSide - 1) * std::sqrt(std::clamp(alpha, 0.0, 1.0)), y = (kSide - 1) * std::clamp(cosine, 0.0, 1.0);
    const auto i = static_cast<std::size_t>(std::min(x, kSide - 2.0)), j = static_cast<std::size_t>(std::min(y, kSide - 2.0));
    const double s = x - static_cast<double>(i), t = y - static_cast<double>(j);
    return (1 - s) * ((1 - t) * at[i][j] + t * at[i][j + 1]) + s * ((1 - t) * at[i + 1][j] + t * at[i + 1][j + 1]);
  }
};

}  // namespace

Color by_several_facets(const Color& face_on, double cosine, double alpha) {
  static const Kept kept;
  const double lost = 1 / kept(cosine, alpha) - 1;
  return Color{1, 1, 1} + lost * face_on;
}

double facet_width(const scene::Material& material) { return std::max(material.roughness * material.roughness, kSmoothest); }

bool polished(const scene::Material& material) { return material.kind == scene::MaterialKind::metal && facet_width(material) < kPolished; }

std::array<double, 2> facet_numbers(int k, int n, int metal) {
  if (metal == 0) {
    const int pair = k / 2, pairs = (n + 1) / 2;
    return {fraction(mirrored_digits(static_cast<unsigned>(pair)) + 0.5 / pairs), fraction(0.5 * (k % 2) + pair * 0.6180339887498949)};
  }
  // Others than those of the metal before, which have the same k: plane lattices (Roberts 2018), and of the roots of 2 and 3.
  const std::array<double, 2> step = metal == 1 ? std::array<double, 2>{0.7548776662466927, 0.5698402909980532}
                                                : std::array<double, 2>{0.4142135623730951, 0.7320508075688772};
  return {fraction(0.5 + k * step[0]), fraction(0.5 + k * step[1])};
}

double facet_density(double cosine, double a2) {
  const double base = cosine * cosine * (a2 - 1) + 1;
  return a2 / (std::numbers::pi * base * base);
}

double facets_seen(double cosine, double a2) { return 2 * cosine / (cosine + std::sqrt(a2 + (1 - a2) * cosine * cosine)); }

Color reflectance(const Color& face_on, double cosine) {
  const double t = 1 - std::clamp(cosine, 0.0, 1.0), t2 = t * t, graze = t2 * t2 * t;
  return (1 - graze) * face_on + graze * Color{1, 1, 1};
}

Color face_on(const scene::Material& material, const Color& albedo) {
  if (material.kind == scene::MaterialKind::metal) return albedo;
  const double f = math::pow((material.index - 1) / (material.index + 1), 2);
  return {f, f, f};
}

Glance glance(geometry::Space space, const trace::SurfacePoint& point, double alpha, const std::array<double, 2>& u) {
  const Frame floor = frame_at(space, point.at.floor);
  const Vector3 n = geometry::normalised(local(space, floor, point.normal)), to_eye = -1.0 * local(space, floor, point.arriving);
  const Vector3 across = geometry::normalised(cross(std::fabs(n.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0}, n)),
                other = cross(n, across);
  const Vector3 eye{dot(to_eye, across), dot(to_eye, other), std::max(1e-6, dot(to_eye, n))};
  const Vector3 facet = seen_facet(eye, alpha, u);
  Glance result;
  result.cosine = std::clamp(dot(eye, facet), 0.0, 1.0);
  const Vector3 way = (2 * result.cosine) * facet - eye;
  if (way.z <= 0) return result;
  result.weight = facets_seen(way.z, alpha * alpha);
  result.direction = global(floor, geometry::normalised(way.x * across + way.y * other + way.z * n));
  return result;
}

}  // namespace orbc::surface
