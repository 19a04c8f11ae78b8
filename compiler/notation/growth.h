#pragma once
#include <optional>
#include <vector>

#include "compiler/base/rational.h"
#include "compiler/notation/orbifold.h"

namespace orbc::notation {

/// W(t) = Σ (copies at word length l)·tˡ = numerator/denominator. Coefficients are stored low order first; the polynomials have no common
/// factor and begin with 1.
struct GrowthSeries {
  std::vector<Integer> numerator, denominator;
};

/// The growth series of the reflection group.
/// In:     a good orbifold with integer corners, as in all functions of this file.
/// Makes:  nothing when the degree would exceed `max_degree` (orders with many different divisors); copies_per_length works all the same.
/// Exact:  integers.
/// Source: Steinberg, Endomorphisms of linear algebraic groups (1968): 1/W(1/t) = Σ (−1)^|T| / W_T(t) over the subsets T of the walls that
///         generate finite subgroups; Solomon, The orders of the finite Chevalley groups (1966), for finite groups.
[[nodiscard]] std::optional<GrowthSeries> growth_series(const Orbifold& orbifold, int max_degree = 4096);

/// The numbers of copies at word lengths 0 … max_length. Of finite groups the list ends with the longest element.
/// Exact: integers. The time is proportional to max_length times the degree of the series, which counts as at most max_length.
[[nodiscard]] std::vector<Integer> copies_per_length(const Orbifold& orbifold, int max_length);

/// The number of copies with words of at most `length` walls.
[[nodiscard]] Integer copies_up_to(const Orbifold& orbifold, int length);

/// The number of elements of the reflection group of a spherical room (2/χ).
[[nodiscard]] std::optional<Integer> group_order(const Orbifold& orbifold);

/// Length of the longest element of a finite group = number of its reflections: `*` 1, `*kk` k, `*22k` k+1, `*233` 6, `*234` 9, `*235` 15.
[[nodiscard]] std::optional<int> longest_length(const Orbifold& orbifold);

/// lim (copies at length l)^(1/l): 1 in E², the reciprocal of the pole nearest to 0 in H², nothing on S².
/// Error: slightly more than ½ ulp; `*237` gives Lehmer's number 1.17628081825991750654….
[[nodiscard]] std::optional<double> growth_rate(const Orbifold& orbifold);

}  // namespace orbc::notation
