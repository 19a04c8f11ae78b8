#pragma once
// Internal to decimate: the half-edge structure of a mesh and its quadrics. OpenMesh is included here and in decimate's sources alone.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compiler/mesh/mesh.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
// QuadricT.hh needs the two before it.
// clang-format off
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>
#include <OpenMesh/Core/Geometry/QuadricT.hh>
// clang-format on
#pragma GCC diagnostic pop

namespace orbc::mesh {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

/// A half-edge structure of triangles. It replaces OpenMesh's test of a collapse, which looks for a mark by its name at every edge: most of
/// the time went there.
class HalfedgeSurface : public OpenMesh::TriMesh_ArrayKernelT<DoubleTraits> {
 public:
  /// Whether the two ends can become one without two surfaces touching there: their rings share the two corners opposite to the edge and
  /// nothing else (the link condition; Dey, Edelsbrunner, Guha & Nekhayev 1999), and borders stay borders.
  [[nodiscard]] bool is_collapse_ok(OpenMesh::HalfedgeHandle edge) const;
};

using Quadric = OpenMesh::Geometry::Quadricd;

/// A mesh under decimation: its welded surface, and for each face of that the corners in the mesh itself.
struct DecimationState {
  explicit DecimationState(const Mesh& given) : mesh(given) {}

  const Mesh& mesh;
  HalfedgeSurface surface;
  std::vector<OpenMesh::VertexHandle> handle;  // of each welded vertex
  std::vector<std::uint32_t> weld, face;       // face: triangle of the mesh, by face index
  std::vector<Triangle> corners;               // by face index: the mesh's own vertices
  std::vector<std::uint32_t> rejected;         // triangles that fit into no manifold
  std::vector<char> feature;                   // by edge index
  std::vector<char> locked;                    // by vertex index
  std::vector<Quadric> quadric;                // by vertex index
  std::vector<double> weight;                  // by vertex index: area behind the quadric
  double bound = 0;                            // square of the largest quadric error allowed
  double scale = 1;                            // priorities are floats: 1 / size²
  std::size_t faces_left = 0;                  // by the collapses so far
  bool done = false;                           // no further collapse is wanted

  std::size_t corner_at(OpenMesh::FaceHandle f, OpenMesh::VertexHandle v) const {
    const auto& c = corners[static_cast<std::size_t>(f.idx())];
    for (std::size_t k = 0; k < 3; ++k) {
      if (handle[weld[c[k]]] == v) return k;
    }
    return 3;
  }
};

/// Whether two vertices differ in uv or colour.
[[nodiscard]] bool attributes_differ(const Mesh& mesh, std::uint32_t a, std::uint32_t b);

/// Welds the vertices and makes the half-edge structure; triangles that fit into no manifold are rejected and their corners locked.
void build_surface(DecimationState& state);

/// Finds features, and the quadrics of faces and features.
void compute_quadrics(DecimationState& state);

}  // namespace orbc::mesh
