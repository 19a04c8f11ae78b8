#pragma once
#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compiler/base/angle.h"
#include "compiler/scene/color.h"
#include "compiler/scene/document.h"

namespace orbc::scene {

/// An interval of allowed numbers; open ends are not included.
struct Range {
  double min = 0, max = 0;
  bool open_min = false, open_max = false;
};
[[nodiscard]] bool contains(const Range& range, double value);
/// "from 0 to 1", "greater than 0 and at most 1000".
[[nodiscard]] std::string to_string(const Range& range);

/// The largest length, height or coordinate of a scene. Larger values are mistakes in the unit.
inline constexpr double kMaxLength = 1000;
inline constexpr Range kLength{0, kMaxLength, true};          ///< extents of objects: > 0
inline constexpr Range kDistance{0, kMaxLength};              ///< distances and coordinates: ≥ 0
inline constexpr Range kUnit{0, 1};

/// Reads single values and collects the diagnostics. Reading does not stop at an error.
/// In:          `what` names the value in messages: "`fov`", "the first colour". `range` (and min, max) are the allowed values.
/// Makes:       the value, or `fallback` after a diagnostic.
/// Diagnostics: scene.wrong-type, scene.out-of-range, scene.not-finite, scene.unknown-value, scene.bad-color, scene.bad-angle,
///              scene.angle-out-of-range, scene.wrong-count.
class Reader {
 public:
  Diagnostics diagnostics;

  void error(std::string code, const SourceSpan& span, std::string message, std::string hint = {});
  void warning(std::string code, const SourceSpan& span, std::string message, std::string hint = {});
  /// Adds scene.wrong-type: `what` must be `wanted`, but is the node.
  void wrong_type(const Node& node, std::string_view what, std::string_view wanted, std::string hint = {});
  /// Adds scene.unknown-value: the node is none of `known`.
  void unknown_value(const Node& node, std::string_view what, const std::vector<std::string>& known);

  [[nodiscard]] double number(const Node& node, std::string_view what, double fallback, const Range& range);
  [[nodiscard]] int integer(const Node& node, std::string_view what, int fallback, int min, int max);
  [[nodiscard]] bool boolean(const Node& node, std::string_view what, bool fallback);
  /// Text that is not empty. Unquoted numbers and truth values are not text.
  [[nodiscard]] std::optional<std::string> text(const Node& node, std::string_view what);
  [[nodiscard]] Color color(const Node& node, std::string_view what, const Color& fallback);
  /// "30deg", "0.5rad", or a plain number of degrees. `degrees` is the allowed range.
  [[nodiscard]] Angle angle(const Node& node, std::string_view what, const Angle& fallback, const Range& degrees = {-360000, 360000});
  /// Whether the node is a list of `count` items; `wanted` describes it in the message.
  [[nodiscard]] bool list(const Node& node, std::string_view what, std::size_t count, std::string_view wanted);

  /// A list of N numbers; `wanted` describes it in the message.
  template <std::size_t N>
  [[nodiscard]] std::array<double, N> numbers(const Node& node, std::string_view what, const std::array<double, N>& fallback,
                                              const Range& range, std::string_view wanted) {
    std::array<double, N> values = fallback;
    if (!list(node, what, N, wanted)) return fallback;
    for (std::size_t i = 0; i < N; ++i) values[i] = number(node.items[i], what, fallback[i], range);
    return values;
  }
};

/// The words of an enumeration in the file, with their values.
template <class T>
using Words = std::initializer_list<std::pair<const char*, T>>;

/// A map of the scene. The constructor reports values that are no maps, and unknown keys. The reading functions return `fallback` if the
/// key is missing, or if its value is wrong, after a diagnostic.
class Fields {
 public:
  /// In: `what` names the map in messages: "the camera"; `known` are all its keys.
  Fields(Reader& reader, const Node& node, std::string what, std::vector<std::string> known);

  [[nodiscard]] const Node* find(std::string_view key) const { return node_.find(key); }
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  [[nodiscard]] bool is_map() const { return node_.kind == NodeKind::map; }
  [[nodiscard]] const Node& node() const { return node_; }
  [[nodiscard]] Reader& reader() const { return reader_; }
  /// The span of a key, or of the map if the key is missing.
  [[nodiscard]] SourceSpan key_span(std::string_view key) const;
  /// Adds scene.missing-key if `key` is missing, unless the value is no map at all.
  void require(std::string_view key, std::string hint) const;
  /// The first of `keys` that is given, or "". Adds scene.conflict for the others that are given.
  [[nodiscard]] std::string only_one_of(const std::vector<std::string>& keys) const;
  /// Adds the warning scene.no-effect if `key` is given; once per key.
  void no_effect(std::string_view key, std::string_view why) const;

  [[nodiscard]] double number(std::string_view key, double fallback, const Range& range) const;
  [[nodiscard]] int integer(std::string_view key, int fallback, int min, int max) const;
  [[nodiscard]] bool boolean(std::string_view key, bool fallback) const;
  [[nodiscard]] Color color(std::string_view key, const Color& fallback) const;
  [[nodiscard]] Angle angle(std::string_view key, const Angle& fallback, const Range& degrees = {-360000, 360000}) const;

  /// A value of an enumeration.
  template <class T>
  [[nodiscard]] T choice(std::string_view key, T fallback, Words<T> words) const {
    const Node* node = find(key);
    if (!node) return fallback;
    std::vector<std::string> known;
    for (const auto& [word, value] : words) {
      if (node->kind == NodeKind::scalar && node->text == word) return value;
      known.emplace_back(word);
    }
    reader_.unknown_value(*node, quoted(key), known);
    return fallback;
  }

 private:
  [[nodiscard]] static std::string quoted(std::string_view key);

  Reader& reader_;
  const Node& node_;
  std::string what_;
};

/// The number of a plain scalar by the core schema of YAML 1.2 (decimal, .inf, .nan), or none.
[[nodiscard]] std::optional<double> number_of(const Node& node);
/// The words as a list in a sentence: "a, b or c".
[[nodiscard]] std::string listed(const std::vector<std::string>& words, std::string_view last = "or");

}  // namespace orbc::scene
