#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "compiler/base/result.h"

namespace orbc::files {

/// The bytes of a regular file.
/// Diagnostics:  mesh.missing-file (the hint names the nearest name in the folder), mesh.not-a-file, mesh.too-big.
[[nodiscard]] Result<std::string> read_file(const std::string& path, std::uint64_t max_bytes);
/// The first bytes of a regular file, at most so many; nothing where they cannot be read.
[[nodiscard]] std::string read_beginning(const std::string& path, std::size_t max_bytes);
/// Makes: the diagnostics that read_file would give before it reads; none if the file can be read.
[[nodiscard]] Diagnostics check_file(const std::string& path, std::uint64_t max_bytes);

/// The path of a file that another file refers to: inside `folder` or below, by a relative path without "..".
/// In:           `name` is what diagnostics call the file that refers; an empty `folder` refuses every reference.
/// Diagnostics:  mesh.bad-reference.
[[nodiscard]] Result<std::string> referred_path(std::string_view reference, const std::string& name, const std::string& folder);

}  // namespace orbc::files
