#pragma once
#include <string>
#include <vector>

#include "exporters/svg/path_data.h"

namespace orbc::svg {

/// A letter as outlines that together fill it (rule nonzero), about 1 high: A to Z, and p, b, d, q, which are mirror images of each other.
/// Makes: nothing for other characters.
[[nodiscard]] std::vector<Polyline> letter_outlines(char letter);

}  // namespace orbc::svg
