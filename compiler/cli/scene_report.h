#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "compiler/driver/load.h"

namespace orbc::cli {

/// What `check --verbose` tells of a scene that is all right: how long the walls are, how exactly relations between them hold, and how far
/// each object is from its true shape. Lengths are in the author's unit, angles in degrees.
[[nodiscard]] nlohmann::ordered_json scene_report(const std::string& scene, const driver::LoadedScene& loaded);

/// The same as lines of text.
[[nodiscard]] std::string report_text(const nlohmann::ordered_json& report);

}  // namespace orbc::cli
