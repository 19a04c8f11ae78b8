#pragma once
#include <string>
#include <vector>

#include "compiler/base/diagnostic.h"
#include "compiler/driver/load.h"

namespace orbc::cli {

/// What a command makes of a scene: one of these, or several together.
enum Target : unsigned {
  kTraced = 1,  ///< the tracer's picture
  kPov = 2,     ///< an export for POV-Ray
  kGltf = 4,    ///< an export as glTF, also for Blender
  kSvg = 8,     ///< the tiling
};

/// All that decides whether an option or a key of the scene matters.
struct Use {
  unsigned targets = 0;
  bool plan = false;                ///< exports are only foreseen
  bool disk_view = false;
  bool all_passes = false;          ///< the picture is an EXR
  int samples = 1;
};

/// Options of the command line, named without dashes, and keys of the scene that change nothing in what is made: they are told, since
/// their author expected something of them. One table says of each what it belongs to and when it is idle there (effects.cpp).
/// Diagnostics: as warnings cli.no-effect and, at its place in the file, scene.no-effect.
[[nodiscard]] Diagnostics without_effect(const std::vector<std::string>& options, const Use& use, const driver::LoadedScene& loaded);

}  // namespace orbc::cli
