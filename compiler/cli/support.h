#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "compiler/base/diagnostic.h"
#include "compiler/cli/commands.h"
#include "compiler/driver/load.h"

namespace orbc::cli {

inline constexpr int kDone = 0, kSceneWrong = 1, kUsage = 2, kMachine = 3;

/// A mistake on the command line that CLI11 cannot see; main prints it and exits with 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Prints errors (and, unless quiet, warnings; with verbose, notes) to standard error; with --json errors also go to standard output as
/// JSON.
void print(const Diagnostics& diagnostics, const Common& common);
[[nodiscard]] std::string to_json(const Diagnostics& diagnostics);

/// How messages name where something is written.
[[nodiscard]] std::string shown(const std::string& output);
void append(Diagnostics& to, const Diagnostics& more);

/// Of the letters a to z, in any locale.
[[nodiscard]] std::string lower_case(std::string text);

/// "800x600". Throws UsageError.
[[nodiscard]] std::array<int, 2> parse_size(const std::string& text);
/// "512MiB", "4GiB", "1e9", plain bytes. Throws UsageError.
[[nodiscard]] std::uint64_t parse_bytes(const std::string& text);
/// What is said instead of the scene: the options that stand for one key each, then --set, which has the last word. Throws UsageError.
[[nodiscard]] scene::Overrides overrides_of(const SceneArguments& arguments);
/// The texts of --set. Throws UsageError where there is no equal sign.
void append_set(const std::vector<std::string>& set, scene::Overrides& overrides);

/// The comment from which editors (yaml-language-server) know how scenes are written: it names the schema of this installation, or a file
/// beside the scene where there is none.
[[nodiscard]] std::string schema_line();

/// A file that ships with orbc: in share/orbc of the installation, or of the build folder; nothing if it is not there.
[[nodiscard]] std::optional<std::string> shipped_file(const std::string& name);
/// A script that ships with orbc (povray-pipe, render_blender.py): beside the sources, or in share/orbc of the installation.
[[nodiscard]] std::string shipped_script(const std::string& name);

}  // namespace orbc::cli
