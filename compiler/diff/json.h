#pragma once
#include <nlohmann/json.hpp>

#include "compiler/diff/compare.h"

namespace orbc::diff {

/// Parses JSON. Diagnostics: diff.bad-file: no JSON, nested deeper than 200, more than 256 MiB.
[[nodiscard]] Result<nlohmann::json> parse_json(std::string_view text, const std::string& name);

/// How trees are compared: whose names count as the same, and which paths are left to others.
struct TreeRules {
  const Source& a;
  const Source& b;
  std::function<bool(std::string_view path)> left_out;  ///< may be empty
};

/// Compares two trees; keys are sorted, so their order does not count.
void compare_trees(const nlohmann::json& a, const nlohmann::json& b, const TreeRules& rules, const Limits& limits, Finding& finding);

}  // namespace orbc::diff
