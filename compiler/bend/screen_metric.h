#pragma once
#include <array>
#include <limits>
#include <span>

#include "compiler/bend/bend.h"

namespace orbc::bend {

/// The value of an upper bound where none is known.
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// What lies outside of a perspective picture may be this many times coarser.
constexpr double kOffscreenFactor = 8;

/// Measures how far two points are apart in a picture, in units of the tolerance. With View::eye distances are angles at the eye, in pixels
/// of its picture; with View::disk they are lengths in the chart.
struct ScreenMetric {
  View view = View::eye;
  geometry::Vector3 eye, forward;  ///< position and direction, in eye coordinates
  place::Camera camera;
  double pixels = 1;        ///< per radian, at the centre of the picture
  double cos_border = 1;    ///< perspective: cosine of the angle to the corner; others: of the highest elevation that counts
  double tolerance = 0.25;  ///< pixels, or chart length
  bool chart_eye = false;   ///< View::disk: the tolerance grows with the distance from `eye`, which stands in the chart
  bool framed = false;      ///< perspective: points may lie outside of the picture
  std::array<geometry::Vector3, 4> outward{};  ///< framed: outward unit normals of the planes through the eye and the picture's sides
};

[[nodiscard]] ScreenMetric screen_metric(const place::Camera& eye, const BendOptions& options);

/// Pixels per radian in the unit direction d.
/// Formula: perspective and cylinder: pixels / cos²; panorama: pixels / cos of the elevation; cosines are at least cos_border.
[[nodiscard]] double pixels_per_radian_at(const ScreenMetric& metric, const geometry::Vector3& d);
/// The largest value of pixels_per_radian_at.
[[nodiscard]] double max_pixels_per_radian(const ScreenMetric& metric);

/// A point of a curve and its parameter, 0 at the first end and 1 at the last.
struct CurvePoint {
  double parameter = 0;
  geometry::Vector3 image;
};

/// How far a chord or a flat triangle is from the true curve or surface.
struct ChordError {
  double tolerances = 0;        ///< error / tolerance; above 1: split it
  bool in_picture = true;       ///< false: it lies outside of a perspective picture
  std::size_t worst_point = 0;  ///< of a chord: index of the point that is farthest off
};

/// Measures the chord from a to b against points of the true curve.
/// In:    eye coordinates; at most 14 points. `color_tolerance` > 0: colours shift along the chord where its point is not the curve's point
///        of the same parameter; so many tolerances of shift count as one (EdgeMesh). 0: colours do not count.
/// Error: the largest error may lie between the points; the result includes a factor for that (1.03, measured up to 1.014).
[[nodiscard]] ChordError measure_chord(const ScreenMetric& metric, const geometry::Vector3& a, const geometry::Vector3& b,
                                       std::span<const CurvePoint> curve, double color_tolerance);

/// Measures a flat triangle against `centre`, the true image of its centroid.
[[nodiscard]] ChordError measure_centre(const ScreenMetric& metric, const std::array<geometry::Vector3, 3>& corners,
                                        const geometry::Vector3& centre, double color_tolerance);

}  // namespace orbc::bend
