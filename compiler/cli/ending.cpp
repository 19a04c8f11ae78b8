// How signals end the program. All threads block the signals; a thread of its own waits for them. So what is done at the end is ordinary
// code, and no loop of any room needs to look for a signal.
#include "compiler/cli/ending.h"

#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <mutex>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "compiler/cli/result.h"
#include "compiler/cli/streams.h"

namespace orbc::cli {
namespace {

constexpr int kInterrupted = 130;
constexpr std::size_t kStack = 256 << 10;  // the usual 8 MiB count against `ulimit -v`

struct Ending {
  std::recursive_mutex held;
  std::set<std::filesystem::path> temporaries;
  pid_t child_group = 0;
  bool written = false;
  bool json = false;
  sigset_t waited_for{};
  sigset_t mask_at_start{};
};

// Never destroyed: the waiting thread lives until the program's last instruction.
Ending& ending() {
  static Ending& the_one = *new Ending;
  return the_one;
}

[[noreturn]] void end_now() {
  Ending& all = ending();
  all.held.lock();  // for ever
  if (all.child_group > 0) {
    ::kill(-all.child_group, SIGKILL);
    ::waitpid(all.child_group, nullptr, 0);  // it writes nothing any more
  }
  std::error_code ignored;
  for (const std::filesystem::path& path : all.temporaries) std::filesystem::remove_all(path, ignored);
  const std::string message = all.written ? "stopped; the output was already written" : "stopped; nothing was written";
  write_at_once(STDERR_FILENO, "orbc: " + message + "\n");
  if (all.json) write_at_once(STDOUT_FILENO, failure_json("cli.stopped", message));
  ::_exit(kInterrupted);
}

extern "C" void* wait_for_signals(void*) {
  int signal = 0;
  while (::sigwait(&ending().waited_for, &signal) != 0) {
  }
  end_now();
}

bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void end_on_signals(bool json) {
  Ending& all = ending();
  all.json = json;
  ::pthread_sigmask(SIG_SETMASK, nullptr, &all.mask_at_start);
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe and a file too large are errors of write(), printed like any other
  std::signal(SIGXFSZ, SIG_IGN);
  sigemptyset(&all.waited_for);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (!is_ignored(signal)) sigaddset(&all.waited_for, signal);  // nohup, and the shell's background jobs, ignore some
  ::pthread_sigmask(SIG_BLOCK, &all.waited_for, nullptr);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStack);
  pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
  pthread_t thread{};
  // Where no thread can be had signals end the program as they would any other.
  if (pthread_create(&thread, &attributes, wait_for_signals, nullptr) != 0) ::pthread_sigmask(SIG_SETMASK, &all.mask_at_start, nullptr);
  pthread_attr_destroy(&attributes);
}

HoldSignals::HoldSignals() { ending().held.lock(); }
HoldSignals::~HoldSignals() { ending().held.unlock(); }

Temporary::Temporary(std::filesystem::path path) : path_(std::move(path)) {
  const HoldSignals hold;
  ending().temporaries.insert(path_);
}

void Temporary::keep() {
  const HoldSignals hold;
  ending().temporaries.erase(path_);
  path_.clear();
}

Temporary::~Temporary() {
  if (path_.empty()) return;
  const HoldSignals hold;
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  ending().temporaries.erase(path_);
}

void output_is_written() {
  const HoldSignals hold;
  ending().written = true;
}

void set_child_group(pid_t group) {
  const HoldSignals hold;
  ending().child_group = group;
}

void restore_signals_in_child() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
  ::pthread_sigmask(SIG_SETMASK, &ending().mask_at_start, nullptr);
}

}  // namespace orbc::cli
