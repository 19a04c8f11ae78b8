#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "compiler/scene/read.h"

namespace orbc::scene::corpus {

inline std::vector<std::string> files(const std::string& folder) {
  std::vector<std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(ORBC_SOURCE_DIR) + "/tests/scenes/" + folder))
    if (entry.path().extension() == ".yaml") all.push_back(entry.path().string());
  std::sort(all.begin(), all.end());
  return all;
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

/// "scene.unknown-key 4:3, scene.bad-color 7:10": what the first line of a bad scene promises after `# expect: `.
inline std::string summary(const Diagnostics& diagnostics) {
  std::string all;
  for (const Diagnostic& d : diagnostics) {
    if (d.severity != Severity::error) continue;
    all += (all.empty() ? "" : ", ") + d.code + " " + std::to_string(d.span.line) + ":" + std::to_string(d.span.column);
  }
  return all;
}

}  // namespace orbc::scene::corpus
