#pragma once
#include <vector>

#include "compiler/bake/view_dependent.h"

namespace orbc::bake {

/// A ball that holds a part; its diameter bounds the size of the part in the picture.
struct BoundingBall {
  geometry::Position centre;
  double radius = 0;
};

/// A part whose light depends on the eye.
struct ViewDependentPart {
  std::size_t part = 0;
  BoundingBall ball;
  double min_diameter_px = 0;        ///< smaller in the picture the part gets no texels of its own
  surface::PartNormals lod_normals;  ///< of a level of detail; of other parts the lighting has them
  std::vector<bool> drawn_in_model;  ///< per model of DrawnParts; empty: drawn in every copy
};

/// Whether a material adds highlights of lamps to its diffuse light. Metals do not: their highlights are part of what they mirror.
[[nodiscard]] bool is_glossy(const scene::Material& material);

/// The parts whose light depends on the eye. In: `has_query` says whether there is a SpecularQuery for mirrors, glass and metals.
[[nodiscard]] std::vector<ViewDependentPart> find_view_dependent_parts(const place::Interior& interior,
                                                                       const light::LightingContext& lighting, const DrawnParts& drawn,
                                                                       bool has_query);

}  // namespace orbc::bake
