#pragma once
#include <functional>

#include "compiler/base/result.h"
#include "compiler/diff/finding.h"
#include "compiler/diff/source.h"

namespace orbc::diff {

enum class Form { pov, svg, json, gltf, glb, picture };

/// What a file is, by its ending; nothing if none of these.
[[nodiscard]] std::optional<Form> form_of(std::string_view name);

/// Compares two files of one form, and the files they name: structure exactly, numbers and pixels within limits.
/// pov, svg:    token by token, blanks left out; a number written whole in both is part of the structure.
/// json:        as trees; whole numbers exactly.
/// gltf, glb:   the JSON as a tree, but for where things lie in buffers; each accessor decoded, element by element; pictures as pixels.
/// picture:     PNG and JPEG in steps of 1/255 of sRGB codes; of EXR R, G, B, A so, too, and other channels as numbers.
/// Names of files count as the same that differ only in their file's own stem and in the digits that say what is in them.
/// Diagnostics: diff.cannot-read, diff.bad-file.
[[nodiscard]] Result<Finding> compare(Form form, const Source& a, const Source& b, const Limits& limits);

// The parts of `compare`. Each takes down what it finds; errors say what cannot be read.
[[nodiscard]] Diagnostics compare_text(Form form, const Source& a, const Source& b, const Limits& limits, Finding& finding);
[[nodiscard]] Diagnostics compare_json(const Source& a, const Source& b, const Limits& limits, Finding& finding);
[[nodiscard]] Diagnostics compare_gltf(Form form, const Source& a, const Source& b, const Limits& limits, Finding& finding);

/// An encoded picture and what to call it.
struct EncodedPicture {
  std::string name;
  std::string_view bytes;
};
[[nodiscard]] Diagnostics compare_pictures(const EncodedPicture& a, const EncodedPicture& b, const Limits& limits, Finding& finding);

[[nodiscard]] Diagnostic bad_file(const std::string& name, const std::string& what);

/// Takes down two numbers. Makes: whether they are within the limits. In: `place` makes the two places when they are wanted.
using PlaceOf = std::function<Difference()>;
[[nodiscard]] inline bool take_numbers(double a, double b, const Limits& limits, Finding& finding, const PlaceOf& place) {
  ++finding.numbers;
  if (a == b) return true;
  const double far = distance(a, b);
  if (far == 0) return true;
  ++finding.numbers_differing;
  const bool beyond = !(far <= limits.within);
  if (far > finding.largest) finding.largest = far, finding.largest_at = place().at;
  if (!beyond) return true;
  ++finding.numbers_beyond;
  if (!finding.differs) finding.differ(place());
  return false;
}

}  // namespace orbc::diff
