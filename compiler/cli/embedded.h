#pragma once
#include <string_view>

namespace orbc::cli {

// Files that are part of the program, so that they are there wherever it is installed (cmake/embed.cmake).

[[nodiscard]] std::string_view scene_schema();       ///< schema/orbc-scene.schema.json
[[nodiscard]] std::string_view diagnostics_table();  ///< schema/diagnostics.md

}  // namespace orbc::cli
