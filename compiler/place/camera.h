#pragma once
#include <array>
#include <optional>

#include "compiler/base/result.h"
#include "compiler/geometry/isometry.h"
#include "compiler/scene/scene.h"

namespace orbc::place {

struct PlacedMesh;
struct Interior;

/// A thin lens instead of a pinhole. All rays through one point of the image meet at the point at the focus distance along the geodesic
/// through the lens's centre.
struct ThinLens {
  double radius = 0.01;                   ///< of the aperture, the disk of geodesics from the eye along `right` and `up`
  double focus_distance = 1;
};

/// A camera. Eye coordinates are the log map at the eye: axes x, y of the translated room frame, z up, origin on the floor below the eye.
/// The eye is at (0, 0, z), and straight rays from there are the geodesics from the eye. Source: design §2.
struct Camera {
  geometry::Isometry room_from_eye;
  double z = 0;
  geometry::Vector3 forward{1, 0, 0}, right{0, -1, 0}, up{0, 0, 1};  ///< orthonormal, right = forward × up
  scene::Projection projection = scene::Projection::perspective;
  Angle fov = Angle::from_degrees(75);    ///< horizontal
  int width = 800, height = 600;
  std::optional<ThinLens> lens;            ///< perspective only; exports and highlights use its centre as a pinhole
  double eye_separation = 0;               ///< stereo only: length of the geodesic between the two eyes
};

/// The unit direction in eye coordinates through the image point (x, y).
/// In:      pixels; (0, 0) is the upper left corner, pixel centres are at +0.5.
/// Formula: F, R, U stand for forward, right, up; W×H is the image size.
///   perspective: F + (2x/W − 1)·tan(fov/2)·R + (1 − 2y/H)·(H/W)·tan(fov/2)·U.
///   panorama:    azimuth 2π(x/W − ½) to the right of F, elevation π(½ − y/H).
///   cylinder:    azimuth fov·(x/W − ½), height (1 − 2y/H)·(H/W)·fov/2 (square pixels at the horizon).
///   stereo:      the panorama of the left eye in the rows above H/2, below it that of the right eye: see `eye_offset`.
[[nodiscard]] geometry::Vector3 direction_through(const Camera& eye, double x, double y);
/// Where the eye stands that sees the image point (x, y): a vector of the log map at the camera's place, 0 but for stereo.
/// In:      pixels, as above.
/// Formula: omni-directional stereo. For the column of azimuth φ to the right of F, half the eye separation along −cos φ·R + sin φ·F (to
///          the left of φ) in the upper picture, the opposite in the lower. Each eye looks along the direction φ, transported in parallel.
/// Source:  Peleg, Ben-Ezra, Pritch, Omnistereo: panoramic stereo imaging, 2001.
[[nodiscard]] geometry::Vector3 eye_offset(const Camera& eye, double x, double y);
/// The image point of a direction, in the same pixels, possibly outside of the image (stereo: as the left eye sees it). None for directions
/// behind a perspective camera, and for those straight above or below a cylinder.
[[nodiscard]] std::optional<std::array<double, 2>> pixel_of(const Camera& eye, const geometry::Vector3& direction);
/// Pixels per radian at the centre of the image.
[[nodiscard]] double pixels_per_radian(const Camera& eye);

/// Places the camera of a scene in its furnished room.
/// Makes:       a camera that looks at an object (the centre of its bounding box), at a place (at the eye's height if it has none), or in a
///              direction. Default: at the centre of the room at the eye's height; from there, at the middle of the longest wall.
///              Panoramas, stereo ones too, and cylinders stay level, with the horizon in the middle, without `roll` and lens.
///              When the camera looks straight up or down, the azimuth that its direction would have fixes the upper edge of the image.
/// Diagnostics: place.eye-outside-room (and how far), place.eye-in-wall (exactly on the border), place.eye-inside-object (names it), those
///              of `locate`, place.no-such-object, place.looks-at-itself, place.lens-too-large (it touches a wall, floor,
///              ceiling or object), place.lens-focus (it cannot focus there), place.stereo-eye (one of the eyes would stand in a wall
///              or object).
/// Exact:       inside the room by exact predicates; inside an object by the parity of the triangles above and below the eye, their
///              footprints tested exactly.
[[nodiscard]] Result<Camera> make_camera(const scene::Scene& scene, const Interior& interior);

/// The object or frame that contains a position, or nullptr. The vertical line through the position meets an odd number of the object's
/// triangles above it, and an odd number below.
/// Exact: the footprints of the triangles; heights are measured.
[[nodiscard]] const PlacedMesh* enclosing_object(const Interior& interior, const geometry::Position& at);

}  // namespace orbc::place
