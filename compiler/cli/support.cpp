#include "compiler/cli/support.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "compiler/cli/streams.h"

namespace orbc::cli {

void print(const Diagnostics& diagnostics, const Common& common) {
  std::string text;
  const auto is_printed = [&](const Diagnostic& d) {
    const bool asks = d.severity == Severity::warning || !d.hint.empty();  // a note with a hint has something to do for the author
    return d.severity == Severity::error || (asks && !common.quiet) || common.verbose;
  };
  for (const Diagnostic& d : diagnostics)
    if (is_printed(d)) text += to_text(d);
  print_message(text);
  if (common.json && has_error(diagnostics)) write_standard_output("{\"diagnostics\": " + to_json(diagnostics) + "}\n");
}

std::string shown(const std::string& output) { return output == "-" ? "standard output" : output; }

void append(Diagnostics& to, const Diagnostics& more) { to.insert(to.end(), more.begin(), more.end()); }

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::array<int, 2> parse_size(const std::string& text) {
  std::array<int, 2> size{};
  const char* at = text.data();
  const char* end = at + text.size();
  for (int i = 0; i < 2; ++i) {
    const auto [next, error] = std::from_chars(at, end, size[static_cast<std::size_t>(i)]);
    const bool separated = i == 0 ? next != end && (*next == 'x' || *next == 'X') : next == end;
    if (error != std::errc() || !separated || size[static_cast<std::size_t>(i)] < 1 || size[static_cast<std::size_t>(i)] > 32768)
      throw UsageError("--size wants WIDTHxHEIGHT in pixels, each 1 to 32768, such as 800x600; got " + text);
    at = next + 1;
  }
  if (static_cast<std::int64_t>(size[0]) * size[1] > std::int64_t{1} << 28)
    throw UsageError("--size " + text + " is more than 2^28 pixels");
  return size;
}

std::uint64_t parse_bytes(const std::string& text) {
  static const std::array<std::pair<const char*, double>, 7> kUnits{
      {{"", 1}, {"KiB", 1024.0}, {"MiB", 1048576.0}, {"GiB", 1073741824.0}, {"k", 1e3}, {"M", 1e6}, {"G", 1e9}}};
  double value = 0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string unit(next, text.data() + text.size());
  for (const auto& [name, factor] : kUnits)
    if (error == std::errc() && unit == name && value > 0 && value * factor < 1e18) return static_cast<std::uint64_t>(value * factor);
  throw UsageError("--max-memory wants a size such as 512MiB or 4GiB; got " + text);
}

scene::Overrides overrides_of(const SceneArguments& a) {
  scene::Overrides overrides;
  const auto add_override = [&](const char* option, const char* key, const std::string& value) {
    if (!value.empty()) overrides.push_back({fmt::format("<{}>", option), fmt::format("{}={}", key, value)});
  };
  if (!a.size.empty()) {
    const std::array<int, 2> size = parse_size(a.size);
    add_override("--size", "camera.size", fmt::format("[{}, {}]", size[0], size[1]));
  }
  if (a.max_bounces) add_override("--max-bounces", "cover.max_bounces", std::to_string(*a.max_bounces));
  add_override("--projection", "camera.projection", a.projection);
  add_override("--rays", "rays", a.rays);
  add_override("--integrator", "integrator", a.integrator);
  add_override("--atlas", "bake.atlas", a.atlas);
  add_override("--lights", "bake.lights", a.lights);
  add_override("--quality", "bake.quality", a.quality);
  add_override("--expected-background", "cover.background", a.expected_background ? "expected" : "");
  append_set(a.set, overrides);
  return overrides;
}

void append_set(const std::vector<std::string>& set, scene::Overrides& overrides) {
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (set[i].find('=') == std::string::npos)
      throw UsageError(fmt::format("--set takes KEY=VALUE, such as camera.fov=60deg; got {}", set[i]));
    overrides.push_back({fmt::format("<--set {}>", i + 1), set[i]});
  }
}

std::optional<std::string> shipped_file(const std::string& name) {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  // Installed as the build said, or beside a build folder's bin/: share/orbc stands in both.
  for (const char* data : {ORBC_DATA_FROM_PROGRAM, "../share/orbc"}) {
    const std::filesystem::path found = (program.parent_path() / data / name).lexically_normal();
    if (std::filesystem::exists(found, ignored)) return found.string();
  }
  return std::nullopt;
}

std::string shipped_script(const std::string& name) {
  if (auto found = shipped_file(name)) return *found;
  throw std::runtime_error("cannot find " + name + ", which belongs to orbc; was it moved without its share/orbc folder?");
}

}  // namespace orbc::cli
