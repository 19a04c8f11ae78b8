#include "compiler/cli/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "compiler/cli/ending.h"

extern char** environ;

namespace orbc::cli {
namespace {

constexpr int kCannotStart = 127;

std::vector<char*> pointers(const std::vector<std::string>& words) {
  std::vector<char*> made;
  for (const std::string& word : words) made.push_back(const_cast<char*>(word.c_str()));
  made.push_back(nullptr);
  return made;
}

std::vector<std::string> environment_of(const ChildProgram& program) {
  std::vector<std::string> words;
  for (char** word = environ; *word; ++word)
    if (std::string_view(*word).rfind("TMPDIR=", 0) != 0) words.emplace_back(*word);
  words.push_back("TMPDIR=" + program.temporary_folder);
  return words;
}

// Between fork and exec of a program with threads: system calls alone.
[[noreturn]] void become(char* const* arguments, char* const* environment, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kCannotStart);  // it has died before that was said
  const int nothing = ::open("/dev/null", O_RDWR);
  if (nothing >= 0) ::dup2(nothing, STDIN_FILENO), ::dup2(nothing, STDOUT_FILENO);
  if (nothing > STDERR_FILENO) ::close(nothing);
  restore_signals_in_child();
  ::execve(arguments[0], arguments, environment);
  ::_exit(kCannotStart);
}

pid_t start(const ChildProgram& program) {
  const std::vector<std::string> environment_words = environment_of(program);
  const std::vector<char*> arguments = pointers(program.arguments), environment = pointers(environment_words);
  const pid_t parent = ::getpid();
  const HoldSignals hold;  // until it is known whom a signal would have to end
  const pid_t child = ::fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start " + program.arguments.front());
  if (child == 0) become(arguments.data(), environment.data(), parent);
  ::setpgid(child, child);  // here as well: whoever comes first
  set_child_group(child);
  return child;
}

}  // namespace

std::optional<std::string> program_in_path(const std::string& program) {
  const char* given = std::getenv("PATH");
  const std::string path = given ? given : "/usr/local/bin:/usr/bin:/bin";
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find(':', begin), path.size());
    const std::string folder = path.substr(begin, end - begin);
    std::string file = (folder.empty() ? "." : folder) + "/" + program;
    if (::access(file.c_str(), X_OK) == 0) return file;
    begin = end + 1;
  }
  return std::nullopt;
}

Diagnostics missing_renderer(const std::string& engine) {
  if (program_in_path(engine)) return {};
  const bool blender = engine == "blender";
  return {make_error("cli.not-drawn",
                     fmt::format("{} is not installed: there is no {} on the path", blender ? "Blender" : "POV-Ray", engine),
                     fmt::format("Debian: apt-get install {}", blender ? "blender python3-numpy" : "povray"))};
}

int run_child(const ChildProgram& program) {
  const pid_t child = start(program);
  siginfo_t ended{};
  while (::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  const HoldSignals hold;
  ::kill(-child, SIGKILL);  // what it has left; its own number is not free for others before it has been waited for
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  set_child_group(0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace orbc::cli
