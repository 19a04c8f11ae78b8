#pragma once
#include <memory>
#include <string>

#include "compiler/base/result.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"
#include "compiler/scene/override.h"
#include "compiler/scene/scene.h"

namespace orbc::driver {

struct Prepared;

/// A scene that has been read, realised, furnished and looked at: where both roads begin.
struct Opened {
  scene::Scene scene;
  std::unique_ptr<place::Interior> room;  ///< keeps its place in memory: the tracer refers to it
  place::Camera eye;
  Diagnostics notes;
  /// Where paths are cut off one sees what is expected beyond (tail.h), times their weight, not `cover.background`
  bool expected_background = false;
  /// Filled when it is first asked for (prepared.h); opened scenes of another room start without
  mutable std::shared_ptr<const Prepared> prepared;
};

/// read → realise → furnish → eye. In: a path, or "-" for standard input; what is said instead of the scene.
/// Diagnostics: those of the rooms it goes through, placed in the file.
[[nodiscard]] Result<Opened> open_scene(const std::string& path, const scene::Overrides& overrides = {});

}  // namespace orbc::driver
