// The designer's page: `orbc compile s.yaml -o s.html` and `orbc design`.
#include "compiler/cli/page.h"

#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "compiler/cli/output.h"
#include "compiler/cli/result.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"
#include "compiler/driver/load.h"
#include "compiler/mesh_io/load.h"
#include "exporters/html/write_html.h"

namespace orbc::cli {
namespace {

/// The page without a scene, as scripts/web builds it.
Result<std::string> empty_page() {
  if (const auto path = shipped_file("designer.html")) {
    std::ifstream file(*path, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  }
  return make_error("html.no-page", "the designer's page has not been built",
                    "scripts/web builds it; a package that is made after that has it");
}

/// The text of a scene: of every scene that was read, some span has it.
std::string text_of(const scene::Scene& scene) { return scene.span.source ? scene.span.source->text : std::string(); }

/// Has the desktop show a file, in a session of its own: the browser stays when this program has ended.
/// Makes: false if there is no xdg-open.
bool start_browser(const std::string& file) {
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  std::string program = "xdg-open", path = file;
  char* argv[] = {program.data(), path.data(), nullptr};
  pid_t child = 0;
  const bool started = posix_spawnp(&child, program.c_str(), nullptr, &attributes, argv, environ) == 0;
  posix_spawnattr_destroy(&attributes);
  return started;
}

int write(const html::PageScene& scene, const std::string& output, const Diagnostics& notes, const Common& common) {
  const auto page = empty_page();
  if (!page) return print(page.error(), common), kMachine;
  const auto file = html::write_html(*page, scene);
  if (!file)
    return print({make_error("html.no-page", "the designer's page has no place for a scene", "scripts/web builds it anew")}, common),
           kMachine;
  write_output(output, file->bytes);
  print_result({{"output", output}, {"format", "html"}, {"bytes", file->bytes.size()}}, notes, common);
  if (!common.quiet)
    print_message(fmt::format("{}: {:.2f} MB, {} {} within\n", shown(output), static_cast<double>(file->bytes.size()) / 1e6,
                              scene.files.size(), scene.files.size() == 1 ? "file" : "files"));
  return kDone;
}

int write_scene(const SceneArguments& arguments, const std::string& output, const Common& common) {
  check_outputs({output});
  const scene::Overrides overrides = overrides_of(arguments);
  if (!overrides.empty()) throw UsageError("the page holds the text of the scene: say in the scene what --set and its like would change");
  const auto loaded = driver::load(arguments.scene, overrides, parse_bytes(common.max_memory));
  if (!loaded) return print(loaded.error(), common), kSceneWrong;
  refuse_inputs({output}, loaded->files);
  print(loaded->notes, common);
  const mesh::AssetSource assets = mesh_io::assets_from_files(mesh_io::bounds_within(parse_bytes(common.max_memory)));
  const auto scene = html::page_scene(text_of(loaded->scene), loaded->scene, loaded->interior->polygon, assets);
  if (!scene) return print(scene.error(), common), kSceneWrong;
  return write(*scene, output, loaded->notes, common);
}

}  // namespace

int write_page(const CompileArguments& a, const Common& common) { return write_scene(a.scene, a.output, common); }

int design(const DesignArguments& a, const Common& common) {
  namespace fs = std::filesystem;
  const std::string stem = a.scene.empty() || a.scene == "-" ? "orbc" : fs::path(a.scene).stem().string();
  const std::string output = a.output.empty() ? (fs::temp_directory_path() / (stem + "-designer.html")).string() : a.output;
  SceneArguments scene;
  scene.scene = a.scene;
  const int code = a.scene.empty() ? write({}, output, {}, common) : write_scene(scene, output, common);
  if (code != kDone || !a.open || output == "-") return code;
  if (!start_browser(output) && !common.quiet) print_message(fmt::format("no browser could be started; open {} in one\n", shown(output)));
  return kDone;
}

}  // namespace orbc::cli
