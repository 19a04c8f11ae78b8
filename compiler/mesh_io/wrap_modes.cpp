#include "compiler/mesh_io/wrap_modes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "compiler/mesh/weld.h"

namespace orbc::mesh_io {
namespace {

using geometry::Vector3;
using mesh::Mesh;

constexpr double kMaxRepeats = 1000;

struct Corner {
  Vector3 position;
  std::array<double, 2> uv{};
  std::array<double, 3> color{};
};

using Polygon = std::vector<Corner>;

bool is_before(const Vector3& a, const Vector3& b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

/// Where the side from a to b has the value `at` of uv[axis]. The same bits for (a, b) and (b, a), so that neighbours are cut alike.
Corner interpolate(const Corner& a, const Corner& b, std::size_t axis, double at) {
  if (is_before(b.position, a.position)) return interpolate(b, a, axis, at);
  const double t = (at - a.uv[axis]) / (b.uv[axis] - a.uv[axis]);
  Corner made;
  made.position = (1 - t) * a.position + t * b.position;
  for (std::size_t k = 0; k < 2; ++k) made.uv[k] = (1 - t) * a.uv[k] + t * b.uv[k];
  for (std::size_t k = 0; k < 3; ++k) made.color[k] = (1 - t) * a.color[k] + t * b.color[k];
  made.uv[axis] = at;
  return made;
}

/// The two sides of a convex polygon, below and above `at`; a side may be empty.
std::pair<Polygon, Polygon> split(const Polygon& polygon, std::size_t axis, double at) {
  Polygon below, above;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (a.uv[axis] <= at) below.push_back(a);
    if (a.uv[axis] >= at) above.push_back(a);
    if ((a.uv[axis] < at && b.uv[axis] > at) || (a.uv[axis] > at && b.uv[axis] < at)) {
      const Corner middle = interpolate(a, b, axis, at);
      below.push_back(middle);
      above.push_back(middle);
    }
  }
  return {below.size() < 3 ? Polygon{} : below, above.size() < 3 ? Polygon{} : above};
}

/// Where along one axis a polygon has to be cut; nothing when there are too many places.
std::optional<std::vector<double>> cuts(const Polygon& polygon, std::size_t axis, Wrap wrap, double texels) {
  double low = polygon[0].uv[axis], high = low;
  for (const Corner& corner : polygon) {
    low = std::min(low, corner.uv[axis]);
    high = std::max(high, corner.uv[axis]);
  }
  if (wrap == Wrap::clamp) return std::vector<double>{0.5 / texels, 1 - 0.5 / texels};
  std::vector<double> places;
  if (wrap == Wrap::repeat || low >= high) return places;
  if (high - low > kMaxRepeats) return {};
  for (double at = std::floor(low) + 1; at < high; ++at) places.push_back(at);
  return places;
}

/// From a coordinate of one uncut polygon into [0, 1].
double wrapped(double value, double middle, Wrap wrap, double texels) {
  if (wrap == Wrap::clamp) return std::clamp(value, 0.5 / texels, 1 - 0.5 / texels);
  if (wrap == Wrap::repeat) return value;
  const double repeat = std::floor(middle), within = value - repeat;
  return std::fmod(std::abs(repeat), 2) == 0 ? within : 1 - within;
}

std::vector<Polygon> cut(const Polygon& triangle, const WrapModes& modes, const image::Image& texture) {
  std::vector<Polygon> pieces{triangle};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto places = cuts(triangle, axis, axis == 0 ? modes.u : modes.v, axis == 0 ? texture.width : texture.height);
    if (!places) return {triangle};
    for (const double at : *places) {
      std::vector<Polygon> parts;
      for (const Polygon& piece : pieces) {
        auto [below, above] = split(piece, axis, at);
        if (!below.empty()) parts.push_back(std::move(below));
        if (!above.empty()) parts.push_back(std::move(above));
      }
      pieces = std::move(parts);
    }
  }
  return pieces;
}

void wrap_uv(Polygon& piece, const WrapModes& modes, const image::Image& texture) {
  std::array<double, 2> middle{0, 0};
  for (const Corner& corner : piece) {
    for (std::size_t axis = 0; axis < 2; ++axis) middle[axis] += corner.uv[axis] / static_cast<double>(piece.size());
  }
  for (Corner& corner : piece) {
    corner.uv[0] = wrapped(corner.uv[0], middle[0], modes.u, texture.width);
    corner.uv[1] = wrapped(corner.uv[1], middle[1], modes.v, texture.height);
  }
}

Corner corner_of(const Mesh& mesh, std::uint32_t v) {
  Corner corner{mesh.positions[v], {static_cast<double>(mesh.uv[v][0]), static_cast<double>(mesh.uv[v][1])}, {}};
  for (std::size_t k = 0; k < 3 && !mesh.colors.empty(); ++k) corner.color[k] = static_cast<double>(mesh.colors[v][k]);
  return corner;
}

void append(const Polygon& piece, std::uint16_t material, Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Corner& corner : piece) {
    mesh.positions.push_back(corner.position);
    mesh.uv.push_back({static_cast<float>(corner.uv[0]), static_cast<float>(corner.uv[1])});
    if (!mesh.colors.empty())
      mesh.colors.push_back(
          {static_cast<float>(corner.color[0]), static_cast<float>(corner.color[1]), static_cast<float>(corner.color[2])});
  }
  for (std::uint32_t k = 1; k + 1 < piece.size(); ++k) {
    mesh.triangles.push_back({first, first + k, first + k + 1});
    mesh.triangle_material.push_back(material);
  }
}

}  // namespace

Mesh apply_wrap_modes(Mesh mesh, const std::vector<WrapModes>& modes) {
  const bool all_repeat =
      std::all_of(modes.begin(), modes.end(), [](const WrapModes& m) { return m.u == Wrap::repeat && m.v == Wrap::repeat; });
  if (all_repeat || mesh.uv.empty()) return mesh;
  const std::vector<mesh::Triangle> triangles = std::move(mesh.triangles);
  std::vector<std::uint16_t> materials = std::move(mesh.triangle_material);
  materials.resize(triangles.size(), 0);
  mesh.triangles.clear();
  mesh.triangle_material.clear();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto material = materials[t];
    const WrapModes mode = material < modes.size() ? modes[material] : WrapModes{};
    const int texture = material < mesh.materials.size() ? mesh.materials[material].texture : -1;
    const auto is_inside = [&](std::uint32_t v) {
      return mesh.uv[v][0] >= 0 && mesh.uv[v][0] <= 1 && mesh.uv[v][1] >= 0 && mesh.uv[v][1] <= 1;
    };
    const auto& corners = triangles[t];
    const bool repeats = texture < 0 || (mode.u == Wrap::repeat && mode.v == Wrap::repeat);
    if (repeats || (is_inside(corners[0]) && is_inside(corners[1]) && is_inside(corners[2]))) {
      mesh.triangles.push_back(corners);
      mesh.triangle_material.push_back(material);
      continue;
    }
    const image::Image& picture = mesh.textures[static_cast<std::size_t>(texture)];
    for (Polygon& piece : cut({corner_of(mesh, corners[0]), corner_of(mesh, corners[1]), corner_of(mesh, corners[2])}, mode, picture)) {
      wrap_uv(piece, mode, picture);
      append(piece, material, mesh);
    }
  }
  return mesh::remove_unused_vertices(std::move(mesh)).mesh;
}

}  // namespace orbc::mesh_io
