#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace orbc::cli {

/// A row of schema/diagnostics.md.
struct Explained {
  std::string code, cause, cure;
};

/// The rows of a table of diagnostics, in its order.
[[nodiscard]] std::vector<Explained> read_explained(std::string_view table);

/// The rows of the table that is part of the program.
[[nodiscard]] const std::vector<Explained>& explained();

}  // namespace orbc::cli
