// Scenes without lights look flat: a note says why, and the line it offers works.
#include "compiler/driver/unlit.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "compiler/driver/trace_film.h"

using namespace orbc;

namespace {

Result<driver::LoadedScene> open_text(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / ("orbc-unlit-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(path) << text;
  auto done = driver::load(path.string());
  std::filesystem::remove(path);
  return done;
}

std::string room_text(const std::string& notation, double height, const std::string& more = "") {
  return "orbc: 1\norbifold: \"" + notation + "\"\nroom: {height: " + std::to_string(height) + "}\ncamera: {size: [16, 12]}\n" + more;
}

/// The line of the hint.
std::string offered_line(const Diagnostics& notes) {
  REQUIRE(notes.size() == 1);
  const std::size_t at = notes[0].hint.find("lights: [");
  INFO(notes[0].hint);
  REQUIRE(at != std::string::npos);
  return notes[0].hint.substr(at) + "\n";
}

double mean_of_film(const render::Film& film) {
  double sum = 0;
  for (const scene::Color& color : film.color) sum += (color.r + color.g + color.b) / 3;
  return sum / static_cast<double>(film.color.size());
}

}  // namespace

TEST_CASE("a scene without lights gets a note with a line that lights it well, in rooms of every kind", "[driver]") {
  const std::string knot = "objects:\n  - torus: {radius: 0.02, tube: 0.004}\n";
  const std::string full =
      "objects:\n  - {cylinder: {radius: 0.2, height: 0.95}, at: centre}\ncamera: {at: {polar: [0.4, 10deg]}, size: [16, 12]}\n";
  for (const auto& [notation, height, more] : {std::tuple{"*", 0.8, knot},
                                               {"**", 1.0, knot},
                                               {"*22", 0.7, knot},
                                               {"*222", 0.9, knot},
                                               {"*235", 0.2, knot},
                                               {"*22(30)", 0.05, std::string()},
                                               {"*333", 1.4, knot},
                                               {"*2222", 0.3, knot},
                                               {"*2222", 8.0, knot},
                                               {"*237", 0.15, knot},
                                               {"*22222", 0.9, knot},
                                               {"*23456789(10)(11)", 1.6, knot},
                                               {"*(100)(100)", 0.02, std::string()}}) {
    const auto flat = open_text(room_text(notation, height, more));
    if (!flat) FAIL(to_text(flat.error()));
    const Diagnostics notes = driver::unlit_note(*flat);
    const std::string line = offered_line(notes);
    CHECK(notes[0].severity == Severity::note);
    CHECK(notes[0].code == "driver.no-lights");
    CHECK(notes[0].span.line == 2);
    const auto lit = open_text(room_text(notation, height, more + line));
    INFO(notation << " " << line);
    if (!lit) FAIL(to_text(lit.error()));
    CHECK(lit->notes.empty());
    CHECK(driver::unlit_note(*lit).empty());
    // Neither night nor glare. In a room much longer than high the middle is bright and the rest is dim, whatever one lamp gives.
    const bool is_long = (notation == std::string("*2222") && height < 0.5) || notation == std::string("*(100)(100)");
    const double bright = mean_of_film(driver::trace_film(*lit, {}, serial_executor()));
    const double plain = mean_of_film(driver::trace_film(*flat, {}, serial_executor()));
    INFO(bright << " against " << plain);
    CHECK(bright > (is_long ? 0.06 : 0.2) * plain);
    CHECK(bright < 2.5 * plain);
  }
  // An object in the middle of the room: the lamp hangs beside it.
  std::string text = "orbc: 1\norbifold: \"*2222\"\n" + full;
  const auto crammed = open_text(text);
  if (!crammed) FAIL(to_text(crammed.error()));
  const auto lit = open_text(text + offered_line(driver::unlit_note(*crammed)));
  if (!lit) FAIL(to_text(lit.error()));
  CHECK(lit->scene.lamps.size() == 1);
}

TEST_CASE("scenes with lamps, and those whose surfaces pass light on, get no note on light", "[driver]") {
  for (const char* more : {"lights: [{at: centre}]\n", "integrator: path\n"}) {
    const auto lit = open_text(room_text("*2222", 1, more));
    if (!lit) FAIL(to_text(lit.error()));
    CHECK(driver::unlit_note(*lit).empty());
  }
}
