#pragma once
#include "compiler/cli/commands.h"

namespace orbc::cli {

/// Writes the designer's page with a scene to `arguments.output`. Throws UsageError where the command line changes the scene, whose text
/// the page holds.
/// Diagnostics: those of the scene; html.no-page where scripts/web has not built the page.
int write_page(const CompileArguments& arguments, const Common& common);

}  // namespace orbc::cli
