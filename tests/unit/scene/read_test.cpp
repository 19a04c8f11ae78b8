#include <catch2/catch.hpp>

#include "compiler/scene/read.h"

using namespace orbc;
using namespace orbc::scene;

TEST_CASE("the smallest scene is two lines", "[scene]") {
  const auto read = read_scene(SourceText{"s.yaml", "orbc: 1\norbifold: \"*22222\"\n"});
  if (!read) FAIL(to_text(read.error()));
  CHECK(read->scene.room.walls.size() == 5);
}
