#pragma once
#include <string>
#include <string_view>

#include "compiler/image/image.h"
#include "compiler/mesh/soup.h"

namespace orbc::mesh {

/// What a sieve lets through: a small clean file in the same format, safe for OpenMesh's reader, which trusts counts and indices.
/// Positions and faces (and uv) are left, every index is in range, every number is finite, every count is true.
struct Sieved {
  std::string text;
  bool binary = false;
  bool has_uv = false;                          ///< the text has uv
  std::vector<std::array<float, 2>> corner_uv;  ///< of each corner in order, v from top, where the reader knows no such thing; or empty
  std::vector<std::uint8_t> look;               ///< OBJ: of each face, or empty
  std::vector<Mesh::Look> looks;
  std::vector<image::Image> textures;
  std::vector<std::string> texture_paths;  ///< of each texture
  Diagnostics warnings;
};

// Each takes the whole file. Diagnostics: those of load_mesh.
[[nodiscard]] Result<Sieved> sieve_obj(std::string_view bytes, const std::string& name, const std::string& folder,
                                       const LoadOptions& options);
[[nodiscard]] Result<Sieved> sieve_ply(std::string_view bytes, const std::string& name, const std::string& folder,
                                       const LoadOptions& options);
[[nodiscard]] Result<Sieved> sieve_off(std::string_view bytes, const std::string& name, const LoadOptions& options);
[[nodiscard]] Result<Sieved> sieve_stl(std::string_view bytes, const std::string& name, const LoadOptions& options);

/// Adds a look with a picture; one that cannot be read leaves the plain colour and a warning. A picture already added is found again.
void add_texture(std::string_view reference, const std::string& name, const std::string& folder, const LoadOptions& options,
                 const std::array<double, 3>& color, Sieved& sieved);

/// Coordinates beyond this are refused: their products would not fit into a float any more.
constexpr double kLargestCoordinate = 1e15;

// The diagnostics that several formats share.
[[nodiscard]] Diagnostic not_finite(const std::string& name, const std::string& where);
[[nodiscard]] Diagnostic bad_number(const std::string& name, const std::string& where, std::string_view word);
[[nodiscard]] Diagnostic truncated(const std::string& name, const std::string& what);
[[nodiscard]] Diagnostic too_many(const std::string& name, const std::string& what, std::uint64_t count, std::uint64_t bound);

/// OpenMesh's reader of the format ("obj", "ply", "off", "stl") on a sieved file.
[[nodiscard]] Result<Soup> read_by_openmesh(const Sieved& sieved, const std::string& format, const std::string& name);

}  // namespace orbc::mesh
