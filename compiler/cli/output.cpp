#include "compiler/cli/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>

#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"

namespace orbc::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

// Where a name leads.
struct Place {
  fs::path path;                   // at the end of symbolic links; what is there may be missing
  bool stream = false;             // written as it is
  std::optional<struct stat> old;  // the file that is replaced
};

Place place_of(const std::string& name) {
  constexpr int kLinks = 40;  // as many as the kernel follows
  Place place{name, name == "-", {}};
  for (int links = 0; !place.stream; ++links) {
    struct stat found {};
    if (::lstat(place.path.c_str(), &found) != 0) {
      if (errno == ENOENT) break;
      fail("cannot write " + name);
    }
    if (S_ISLNK(found.st_mode)) {
      if (links == kLinks) errno = ELOOP, fail("cannot write " + name);
      const fs::path target = fs::read_symlink(place.path);
      const bool open_already = place.path.string().rfind("/proc/", 0) == 0 || target.string().rfind("/proc/", 0) == 0;
      if (open_already) place.stream = true;  // /dev/stdout and its like
      else place.path = target.is_absolute() ? target : place.path.parent_path() / target;
      continue;
    }
    if (S_ISDIR(found.st_mode)) errno = EISDIR, fail("cannot write " + name);
    if (!S_ISREG(found.st_mode)) place.stream = true;
    else place.old = found;
    break;
  }
  if (!place.stream && !place.path.has_filename()) errno = EISDIR, fail("cannot write " + name);
  return place;
}

fs::path folder_of(const Place& place) { return place.path.has_parent_path() ? place.path.parent_path() : fs::path("."); }

mode_t mode_of(const Place& place) {
  if (place.old) return place.old->st_mode & 0777;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

// A file that has no name yet, or a temporary one on file systems that want one.
class PendingFile {
 public:
  PendingFile(const OutputFile& file, Place place) : name_(file.name), place_(std::move(place)) {
    const fs::path folder = folder_of(place_);
    descriptor_ = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    if (descriptor_ < 0 || ::access(own_link().c_str(), F_OK) != 0) create_named();
  }
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  ~PendingFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  void write(std::string_view bytes) {
    if (!write_all(descriptor_, bytes)) fail("cannot write " + name_);
    if (::fchmod(descriptor_, mode_of(place_)) != 0) fail("cannot write " + name_);
    // Where the owner may be kept he is; nobody but root may give files away.
    if (place_.old) [[maybe_unused]]
      const int refused = ::fchown(descriptor_, place_.old->st_uid, place_.old->st_gid);
  }
  // To be called when signals are held.
  void take_temporary_name() {
    if (!temporary_) {
      const std::string self = own_link();
      make_unique([&](const fs::path& path) { return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW); });
    }
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0) fail("cannot write " + name_);  // delayed errors of network disks come here
  }
  void take_name() {
    if (::rename(temporary_->path().c_str(), place_.path.c_str()) != 0) fail("cannot write " + name_);
    temporary_->keep();
  }

 private:
  [[nodiscard]] std::string own_link() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

  void create_named() {
    if (descriptor_ >= 0) ::close(descriptor_);
    const HoldSignals hold;
    make_unique([&](const fs::path& path) { return descriptor_ = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600); });
  }
  // Short, whatever the output is called: names may have 255 bytes.
  template <class Make>
  void make_unique(const Make& make) {
    for (int number = 0;; ++number) {
      const fs::path path = folder_of(place_) / fmt::format(".orbc.{}.{}", ::getpid(), number);
      if (make(path) >= 0) {
        temporary_ = std::make_unique<Temporary>(path);
        return;
      }
      if (errno != EEXIST) fail(fmt::format("cannot write {}: no file can be made in {}", name_, folder_of(place_).string()));
    }
  }

  std::string name_;
  Place place_;
  int descriptor_ = -1;
  std::unique_ptr<Temporary> temporary_;
};

