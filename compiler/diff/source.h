#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "compiler/base/result.h"

namespace orbc::diff {

/// One of the two files that are compared, and where the files lie that it names.
struct Source {
  std::string name;    ///< as the caller calls it
  std::string folder;  ///< in which the files lie that it names
  std::string stem;    ///< its own name without ending: what it names is called after it
  std::string bytes;
};

/// Reads a file whole. Diagnostics: diff.cannot-read.
[[nodiscard]] Result<Source> read_source(const std::string& path);
/// The bytes of a file that `source` names, beside it or below. Diagnostics: diff.cannot-read.
[[nodiscard]] Result<std::string> read_beside(const Source& source, std::string_view reference);

/// Whether two names say the same, each in its file: alike but for the files' own stems at the beginning and for the digits before the
/// ending that say what is in a file, as in "a-atlas-0a1b2c3d4e5f.png" of a.pov and "b-atlas-a0b1c2d3e4f5.png" of b.pov.
[[nodiscard]] bool same_name(std::string_view a, const Source& in_a, std::string_view b, const Source& in_b);
/// A text with the file's own names replaced (STEM.pov, STEM-atlas.…), to be compared with another file's.
[[nodiscard]] std::string without_stem(std::string_view text, const Source& source);
/// Whether a name ends in .png, .jpg, .jpeg or .exr.
[[nodiscard]] bool names_picture(std::string_view name);

/// The bytes that base64 stands for, blanks left out; nothing if it is none.
[[nodiscard]] std::optional<std::string> decode_base64(std::string_view text);

}  // namespace orbc::diff
