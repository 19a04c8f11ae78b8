#pragma once
#include <optional>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/light/connection.h"
#include "compiler/place/eye.h"

namespace orbc::bake {

/// The eye as a copy sees it.
struct EyeImage {
  geometry::Space space = geometry::Space::euclidean;
  geometry::Position at;
  int sheet = 0;
};

[[nodiscard]] EyeImage image_of(const cover::Copy& copy, const place::Eye& eye);
[[nodiscard]] light::Connection connect(const EyeImage& eye, const geometry::Position& from);

/// What one unit of length takes in the picture, at most: things stand across the sight, on the floor or upright.
/// In: the sight from the point to the eye; pixels per radian.
[[nodiscard]] double pixels_per_unit(const EyeImage& eye, const light::Connection& sight, double per_radian);

/// What one unit of length along `side` (any length) takes in the picture where it starts. In the map of the eye (the log map) lengths
/// across the geodesic grow by arc/sinκ(arc), those along it and upright stay. Something of what the sight foreshortens is kept: the
/// surface bends.
[[nodiscard]] double pixels_along(const EyeImage& eye, const light::Connection& sight, const geometry::Position& at,
                                  const trace::Direction& side, double per_radian);

/// Where the eye sees a point of a copy, in eye coordinates: the other end of the sight. Nothing: in all directions at once.
[[nodiscard]] std::optional<geometry::Vector3> direction_from_eye(const cover::Copy& copy, const place::Eye& camera,
                                                                  const geometry::Position& point);

/// Whether all of something whose corners are seen in these directions surely lies beside the picture.
[[nodiscard]] bool beside_picture(const place::Eye& camera, const std::vector<geometry::Vector3>& directions);

/// The unit direction at a point of the room in which the eye sees that point of a copy: that of the geodesic to the eye's image, on S²
/// over as many half turns as the copy's sheet has. Nothing exists where the point is the focus of all directions: the zero vector.
[[nodiscard]] trace::Direction direction_to_eye(const cover::Copy& copy, const place::Eye& eye, const geometry::Position& at);

}  // namespace orbc::bake
