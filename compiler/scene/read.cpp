// From text to scene: first the document (read_yaml.cpp), then its parts (read_*.cpp), then the checks of the whole scene (check.cpp).
#include "compiler/scene/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "compiler/scene/check.h"
#include "compiler/scene/defaults.h"
#include "compiler/scene/parsed_notation.h"
#include "compiler/scene/readers.h"

namespace orbc::scene {
namespace {

constexpr std::size_t kMaxReported = 100;  // more errors help nobody and take long to print
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

void read_version(const Fields& fields) {
  fields.require("orbc", "start the file with `orbc: 1`");
  const Node* node = fields.find("orbc");
  if (!node) return;
  const auto version = number_of(*node);
  if (!version) fields.reader().wrong_type(*node, "`orbc`", "the version of the file format, the number 1");
  else if (*version != 1)
    fields.reader().error(
        "scene.wrong-version", node->span,
        fmt::format("this file has version {} of the scene format, this program reads version 1", node->text.substr(0, 40)),
        "write `orbc: 1`");
}

std::optional<notation::Orbifold> read_orbifold(const Fields& fields, bool allow_non_orbifold) {
  Reader& reader = fields.reader();
  fields.require("orbifold", "say which room this is: orbifold: \"*22222\"");
  const Node* node = fields.find("orbifold");
  if (!node) return std::nullopt;
  const auto text = reader.text(*node, "`orbifold`");
  if (!text) return std::nullopt;
  ParsedNotation read = parse_notation(*text, allow_non_orbifold, node->span);
  reader.diagnostics.insert(reader.diagnostics.end(), read.diagnostics.begin(), read.diagnostics.end());
  return read.orbifold;
}

Node empty_map() {
  Node node;
  node.kind = NodeKind::map;
  return node;
}

int horizontal_mirrors(const RoomSpec& room) { return (room.floor.mirror ? 1 : 0) + (room.ceiling.mirror ? 1 : 0); }

Scene read_root(Reader& reader, const Node& root) {
  Scene scene;
  scene.span = root.span;
  const Fields fields(reader, root, "the scene",
                      {"orbc", "orbifold", "allow_non_orbifold", "room", "objects", "lights", "ambient", "exposure", "white", "integrator",
                       "rays", "bake", "camera", "cover", "animation"});
  if (!fields.is_map()) return scene;
  read_version(fields);
  scene.allow_non_orbifold = fields.boolean("allow_non_orbifold", false);
  RoomFacts facts;
  if (auto orbifold = read_orbifold(fields, scene.allow_non_orbifold)) {
    scene.orbifold = std::move(*orbifold);
    scene.orbifold_span = fields.find("orbifold")->span;
    facts = room_facts(scene.orbifold);
  }
  const Node empty = empty_map();
  const auto part = [&](std::string_view key) -> const Node& { return fields.has(key) ? *fields.find(key) : empty; };
  scene.room = read_room(reader, part("room"), facts);
  if (fields.has("objects")) scene.objects = read_objects(reader, part("objects"), facts);
  if (fields.has("lights")) scene.lamps = read_lamps(reader, part("lights"), facts);
  scene.ambient = fields.color("ambient", scene.ambient);
  scene.exposure = fields.number("exposure", scene.exposure, {0, 1e6, true});
  scene.integrator =
      fields.choice<Integrator>("integrator", scene.integrator, {{"direct", Integrator::direct}, {"path", Integrator::path}});
  scene.rays = fields.choice<Rays>("rays", scene.rays, {{"curved", Rays::curved}, {"straight", Rays::straight}});
  scene.bake = read_bake(reader, part("bake"), scene.integrator);
  scene.camera = read_camera(reader, part("camera"), facts);
  if (scene.orbifold_span.source) scene.cover.max_bounces = default_max_bounces(scene.orbifold, horizontal_mirrors(scene.room));
  scene.cover = read_cover(reader, part("cover"), scene.cover);
  if (const Node* node = fields.find("animation"))
    scene.animation = std::make_shared<const Animation>(read_animation(reader, *node, facts));
  balance_white(fields, scene);
  return scene;
}

void add_given_keys(const Node& map, const std::string& before, std::vector<GivenKey>& given) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    given.push_back({before + map.keys[i].text, map.keys[i].span});
    if (map.items[i].kind == NodeKind::map) add_given_keys(map.items[i], given.back().path + ".", given);
  }
}

// Sorts by the order of the file, so that an author can work from top to bottom, then by the order of the overrides. Errors without a span
// come first.
void sort_by_place(Diagnostics& diagnostics, const OverrideSources& overrides) {
  const auto place = [&](const Diagnostic& d) {
    const auto found = std::find(overrides.begin(), overrides.end(), d.span.source);
    return std::tuple(found == overrides.end() ? 0 : found - overrides.begin() + 1, d.span.line, d.span.column);
  };
  std::stable_sort(diagnostics.begin(), diagnostics.end(), [&](const Diagnostic& a, const Diagnostic& b) { return place(a) < place(b); });
}

