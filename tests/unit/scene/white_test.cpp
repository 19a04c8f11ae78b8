#include <catch2/catch.hpp>

#include "compiler/scene/read.h"

using namespace orbc;
using namespace orbc::scene;

namespace {

Scene read(const std::string& more) {
  return read_scene(SourceText{"white",
                               "orbc: 1\norbifold: \"*2222\"\nlights: [{at: {z: 0.5}, temperature: 3000}]\nambient: \"#222222\"\n" + more},
                    "")
      .value()
      .scene;
}

}  // namespace

TEST_CASE("light of the white point's own colour looks white, and keeps its luminance", "[scene]") {
  const Color plain = read("").lamps[0].color, balanced = read("white: 3000\n").lamps[0].color;
  CHECK(plain.r > 2 * plain.b);
  CHECK(balanced.r == Approx(balanced.g));
  CHECK(balanced.r == Approx(balanced.b));
  CHECK(balanced.g == Approx(0.2126 * plain.r + 0.7152 * plain.g + 0.0722 * plain.b));
  const Color ambient = read("white: 3000\n").ambient;
  CHECK(ambient.b > ambient.r);
}

TEST_CASE("a white point may be a colour, and what glows is divided by it", "[scene]") {
  const std::string glowing = "objects: [{sphere: {}, at: centre, material: {kind: emissive, color: wheat}}]\n";
  const Color c = read(glowing + "white: wheat\n").objects[0].material->color;
  CHECK(c.r == Approx(c.g));
  CHECK(c.r == Approx(c.b));
  const Color matte = read("objects: [{sphere: {}, at: centre, material: wheat}]\nwhite: wheat\n").objects[0].material->color;
  CHECK(matte.r > matte.b);
}

TEST_CASE("a white point is of use where anything glows or surfaces pass light on, also at the command line's word", "[scene]") {
  const auto notes = [](const std::string& more, const Overrides& overrides) {
    const auto read_in = read_scene(SourceText{"white", "orbc: 1\norbifold: \"*2222\"\n" + more}, "", overrides);
    std::string codes;
    for (const Diagnostic& note : read_in->notes) codes += note.code + " ";
    return codes;
  };
  CHECK(notes("white: 3000\n", {}) == "scene.no-effect ");
  CHECK(notes("white: 3000\n", {{"path", "integrator=path"}}) == "");
  CHECK(notes("white: 3000\nobjects: [{sphere: {}, at: centre, material: {kind: emissive, color: wheat}}]\n", {}) == "");
  CHECK(notes("white: 3000\nroom: {walls: {all: {mirror: {glow: gray}}}}\n", {}) == "");
  CHECK(notes("bake: {seed: 3}\n", {}) == "scene.no-effect ");
  CHECK(notes("bake: {seed: 3}\n", {{"path", "integrator=path"}}) == "");
  CHECK(notes("integrator: path\nbake: {seed: 3}\n", {{"direct", "integrator=direct"}}) == "scene.no-effect ");
}
