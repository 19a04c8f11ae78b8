#pragma once
#include <nlohmann/json.hpp>

#include "compiler/base/diagnostic.h"
#include "compiler/cli/commands.h"

namespace orbc::cli {

/// Diagnostics as docs/json.md describes them.
[[nodiscard]] nlohmann::ordered_json json_of(const Diagnostics& diagnostics);

/// With --json: prints a command's result, one object on standard output, with the diagnostics of the command as its last key.
void print_result(nlohmann::ordered_json result, const Diagnostics& diagnostics, const Common& common);

/// What stopped a program, an error of the given code, as one JSON object.
[[nodiscard]] std::string failure_json(const std::string& code, const std::string& message);

/// With --json: the same on standard output, if that can be written.
void print_failure(const std::string& code, const std::string& message);

/// Refuses --json where the output itself goes to standard output. Throws UsageError.
void keep_standard_output_apart(const std::string& output, const Common& common);

}  // namespace orbc::cli
