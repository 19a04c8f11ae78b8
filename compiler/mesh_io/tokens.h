#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orbc::mesh_io {

/// A file as text in UTF-8 with lines that end in '\n' or "\r\n".
struct DecodedText {
  std::string_view original;           ///< the bytes given, without a byte order mark
  std::optional<std::string> changed;  ///< another text in place of them, where they had to be changed
  [[nodiscard]] std::string_view text() const { return changed ? *changed : original; }
};

/// Takes a byte order mark away, makes UTF-8 of UTF-16 with a byte order mark, and lines of those that end in '\r' alone.
[[nodiscard]] DecodedText decode_text(std::string_view bytes);

/// The text with the capitals of ASCII as small letters.
[[nodiscard]] std::string lower_case(std::string_view text);

/// Walks through the words of a text file. Words are separated by blanks; lines are counted for diagnostics.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : rest_(text) {}

  /// The next word, whatever line it is on; "" at the end. '#' starts a comment when `comments`.
  std::string_view next(bool comments = false);
  /// The next word of this line; "" at its end.
  std::string_view next_in_line();
  /// The rest of the line without blanks around it; goes to the next line.
  std::string_view rest_of_line();
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  /// The number of the line, from 1.
  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view word();
  std::string_view rest_;
  std::size_t line_ = 1;
};

/// The number that a whole word stands for ("1", "+2.5", "-3e4", "nan"), or nothing.
[[nodiscard]] std::optional<double> to_number(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> to_integer(std::string_view word);

}  // namespace orbc::mesh_io
