#include "compiler/cli/streams.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

namespace orbc::cli {
namespace {

// Whether another attempt makes sense after `errno`; waits for streams that somebody has made non-blocking.
bool try_again(int descriptor) {
  if (errno == EINTR) return true;
  if (errno != EAGAIN) return false;
  pollfd waiting{descriptor, POLLOUT, 0};
  return ::poll(&waiting, 1, -1) >= 0 || errno == EINTR;
}

}  // namespace

void reserve_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // open() gives the lowest free number, which is this one: those below are taken. Opened the wrong way round, it fails when it is used.
    if (::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) return;  // there is nothing better to do without /dev
  }
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), std::min<std::size_t>(bytes.size(), 1 << 24));
    if (written < 0) {
      if (try_again(descriptor)) continue;
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void print_message(std::string_view text) { (void)write_all(STDERR_FILENO, text); }

void write_standard_output(std::string_view bytes) {
  if (!write_all(STDOUT_FILENO, bytes)) throw std::system_error(errno, std::generic_category(), "cannot write standard output");
}

void write_at_once(int descriptor, std::string_view text) {
  pollfd ready{descriptor, POLLOUT, 0};
  if (::poll(&ready, 1, 0) == 1 && (ready.revents & POLLOUT)) [[maybe_unused]]
    const ssize_t lost = ::write(descriptor, text.data(), text.size());
}

bool stderr_is_terminal() {
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) && terminal && std::string_view(terminal) != "dumb";
}

}  // namespace orbc::cli