// The value that conflicts with an override is in the file, which need not be changed.
void hint_at_removal(Diagnostics& diagnostics, const OverrideSources& overrides) {
  for (Diagnostic& d : diagnostics)
    if (d.code == "scene.conflict" && std::find(overrides.begin(), overrides.end(), d.span.source) != overrides.end())
      d.hint = "say the whole map, or remove the other key first: KEY= without a value removes it";
}

Diagnostics limited(Diagnostics diagnostics, const OverrideSources& overrides) {
  if (diagnostics.size() <= kMaxReported) return diagnostics;
  const std::size_t more = diagnostics.size() - kMaxReported;
  std::stable_partition(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& d) { return d.severity == Severity::error; });
  diagnostics.resize(kMaxReported);
  sort_by_place(diagnostics, overrides);
  diagnostics.push_back(make_note("scene.too-many-errors", fmt::format("{} more are not shown", more)));
  return diagnostics;
}

bool is_error(const Diagnostic& diagnostic) { return diagnostic.severity == Severity::error; }

// The folder to which paths in a scene are relative. A pipe (`orbc check <(…)` is /dev/fd/63) belongs to the current folder.
std::string folder_of(const std::filesystem::path& path) {
  std::error_code error;
  const std::string text = path.string();
  const bool device = text.rfind("/dev/", 0) == 0 || text.rfind("/proc/", 0) == 0;
  return device || !std::filesystem::is_regular_file(path, error) ? "." : path.parent_path().string();
}

// The text without a byte order mark.
std::shared_ptr<const SourceText> without_bom(const std::shared_ptr<const SourceText>& source) {
  if (source->text.compare(0, kByteOrderMark.size(), kByteOrderMark) != 0) return source;
  return std::make_shared<const SourceText>(SourceText{source->name, source->text.substr(kByteOrderMark.size())});
}

// In: a text without a byte order mark.
Result<ReadResult> read_without_bom(const std::shared_ptr<const SourceText>& source, const std::string& folder, const Overrides& texts) {
  const OverrideSources overrides = sources_of(texts);
  Result<Document> document = parse_document(source);
  if (!document) return document.error();
  Reader reader;
  reader.diagnostics = std::move(document->faults);
  Diagnostics faults = apply_overrides(overrides, *document);
  std::move(faults.begin(), faults.end(), std::back_inserter(reader.diagnostics));
  ReadResult read{read_root(reader, document->root), {}};
  read.scene.folder = folder;
  add_given_keys(document->root, "", read.scene.given_keys);
  if (std::none_of(reader.diagnostics.begin(), reader.diagnostics.end(), is_error) || read.scene.orbifold_span.source) {
    Diagnostics found = check(read.scene);
    std::move(found.begin(), found.end(), std::back_inserter(reader.diagnostics));
  }
  hint_at_removal(reader.diagnostics, overrides);
  sort_by_place(reader.diagnostics, overrides);
  if (has_error(reader.diagnostics)) return limited(std::move(reader.diagnostics), overrides);
  read.notes = limited(std::move(reader.diagnostics), overrides);
  return read;
}

}  // namespace

RoomFacts room_facts(const notation::Orbifold& orbifold) {
  const bool right_angles = std::all_of(orbifold.corners.begin(), orbifold.corners.end(), [](const Rational& k) { return k == 2; });
  return {wall_count(orbifold), corner_count(orbifold), orbifold, curvature_sign(orbifold) == 0,
          orbifold.corners.size() == 4 && right_angles};
}

Result<ReadResult> read_scene(const std::shared_ptr<const SourceText>& source, const std::string& folder, const Overrides& overrides) {
  return read_without_bom(without_bom(source), folder, overrides);
}

Result<ReadResult> read_scene(const SourceText& source, const std::string& folder, const Overrides& overrides) {
  return read_scene(std::make_shared<const SourceText>(source), folder, overrides);
}

Result<Document> document_of(const SceneText& text, const Overrides& overrides) {
  Result<Document> document = parse_document(without_bom(text.source));
  if (!document) return document;
  Diagnostics found = apply_overrides(sources_of(overrides), *document);
  if (has_error(found)) return found;
  return document;
}

Result<SceneText> open_scene(const std::string& path) {
  const auto cannot_read = [&](const std::string& why) {
    return make_error("scene.cannot-read", fmt::format("cannot read the scene {}: {}", path, why),
                      "give the path of a scene file; `orbc new '*2323'` writes one");
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return cannot_read("it is a folder");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) return cannot_read(errno != 0 ? std::strerror(errno) : "it cannot be opened");
  const std::size_t limit = DocumentLimits{}.bytes;
  std::string text(limit + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) return cannot_read("reading failed");
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > limit)
    return make_error("scene.too-large", fmt::format("{} has more bytes than a scene may have ({})", path, limit),
                      "put big data into mesh files");
  return SceneText{std::make_shared<const SourceText>(SourceText{path, std::move(text)}), folder_of(path)};
}

Result<ReadResult> load_scene(const std::string& path, const Overrides& overrides) {
  const auto text = open_scene(path);
  if (!text) return text.error();
  return read_scene(text->source, text->folder, overrides);
}

}  // namespace orbc::scene
