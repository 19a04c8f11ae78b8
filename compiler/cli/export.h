#pragma once
#include <string>

#include "compiler/base/result.h"
#include "compiler/cli/commands.h"
#include "compiler/driver/compile.h"
#include "compiler/driver/prepare.h"

namespace orbc::cli {

/// What exporting a scene has made, in numbers.
struct Exported {
  driver::Report report;
  std::string report_json;
  Diagnostics notes;                ///< what its author should know
  Diagnostics size_warning;         ///< cli.large-export, which was printed before the work
  std::uint64_t bytes = 0;          ///< of the main output alone
};

/// How scenes are prepared for the exports of a command.
[[nodiscard]] driver::PrepareOptions prepare_options(const CompileArguments& arguments);

/// Compiles a scene for its own camera and writes the files of a renderer: pov, glb or gltf, to `arguments.output`, and the report.
/// Diagnostics: those of the driver; gltf.no-exr; among the notes gltf.native-lights-shared. Printed while it works: cli.large-export.
[[nodiscard]] Result<Exported> export_scene(const driver::PreparedScene& scene, const CompileArguments& arguments,
                                            const std::string& format_name, const Common& common);

}  // namespace orbc::cli
