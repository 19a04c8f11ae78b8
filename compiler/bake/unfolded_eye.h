#pragma once
#include <optional>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/light/connection.h"
#include "compiler/place/camera.h"

namespace orbc::bake {

/// The image of the eye under the inverse map of a copy: from a point of the room, the eye sees the copy of that point along the geodesic
/// to this image.
struct UnfoldedEye {
  geometry::Space space = geometry::Space::euclidean;
  geometry::Position at;
  int sheet = 0;  ///< of the copy: on S² the geodesic goes over that many half turns of the sphere
};

[[nodiscard]] UnfoldedEye unfold_eye(const cover::Copy& copy, const place::Camera& eye);
/// The geodesic from a point of the room to the eye.
[[nodiscard]] light::Connection connect(const UnfoldedEye& eye, const geometry::Position& from);

/// The most pixels that a unit of length takes in the picture, whatever its direction.
/// In: the geodesic from the point to the eye; pixels per radian of the picture.
[[nodiscard]] double max_pixels_per_unit(const UnfoldedEye& eye, const light::Connection& sight, double per_radian);

/// Pixels that a unit of length along `side` (of any length) takes in the picture.
/// In:      the geodesic from the point `at` to the eye; pixels per radian of the picture.
/// Formula: in the log map of the eye, lengths across the geodesic grow by arc/sinκ(arc); upright ones and those along the geodesic stay.
///          At least 0.3 of a length that the eye sees foreshortened is kept, because surfaces bend.
[[nodiscard]] double pixel_footprint(const UnfoldedEye& eye, const light::Connection& sight, const geometry::Position& at,
                                     const trace::Direction& side, double per_radian);

/// The direction in which the eye sees a point of a copy, unit, in eye coordinates. Nothing where the eye sees the point in all directions
/// at once.
[[nodiscard]] std::optional<geometry::Vector3> direction_from_eye(const cover::Copy& copy, const place::Camera& camera,
                                                                  const geometry::Position& point);

/// Whether something whose corners the eye sees in these directions surely lies outside of the picture, all of it.
[[nodiscard]] bool outside_frustum(const place::Camera& camera, const std::vector<geometry::Vector3>& directions);

/// The direction of the geodesic from a point of the room to the image of the eye, unit. The zero vector where all directions lead there.
[[nodiscard]] trace::Direction direction_to_eye(const cover::Copy& copy, const place::Camera& eye, const geometry::Position& at);

}  // namespace orbc::bake
