#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/driver/product.h"
#include "exporters/formats.h"

namespace orbc::cli {

/// Where an export goes, and what goes with it.
struct ExportTarget {
  std::string output;  ///< the main output
  const exporters::ExportFormat* format = nullptr;
  std::string report;  ///< a file for the report, "-", or empty for none
  std::string report_json;
};

/// The output's name without folder and ending, which files beside it are called after; "scene" for streams and where it has none.
[[nodiscard]] std::string stem_of(const std::string& output);

/// Writes the files of an export and its report, all or none, the main output last: whoever sees it finds the files that it names. Removes
/// the files beside it that an earlier export to the same output has left, unless they are among `inputs`.
/// Makes: how many bytes the main output has. Throws as write_together does.
std::uint64_t write_export(const std::vector<driver::File>& files, const ExportTarget& target, const std::vector<std::string>& inputs);

}  // namespace orbc::cli
