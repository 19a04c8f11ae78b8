#pragma once
#include <sys/types.h>

#include <filesystem>

namespace orbc::cli {

/// From now on Ctrl-C (SIGINT), SIGTERM and SIGHUP end the program at once, whatever it is doing, with exit code 130: the renderer that it
/// has started is killed, and what it would have removed in the end is removed. Signals that were ignored when it started stay so.
/// In: whether a failure is also told as JSON on standard output. To be called once, before there are other threads.
void end_on_signals(bool json);

/// As long as one of these exists no signal ends the program: it waits. For steps that belong together and take no time.
class HoldSignals {
 public:
  HoldSignals();
  ~HoldSignals();
  HoldSignals(const HoldSignals&) = delete;
  HoldSignals& operator=(const HoldSignals&) = delete;
};

/// A file or folder that must not outlive the program: removed with this object, or when a signal ends the program.
/// In: a path that has been made under the same HoldSignals.
class Temporary {
 public:
  explicit Temporary(std::filesystem::path path);
  ~Temporary();
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// It has become what it was made for, under another name.
  void keep();

 private:
  std::filesystem::path path_;
};

/// The program's output is complete: who ends the program after that is told so.
void output_is_written();

/// The process group of the renderer that is killed when a signal ends the program; 0 for none.
void set_child_group(pid_t group);

/// Gives a child process the signals that this program was started with. To be called between fork and exec.
void restore_signals_in_child();

}  // namespace orbc::cli
