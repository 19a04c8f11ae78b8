#pragma once
#include <string>

#include "compiler/base/diagnostic.h"
#include "compiler/mesh/mesh.h"

namespace orbc::mesh_io {

/// A material without blending, and whether that looks the same.
struct UnblendedMaterial {
  mesh::Material material;
  bool is_exact = true;
};

/// Replaces blending by a threshold, since no surface here is half there: texels of less alpha than one half become holes. A material
/// whose alpha is less than one half everywhere becomes invisible.
/// In: the factor of the texture's alpha, 0…1; the texture, or null.
[[nodiscard]] UnblendedMaterial without_blending(mesh::Material material, double alpha, const image::Image* texture);

/// mesh.blended: the warning that a file needs blending.
[[nodiscard]] Diagnostic blending_warning(const std::string& name);

/// Leaves out the triangles of invisible materials, unless nothing else is there.
[[nodiscard]] mesh::Mesh without_invisible_triangles(mesh::Mesh mesh);

/// A picture with the alpha of a mask: that of its alpha channel, or else its brightness (Rec. 709 weights on the codes).
/// In: the colours, or null for white. Makes: the larger size of the two.
[[nodiscard]] image::Image with_opacity_mask(const image::Image* colors, const image::Image& mask);

}  // namespace orbc::mesh_io
