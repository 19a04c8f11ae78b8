// How far mirrors are followed when a scene does not say.
#include "compiler/scene/defaults.h"

#include <catch2/catch.hpp>

#include "compiler/notation/enumerate.h"
#include "compiler/notation/growth.h"
#include "compiler/notation/parse.h"
#include "compiler/notation/print.h"
#include "compiler/scene/read.h"

using namespace orbc;

namespace {

notation::Orbifold any_orbifold(const std::string& text) { return notation::parse(text, {{}, true}).value(); }
int default_bounces(const std::string& text, int horizontal_mirrors = 0) {
  return scene::default_max_bounces(any_orbifold(text), horizontal_mirrors);
}

}  // namespace

TEST_CASE("a hyperbolic scene that says nothing shows at most 200 copies, and with one bounce more would show more", "[scene]") {
  for (int corners = 3; corners <= 5; ++corners) {
    const auto listed = notation::enumerate(corners, corners == 5 ? 4 : 9, [&](const notation::Orbifold& o, geometry::Space space) {
      if (space != geometry::Space::hyperbolic) return true;
      const int bounces = scene::default_max_bounces(o);
      INFO(notation::to_text(o) << ": " << bounces << " bounces");
      CHECK(notation::copies_up_to(o, bounces) <= 200);
      CHECK(notation::copies_up_to(o, bounces + 1) > 200);
      return true;
    });
    REQUIRE(listed);
  }
  CHECK(default_bounces("*22222") == 4);
  CHECK(default_bounces("*237") == 11);   // 198 copies
  // Where the first bounce alone shows more: it is shown.
  notation::Orbifold widest;
  widest.corners.assign(256, Rational(2));
  CHECK(scene::default_max_bounces(widest) == 1);
}

TEST_CASE("a spherical scene that says nothing shows the whole group", "[scene]") {
  for (const char* text : {"*", "*22", "*66", "*(13)(13)", "*222", "*22(50)", "*22(120)", "*233", "*234", "*235", "*(500)(500)"}) {
    const notation::Orbifold o = any_orbifold(text);
    const int bounces = scene::default_max_bounces(o);
    INFO(text << ": " << bounces << " bounces");
    CHECK(bounces >= 12);
    CHECK(notation::copies_up_to(o, bounces) == *notation::group_order(o));
  }
  CHECK(default_bounces("*235") == 15);
  // Of larger groups as many as 1000 copies.
  CHECK(notation::copies_up_to(any_orbifold("*(1000000)(1000000)"), default_bounces("*(1000000)(1000000)")) <= 1000);
  CHECK(default_bounces("*22(999999)") >= 200);
}

TEST_CASE("a flat scene that says nothing follows 12 bounces", "[scene]") {
  for (const char* text : {"**", "*333", "*244", "*236", "*2222", "*(5/2)(5/2)5"}) CHECK(default_bounces(text) == 12);
}

TEST_CASE("rooms with real corners follow as many bounces as the orbifold of the next integers", "[scene]") {
  CHECK(default_bounces("*(2.5)(2.5)(2.5)(2.5)(2.5)") == default_bounces("*33333"));
  CHECK(default_bounces("*(3/2)(12)(12)") == default_bounces("*2(12)(12)"));
  CHECK(default_bounces("*(3/2)(3/2)(3/2)") == 12);   // a sphere's
}

TEST_CASE("storeys of a hyperbolic room count among its copies", "[scene]") {
  CHECK(default_bounces("*22222", 2) < default_bounces("*22222"));
  CHECK(default_bounces("*22222", 1) <= default_bounces("*22222"));
  CHECK(default_bounces("*235", 2) == 15);
}

TEST_CASE("the reader takes the default of the room that it has read, unless the scene says otherwise", "[scene]") {
  const auto bounces = [](const std::string& text) {
    const auto read = scene::read_scene(SourceText{"scene.yaml", text});
    REQUIRE(read);
    return read->scene.cover.max_bounces;
  };
  CHECK(bounces("orbc: 1\norbifold: \"*22222\"\n") == 4);
  CHECK(bounces("orbc: 1\norbifold: \"*235\"\ncover: {background: gray}\n") == 15);
  CHECK(bounces("orbc: 1\norbifold: \"*333\"\n") == 12);
  CHECK(bounces("orbc: 1\norbifold: \"*22222\"\ncover: {max_bounces: 7}\n") == 7);
  CHECK(bounces("orbc: 1\norbifold: \"*22222\"\nroom: {floor: {mirror: {}}, ceiling: {mirror: {}}}\n") == default_bounces("*22222", 2));
  CHECK(bounces("orbc: 1\nallow_non_orbifold: true\norbifold: \"*(2.5)(2.5)(2.5)(2.5)(2.5)\"\n") == default_bounces("*33333"));
}
