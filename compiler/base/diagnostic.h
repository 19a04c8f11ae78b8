#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "compiler/base/source_span.h"

namespace orbc {

enum class Severity { note, warning, error };

/// One thing the author of a scene should know: what is wrong, where, and what to do.
/// `code` is `room.what-is-wrong` and stands in schema/diagnostics.md.
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

/// Gives the diagnostics that carry no place yet the place `span`.
[[nodiscard]] Diagnostics located(Diagnostics diagnostics, const SourceSpan& span);

/// The text a terminal shows: `file:line:column: error[code] message`, the line itself, a caret below it, the hint.
/// Long lines are cut around the caret; control bytes and bytes that are not UTF-8 are shown as `\xNN`,
/// in the quoted line as in message and hint, which may quote the author too.
[[nodiscard]] std::string to_text(const Diagnostic& diagnostic);
[[nodiscard]] std::string to_text(const Diagnostics& diagnostics);

/// The known word nearest to `word` (edit distance with transpositions, at most a third of its length and at least one), or "".
[[nodiscard]] std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

}  // namespace orbc
