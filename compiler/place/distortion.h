#pragma once
#include "compiler/place/interior.h"

namespace orbc::place {

/// How far the embedding of an object is from a copy in true shape. Heights are never distorted.
struct EmbeddingDistortion {
  double reach = 0;        ///< largest distance from the object's axis, intrinsic
  double least_scale = 1;  ///< of horizontal lengths, anywhere in the object and in any direction; on the axis it is 1
  double largest_scale = 1;
  double angle = 0;          ///< radians by which angles between horizontal directions change at most
  double upright_angle = 0;  ///< the same of angles between a horizontal and the vertical direction, in planes through both
};

/// In:      0 ≤ reach, on the sphere < π.
/// Formula: exponential: distances from the axis are true, circles about it are longer by sinκ(ρ)/ρ. Conformal: every horizontal length is
///          longer by cosκ²(ρ/2), since x becomes ρ = 2·atanκ(x/2). A map that stretches two perpendicular directions by p and q changes
///          angles by at most 2·asin(|p − q|/(p + q)) (Ahlfors, Lectures on Quasiconformal Mappings, chapter 1).
[[nodiscard]] EmbeddingDistortion embedding_distortion(geometry::Space space, scene::Embedding embedding, double reach);

/// The largest distance of a placed object from the vertical axis through `axis`.
[[nodiscard]] double reach_of(const PlacedMesh& object, geometry::Space space, const geometry::Point& axis);

}  // namespace orbc::place