void write_stream(const OutputFile& file) {
  if (file.name == "-") return write_standard_output(file.bytes);
  const int descriptor = ::open(file.name.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);  // /dev/stdout may be a file that others begin
  if (descriptor < 0) fail("cannot write " + file.name);
  if (!write_all(descriptor, file.bytes)) {
    const int error = errno;
    ::close(descriptor);
    errno = error, fail("cannot write " + file.name);
  }
  if (::close(descriptor) != 0) fail("cannot write " + file.name);
}

void check_output(const std::string& name, const Place& place) {
  if (name == "-") return;
  if (place.stream || place.old) {
    if (::faccessat(AT_FDCWD, place.path.c_str(), W_OK, AT_EACCESS) != 0) fail("cannot write " + name);
    if (place.stream) return;
  }
  const fs::path file = place.path.filename();
  struct stat ignored {};
  if (!place.old && ::lstat(place.path.c_str(), &ignored) != 0 && errno != ENOENT) fail("cannot write " + name);  // ENAMETOOLONG, too
  const PendingFile tried({name, {}}, place);
}

// What a file is, whatever it is called.
std::optional<std::pair<dev_t, ino_t>> identity(const std::string& name) {
  struct stat found {};
  if (name.empty() || ::stat(name.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return {};
  return std::pair(found.st_dev, found.st_ino);
}

fs::path make_temporary_folder() {
  const char* wanted = std::getenv("TMPDIR");
  const bool given = wanted && *wanted;
  const std::string where = given ? wanted : "/tmp";
  std::string name = (fs::absolute(where) / "orbc.XXXXXX").string();
  if (!::mkdtemp(name.data())) fail(fmt::format("cannot make a temporary folder in {}{}", where, given ? ", which is $TMPDIR" : ""));
  return name;
}

}  // namespace

bool is_stream(const std::string& name) { return place_of(name).stream; }

void check_outputs(const std::vector<std::string>& names) {
  std::vector<fs::path> taken;
  for (const std::string& name : names) {
    if (name.empty()) continue;
    const Place place = place_of(name);
    check_output(name, place);
    if (place.stream) continue;
    fs::path real = fs::canonical(folder_of(place)) / place.path.filename();
    if (std::find(taken.begin(), taken.end(), real) != taken.end())
      throw UsageError(fmt::format("two outputs would be written to {}", real.string()));
    taken.push_back(std::move(real));
  }
}

void refuse_inputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  for (const std::string& output : outputs) {
    const auto written = output == "-" ? std::nullopt : identity(output);
    if (!written) continue;
    for (const std::string& input : inputs)
      if (identity(input == "-" ? "/dev/stdin" : input) == written)
        throw UsageError(output == input ? fmt::format("{} is read: the output would replace it", output)
                                         : fmt::format("{} is {}, which is read: the output would replace it", output, input));
  }
}

void write_together(const std::vector<OutputFile>& files, const std::function<void()>& when_named) {
  std::vector<std::unique_ptr<PendingFile>> pending;
  std::vector<const OutputFile*> streams;
  for (const OutputFile& file : files) {
    Place place = place_of(file.name);
    if (place.stream) {
      streams.push_back(&file);
      continue;
    }
    pending.push_back(std::make_unique<PendingFile>(file, std::move(place)));
    pending.back()->write(file.bytes);
  }
  for (const OutputFile* file : streams) write_stream(*file);
  const HoldSignals hold;
  for (const auto& file : pending) file->take_temporary_name();
  for (const auto& file : pending) file->take_name();
  if (when_named) when_named();
  output_is_written();
}

void write_output(const std::string& name, std::string_view bytes) { write_together({{name, bytes}}); }

FolderLock::FolderLock(const std::filesystem::path& folder) {
  constexpr int kTries = 200;
  descriptor_ = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  for (int i = 0; i < kTries && descriptor_ >= 0 && !held_; ++i) {
    held_ = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    if (!held_ && errno != EWOULDBLOCK) return;
    if (!held_) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

TemporaryFolder::TemporaryFolder(const HoldSignals&) : folder_(make_temporary_folder()) {}

TemporaryFolder::TemporaryFolder() : TemporaryFolder(HoldSignals()) {}

}  // namespace orbc::cli
