#include "compiler/bake/view_dependent_parts.h"

#include <algorithm>
#include <cmath>

#include "compiler/base/elementary.h"

namespace orbc::bake {
namespace {

constexpr double kMinGlossyDiameterPx = 3;      // smaller parts show no highlights
constexpr double kMinSpecularDiameterPx = 0.5;  // of mirrors, glass and metals, which show nothing else

BoundingBall bounding_ball(geometry::Space space, const place::PlacedMesh& part) {
  geometry::Ambient sum{0, 0, 0};
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < part.floor.size(); ++i) {
    sum = sum + part.floor[i];
    low = std::min(low, part.z[i]);
    high = std::max(high, part.z[i]);
  }
  BoundingBall ball{{geometry::normalised_point(space, sum), (low + high) / 2}, 0};
  for (std::size_t i = 0; i < part.floor.size(); ++i)
    ball.radius =
        std::max(ball.radius, math::hypot(geometry::distance(space, ball.centre.floor, part.floor[i]), part.z[i] - ball.centre.z));
  return ball;
}

}  // namespace

bool is_glossy(const scene::Material& material) { return material.kind == scene::MaterialKind::glossy; }

std::vector<ViewDependentPart> find_view_dependent_parts(const place::Interior& interior, const light::LightingContext& lighting,
                                                         const DrawnParts& drawn, bool has_query) {
  const auto is_view_dependent = [&](const scene::Material& m) { return is_glossy(m) || (has_query && is_specular(m, lighting.lit)); };
  std::vector<ViewDependentPart> parts;
  const std::size_t count = drawn.models.empty() ? std::min(interior.parts.size(), lighting.normals.size()) : interior.parts.size();
  for (std::size_t p = 0; p < count; ++p) {
    const place::PlacedMesh& mesh = interior.parts[p];
    if (std::none_of(mesh.style.begin(), mesh.style.end(),
                     [&](std::uint16_t style) { return is_view_dependent(interior.styles[style].material); }))
      continue;
    ViewDependentPart part{p, bounding_ball(interior.polygon.space, mesh), kMinGlossyDiameterPx, {}, {}};
    const auto is_seen_through_query = [&](std::uint16_t style) {
      return has_query && is_specular(interior.styles[style].material, lighting.lit);
    };
    if (std::any_of(mesh.style.begin(), mesh.style.end(), is_seen_through_query)) part.min_diameter_px = kMinSpecularDiameterPx;
    for (const auto& model : drawn.models) part.drawn_in_model.push_back(std::find(model.begin(), model.end(), p) != model.end());
    if (p >= lighting.normals.size()) part.lod_normals = surface::part_normals(interior, mesh);
    parts.push_back(std::move(part));
  }
  return parts;
}

bool needs_view_bake(const place::Interior& interior, const light::LightingContext& lighting) {
  if (is_specular(interior, lighting.lit)) return true;
  if (!lighting.lit || lighting.lamps->images.empty()) return false;
  return std::any_of(interior.styles.begin(), interior.styles.end(),
                     [](const place::SurfaceStyle& style) { return is_glossy(style.material); });
}

}  // namespace orbc::bake
