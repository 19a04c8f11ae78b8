// Every starter scene is right: written, read, realised, furnished, compiled and drawn.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "compiler/driver/compile.h"
#include "compiler/driver/threads.h"
#include "compiler/driver/trace_film.h"
#include "compiler/notation/enumerate.h"
#include "compiler/notation/parse.h"
#include "compiler/notation/print.h"
#include "compiler/room/realise.h"
#include "compiler/room/view.h"
#include "compiler/scene/starter.h"

using namespace orbc;

namespace {

/// A scene file that is gone afterwards.
struct StarterFile {
  StarterFile() {
    std::string name = (std::filesystem::temp_directory_path() / "orbc-starter.XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    folder = name;
  }
  StarterFile(const StarterFile&) = delete;
  StarterFile& operator=(const StarterFile&) = delete;
  ~StarterFile() { std::filesystem::remove_all(folder); }
  [[nodiscard]] std::string write(const std::string& text) const {
    std::ofstream(folder / "scene.yaml") << text;
    return (folder / "scene.yaml").string();
  }
  std::filesystem::path folder;
};

std::string starter_of(const notation::Orbifold& orbifold) {
  const auto room = room::realise(orbifold, {}, true);
  if (!room) FAIL(notation::to_text(orbifold) << ": " << to_text(room.error()));
  return scene::starter_scene(
      {notation::to_text(orbifold), static_cast<int>(room->walls.size()), room->inradius, room::view_direction(*room)});
}

/// What is wrong with a starter scene as `orbc check` sees it, or nothing.
std::string fault_of_starter(const notation::Orbifold& orbifold, const StarterFile& file) {
  const std::string text = starter_of(orbifold);
  const auto loaded = driver::load(file.write(text));
  if (!loaded) return to_text(loaded.error());
  return to_text(loaded->notes);
}

void draw_starter(const notation::Orbifold& orbifold, const StarterFile& file, const Executor& executor) {
  const scene::Overrides small{{"<size>", "camera.size=[64, 48]"}, {"<quality>", "bake.quality=draft"}};
  const auto loaded = driver::load(file.write(starter_of(orbifold)), small);
  REQUIRE(loaded);
  driver::CompileOptions options;
  options.highlights = false;  // a starter may have glass: that takes minutes where many are drawn
  const auto compiled = driver::compile(*loaded, options, executor);
  if (!compiled) FAIL(to_text(compiled.error()));
  CHECK(compiled->report.triangles > 0);
  CHECK(compiled->report.copies >= 2);
  CHECK(compiled->report.copies <= 3000);
  const render::Film film = driver::trace_film(*loaded, {}, executor);
  double brightest = 0;
  for (const scene::Color& color : film.color) brightest = std::max(brightest, scene::max_channel(color));
  CHECK(brightest > 0.1);
}

/// All of few corners; of more a sample with a seed.
std::vector<notation::Orbifold> symbols_up_to_order_12() {
  std::vector<notation::Orbifold> all;
  for (int corners = 1; corners <= 4; ++corners) {  // one corner: *
    const auto listed = notation::enumerate(corners, 12, [&](const notation::Orbifold& o, geometry::Space) {
      all.push_back(o);
      return true;
    });
    REQUIRE(listed);
  }
  std::mt19937_64 random(12);
  for (int i = 0; i < 60; ++i) {
    notation::Orbifold o;
    for (std::uint64_t corner = 0, corners = 5 + random() % 8; corner < corners; ++corner) o.corners.emplace_back(2 + random() % 11);
    all.push_back(o);
  }
  return all;
}

std::vector<notation::Orbifold> real_symbols() {
  std::vector<notation::Orbifold> all;
  const notation::ParseOptions real{{}, true};
  for (const char* text : {"*(3/2)(12)(12)", "*(2.5)(2.5)(2.5)(2.5)(2.5)", "*(2.5)44", "*(5/2)(5/2)5", "*(3/2)(3/2)(3/2)", "*(2.0000001)33",
                           "*(7/3)(7/3)(7/3)(7/3)", "*(7/2)(7/2)", "*2 2 2 2 (5/2)", "*(11/10)777"})
    if (const auto o = notation::parse(text, real)) all.push_back(*o);
  std::mt19937_64 random(77);
  const std::size_t fixed = all.size();
  while (all.size() < fixed + 25) {
    notation::Orbifold o;
    for (std::uint64_t corner = 0, corners = 3 + random() % 4; corner < corners; ++corner)
      o.corners.emplace_back(Integer(5 + random() % 30), Integer(1 + random() % 4));
    if (room::realise(o, {}, true)) all.push_back(o);
  }
  return all;
}

}  // namespace

TEST_CASE("the starter scene of every orbifold passes check without a word", "[driver][long]") {
  const StarterFile file;
  std::vector<notation::Orbifold> symbols = symbols_up_to_order_12();
  for (const char* text : {"**", "*22(120)", "*22(1000)", "*(120)(120)", "*(1000)(1000)", "*23(1000)"})
    symbols.push_back(notation::parse(text).value());
  for (notation::Orbifold& o : real_symbols()) symbols.push_back(std::move(o));
  std::vector<std::string> wrong;
  for (const notation::Orbifold& o : symbols) {
    const std::string fault = fault_of_starter(o, file);
    if (!fault.empty()) wrong.push_back(notation::to_text(o) + ": " + fault);
  }
  INFO(wrong.size() << " of " << symbols.size() << " are wrong, such as " << (wrong.empty() ? "" : wrong.front()));
  CHECK(wrong.empty());
}

TEST_CASE("the starter scene of every kind of room is compiled and drawn", "[driver][long]") {
  const StarterFile file;
  const Executor executor = driver::parallel_executor();
  std::vector<notation::Orbifold> symbols;
  for (const char* text : {"*",    "**",   "*22",  "*(12)(12)", "*222", "*22(12)", "*22(120)",      "*233",  "*234",   "*235",
                           "*333", "*244", "*236", "*2222",     "*237", "*23(12)", "*(12)(12)(12)", "*2223", "*22222", "*(12)(12)(12)(12)"})
    symbols.push_back(notation::parse(text).value());
  std::vector<notation::Orbifold> listed = symbols_up_to_order_12();
  std::mt19937_64 random(5);
  for (int i = 0; i < 12; ++i) symbols.push_back(listed[random() % listed.size()]);
  std::vector<notation::Orbifold> real = real_symbols();
  for (std::size_t i = 0; i < real.size(); i += i < 10 ? 1 : 4) symbols.push_back(real[i]);
  for (const notation::Orbifold& o : symbols) {
    INFO(notation::to_text(o));
    draw_starter(o, file, executor);
  }
}
