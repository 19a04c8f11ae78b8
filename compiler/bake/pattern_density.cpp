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
constexpr double kGrains = 8;         // texels per cell of a solid pattern, at least
constexpr double kFinestPattern = 3;  // times BakeOptions::texture_fine: no solid pattern gets more texels
constexpr double kPatternError = 2;   // times BakeOptions::tolerance: by so much texels of a pattern may be off
constexpr int kPlacesPerWrong = 25;   // at one of so many places
constexpr int kPlaces = 64;           // looked at on a block

double difference(const Color& a, const Color& b) {
  const auto code = [](double c) { return 255 * image::encode_srgb(std::clamp(c, 0.0, 1.0)); };
  return std::max({std::fabs(code(a.r) - code(b.r)), std::fabs(code(a.g) - code(b.g)), std::fabs(code(a.b) - code(b.b))});
}

// Whether texels at that density, looked up in between, would show the pattern wrongly at more than a few of some places.
bool blurs(const place::PlacedRoom& room, const place::PlacedMesh& mesh, const Block& block, const BakeOptions& options, double density) {
  const int most = 1 << kMaxPatternHalvings;
  const int cells_u = 1 << level_of(block.length_u * density), cells_v = 1 << level_of(block.length_v * density);
  if (cells_u >= most && cells_v >= most) return false;
  const auto albedo = [&](double u, double v) {
    if (block.second < 0 && u + v > 1) u = 1 - v;  // beyond the long side of a single triangle: as good as on it
    const InTriangle at = in_triangle(block, u, v);
    return surface::triangle_albedo(room, mesh, at.triangle, at.b);
  };
  const int places = std::min(kPlaces, 2 * cells_u * cells_v);
  int wrong = 0;
  for (int k = 0; k < places; ++k) {
    const auto at = surface::r3_point(k);
    double u = at[0], v = at[1];
    if (block.second < 0 && u + v > 1) u = 1 - u, v = 1 - v;
    const double i = std::min(std::floor(u * cells_u), cells_u - 1.0), j = std::min(std::floor(v * cells_v), cells_v - 1.0);
    const double s = u * cells_u - i, t = v * cells_v - j;
    const auto texel = [&](double x, double y) { return albedo(x / cells_u, y / cells_v); };
    const Color between =
        (1 - t) * ((1 - s) * texel(i, j) + s * texel(i + 1, j)) + t * ((1 - s) * texel(i, j + 1) + s * texel(i + 1, j + 1));
    wrong += difference(between, albedo(u, v)) > kPatternError * options.tolerance;
  }
  return wrong * kPlacesPerWrong > places;
}

}  // namespace

int level_of(double cells) { return std::clamp(static_cast<int>(std::lround(math::log2(std::max(1.0, cells)))), 0, kMaxPatternHalvings); }

double pattern_density(const place::PlacedRoom& room, const place::PlacedMesh& mesh, const Block& block, const BakeOptions& options) {
  const place::Look& look = room.looks[mesh.look[block.first]];
  if (look.texture >= 0) return options.texture_fine;
  double density = std::clamp(kGrains / std::max(look.material.cell, 1e-6), options.fine, options.texture_fine);
  while (density < kFinestPattern * options.texture_fine && blurs(room, mesh, block, options, density)) density *= 2;
  return density;
}

}  // namespace orbc::bake
