#pragma once
#include <string>
#include <string_view>

#include "compiler/mesh_io/load.h"
#include "compiler/mesh_io/polygon_soup.h"

namespace orbc::mesh_io {

// One reader for each format. Each takes the whole file and trusts nothing in it: counts, indices and numbers are checked before they are
// used. Diagnostics: those of load_mesh.

/// Wavefront OBJ with its MTL.
[[nodiscard]] Result<PolygonSoup> read_obj(std::string_view bytes, const ReadContext& context);
/// PLY, text or binary.
[[nodiscard]] Result<PolygonSoup> read_ply(std::string_view bytes, const ReadContext& context);
/// Geomview's OFF, as text.
[[nodiscard]] Result<PolygonSoup> read_off(std::string_view bytes, const ReadContext& context);
/// Refuses a binary STL that its first bytes promise to be too large. In: these bytes; the size of the whole file.
[[nodiscard]] Diagnostics check_stl_size(std::string_view beginning, std::uint64_t file_bytes, const ReadContext& context);
/// STL, text or binary. Corners at the same position share a vertex.
[[nodiscard]] Result<PolygonSoup> read_stl(std::string_view bytes, const ReadContext& context);

}  // namespace orbc::mesh_io
