#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "compiler/base/source_span.h"

namespace orbc {

enum class Severity { note, warning, error };

/// A message to the author of a scene: what is wrong, where, and what to do.
/// `code` has the form `room.what-is-wrong`; schema/diagnostics.md explains it.
struct Diagnostic {
  Severity severity = Severity::error;
  std::string code;
  SourceSpan span;
  std::string message;
  std::string hint;
};

using Diagnostics = std::vector<Diagnostic>;

[[nodiscard]] Diagnostic make_error(std::string code, std::string message, std::string hint = {}, SourceSpan span = {});
[[nodiscard]] Diagnostic make_warning(std::string code, std::string message, std::string hint = {}, SourceSpan span = {});
[[nodiscard]] Diagnostic make_note(std::string code, std::string message, std::string hint = {}, SourceSpan span = {});
[[nodiscard]] bool has_error(const Diagnostics& diagnostics);

/// Sets the span of those diagnostics that have none.
[[nodiscard]] Diagnostics located(Diagnostics diagnostics, const SourceSpan& span);

/// The text for a terminal: `file:line:column: error[code] message`, the line itself, a caret below it, the hint.
/// Long lines are cut around the caret. Control characters and bytes that are not UTF-8 become `\xNN`, in the line as well as in message
/// and hint, which may quote the author.
[[nodiscard]] std::string to_text(const Diagnostic& diagnostic);
[[nodiscard]] std::string to_text(const Diagnostics& diagnostics);

/// The known word nearest to `word` (edit distance with transpositions, at most a third of its length and at least one), or "".
[[nodiscard]] std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

}  // namespace orbc
