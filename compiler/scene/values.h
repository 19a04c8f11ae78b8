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

/// The numbers a value may have; an open end is not itself allowed.
struct Range {
  double min = 0, max = 0;
  bool open_min = false, open_max = false;
};
[[nodiscard]] bool contains(const Range& range, double value);
/// "from 0 to 1", "greater than 0 and at most 1000".
[[nodiscard]] std::string to_string(const Range& range);

/// No length, height or coordinate of a scene exceeds this; whatever needs more is a mistake in its unit.
inline constexpr double kMaxLength = 1000;
inline constexpr Range kLength{0, kMaxLength, true};          ///< of things that have an extent
inline constexpr Range kDistance{0, kMaxLength};              ///< of places
inline constexpr Range kUnit{0, 1};

/// Collects what is wrong with a scene while it is read. Reading never stops at a mistake: each `read_…` returns its fallback and goes on.
class Reader {
 public:
  Diagnostics diagnostics;

  void error(std::string code, const SourceSpan& span, std::string message, std::string hint = {});
  void warning(std::string code, const SourceSpan& span, std::string message, std::string hint = {});
  void wrong_type(const Node& node, std::string_view what, std::string_view wanted, std::string hint = {});
  void unknown_value(const Node& node, std::string_view what, const std::vector<std::string>& known);

  [[nodiscard]] double number(const Node& node, std::string_view what, double fallback, const Range& range);
  [[nodiscard]] int integer(const Node& node, std::string_view what, int fallback, int min, int max);
  [[nodiscard]] bool boolean(const Node& node, std::string_view what, bool fallback);
  /// Text that is not empty; a plain scalar that looks like a number, a truth value or nothing is none.
  [[nodiscard]] std::optional<std::string> text(const Node& node, std::string_view what);
  [[nodiscard]] Color color(const Node& node, std::string_view what, const Color& fallback);
  /// "30deg", "0.5rad", or a plain number of degrees. `degrees` bounds it.
  [[nodiscard]] Angle angle(const Node& node, std::string_view what, const Angle& fallback, const Range& degrees = {-360000, 360000});
  [[nodiscard]] bool list(const Node& node, std::string_view what, std::size_t count, std::string_view wanted);

  template <std::size_t N>
  [[nodiscard]] std::array<double, N> numbers(const Node& node, std::string_view what, const std::array<double, N>& fallback,
                                              const Range& range, std::string_view wanted) {
    std::array<double, N> values = fallback;
    if (!list(node, what, N, wanted)) return fallback;
    for (std::size_t i = 0; i < N; ++i) values[i] = number(node.items[i], what, fallback[i], range);
    return values;
  }
};

/// One value of an enumeration and its word in the file.
template <class T>
using Words = std::initializer_list<std::pair<const char*, T>>;

/// A map of the scene: refuses what is no map and every key it does not know, and hands out values by key.
class Fields {
 public:
  /// `what` names the map in messages: "the camera".
  Fields(Reader& reader, const Node& node, std::string what, std::vector<std::string> known);

  [[nodiscard]] const Node* find(std::string_view key) const { return node_.find(key); }
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  [[nodiscard]] bool is_map() const { return node_.kind == NodeKind::map; }
  [[nodiscard]] const Node& node() const { return node_; }
  [[nodiscard]] Reader& reader() const { return reader_; }
  [[nodiscard]] SourceSpan key_span(std::string_view key) const;
  /// Says that `key` is missing; nothing when the map itself was refused.
  void require(std::string_view key, std::string hint) const;
  /// Refuses all but the first of `keys` that are given; returns that one or "".
  [[nodiscard]] std::string only_one_of(const std::vector<std::string>& keys) const;
  /// Warns that a key changes nothing, and why.
  void no_effect(std::string_view key, std::string_view why) const;

  [[nodiscard]] double number(std::string_view key, double fallback, const Range& range) const;
  [[nodiscard]] int integer(std::string_view key, int fallback, int min, int max) const;
  [[nodiscard]] bool boolean(std::string_view key, bool fallback) const;
  [[nodiscard]] Color color(std::string_view key, const Color& fallback) const;
  [[nodiscard]] Angle angle(std::string_view key, const Angle& fallback, const Range& degrees = {-360000, 360000}) const;

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

/// The number that a plain scalar is by YAML 1.2's core schema (decimal; .inf and .nan too), if it is one.
[[nodiscard]] std::optional<double> number_of(const Node& node);
/// "a, b or c".
[[nodiscard]] std::string listed(const std::vector<std::string>& words, std::string_view last = "or");

}  // namespace orbc::scene
