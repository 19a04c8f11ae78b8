#include "compiler/surface/ggx.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "compiler/surface/sampling.h"
#include "compiler/surface/tangent_frame.h"

using namespace orbc;
using geometry::Space;
using geometry::Vector3;

namespace {

constexpr double kPi = std::numbers::pi;

/// A point of a surface whose normal leans, met by a ray with the cosine `facing` to it.
trace::SurfacePoint met(Space space, double facing) {
  trace::SurfacePoint point;
  point.at = {geometry::point_along(space, {}, geometry::Tangent(0, 0.6, 0.8), 0.4), 0.3};
  const surface::TangentFrame frame = surface::tangent_frame(space, point.at.floor);
  const Vector3 n = geometry::normalised({0.3, -0.5, 0.6}), across = geometry::normalised(cross(n, {0, 0, 1}));
  point.normal = surface::to_ambient(frame, n);
  point.incoming = surface::to_ambient(frame, -1.0 * (facing * n + std::sqrt(1 - facing * facing) * across));
  return point;
}

/// Something to see: brighter towards one side.
double sky(const Vector3& d) { return 1 + 0.8 * d.x - 0.3 * d.z; }

}  // namespace

TEST_CASE("the mean over sampled directions is the integral of the microfacet model over all directions", "[surface]") {
  for (const Space space : {Space::spherical, Space::euclidean, Space::hyperbolic})
    for (const double roughness : {0.3, 0.6, 1.0})
      for (const double facing : {0.9, 0.4}) {
        const trace::SurfacePoint point = met(space, facing);
        const surface::TangentFrame frame = surface::tangent_frame(space, point.at.floor);
        const double alpha = roughness * roughness, a2 = alpha * alpha;
        const scene::Color f0{0.6, 0.6, 0.6};
        double by_ways = 0;
        constexpr int kWays = 20000;
        for (int k = 0; k < kWays; ++k) {
          const auto u = surface::r3_point(k);
          const surface::BsdfSample way = surface::sample_ggx(space, point, alpha, {u[0], u[1]});
          if (way.weight <= 0) continue;
          REQUIRE(trace::inner(space, way.direction, way.direction) == Approx(1));
          REQUIRE(trace::inner(space, way.direction, point.normal) > 0);
          by_ways +=
              way.weight * surface::fresnel_schlick(f0, way.cos_half).r * sky(surface::to_local(space, frame, way.direction)) / kWays;
        }
        // D·F·G/(4·cos·cos), times cos, over the half sphere
        const Vector3 n = surface::to_local(space, frame, point.normal), v = -1.0 * surface::to_local(space, frame, point.incoming);
        const Vector3 e = geometry::normalised(cross(n, {1, 0, 0})), f = cross(n, e);
        double whole = 0;
        constexpr int kUp = 600, kRound = 600;
        for (int i = 0; i < kUp; ++i)
          for (int j = 0; j < kRound; ++j) {
            const double c = (i + 0.5) / kUp, s = std::sqrt(1 - c * c), phi = 2 * kPi * (j + 0.5) / kRound;
            const Vector3 l = c * n + (s * std::cos(phi)) * e + (s * std::sin(phi)) * f, half = geometry::normalised(l + v);
            const double brdf = surface::ggx_d(dot(half, n), a2) * surface::smith_g1(c, a2) * surface::smith_g1(dot(v, n), a2) *
                                surface::fresnel_schlick(f0, dot(l, half)).r / (4 * c * dot(v, n));
            whole += brdf * c * sky(l) * 2 * kPi / (kUp * kRound);
          }
        INFO("space " << geometry::curvature(space) << ", roughness " << roughness << ", facing " << facing);
        CHECK(by_ways == Approx(whole).epsilon(0.005));
      }
}

TEST_CASE("a smooth metal reflects as a mirror does", "[surface]") {
  const trace::SurfacePoint point = met(Space::hyperbolic, 0.5);
  const trace::Direction expected = point.incoming + (2 * 0.5) * point.normal;
  for (int k = 0; k < 50; ++k) {
    const auto u = surface::r3_point(k);
    const surface::BsdfSample way = surface::sample_ggx(Space::hyperbolic, point, 0.0005, {u[0], u[1]});
    CHECK(way.weight == Approx(1).margin(1e-4));
    CHECK(way.cos_half == Approx(0.5).margin(0.02));
    const trace::Direction off = way.direction + -1.0 * expected;
    CHECK(std::sqrt(trace::inner(Space::hyperbolic, off, off)) < 0.02);
  }
}

TEST_CASE("metals reflect their colour at normal incidence and white at grazing angles; gloss reflects a twenty-fifth", "[surface]") {
  scene::Material metal, glossy;
  metal.kind = scene::MaterialKind::metal, glossy.kind = scene::MaterialKind::glossy;
  const scene::Color gold{1, 0.78, 0.34};
  CHECK(surface::fresnel_schlick(surface::f0(metal, gold), 1) == gold);
  CHECK(surface::fresnel_schlick(surface::f0(metal, gold), 0).b == Approx(1));
  CHECK(surface::f0(glossy, gold).r == Approx(0.04));
}

TEST_CASE("the directions sampled for a metal, and any even number of them from an even one on, have the reflected direction as their mean",
          "[surface]") {
  for (const int n : {2, 4, 8, 16, 32, 64, 128, 256}) {
    double across = 0, up = 0, depth = 0;
    for (int k = 0; k < n; ++k) {
      const auto u = surface::vndf_point(k, n, 0);
      REQUIRE((u[0] >= 0 && u[0] < 1 && u[1] >= 0 && u[1] < 1));
      depth += u[0] / n;
      across += std::sqrt(u[0]) * std::cos(2 * kPi * u[1]) / n, up += std::sqrt(u[0]) * std::sin(2 * kPi * u[1]) / n;
      INFO(n << " ways, up to " << k);
      if (k % 2) CHECK(std::hypot(across, up) < 1e-12);
    }
    CHECK(depth == Approx(0.5));  // as many within half the disk as without
    // Layers: every sixteenth of the disk's area has its share.
    if (n < 32) continue;
    std::array<int, 16> in_layer{};
    for (int k = 0; k < n; ++k) ++in_layer[static_cast<std::size_t>(16 * surface::vndf_point(k, n, 0)[0])];
    for (const int count : in_layer) CHECK(count == n / 16);
  }
}

TEST_CASE("the samples of the second and third metal on a path are independent of the first's", "[surface]") {
  constexpr int kWays = 256;
  for (const int metal : {1, 2})
    for (const std::size_t a : {0u, 1u})
      for (const std::size_t b : {0u, 1u}) {
        double product = 0, mean = 0;
        for (int k = 0; k < kWays; ++k) {
          const double first = surface::vndf_point(k, kWays, 0)[a] - 0.5, next = surface::vndf_point(k, kWays, metal)[b] - 0.5;
          product += first * next / kWays, mean += next / kWays;
        }
        CHECK(std::fabs(mean) < 0.01);
        CHECK(std::fabs(12 * product) < 0.1);  // correlation
      }
}
