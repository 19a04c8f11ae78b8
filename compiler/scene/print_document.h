#pragma once
#include <string>

#include "compiler/scene/document.h"

namespace orbc::scene {

/// A value on one line, as a scene could say it: {polar: [0.2, 30deg], z: 0.4}. Reading it gives the same value.
[[nodiscard]] std::string flow_text(const Node& value);

/// A map as lines of a scene file. Values that fit on a line stand on one line. Comments are not part of a document.
[[nodiscard]] std::string block_text(const Node& map);

}  // namespace orbc::scene
