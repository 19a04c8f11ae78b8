#pragma once
#include <string>

#include "compiler/notation/symbol.h"
#include "compiler/room/glued_polygon.h"

namespace orbc::cli {

/// What `info` tells of an orbifold that is not closed by mirrors alone, as JSON (docs/json.md) and for people.
[[nodiscard]] std::string symbol_json(const notation::Symbol& symbol, const room::GluedPolygon& polygon, int max_length);
[[nodiscard]] std::string symbol_text(const notation::Symbol& symbol, const room::GluedPolygon& polygon);

/// The lines of that JSON that tell the polygon, without braces around them.
[[nodiscard]] std::string polygon_lines(const room::GluedPolygon& polygon, int max_length);

}  // namespace orbc::cli
