#include "compiler/mesh_io/errors.h"

#include <fmt/core.h>

namespace orbc::mesh_io {

std::string quotable(std::string_view text, std::size_t max_characters) {
  std::string shown;
  for (const char c : text.substr(0, max_characters)) shown += c >= 32 && c < 127 ? c : '?';
  return shown;
}

Diagnostic not_finite(const std::string& name, const std::string& where) {
  return make_error("mesh.not-finite",
                    fmt::format("{}: {} has a coordinate that is not a finite number below {:g}", name, where, kMaxCoordinate),
                    "export the mesh again");
}

Diagnostic bad_number(const std::string& name, const std::string& where, std::string_view word) {
  const bool has_comma = word.find(',') != word.npos && word.find_first_not_of("+-0123456789,eE") == word.npos;
  return make_error("mesh.bad-number", fmt::format("{}: {}: \"{}\" is not a number", name, where, quotable(word)),
                    has_comma ? "export it with decimal points: decimal commas depend on the language of the program" : "");
}

Diagnostic truncated(const std::string& name, const std::string& what) {
  return make_error("mesh.truncated", fmt::format("{}: {}", name, what),
                    "the file was cut off, or its header is wrong: copy or export it again");
}

Diagnostic too_many(const std::string& name, const std::string& what, std::uint64_t count, std::uint64_t bound) {
  return make_error("mesh.too-big", fmt::format("{}: {} {}; at most {} are read", name, count, what, bound),
                    "simplify the mesh in the program that made it, or allow more with --max-memory");
}

}  // namespace orbc::mesh_io
