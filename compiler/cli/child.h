#pragma once
#include <optional>
#include <string>
#include <vector>

#include "compiler/base/diagnostic.h"

namespace orbc::cli {

/// A program of this installation or machine, and what it is started with.
struct ChildProgram {
  std::vector<std::string> arguments;  ///< the program's path first
  std::string temporary_folder;        ///< its TMPDIR: what it leaves there goes with ours
};

/// The path of a program that is found on PATH, or nothing.
[[nodiscard]] std::optional<std::string> program_in_path(const std::string& program);

/// What is to be told before the work when a renderer ("povray" or "blender") is not installed; nothing when it is.
/// Diagnostics: cli.not-drawn.
[[nodiscard]] Diagnostics missing_renderer(const std::string& engine);

/// Runs a program in a process group of its own and waits for it. It reads nothing, its standard output is thrown away, standard error is
/// ours. Whatever it has started ends with it, and all of it ends when this program does, by a signal or even by SIGKILL.
/// Makes: its exit code, 128 + the number of the signal that has ended it, or 127 when it cannot be started.
[[nodiscard]] int run_child(const ChildProgram& program);

}  // namespace orbc::cli
