#pragma once
#include <array>
#include <limits>

#include "compiler/bend/bend.h"

namespace orbc::bend {

/// A bound where none can be given.
constexpr double kCannotTell = std::numeric_limits<double>::infinity();

/// What is outside of a perspective picture may be so many times coarser.
constexpr double kOutside = 8;

/// How well a picture tells two things apart: turns the distance of a chord from the true curve into a share of the tolerance.
/// With View::eye the distance counts as it is seen from the eye, in pixels of its picture; with View::disk in chart length.
struct Sight {
  View view = View::eye;
  geometry::Vector3 eye, forward;
  place::Eye camera;
  double pixels = 1;        ///< per radian at the centre of the picture
  double cos_border = 1;    ///< perspective: cosine of the angle to the corner; others: of the highest elevation that counts
  double tolerance = 0.25;  ///< pixels, or chart length
  bool framed = false;      ///< perspective: things may lie outside of the picture
  std::array<geometry::Vector3, 4> outward{};  ///< framed: unit normals of the picture's sides
};

[[nodiscard]] Sight sight_of(const place::Eye& eye, const BendOptions& options);

/// Pixels per radian in the unit direction d, and the largest value of it.
[[nodiscard]] double pixels_at(const Sight& sight, const geometry::Vector3& d);
[[nodiscard]] double densest(const Sight& sight);

/// What was found about a chord or a flat triangle: error / tolerance (> 1: split it), and whether it can be in the picture at all.
struct Judgement {
  double share = 0;
  bool in_picture = true;
  int worst = 0;  ///< of a chord: which of the points is farthest off
};

/// Judges the chord from a to b against `count` points of the true curve.
/// `along`: 0, or the tolerance (in tolerances) for the shift of colours along the chord against the point at the same parameter.
[[nodiscard]] Judgement judge_chord(const Sight& sight, const geometry::Vector3& a, const geometry::Vector3& b,
                                    const geometry::Vector3* curve, const double* parameter, int count, double along);

/// Judges the flat triangle against the true image of its centroid.
[[nodiscard]] Judgement judge_centre(const Sight& sight, const std::array<geometry::Vector3, 3>& corners, const geometry::Vector3& centre,
                                     double along);

}  // namespace orbc::bend
