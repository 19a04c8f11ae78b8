#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/cli/ending.h"

namespace orbc::cli {

/// Whether a name stands for something that is written as it is, and not replaced: standard output ("-"), a device, a named pipe.
[[nodiscard]] bool is_stream(const std::string& name);

/// Finds out before the work whether these outputs can be written; empty names stand for none. Nothing is left behind.
/// Throws std::system_error where one cannot (no such folder, a folder under that name, no permission); UsageError where two are the same
/// file.
void check_outputs(const std::vector<std::string>& names);

/// Refuses to write over what is read, whatever it is called: by another path, a link or a hard link. Throws UsageError.
void refuse_inputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

struct OutputFile {
  std::string name;  ///< "-" is standard output
  std::string_view bytes;
};

/// Writes files that belong together, all or none: first the bytes of all of them, under no name or a temporary one, then each takes its
/// name, in the order given. A symbolic link stays and what it points to is replaced; the new file gets the mode of the old one.
/// In:     `when_named` is called when the files have their names, and before a signal can end the program: it removes what they replace.
/// Throws: std::system_error when the machine refuses; nothing is left behind.
void write_together(const std::vector<OutputFile>& files, const std::function<void()>& when_named = {});

/// Writes one file, as write_together does.
void write_output(const std::string& name, std::string_view bytes);

/// Holds a folder against other runs of this program as long as it exists; those that find it held wait, for two seconds at most.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  /// False where the file system has no locks, or another run would not give it free.
  [[nodiscard]] bool held() const { return held_; }

 private:
  int descriptor_ = -1;
  bool held_ = false;
};

/// A folder of one's own in $TMPDIR, or else /tmp, gone with the object. Throws std::system_error.
class TemporaryFolder {
 public:
  TemporaryFolder();
  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

 private:
  explicit TemporaryFolder(const HoldSignals& made_and_registered_together);
  Temporary folder_;
};

}  // namespace orbc::cli
