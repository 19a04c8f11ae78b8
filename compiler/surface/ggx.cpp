// In an orthonormal tangent frame with the normal upwards the formulas are those of Euclidean space.
#include "compiler/surface/ggx.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/surface/sampling.h"
#include "compiler/surface/tangent_frame.h"

namespace orbc::surface {
namespace {

using geometry::Vector3;
using scene::Color;

constexpr double kMinAlpha = 0.002;          // below it single precision cannot resolve the lobe
constexpr double kMaxSpecularAlpha = 0.003;  // below it the lobe is narrower than a pixel

// The binary digits of k in reverse order behind the point: van der Corput's sequence.
double radical_inverse(unsigned k) {
  double v = 0;
  for (double digit = 0.5; k > 0; k >>= 1, digit /= 2)
    if (k & 1) v += digit;
  return v;
}

// The normal of a microfacet, sampled among those visible from `eye` (unit, z > 0).
Vector3 sample_vndf(const Vector3& eye, double alpha, const std::array<double, 2>& u) {
  const Vector3 stretched = geometry::normalised({alpha * eye.x, alpha * eye.y, eye.z});
  const double flat = math::hypot(stretched.x, stretched.y);
  const Vector3 tangent = flat > 1e-12 ? Vector3{-stretched.y / flat, stretched.x / flat, 0} : Vector3{1, 0, 0};
  const Vector3 bitangent = cross(stretched, tangent);
  const double r = std::sqrt(u[0]), phi = 2 * std::numbers::pi * u[1], half = 0.5 * (1 + stretched.z);
  const double x = r * math::cos(phi), y = (1 - half) * std::sqrt(std::max(0.0, 1 - x * x)) + half * r * math::sin(phi);
  const Vector3 n = x * tangent + y * bitangent + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * stretched;
  return geometry::normalised({alpha * n.x, alpha * n.y, std::max(1e-9, n.z)});
}

// The share of light that a white surface reflects by single reflections.
double single_scatter_albedo(double cosine, double alpha) {
  constexpr int kSamples = 256;
  const Vector3 eye{std::sqrt(std::max(0.0, 1 - cosine * cosine)), 0, cosine};
  double sum = 0;
  for (int k = 0; k < kSamples; ++k) {
    const Vector3 facet = sample_vndf(eye, alpha, vndf_point(k, kSamples, 0));
    const double z = 2 * dot(eye, facet) * facet.z - eye.z;
    if (z > 0) sum += smith_g1(z, alpha * alpha);
  }
  return sum / kSamples;
}

/// single_scatter_albedo on a grid of cosines and roughnesses √α, interpolated.
struct AlbedoTable {
  static constexpr int kSide = 33;
  std::array<std::array<double, kSide>, kSide> at{};
  AlbedoTable() {
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const double roughness = static_cast<double>(i) / (kSide - 1), cosine = std::max(1e-3, static_cast<double>(j) / (kSide - 1));
        at[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
            single_scatter_albedo(cosine, std::max(roughness * roughness, kMinAlpha));
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

Color multiscatter_compensation(const Color& f0, double cosine, double alpha) {
  static const AlbedoTable table;
  const double lost = 1 / table(cosine, alpha) - 1;
  return Color{1, 1, 1} + lost * f0;
}

double ggx_alpha(const scene::Material& material) { return std::max(material.roughness * material.roughness, kMinAlpha); }

bool is_specular_metal(const scene::Material& material) {
  return material.kind == scene::MaterialKind::metal && ggx_alpha(material) < kMaxSpecularAlpha;
}

std::array<double, 2> vndf_point(int k, int n, int metals_before) {
  if (metals_before == 0) {
    const int pair = k / 2, pairs = (n + 1) / 2;
    return {fract(radical_inverse(static_cast<unsigned>(pair)) + 0.5 / pairs), fract(0.5 * (k % 2) + pair * 0.6180339887498949)};
  }
  // The metals on a path share k, so their lattices must differ: by the plastic number (Roberts 2018), and by the roots of 2 and 3.
  const std::array<double, 2> step = metals_before == 1 ? std::array<double, 2>{0.7548776662466927, 0.5698402909980532}
                                                        : std::array<double, 2>{0.4142135623730951, 0.7320508075688772};
  return {fract(0.5 + k * step[0]), fract(0.5 + k * step[1])};
}

double ggx_d(double cosine, double a2) {
  const double base = cosine * cosine * (a2 - 1) + 1;
  return a2 / (std::numbers::pi * base * base);
}

double smith_g1(double cosine, double a2) { return 2 * cosine / (cosine + std::sqrt(a2 + (1 - a2) * cosine * cosine)); }

Color fresnel_schlick(const Color& f0, double cosine) {
  const double t = 1 - std::clamp(cosine, 0.0, 1.0), t2 = t * t, t5 = t2 * t2 * t;
  return (1 - t5) * f0 + t5 * Color{1, 1, 1};
}

Color f0(const scene::Material& material, const Color& albedo) {
  if (material.kind == scene::MaterialKind::metal) return albedo;
  const double f = math::pow((material.index - 1) / (material.index + 1), 2);
  return {f, f, f};
}

BsdfSample sample_ggx(geometry::Space space, const trace::SurfacePoint& point, double alpha, const std::array<double, 2>& u) {
  const TangentFrame frame = tangent_frame(space, point.at.floor);
  const Vector3 n = geometry::normalised(to_local(space, frame, point.normal)), to_eye = -1.0 * to_local(space, frame, point.incoming);
  const Vector3 tangent = geometry::normalised(cross(std::fabs(n.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0}, n)),
                bitangent = cross(n, tangent);
  const Vector3 eye{dot(to_eye, tangent), dot(to_eye, bitangent), std::max(1e-6, dot(to_eye, n))};
  const Vector3 facet = sample_vndf(eye, alpha, u);
  BsdfSample result;
  result.cos_half = std::clamp(dot(eye, facet), 0.0, 1.0);
  const Vector3 reflected = (2 * result.cos_half) * facet - eye;
  if (reflected.z <= 0) return result;
  result.weight = smith_g1(reflected.z, alpha * alpha);
  result.direction = to_ambient(frame, geometry::normalised(reflected.x * tangent + reflected.y * bitangent + reflected.z * n));
  return result;
}

}  // namespace orbc::surface
