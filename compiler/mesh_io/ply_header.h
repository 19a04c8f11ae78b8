#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/mesh_io/polygon_soup.h"
#include "compiler/mesh_io/tokens.h"

namespace orbc::mesh_io {

enum class PlyType { none, i8, u8, i16, u16, i32, u32, f32, f64 };

/// Bytes that a value takes in a binary file.
[[nodiscard]] std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::none;
  PlyType count_type = PlyType::none;  ///< of a list's length; none: a single value
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  bool ascii = false, big_endian = false;
  std::vector<PlyElement> elements;
  std::vector<std::string> textures;  ///< of the comments "TextureFile"
  std::string_view body;              ///< what follows the header
};

/// In: the bytes of a PLY file, without a byte order mark; lines of the header may end in '\r' alone.
/// Diagnostics: mesh.bad-header, mesh.truncated.
[[nodiscard]] Result<PlyHeader> read_ply_header(std::string_view bytes, const ReadContext& context);

/// Diagnostics: mesh.too-big when the header promises more vertices or faces than may be read.
[[nodiscard]] Diagnostics check_ply_size(const PlyHeader& header, const ReadContext& context);

/// Reads one number after the other from the body, whatever its encoding.
class PlyBody {
 public:
  explicit PlyBody(const PlyHeader& header);

  /// False at the end of the file, or when a word is no number.
  bool read(PlyType type, double& value) { return ascii_ ? read_word(value) : read_bytes(type, value); }
  [[nodiscard]] std::uint64_t bytes_left() const;
  /// The word that was no number, if there was one.
  [[nodiscard]] std::string_view wrong_word() const { return wrong_word_; }

 private:
  bool read_word(double& value);
  bool read_bytes(PlyType type, double& value);

  bool ascii_, big_endian_;
  Tokens tokens_;          // of text
  std::string_view rest_;  // of binary
  std::string_view wrong_word_;
};

}  // namespace orbc::mesh_io
