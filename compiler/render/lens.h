#pragma once
#include <array>
#include <cstdint>

#include "compiler/place/camera.h"
#include "compiler/trace/ray.h"

namespace orbc::render {

/// The ray from a point of the lens to the point at focus distance on the ray through the lens's centre.
/// In:    an eye with a lens; the picture at (x, y) pixels; the point of the lens: (right, up) in the unit disk.
/// Makes: a geodesic of the room that starts at distance radius·|on_lens| from the eye. On S² it goes the same way round as the ray
///        through the centre, which is the shorter one, since no lens focuses at π or beyond.
[[nodiscard]] trace::Ray lens_ray(const place::Camera& eye, double x, double y, const std::array<double, 2>& on_lens);

/// The point of the lens for sample k of a pixel, in the unit disk, uniform by area.
/// Makes: points of a lattice that is shifted at random for each pixel. With few samples the picture has noise instead of ghosts.
[[nodiscard]] std::array<double, 2> lens_point(std::uint64_t seed, std::uint64_t pixel, int k);

}  // namespace orbc::render
