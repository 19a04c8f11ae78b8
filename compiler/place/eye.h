#pragma once
#include <array>
#include <optional>

#include "compiler/base/result.h"
#include "compiler/geometry/isometry.h"
#include "compiler/scene/scene.h"

namespace orbc::place {

struct PlacedMesh;
struct PlacedRoom;

/// A thin lens in the place of the pinhole: all rays of a point of the picture, from wherever on the lens, meet at the point at the focus
/// distance along the geodesic through the middle.
struct EyeLens {
  double radius = 0.01;                   ///< of the disk of geodesics from the eye along `right` and `up`
  double focus_distance = 1;
};

/// The eye and its camera. Eye coordinates: the log map at the eye with axes x, y of the translated room frame, z up, origin on the floor
/// below the eye; the eye is at (0, 0, z). Straight rays from there are the geodesics from the eye. Source: design §2.
struct Eye {
  geometry::Isometry room_from_eye;
  double z = 0;
  geometry::Vector3 forward{1, 0, 0}, right{0, -1, 0}, up{0, 0, 1};  ///< orthonormal, right = forward × up
  scene::Projection projection = scene::Projection::perspective;
  Angle fov = Angle::from_degrees(75);    ///< horizontal
  int width = 800, height = 600;
  std::optional<EyeLens> lens;            ///< perspective only; exports and what is baked for the eye see from its middle
};

/// Direction in eye coordinates through the picture at (x, y) pixels, (0, 0) the upper left corner, pixel centres at +0.5. Unit length.
/// perspective: F + (2x/W − 1)·tan(fov/2)·R + (1 − 2y/H)·(H/W)·tan(fov/2)·U.
/// panorama: azimuth 2π(x/W − ½) to the right of F, elevation π(½ − y/H).  cylinder: azimuth fov·(x/W − ½), height (1 − 2y/H)·(H/W)·fov/2
/// (square pixels at the horizon).
[[nodiscard]] geometry::Vector3 direction_through(const Eye& eye, double x, double y);
/// Where in the picture a direction is seen, in the same pixels (perhaps beyond its border); nothing behind a perspective camera, and
/// nothing straight above or below a cylinder.
[[nodiscard]] std::optional<std::array<double, 2>> pixel_of(const Eye& eye, const geometry::Vector3& direction);
/// Pixels per radian at the centre of the picture.
[[nodiscard]] double pixels_per_radian(const Eye& eye);

/// Places the camera of a scene in its furnished room.
/// Makes:       an eye that looks at an object (the centre of its bounding box), a place (at the eye's height if it has none) or in a
///              direction along the geodesic there. Default: the centre of the room at the eye's height; an eye that stands there looks
///              towards the middle of the longest wall.
///              Panoramas and cylinders stay level: they look there with the horizon in the middle, without `roll` or lens.
///              Looking straight up or down is fine: the upper edge of the picture then shows what lies behind or before the azimuth.
/// Diagnostics: place.eye-outside-room (and how far), place.eye-in-wall (exactly on the border), place.eye-inside-object (names it), those
///              of `locate`, place.no-such-object, place.looks-at-itself, place.lens-too-large (it reaches into a wall, floor,
///              ceiling or object), place.lens-focus (it cannot focus there).
/// Exact:       inside the room by exact predicates; inside an object by the parity of the triangles above and below the eye, their
///              footprints tested exactly.
[[nodiscard]] Result<Eye> make_eye(const scene::Scene& scene, const PlacedRoom& room);

/// The object or frame around a position: the vertical line through it meets an odd number of its triangles above, and an odd number below;
/// none: nullptr. Exact: the footprints; heights are measured.
[[nodiscard]] const PlacedMesh* object_around(const PlacedRoom& room, const geometry::Position& at);

}  // namespace orbc::place
