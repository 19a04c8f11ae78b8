#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "compiler/base/diagnostic.h"
#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

/// What kind of surface a mesh is. Vertices with bitwise the same position count as one (files split them at uv seams).
struct MeshReport {
  geometry::Vector3 lowest, highest;  ///< bounding box of the vertices in use
  bool closed = false;                ///< every edge has two triangles, running opposite ways
  bool inside_out = false;            ///< closed, and the signed volume is negative
  double volume = 0;                  ///< signed, of a closed mesh; else 0
  double area = 0;
  geometry::Vector3 centroid;          ///< of the volume if closed and not flat, else of the surface, else of the vertices
  int euler = 0;                       ///< vertices − edges + triangles, degenerate triangles left out
  std::size_t open_edges = 0;          ///< with one triangle
  std::size_t non_manifold_edges = 0;  ///< with three or more triangles
  std::size_t inconsistent_edges = 0;  ///< with two triangles that run the same way: neighbours disagree what is outside
  std::size_t degenerate = 0;          ///< triangles without area
  std::size_t crossings = 0;           ///< pairs of triangles that cross; counting stops at `max_crossings`
  bool crossings_known = false;        ///< false when the mesh was too large to look for them
  geometry::Vector3 open_at, non_manifold_at, inconsistent_at, degenerate_at, crossing_at;  ///< an example of each
};

struct AnalyseOptions {
  bool crossings = true;
  std::size_t max_crossings = 1000;
  std::uint64_t max_pair_tests = 50'000'000;  ///< about a second and a half; beyond it crossings_known stays false
};

/// Examines a mesh.
/// Exact or error: edges, closedness, orientation of edges exact; crossings by floating-point signs of segment against triangle, triangles
///                 that share a position are not compared, touching does not count: a report, not a proof.
[[nodiscard]] MeshReport analyse(const Mesh& mesh, const AnalyseOptions& options = {});

/// What the author of a mesh should know.
/// Diagnostics: warnings mesh.inside-out, mesh.turned-triangles: light falls on the wrong side; notes mesh.not-manifold,
///              mesh.degenerate-triangles, mesh.self-intersections, mesh.open: the mesh is drawn as it is, and looks right.
[[nodiscard]] Diagnostics report_warnings(const MeshReport& report, const std::string& name);

/// The mesh with every triangle turned over.
[[nodiscard]] Mesh flip_orientation(Mesh mesh);

}  // namespace orbc::mesh
