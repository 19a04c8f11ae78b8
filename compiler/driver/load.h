#pragma once
#include <memory>
#include <string>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/light/lighting.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"
#include "compiler/scene/override.h"
#include "compiler/scene/scene.h"

namespace orbc::driver {

/// A scene that has been read, realised and furnished, with its lamps and its eye: where both roads begin.
struct LoadedScene {
  scene::Scene scene;
  std::shared_ptr<const place::Interior> interior;  ///< shared by copies of this; never null
  std::shared_ptr<const light::LampSet> lamps;      ///< placed in the interior, with their mirror images; never null
  place::Camera eye;                                ///< the scene's camera
  Diagnostics notes;
  std::vector<std::string> files = {};              ///< all that were read: the scene ("-" is standard input), meshes, what they refer to
};

/// read → realise → furnish → place lamps → eye.
/// In:          a path, or "-" for standard input; values that replace those of the scene.
/// Diagnostics: those of the rooms it goes through, with places in the file.
[[nodiscard]] Result<LoadedScene> load(const std::string& path, const scene::Overrides& overrides = {});

}  // namespace orbc::driver
