// Files beside the main output are called by their content (exporters/side_file.h). So an old and a new export never share one, and
// whenever the program is ended, or the machine, the main output is an old or a new one with all that belongs to it.
#include "compiler/cli/write_export.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "compiler/cli/output.h"
#include "compiler/files/files.h"
#include "exporters/side_file.h"

namespace orbc::cli {
namespace {

namespace fs = std::filesystem;

bool is_input(const fs::path& file, const std::vector<std::string>& inputs) {
  std::error_code ignored;
  return std::any_of(inputs.begin(), inputs.end(), [&](const std::string& input) { return fs::equivalent(file, input, ignored); });
}

// To be called when the folder is locked: another run may have written its side files, and its main output not yet.
void remove_old_side_files(const std::vector<driver::File>& files, const ExportTarget& target, const std::vector<std::string>& inputs) {
  const fs::path parent = fs::path(target.output).parent_path(), folder = parent.empty() ? "." : parent;
  const std::string stem = stem_of(target.output), start = exporters::plain_name(stem);
  std::error_code ignored;
  std::vector<fs::path> old;
  for (fs::directory_iterator it(folder, ignored), end; !ignored && it != end; it.increment(ignored)) {
    const std::string name = it->path().filename().string();
    const bool current = std::any_of(files.begin(), files.end(), [&](const driver::File& file) { return file.name == name; });
    if (current || name.rfind(start, 0) != 0 || !exporters::looks_like_side_file(name) || is_input(it->path(), inputs)) continue;
    const auto bytes = files::read_file(it->path().string(), std::uint64_t{8} << 30);
    if (bytes && exporters::is_side_file(name, *bytes, stem, target.format->name)) old.push_back(it->path());
  }
  for (const fs::path& path : old) fs::remove(path, ignored);
}

}  // namespace

std::string stem_of(const std::string& output) {
  const std::string stem = is_stream(output) ? "scene" : fs::path(output).stem().string();
  return stem.empty() ? "scene" : stem;
}

std::uint64_t write_export(const std::vector<driver::File>& files, const ExportTarget& target, const std::vector<std::string>& inputs) {
  const fs::path folder = fs::path(target.output).parent_path();
  std::vector<OutputFile> set;
  for (const driver::File& file : files)
    if (!file.name.empty()) set.push_back({(folder / file.name).string(), file.bytes});
  if (!target.report.empty()) set.push_back({target.report, target.report_json});
  std::uint64_t bytes = 0;
  for (const driver::File& file : files)
    if (file.name.empty()) set.push_back({target.output, file.bytes}), bytes = file.bytes.size();
  std::optional<FolderLock> lock;
  if (target.format->has_side_files && !is_stream(target.output)) lock.emplace(folder);
  write_together(set, [&] {
    if (lock && lock->held()) remove_old_side_files(files, target, inputs);
  });
  return bytes;
}

}  // namespace orbc::cli
