#include "compiler/cli/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <vector>

namespace orbc::cli {
namespace {

[[noreturn]] void fail(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

void write_all(int descriptor, std::string_view bytes, const std::string& name) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), std::min<std::size_t>(bytes.size(), 1 << 24));
    if (written < 0) {
      if (errno == EINTR) continue;
      fail("cannot write " + name);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

// Closes and unlinks unless `keep` was called: nothing half written stays.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& target) : name_(target + ".XXXXXX") {
    std::vector<char> buffer(name_.c_str(), name_.c_str() + name_.size() + 1);
    descriptor_ = ::mkstemp(buffer.data());
    if (descriptor_ < 0) fail("cannot create a file beside " + target);
    name_ = buffer.data();
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!kept_) ::unlink(name_.c_str());
  }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  void move_to(const std::string& target) {
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::fchmod(descriptor_, 0666 & ~mask);
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0) fail("cannot write " + target);  // delayed errors of network disks come here
    if (::rename(name_.c_str(), target.c_str()) != 0) fail("cannot rename to " + target);
    kept_ = true;
  }

 private:
  std::string name_;
  int descriptor_ = -1;
  bool kept_ = false;
};

}  // namespace

void write_output(const std::string& target, std::string_view bytes) {
  if (target == "-") return write_all(STDOUT_FILENO, bytes, "standard output");
  struct stat status {};
  const bool special = ::stat(target.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
  if (special) {  // /dev/null, a named pipe: there is nothing to rename
    if (S_ISDIR(status.st_mode)) errno = EISDIR, fail("cannot write " + target);
    const int descriptor = ::open(target.c_str(), O_WRONLY);
    if (descriptor < 0) fail("cannot open " + target);
    write_all(descriptor, bytes, target);
    if (::close(descriptor) != 0) fail("cannot write " + target);
    return;
  }
  TemporaryFile file(target);
  write_all(file.descriptor(), bytes, target);
  file.move_to(target);
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "orbc.XXXXXX").string();
  if (!::mkdtemp(name.data())) fail("cannot create a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

bool stderr_is_terminal() {
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) && terminal && std::string_view(terminal) != "dumb";
}

}  // namespace orbc::cli
