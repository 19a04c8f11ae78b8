// From a polygon soup to a triangle mesh.
#include "compiler/mesh_io/polygon_soup.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "compiler/mesh_io/colors.h"
#include "compiler/mesh_io/errors.h"
#include "compiler/mesh_io/transparency.h"
#include "compiler/mesh_io/triangulate.h"

namespace orbc::mesh_io {
namespace {

using geometry::Vector3;
using mesh::LinearColor;
using mesh::Mesh;

/// Tests of corners against ears that one file may spend: half a second. Ordinary files need a thousandth of it.
constexpr std::int64_t kMaxEarTests = 500'000'000;

/// Gives each different corner of a vertex (by uv and colour) one vertex of the mesh, in order of first use.
class VertexSplitter {
 public:
  VertexSplitter(const PolygonSoup& soup, Mesh& mesh) : soup_(soup), mesh_(mesh), first_(soup.positions.size(), kNone) {}

  std::uint32_t vertex(std::uint32_t corner, std::size_t face) {
    const auto from = soup_.corners[corner];
    const auto color = color_of(from, face);
    for (auto at = first_[from]; at != kNone; at = next_[at]) {
      const bool same_uv = soup_.corner_uv.empty() || mesh_.uv[at] == soup_.corner_uv[corner];
      if (same_uv && (!color || mesh_.colors[at] == *color)) return at;
    }
    const auto at = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.push_back(soup_.positions[from]);
    if (!soup_.corner_uv.empty()) mesh_.uv.push_back(soup_.corner_uv[corner]);
    if (color) mesh_.colors.push_back(*color);
    next_.push_back(first_[from]);
    first_[from] = at;
    return at;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// A texture hides the colours of vertices and faces: files that have both mean them as alternatives.
  std::optional<LinearColor> color_of(std::uint32_t vertex, std::size_t face) const {
    if (soup_.vertex_color.empty() && soup_.face_color.empty()) return {};
    if (!soup_.face_material.empty() && soup_.materials[soup_.face_material[face]].texture >= 0) return LinearColor{1, 1, 1};
    return soup_.vertex_color.empty() ? soup_.face_color[face] : soup_.vertex_color[vertex];
  }

  const PolygonSoup& soup_;
  Mesh& mesh_;
  std::vector<std::uint32_t> first_, next_;
};

/// At least three vertices, and not many that occur several times: each hole of a polygon has three vertices, and its bridge repeats two.
bool is_polygon(std::vector<std::uint32_t>& corners) {
  const auto count = static_cast<std::ptrdiff_t>(corners.size());
  std::sort(corners.begin(), corners.end());
  const auto different = std::unique(corners.begin(), corners.end()) - corners.begin();
  return different >= 3 && count <= 2 * different;
}

std::uint64_t count_triangles(const PolygonSoup& soup) {
  std::uint64_t triangles = 0;
  for (std::size_t f = 0; f < soup.faces(); ++f) triangles += std::max<std::uint64_t>(soup.face_begin[f + 1] - soup.face_begin[f], 2) - 2;
  return triangles;
}

/// Colours of vertices and faces stand in place of those of materials, which are their factor.
void whiten_untextured(PolygonSoup& soup) {
  if (soup.materials.empty()) soup.materials.push_back({});
  for (auto& material : soup.materials) {
    if (material.texture < 0) material.color = {1, 1, 1};
  }
}

/// Triangulates all faces into the mesh. Makes: how many faces had fewer than three vertices.
std::uint64_t add_triangles(const PolygonSoup& soup, Mesh& mesh) {
  VertexSplitter splitter(soup, mesh);
  std::int64_t ear_tests = kMaxEarTests;
  std::uint64_t skipped = 0;
  std::vector<Vector3> polygon;
  std::vector<std::uint32_t> sorted;
  for (std::size_t f = 0; f < soup.faces(); ++f) {
    const auto begin = soup.face_begin[f], end = soup.face_begin[f + 1];
    sorted.assign(soup.corners.begin() + begin, soup.corners.begin() + end);
    if (!is_polygon(sorted)) {
      ++skipped;
      continue;
    }
    polygon.clear();
    for (auto c = begin; c < end; ++c) polygon.push_back(soup.positions[soup.corners[c]]);
    for (const auto& t : triangulate(polygon, ear_tests)) {
      const auto corner = [&](std::size_t k) { return soup.corners[begin + t[k]]; };
      if (corner(0) == corner(1) || corner(1) == corner(2) || corner(2) == corner(0)) continue;
      // In this order, not in that of evaluating arguments: vertices are numbered as they are met.
      const auto i = splitter.vertex(begin + t[0], f), j = splitter.vertex(begin + t[1], f), k = splitter.vertex(begin + t[2], f);
      mesh.triangles.push_back({i, j, k});
      if (!soup.face_material.empty())
        mesh.triangle_material.push_back(static_cast<std::uint16_t>(std::min<std::size_t>(soup.face_material[f], kMaxMaterials - 1)));
    }
  }
  return skipped;
}

}  // namespace

Result<mesh::LoadedMesh> to_mesh(PolygonSoup soup, const ReadContext& context) {
  const std::uint64_t triangles = count_triangles(soup);
  if (triangles > context.options.max_triangles) return too_many(context.name, "triangles", triangles, context.options.max_triangles);
  if (!soup.vertex_color.empty() || !soup.face_color.empty()) whiten_untextured(soup);
  mesh::LoadedMesh loaded;
  Mesh& mesh = loaded.mesh;
  mesh.triangles.reserve(triangles);
  const std::uint64_t skipped = add_triangles(soup, mesh);
  if (mesh.triangles.empty()) {
    return make_error(
        "mesh.no-triangles",
        fmt::format("{}: there is no triangle in it ({} vertices, {} faces)", context.name, soup.positions.size(), soup.faces()),
        "export the surface, not only its points or edges");
  }
  loaded.warnings = std::move(soup.warnings);
  if (soup.materials.size() > kMaxMaterials) {
    soup.materials.resize(kMaxMaterials);
    loaded.warnings.push_back(make_warning(
        "mesh.too-many-looks", fmt::format("{}: more than {} materials; the others look like the last one", context.name, kMaxMaterials)));
  }
  if (skipped > 0) {
    loaded.warnings.push_back(make_note(
        "mesh.skipped-faces",
        fmt::format("{}: {} of {} faces use fewer than three different vertices and are left out", context.name, skipped, soup.faces())));
  }
  mesh.materials = std::move(soup.materials);
  mesh.textures = std::move(soup.textures);
  mesh = fold_uniform_colors(apply_wrap_modes(without_invisible_triangles(std::move(mesh)), soup.wrap_modes));
  return loaded;
}

}  // namespace orbc::mesh_io
