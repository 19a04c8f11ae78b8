#pragma once
#include <string>
#include <string_view>

#include "compiler/room/room.h"
#include "exporters/svg/page.h"

namespace orbc::svg {

/// Text for XML: marks escaped, control characters blank, bytes that are not UTF-8 as U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

/// ` name="12.5"`.
[[nodiscard]] std::string attribute(const char* name, double value);

/// The orders of the corners in circles and the numbers of the walls in italics, on the room itself.
[[nodiscard]] std::string labels(const room::Room& room, const Page& page);

/// The cuts of the paper's decomposition as dashed lines with a caption each: the numbers of their walls.
[[nodiscard]] std::string cut_lines(const room::Room& room, const Page& page);

}  // namespace orbc::svg
