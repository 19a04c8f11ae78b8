#pragma once
#include <string_view>

namespace orbc::cli {

/// Fills the numbers of standard streams that are closed, so that no file opened later gets one of them and messages into it.
/// Such a stream fails as before: it can neither be read nor written.
void reserve_standard_streams();

/// Writes a message to standard error. Where that is closed or full the message is lost: messages never change what a command does.
void say(std::string_view text);

/// Writes bytes to standard output. Throws std::system_error when it is closed or full.
void write_standard_output(std::string_view bytes);

/// Writes to one of the standard streams only what it takes at once: for the last words of a program that is being ended.
void write_at_once(int descriptor, std::string_view text);

/// Whether standard error is a terminal that can show a progress bar.
[[nodiscard]] bool stderr_is_terminal();

}  // namespace orbc::cli
