#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "compiler/base/diagnostic.h"
#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

/// What kind of surface a mesh is. Vertices with bitwise the same position count as one (files split them at uv seams).
struct Examination {
  geometry::Vector3 lowest, highest;  ///< bounding box of the vertices in use
  bool closed = false;                ///< every edge has two triangles, running opposite ways
  bool inside_out = false;            ///< closed, and the signed volume is negative
  double volume = 0;                  ///< signed, of a closed mesh; else 0
  double area = 0;
  geometry::Vector3 centroid;    ///< of the volume if closed and not flat, else of the surface, else of the vertices
  int euler = 0;                 ///< vertices − edges + triangles, degenerate triangles left out
  std::size_t open_edges = 0;    ///< with one triangle
  std::size_t bad_edges = 0;     ///< with three or more triangles
  std::size_t turned_edges = 0;  ///< with two triangles that run the same way: neighbours disagree what is outside
  std::size_t degenerate = 0;    ///< triangles without area
  std::size_t crossings = 0;     ///< pairs of triangles that cross; counting stops at `max_crossings`
  bool crossings_known = false;  ///< false when the mesh was too large to look for them
  geometry::Vector3 open_at, bad_at, turned_at, degenerate_at, crossing_at;  ///< an example of each
};

struct ExamineOptions {
  bool crossings = true;
  std::size_t max_crossings = 1000;
  std::uint64_t max_pair_tests = 50'000'000;  ///< about a second and a half; beyond it crossings_known stays false
};

/// Looks a mesh over.
/// Exact or error: edges, closedness, orientation of edges exact; crossings by floating-point signs of segment against triangle, triangles
///                 that share a position are not compared, touching does not count: a report, not a proof.
[[nodiscard]] Examination examine(const Mesh& mesh, const ExamineOptions& options = {});

/// What an author should know of it: mesh.inside-out, mesh.turned-triangles (warnings: light falls on the wrong side);
/// mesh.not-manifold, mesh.degenerate-triangles, mesh.self-intersections, mesh.open (notes: it is drawn as it is, and looks right).
[[nodiscard]] Diagnostics warnings_of(const Examination& examination, const std::string& name);

/// Turns every triangle over.
void turn_inside_out(Mesh& mesh);

}  // namespace orbc::mesh
