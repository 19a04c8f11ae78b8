#pragma once
#include <array>

#include "compiler/geometry/point.h"
#include "compiler/scene/color.h"
#include "exporters/gltf/json.h"

namespace orbc::gltf {

/// A colour as JSON holds it.
[[nodiscard]] inline std::array<float, 3> floats(const scene::Color& c) {
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
}

/// A position and an orthonormal frame in the axes of the product.
struct Pose {
  geometry::Vector3 right, up, back, at;
};

/// Writes the member `matrix`: the columns right, up, back, position in glTF's axes, where (x, y, z) becomes (x, z, −y).
inline void write_matrix(Json& json, const Pose& pose) {
  json.key("matrix").array();
  const auto column = [&](const geometry::Vector3& v, int last) { json.number(v.x).number(v.z).number(0 - v.y).number(last); };
  column(pose.right, 0);
  column(pose.up, 0);
  column(pose.back, 0);
  column(pose.at, 1);
  json.end_array();
}

}  // namespace orbc::gltf
