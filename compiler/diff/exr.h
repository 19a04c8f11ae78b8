#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/base/result.h"

namespace orbc::diff {

/// An OpenEXR picture: every channel as floats, rows from top to bottom.
struct ExrPicture {
  int width = 0, height = 0;
  std::map<std::string, std::vector<float>> channels;
};

[[nodiscard]] bool is_exr(std::string_view bytes);
/// Diagnostics: diff.bad-file: not EXR, damaged, subsampled or deep, or more than 2 GiB when unpacked.
[[nodiscard]] Result<ExrPicture> read_exr(std::string_view bytes, const std::string& name);

}  // namespace orbc::diff
