#pragma once
#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/base/diagnostic.h"
#include "compiler/mesh_io/polygon_soup.h"

namespace orbc::mesh_io {

/// Ends the reading of a glTF file; caught in read_gltf.
struct GltfError {
  Diagnostic diagnostic;
};

/// A parsed file. Nothing in it has been checked: every index, offset and count is, before it is used.
struct GltfSource {
  const tinygltf::Model& model;
  const ReadContext& context;

  [[noreturn]] void fail(const std::string& code, const std::string& what, const std::string& hint = {}) const;
};

/// The entry of a list of the model. Throws: GltfError when there is none; `what` says what asks for it.
template <class T>
const T& entry(const GltfSource& source, const std::vector<T>& list, int index, const std::string& what) {
  if (index < 0 || static_cast<std::size_t>(index) >= list.size()) source.fail("mesh.bad-gltf", what + " is not there");
  return list[static_cast<std::size_t>(index)];
}

/// The bytes of a buffer view from an offset on, at least `needed` of them. Throws: GltfError.
[[nodiscard]] const unsigned char* bytes_of_view(const GltfSource& source, int view, std::uint64_t offset, std::uint64_t needed,
                                                 const std::string& what);

/// What an accessor has to be.
struct AccessorShape {
  int type = 0;             ///< TINYGLTF_TYPE_…
  std::uint64_t width = 1;  ///< numbers in each element
};

/// All numbers of an accessor, element after element; sparse parts applied, normalised integers decoded. Throws: GltfError.
[[nodiscard]] std::vector<double> numbers_of_accessor(const GltfSource& source, int accessor, AccessorShape shape, const std::string& what);

}  // namespace orbc::mesh_io
