#include "compiler/base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "compiler/base/utf8.h"

namespace orbc {
namespace {

constexpr std::size_t kShownColumns = 100;  // a longer line is cut to a window around the caret

Diagnostic make(Severity severity, std::string code, std::string message, std::string hint, SourceSpan span) {
  return {severity, std::move(code), std::move(span), std::move(message), std::move(hint)};
}

// The length of the character at `at`; 0 for bytes that are no UTF-8, and for control characters of Latin-1, which terminals obey.
std::size_t printable_length(std::string_view text, std::size_t at) {
  const auto character = decode_utf8(text, at);
  return !character || (character->code >= 0x80 && character->code < 0xA0) ? 0 : character->length;
}

std::vector<std::string> shown_characters(std::string_view line) {
  std::vector<std::string> shown;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t length = printable_length(line, at);
    const auto byte = static_cast<unsigned char>(line[at]);
    if (line[at] == '\t') shown.emplace_back(" ");
    else if (length == 0 || byte < 0x20 || byte == 0x7F) shown.push_back(fmt::format("\\x{:02X}", byte));
    else shown.emplace_back(line.substr(at, length));
    at += std::max<std::size_t>(length, 1);
  }
  return shown;
}

// Text that quotes the author, made safe for a terminal; line breaks stay.
std::string shown_text(std::string_view text) {
  std::string shown;
  for (std::size_t begin = 0;; ++begin) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    for (const std::string& character : shown_characters(text.substr(begin, end - begin))) shown += character;
    if (end == text.size()) return shown;
    shown += '\n';
    begin = end;
  }
}

std::string_view line_of(std::string_view text, std::size_t line) {
  std::size_t begin = 0;
  for (std::size_t i = 1; i < line; ++i) {
    begin = text.find('\n', begin);
    if (begin == std::string_view::npos) return {};
    ++begin;
  }
  std::string_view rest = text.substr(begin);
  rest = rest.substr(0, rest.find('\n'));
  if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
  return rest;
}

std::string quoted_line(const SourceSpan& span) {
  // One character per column. Long lines are shown in a window around the caret.
  const std::vector<std::string> characters = shown_characters(line_of(span.source->text, span.line).substr(0, 100000));
  const std::size_t column = std::clamp<std::size_t>(span.column, 1, characters.size() + 1);
  const std::size_t first = column > kShownColumns ? column - kShownColumns / 2 : 1;
  const std::size_t last = std::min(characters.size(), first + kShownColumns - 1);
  const std::string number = fmt::format("{:>4}", span.line);
  std::string text = number + " | " + (first > 1 ? "…" : "");
  std::string caret = std::string(number.size(), ' ') + " | " + (first > 1 ? " " : "");
  for (std::size_t i = first; i <= last; ++i) {
    text += characters[i - 1];
    const std::size_t width = characters[i - 1].size() > 3 && characters[i - 1][0] == '\\' ? characters[i - 1].size() : 1;
    if (i < column) caret.append(width, ' ');
    else if (i < column + std::max<std::size_t>(span.length, 1)) caret.append(width, '^');
  }
  if (column > last) caret += '^';
  if (last < characters.size()) text += "…";
  return text + "\n" + caret + "\n";
}

}  // namespace

Diagnostic make_error(std::string code, std::string message, std::string hint, SourceSpan span) {
  return make(Severity::error, std::move(code), std::move(message), std::move(hint), std::move(span));
}

Diagnostic make_warning(std::string code, std::string message, std::string hint, SourceSpan span) {
  return make(Severity::warning, std::move(code), std::move(message), std::move(hint), std::move(span));
}

Diagnostic make_note(std::string code, std::string message, std::string hint, SourceSpan span) {
  return make(Severity::note, std::move(code), std::move(message), std::move(hint), std::move(span));
}

bool has_error(const Diagnostics& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& d) { return d.severity == Severity::error; });
}

Diagnostics located(Diagnostics diagnostics, const SourceSpan& span) {
  for (Diagnostic& diagnostic : diagnostics)
    if (!diagnostic.span.source) diagnostic.span = span;
  return diagnostics;
}

std::string to_text(const Diagnostic& diagnostic) {
  static constexpr const char* kNames[] = {"note", "warning", "error"};
  const SourceSpan& span = diagnostic.span;
  std::string text;
  if (span.source && span.line > 0) text += fmt::format("{}:{}:{}: ", shown_text(span.source->name), span.line, span.column);
  else if (span.source) text += shown_text(span.source->name) + ": ";
  text += fmt::format("{}[{}] {}\n", kNames[static_cast<int>(diagnostic.severity)], diagnostic.code, shown_text(diagnostic.message));
  if (span.source && span.line > 0) text += quoted_line(span);
  if (!diagnostic.hint.empty()) text += "  hint: " + shown_text(diagnostic.hint) + "\n";
  return text;
}

std::string to_text(const Diagnostics& diagnostics) {
  return std::accumulate(diagnostics.begin(), diagnostics.end(), std::string(),
                         [](std::string all, const Diagnostic& d) { return std::move(all) + to_text(d); });
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  // Optimal string alignment distance (Damerau 1964, restricted), three rows at a time.
  const auto distance = [](std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), row(b.size() + 1);
    std::iota(previous.begin(), previous.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
      row[0] = i;
      for (std::size_t j = 1; j <= b.size(); ++j) {
        row[j] = std::min({previous[j] + 1, row[j - 1] + 1, previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
        if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
      }
      std::swap(before, previous);
      std::swap(previous, row);
    }
    return previous[b.size()];
  };
  if (word.size() < 2 || word.size() > 64) return {};
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t d = distance(word, candidate);
    if (d < best_distance) {
      best = candidate;
      best_distance = d;
    }
  }
  return best;
}

}  // namespace orbc
