#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace orbc::cli {

/// Writes a whole file or none: to a temporary name beside the target, flushed to the disk's satisfaction, then renamed.
/// "-" is standard output. Throws std::system_error when the machine refuses; nothing is left behind.
void write_output(const std::string& target, std::string_view bytes);

/// A folder of one's own in $TMPDIR, gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Whether standard error is a terminal that can show a progress bar.
[[nodiscard]] bool stderr_is_terminal();

}  // namespace orbc::cli
