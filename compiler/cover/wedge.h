#pragma once
#include <optional>

#include "compiler/geometry/point.h"

namespace orbc::cover {

/// A unit direction on the floor at the eye, in eye coordinates. As a border it stands for the upright plane through the eye along this
/// direction: the covector (0, −y, x), positive to the left. All these planes contain the eye, so bending keeps them flat.
struct Bearing {
  double x = 1, y = 0;
};
/// Exact: compares bit by bit. Neighbouring wedges store their common border with equal bits.
[[nodiscard]] inline bool operator==(const Bearing& a, const Bearing& b) { return a.x == b.x && a.y == b.y; }

/// The sine of the angle from `a` to `b`, times the length of `b`: positive when `b` lies to the left of `a`.
[[nodiscard]] inline double cross(const Bearing& a, const Bearing& b) { return a.x * b.y - a.y * b.x; }
/// The same for a point in eye coordinates: sinκ of its distance from the plane of `a`, positive to the left.
[[nodiscard]] inline double cross(const Bearing& a, const geometry::Ambient& point) { return a.x * point.y - a.y * point.x; }
/// Whether the angle between `a` and `b` is less than π/2.
[[nodiscard]] inline bool in_front(const Bearing& a, const Bearing& b) { return a.x * b.x + a.y * b.y > 0; }

/// The bearings from `from` counter-clockwise to `to`, less than half a turn.
struct Wedge {
  Bearing from, to;
};

/// Bearings closer than this (in radians) are one bearing; rounding moves bearings by far less.
constexpr double kSameBearingRadians = 1e-12;

/// A border of the wedge if the bearing equals it but for rounding; else the bearing.
[[nodiscard]] Bearing snapped(const Bearing& bearing, const Wedge& wedge);

/// The bearing, moved into the wedge by the shortest way. In: the bearing lies less than half a turn from both borders.
[[nodiscard]] Bearing clamped(const Bearing& bearing, const Wedge& wedge);

/// What two wedges have in common; nothing when they only touch. Makes: borders with the bits of the given ones.
[[nodiscard]] std::optional<Wedge> intersection(const Wedge& a, const Wedge& b);

}  // namespace orbc::cover
