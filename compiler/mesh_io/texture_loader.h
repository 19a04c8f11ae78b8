#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/mesh_io/polygon_soup.h"

namespace orbc::mesh_io {

/// The path of a file that a mesh file refers to.
/// Makes:        the file at the relative path inside the mesh's folder or below, in other case if need be; else the file of that name
///               beside the mesh, wherever the reference points ("C:\\art\\wood.png", "..\\wood.png").
/// Diagnostics:  mesh.bad-reference, mesh.missing-file.
[[nodiscard]] Result<std::string> find_referred_file(std::string_view reference, const ReadContext& context);

/// Loads the pictures that a mesh file refers to, each once, within the bounds of one mesh. What cannot be read is left out with a
/// warning.
class TextureLoader {
 public:
  explicit TextureLoader(const ReadContext& context) : context_(context) {}

  /// Makes: an index into `textures`, or −1.
  int load(std::string_view reference);
  /// A picture that is made, not read. Makes: its index into `textures`.
  int add(image::Image image);

  std::vector<image::Image> textures;
  Diagnostics warnings;

 private:
  void warn(const Diagnostics& reasons);

  const ReadContext& context_;
  std::map<std::string, int> index_of_path_;
};

}  // namespace orbc::mesh_io
