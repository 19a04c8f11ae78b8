#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

struct DecimateOptions {
  std::size_t triangles = 0;  ///< stop at this many; 0 = only the error stops it
  double max_error = 0;       ///< never be farther than this from the given surface; 0 = no bound
};

struct Decimated {
  Mesh mesh;
  std::vector<std::uint32_t> origin;  ///< per vertex: which one of the given mesh it is
  double error = 0;  ///< largest distance of a vertex of the given mesh from the surface of `mesh`, measured
};

/// Simplifies a mesh by collapsing edges, those that change the surface least first (quadric errors, OpenMesh).
/// Makes:        a mesh of a subset of the vertices; borders, uv seams and borders between looks stay where they are, up to the error; the
///               two sides of a seam keep together, so no crack opens; no triangle turns over. Same input, same bytes.
/// Error:        `error` is measured from the given vertices to the new surface; the other direction is not, but new vertices are old ones.
/// Not promised: that `triangles` is reached: a mesh of many small separate pieces, or of seams everywhere, has a floor.
[[nodiscard]] Decimated decimate(const Mesh& mesh, const DecimateOptions& options);

/// A chain of ever coarser meshes, each made from the one before in one go.
/// In:    numbers of triangles, decreasing.
/// Makes: as many as there are numbers, or fewer when the mesh cannot be simplified further; as `decimate` does, each with what is kept
/// there.
/// Error: not measured (0): see `deviation`.
[[nodiscard]] std::vector<Decimated> decimate_in_steps(const Mesh& mesh, const std::vector<std::size_t>& triangles);

}  // namespace orbc::mesh
