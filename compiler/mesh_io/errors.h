#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "compiler/base/diagnostic.h"

namespace orbc::mesh_io {

/// Coordinates beyond this are refused: their products would not fit into a float any more.
constexpr double kMaxCoordinate = 1e15;
/// Texture coordinates beyond this are refused.
constexpr double kMaxUv = 1e6;
/// A mesh has no more materials than this, so that a room with it has fewer surfaces than place/ can count (65,535).
constexpr std::size_t kMaxMaterials = 60'000;

// The diagnostics that several formats share. `name` is the file, `where` the place in it.
[[nodiscard]] Diagnostic not_finite(const std::string& name, const std::string& where);
[[nodiscard]] Diagnostic bad_number(const std::string& name, const std::string& where, std::string_view word);
[[nodiscard]] Diagnostic truncated(const std::string& name, const std::string& what);
[[nodiscard]] Diagnostic too_many(const std::string& name, const std::string& what, std::uint64_t count, std::uint64_t bound);

/// The first characters of a text from a file as a message may quote them: printable ASCII, the rest as '?'.
[[nodiscard]] std::string quotable(std::string_view text, std::size_t max_characters = 40);

}  // namespace orbc::mesh_io
