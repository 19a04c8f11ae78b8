#pragma once
#include <memory>
#include <string>
#include <vector>

#include "compiler/base/progress.h"
#include "compiler/driver/product.h"
#include "exporters/html/core/page_assets.h"

namespace orbc::html {

/// Puts a camera where the page stands. In: 19 numbers as orbc_trace_begin takes them (core.h).
void stand(place::Camera& camera, geometry::Space space, const double* eye);

/// What the page wants of a scene.
struct WantedExport {
  std::string format;           ///< "glb", "pov" or "svg"
  const double* eye = nullptr;  ///< where to stand, as for `stand`; null: at the scene's own camera
};

/// The files of an export, the main one without a name; none where diagnostics hold an error.
struct ExportedScene {
  std::vector<driver::File> files;
  Diagnostics diagnostics;
  std::uint64_t copies = 0, triangles = 0;
  double error_px = 0;  ///< no surface is displaced by more, in pixels of the scene's picture
};

/// Compiles a scene as `orbc compile` does without options.
/// Diagnostics: those of the driver's rooms; page.no-exr.
[[nodiscard]] ExportedScene export_scene(const std::shared_ptr<const SourceText>& source, const PageFiles& files,
                                         const WantedExport& wanted, const Progress& progress);

}  // namespace orbc::html
