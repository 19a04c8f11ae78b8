#pragma once
#include <cstdint>
#include <string_view>

#include "compiler/place/interior.h"

namespace orbc::driver {

/// A checksum of bytes: FNV-1a of 64 bits. Source: Fowler, Noll, Vo, "The FNV Non-Cryptographic Hash Algorithm".
/// In: the checksum of the bytes before these.
[[nodiscard]] std::uint64_t checksum(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325);

/// A checksum of all that is placed in a room: vertices, triangles, styles and pixels. Files that meshes and materials come from are
/// thereby included with their contents.
[[nodiscard]] std::uint64_t fingerprint(const place::Interior& interior);

}  // namespace orbc::driver
