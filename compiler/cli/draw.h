#pragma once
#include <optional>

#include "compiler/cli/commands.h"
#include "compiler/cli/export.h"
#include "compiler/image/image.h"
#include "compiler/mesh/mesh.h"

namespace orbc::cli {

/// A picture by another program, and what it was drawn from.
struct Drawn {
  int code = 0;  ///< exit code; the picture is there when it is kDone, else it has been told why not
  image::Image picture;
  Exported exported;
};

/// Exports a scene into a folder of its own and has POV-Ray or Blender draw it (`arguments.engine`), in the size of the scene.
/// In: `arguments.compile.output` is not looked at. Prints errors, and what exporting has to say.
[[nodiscard]] Drawn draw_elsewhere(const driver::PreparedScene& scene, const RenderArguments& arguments, const Common& common);

}  // namespace orbc::cli
