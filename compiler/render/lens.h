#pragma once
#include <array>
#include <cstdint>

#include "compiler/place/eye.h"
#include "compiler/trace/ray.h"

namespace orbc::render {

/// The ray that meets, at the lens's focus distance, what the ray through its middle meets there.
/// In:    an eye with a lens; the picture at (x, y) pixels; where on the lens: (right, up) in the unit disk.
/// Makes: a geodesic of the room that starts at distance radius·|on_lens| from the eye. On S² it goes the way of its neighbour through the
///        middle, which is the shorter one, since no lens focuses at π or beyond.
[[nodiscard]] trace::Ray lens_ray(const place::Eye& eye, double x, double y, const std::array<double, 2>& on_lens);

/// Where on the lens the k-th sample of a pixel looks through, in the unit disk, evenly by area.
/// Makes: points of one lattice a pixel, moved at random: neighbours differ, so that few samples show noise instead of ghosts.
[[nodiscard]] std::array<double, 2> lens_point(std::uint64_t seed, std::uint64_t pixel, int k);

}  // namespace orbc::render
