#include "compiler/bake/pattern_density.h"

#include <algorithm>
#include <cmath>

#include "compiler/base/elementary.h"
#include "compiler/image/srgb.h"
#include "compiler/surface/albedo.h"
#include "compiler/surface/sampling.h"

namespace orbc::bake {
namespace {

using scene::Color;

constexpr int kMaxPatternHalvings = 11;
constexpr double kMinTexelsPerCell = 8;      // of a solid pattern
constexpr double kMaxDensityFactor = 3;      // times BakeOptions::texture_density: the most texels of a solid pattern
constexpr double kErrorFactor = 2;           // times BakeOptions::tolerance: the error of interpolated colours
constexpr int kSamplesPerAllowedError = 25;  // one in so many samples may be off by more
constexpr int kSamples = 64;                 // of a patch

double difference(const Color& a, const Color& b) {
  const auto code = [](double c) { return 255 * image::encode_srgb(std::clamp(c, 0.0, 1.0)); };
  return std::max({std::fabs(code(a.r) - code(b.r)), std::fabs(code(a.g) - code(b.g)), std::fabs(code(a.b) - code(b.b))});
}

/// Whether colours interpolated between texels of that density miss the pattern at too many samples.
bool exceeds_interpolation_error(const place::Interior& interior, const place::PlacedMesh& mesh, const TexelPatch& patch,
                                 const BakeOptions& options, double density) {
  const int max_cells = 1 << kMaxPatternHalvings;
  const int cells_u = 1 << halvings(patch.length_u * density), cells_v = 1 << halvings(patch.length_v * density);
  if (cells_u >= max_cells && cells_v >= max_cells) return false;
  const auto albedo = [&](double u, double v) {
    if (patch.second < 0 && u + v > 1) u = 1 - v;  // beyond the long side of a single triangle: as good as on it
    return albedo_at(interior, mesh, patch, u, v);
  };
  const int samples = std::min(kSamples, 2 * cells_u * cells_v);
  int wrong = 0;
  for (int k = 0; k < samples; ++k) {
    const auto at = surface::r3_point(k);
    double u = at[0], v = at[1];
    if (patch.second < 0 && u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const double i = std::min(std::floor(u * cells_u), cells_u - 1.0), j = std::min(std::floor(v * cells_v), cells_v - 1.0);
    const double s = u * cells_u - i, t = v * cells_v - j;
    const auto texel = [&](double x, double y) { return albedo(x / cells_u, y / cells_v); };
    const Color between =
        (1 - t) * ((1 - s) * texel(i, j) + s * texel(i + 1, j)) + t * ((1 - s) * texel(i, j + 1) + s * texel(i + 1, j + 1));
    wrong += difference(between, albedo(u, v)) > kErrorFactor * options.tolerance;
  }
  return wrong * kSamplesPerAllowedError > samples;
}

}  // namespace

int halvings(double cells) {
  constexpr double kTie =
      1e-5;  // diagonals of cells lie in the middle of two powers of two: they get the smaller one, whatever the last bits
  return std::clamp(static_cast<int>(std::lround(math::log2(std::max(1.0, cells)) - kTie)), 0, kMaxPatternHalvings);
}

double pattern_density(const place::Interior& interior, const place::PlacedMesh& mesh, const TexelPatch& patch,
                       const BakeOptions& options) {
  const place::SurfaceStyle& style = interior.styles[mesh.style[patch.first]];
  if (style.texture >= 0) return options.texture_density;
  double density = std::clamp(kMinTexelsPerCell / std::max(style.material.cell, 1e-6), options.max_density, options.texture_density);
  while (density < kMaxDensityFactor * options.texture_density && exceeds_interpolation_error(interior, mesh, patch, options, density))
    density *= 2;
  return density;
}

}  // namespace orbc::bake
