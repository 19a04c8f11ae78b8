#pragma once
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "compiler/base/diagnostic.h"

namespace orbc::scene {

/// Turns byte offsets of a text into lines and columns (code points), in constant time however long the lines are.
class Locator {
 public:
  explicit Locator(std::shared_ptr<const SourceText> source);

  [[nodiscard]] std::string_view text() const { return source_->text; }
  /// The single character at `offset`.
  [[nodiscard]] SourceSpan at(std::size_t offset) const;
  /// The characters from `offset` to the next blank, comma or bracket.
  [[nodiscard]] SourceSpan token_at(std::size_t offset) const;
  /// The scalar with the value `value` that starts at `offset`, with its quotes, up to the end of its line.
  [[nodiscard]] SourceSpan scalar_at(std::size_t offset, std::string_view value) const;
  /// Whether a quote at `offset` is closed before the end of the file. (yaml-cpp takes an open one as closed.)
  [[nodiscard]] bool quote_is_closed(std::size_t offset) const;
  /// A diagnostic for the first byte sequence that is not UTF-8 or not a printable character of YAML 1.2 (§ 5.1).
  [[nodiscard]] std::optional<Diagnostic> first_bad_character() const;

 private:
  [[nodiscard]] std::size_t characters_before(std::size_t offset) const;
  [[nodiscard]] SourceSpan span(std::size_t begin, std::size_t end) const;

  std::shared_ptr<const SourceText> source_;
  std::vector<std::size_t> line_starts_;
  std::vector<std::size_t> characters_;  // before each block of kBlockBytes bytes
};

}  // namespace orbc::scene
