#pragma once
#include <string_view>

namespace orbc::cli {

/// Opens /dev/null under the numbers of closed standard streams, so that no file that is opened later gets such a number, and messages.
/// Such a stream fails as before: it can neither be read nor written.
void reserve_standard_streams();

/// Writes a message to standard error. Where that is closed or full the message is lost: messages never change what a command does.
void print_message(std::string_view text);

/// Writes all bytes to an open descriptor; waits for one that somebody has made non-blocking.
/// Makes: whether all were written; if not, errno says why.
[[nodiscard]] bool write_all(int descriptor, std::string_view bytes);

/// Writes bytes to standard output. Throws std::system_error when it is closed or full.
void write_standard_output(std::string_view bytes);

/// Writes to one of the standard streams what it takes without waiting. For messages of a program that is ending.
void write_at_once(int descriptor, std::string_view text);

/// Whether standard error is a terminal that can show a progress bar.
[[nodiscard]] bool stderr_is_terminal();

}  // namespace orbc::cli
