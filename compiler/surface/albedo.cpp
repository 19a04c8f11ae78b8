#include "compiler/surface/albedo.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "compiler/image/image.h"
#include "compiler/image/srgb.h"
#include "compiler/place/alpha_mask.h"

namespace orbc::surface {
namespace {

using geometry::Vector3;
using scene::Color;
using scene::Pattern;

// Hash of a lattice point as a number in [0, 1): the finaliser of MurmurHash3 (Appleby, public domain).
double lattice_value(std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^ static_cast<std::uint32_t>(y) * 0xd8163841u ^
                    static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
  h ^= h >> 16;
  h *= 0x85ebca6bu;
  h ^= h >> 13;
  h *= 0xc2b2ae35u;
  h ^= h >> 16;
  return h * (1.0 / 4294967296.0);
}

double quintic(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

// Value noise, −1…1, twice differentiable.
double noise(const Vector3& p) {
  const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const double u = quintic(p.x - fx), v = quintic(p.y - fy), w = quintic(p.z - fz);
  const auto x = static_cast<std::int64_t>(fx), y = static_cast<std::int64_t>(fy), z = static_cast<std::int64_t>(fz);
  const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
  const auto row = [&](std::int64_t j, std::int64_t k) { return mix(lattice_value(x, j, k), lattice_value(x + 1, j, k), u); };
  return 2 * mix(mix(row(y, z), row(y + 1, z), v), mix(row(y, z + 1), row(y + 1, z + 1), v), w) - 1;
}

double turbulence(Vector3 p, int octaves) {
  double sum = 0, amplitude = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * noise(p);
    amplitude /= 2;
    p = 2.03 * p + Vector3{17.1, 5.7, 31.3};
  }
  return sum;
}

double smoothstep(double from, double to, double t) {
  t = std::clamp((t - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Color texel(const image::Image& image, double u, double v) {
  const std::uint8_t* p = place::texel(image, u, v);
  return {image::decode_srgb8(p[0]), image::decode_srgb8(p[1]), image::decode_srgb8(p[2])};
}

bool is_solid(Pattern pattern) { return pattern == Pattern::marble || pattern == Pattern::wood || pattern == Pattern::granite; }

// Objects carry coordinates of their own. Floor, ceiling and walls are cut from one solid. Frames have neither.
bool has_solid_position(const place::PlacedMesh& part) {
  return !part.pattern_position.empty() || part.kind == place::PartKind::floor || part.kind == place::PartKind::ceiling ||
         part.kind == place::PartKind::wall;
}

std::optional<Vector3> solid_position(const place::Interior& interior, const place::PlacedMesh& part, const geometry::Position& at,
                                      const Vector3& object_position) {
  if (!has_solid_position(part)) return std::nullopt;
  return part.pattern_position.empty() ? shell_position(interior.polygon.space, at) : object_position;
}

}  // namespace

double solid_pattern(Pattern pattern, const Vector3& at, double cell) {
  const Vector3 p = (1 / cell) * at;
  switch (pattern) {
    case Pattern::marble: {
      const double sheet = p.x + 0.6 * p.y + 0.8 * p.z + 1.3 * turbulence(1.1 * p, 5);
      const double vein = 1 - std::fabs(math::sin(3.14159265358979 * sheet));
      return std::clamp(0.75 * smoothstep(0.72, 1, vein) + 0.25 * smoothstep(0.1, 0.9, vein) * smoothstep(-0.4, 0.8, noise(2.3 * p)), 0.0,
                        1.0);
    }
    case Pattern::wood: {
      const Vector3 bent = p + 0.18 * Vector3{noise(1.3 * p), noise(1.3 * p + Vector3{7.7, 3.1, 9.2}), 0};
      const double ring = 4 * math::hypot(bent.x + 0.9, bent.y + 0.4 + 0.08 * p.z), within = ring - std::floor(ring);
      const double grain = 0.12 * noise({28 * p.x, 28 * p.y, 2 * p.z});
      return std::clamp(smoothstep(0.15, 0.85, within) * (1 - smoothstep(0.9, 1, within)) + grain, 0.0, 1.0);
    }
    case Pattern::granite: {
      const double grains = noise(6 * p) + 0.7 * noise(13 * p + Vector3{3.3, 8.1, 1.7}) + 0.45 * noise(29 * p + Vector3{9.4, 2.6, 5.5});
      return smoothstep(-0.35, 0.75, grains);
    }
    default:
      return 0;
  }
}

Vector3 shell_position(geometry::Space space, const geometry::Position& at) {
  const std::complex<double> z = (space == geometry::Space::euclidean ? 1.0 : 2.0) * geometry::disk_from_point(space, at.floor);
  return {z.real(), z.imag(), at.z};
}

bool varies_in_triangle(const place::Interior& interior, const place::PlacedMesh& part, int style) {
  if (style < 0) return false;
  const place::SurfaceStyle& l = interior.styles[static_cast<std::size_t>(style)];
  return l.texture >= 0 || !part.color.empty() || (has_solid_position(part) && is_solid(l.material.pattern));
}

Color albedo(const place::Interior& interior, const AlbedoQuery& query) {
  if (query.style < 0) return query.color;
  const place::SurfaceStyle& style = interior.styles[static_cast<std::size_t>(query.style)];
  if (style.texture >= 0) return query.color * texel(interior.textures[static_cast<std::size_t>(style.texture)], query.uv[0], query.uv[1]);
  if (!query.solid_position || !is_solid(style.material.pattern)) return query.color;
  const double t = solid_pattern(style.material.pattern, *query.solid_position, style.material.cell);
  return (1 - t) * style.material.color + t * style.material.second;
}

Color hit_albedo(const place::Interior& interior, const trace::SurfacePoint& point) {
  AlbedoQuery query;
  query.style = point.style;
  query.color = point.color;
  query.uv[0] = point.uv[0];
  query.uv[1] = point.uv[1];
  if (point.part >= 0)
    query.solid_position = solid_position(interior, interior.parts[static_cast<std::size_t>(point.part)], point.at, point.pattern_position);
  return albedo(interior, query);
}

Color triangle_albedo(const place::Interior& interior, const place::PlacedMesh& part, std::size_t triangle,
                      const std::array<double, 3>& b) {
  AlbedoQuery query;
  query.style = part.style[triangle];
  query.color = interior.styles[part.style[triangle]].color;
  if (!part.color.empty()) query.color = query.color * place::interpolated_color(part, triangle, b);
  const mesh::Triangle& t = part.triangles[triangle];
  geometry::Ambient sum{0, 0, 0};
  geometry::Vector3 object_position;
  double z = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    sum = sum + b[k] * part.floor[t[k]];
    z += b[k] * part.z[t[k]];
    if (!part.uv.empty())
      for (std::size_t c = 0; c < 2; ++c) query.uv[c] += b[k] * static_cast<double>(part.uv[t[k]][c]);
    if (!part.pattern_position.empty()) object_position = object_position + b[k] * part.pattern_position[t[k]];
  }
  // The uv of a triangle lie in [0, 1]. 1 means the last texel of this repeat, not the first texel of the next one.
  for (double& c : query.uv) c = std::clamp(c, 0.0, 1 - 1e-9);
  query.solid_position = solid_position(interior, part, {geometry::normalised_point(interior.polygon.space, sum), z}, object_position);
  return albedo(interior, query);
}

}  // namespace orbc::surface
