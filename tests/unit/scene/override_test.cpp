// What is said instead of a scene is read and checked as if it stood in the file.
#include "compiler/scene/override.h"

#include <catch2/catch.hpp>

#include "compiler/scene/read.h"

using namespace orbc;
using namespace orbc::scene;

namespace {

const char* kScene = R"(orbc: 1
orbifold: "*22222"
room:
  floor: wood
  walls: {all: {mirror: {reflectance: 0.9}}}
objects:
  - {sphere: {radius: 0.1}, name: ball, at: {polar: [0.1, 0deg]}}
  - {mesh: meshes/statue.obj, at: {toward: corner 2, distance: 0.3}}
  - box: {size: [0.1, 0.1, 0.1]}
lights:
  - {at: {polar: [0, 0deg], z: 0.8}, power: 5}
camera: {at: {polar: [0.4, 200deg], z: 0.5}, fov: 80deg}
)";

Result<ReadResult> with(const std::vector<std::string>& said, const std::string& text = kScene) {
  Overrides overrides;
  for (const std::string& one : said) overrides.push_back({"<--set " + std::to_string(overrides.size() + 1) + ">", one});
  return read_scene(SourceText{"s.yaml", text}, "", overrides);
}

Scene changed(const std::vector<std::string>& said, const std::string& text = kScene) {
  auto read = with(said, text);
  if (!read) FAIL(to_text(read.error()));
  return std::move(read->scene);
}

// The first line of the first error, and the hint.
std::string refusal(const std::string& said) {
  const auto read = with({said});
  if (read) return "accepted";
  const std::string text = to_text(read.error().front());
  const std::size_t hint = text.find("\n  hint: ");
  const std::string first = text.substr(0, text.find('\n'));
  return hint == std::string::npos ? first : first + " | " + text.substr(hint + 9, text.find('\n', hint + 1) - hint - 9);
}

}  // namespace

TEST_CASE("any key of a scene can be said instead, by its path", "[scene]") {
  CHECK(changed({"camera.fov=60deg"}).camera.fov.degrees() == Approx(60));
  CHECK(changed({"camera.size=[320, 200]"}).camera.size == std::array<int, 2>{320, 200});
  CHECK(changed({"cover={max_bounces: 3, min_weight: 0.25}"}).cover.max_bounces == 3);
  CHECK(changed({"orbifold=*237"}).orbifold.corners.size() == 3);
  CHECK(changed({"room.height = 1.5 "}).room.height == 1.5);
  CHECK(changed({"camera.at.polar.1=0.25"}).camera.place.floor.index() == changed({}).camera.place.floor.index());
  CHECK(std::get<AtPolar>(changed({"camera.at.polar.1=0.25"}).camera.place.floor).r == 0.25);
}

TEST_CASE("items of lists go by number, objects by name as well", "[scene]") {
  const auto radius = [](const Scene& scene, std::size_t i) { return std::get<SphereSpec>(scene.objects[i].shape).radius; };
  CHECK(radius(changed({"objects.ball.sphere.radius=0.2"}), 0) == 0.2);
  CHECK(radius(changed({"objects.1.sphere.radius=0.2"}), 0) == 0.2);
  CHECK(std::get<AtToward>(changed({"objects.statue.at.distance=0.4"}).objects[1].place.floor).distance == 0.4);
  CHECK(changed({"objects.box.turn=30deg"}).objects[2].turn.degrees() == Approx(30));
  CHECK(changed({"objects.\"ball\".turn=30deg"}).objects[0].turn.degrees() == Approx(30));
  CHECK(changed({"lights.1.power=9"}).lamps[0].power == 9);
  CHECK(changed({"lights.2={at: centre, kind: point}"}).lamps.size() == 2);
  CHECK(radius(changed({"objects.4.sphere={radius: 0.3}"}), 3) == 0.3);
}

TEST_CASE("walls are keys, and so is all of them", "[scene]") {
  const Scene scene = changed({"room.walls.all.mirror.reflectance=0.8", "room.walls.2={mirror: none, color: brown}"});
  CHECK(scene.room.walls[0].mirrors[0].reflectance == 0.8);
  CHECK(scene.room.walls[1].mirrors.empty());
  CHECK(scene.room.walls[1].material.color == *named_color("brown"));
}

TEST_CASE("what is missing on the way is made", "[scene]") {
  const std::string smallest = "orbc: 1\norbifold: \"*22222\"\n";
  CHECK(changed({"camera.fov=60deg"}, smallest).camera.fov.degrees() == Approx(60));
  CHECK(changed({"room.walls.all.mirror.tint=wheat"}, smallest).room.walls[4].mirrors[0].tint == *named_color("wheat"));
  CHECK(changed({"lights.1.at=centre"}, smallest).lamps.size() == 1);
  CHECK(changed({"lights.1.at=centre", "lights.2.at=centre"}, smallest).lamps.size() == 2);
  CHECK(changed({"cover.max_bounces=2"}, smallest + "cover:\n").cover.max_bounces == 2);
}

TEST_CASE("nothing behind the equal sign removes the key", "[scene]") {
  CHECK(changed({"camera.fov="}).camera.fov.degrees() == Approx(75));
  CHECK(changed({"lights=null"}).lamps.empty());
  CHECK(changed({"objects.statue=~"}).objects.size() == 2);
  const auto read = with({"camera.fow="});
  REQUIRE(read);
  REQUIRE(read->notes.size() == 1);
  CHECK(to_text(read->notes[0]).find("<--set 1>:1:8: warning[scene.no-effect]") == 0);
  CHECK(read->notes[0].hint == "did you mean `fov`?");
}

TEST_CASE("the last word counts, and later words build on earlier ones", "[scene]") {
  CHECK(changed({"cover.max_bounces=3", "cover.max_bounces=4"}).cover.max_bounces == 4);
  CHECK(changed({"objects.ball.name=moon", "objects.moon.turn=10deg"}).objects[0].turn.degrees() == Approx(10));
  CHECK(std::holds_alternative<AtDisk>(changed({"objects.ball.at=", "objects.ball.at.disk=[0.1, 0]"}).objects[0].place.floor));
}

TEST_CASE("colours and notations need no quotes within the quotes of the shell", "[scene]") {
  CHECK(changed({"objects.ball.color=#f00"}).objects[0].material->color == from_hex(0xff0000));
  CHECK(changed({"orbifold=*2323"}).orbifold.corners.size() == 4);
}

TEST_CASE("mistakes are shown in the argument, with the nearest known word", "[scene]") {
  CHECK(refusal("camera.fow=60deg") == "<--set 1>:1:8: error[scene.unknown-key] the camera has no key `fow` | did you mean `fov`?");
  CHECK(refusal("camra.fov=60deg") == "<--set 1>:1:1: error[scene.unknown-key] the scene has no key `camra` | did you mean `camera`?");
  CHECK(refusal("camera.fov=200deg").find("<--set 1>:1:12: error[scene.angle-out-of-range]") == 0);
  CHECK(refusal("room.walls.7.color=red").find("<--set 1>:1:12: error[scene.no-such-wall]") == 0);
  CHECK(refusal("cover={max_bounces: many}").find("<--set 1>:1:21: error[scene.wrong-type]") == 0);
  CHECK(refusal("objects.bal.turn=3") ==
        "<--set 1>:1:9: error[scene.no-such-item] `objects` has no item `bal` | did you mean `ball`?");
  CHECK(refusal("lights.4.power=3") ==
        "<--set 1>:1:8: error[scene.no-such-item] `lights` has no item `4` | it has one item; 2 would append one");
  CHECK(refusal("room.floor.cell=0.1") ==
        "<--set 1>:1:12: error[scene.not-a-map] `floor` is `wood` here, which has no keys | say all of it: room.floor={cell: …}");
  CHECK(refusal("camera..fov=3").find("<--set 1>:1:8: error[scene.bad-override]") == 0);
  CHECK(refusal("camera.fov").find("<--set 1>:1:1: error[scene.bad-override]") == 0);
  CHECK(refusal("camera={fov: 3").find("<--set 1>:1:8: error[scene.syntax] this { is not closed") == 0);
  CHECK(refusal("camera={fov: 3, fov: 4}").find("<--set 1>:1:17: error[scene.duplicate-key]") == 0);
  CHECK(refusal("ü.x=3").find("<--set 1>:1:1: error[scene.unknown-key]") == 0);

  const std::string conflict = refusal("objects.ball.at.disk=[0, 0]");
  CHECK(conflict.find("<--set 1>:1:17: error[scene.conflict]") == 0);
  CHECK(conflict.find("remove the other key first") != std::string::npos);
}

TEST_CASE("a caret stands under the word of the argument", "[scene]") {
  const auto read = with({"cover.max_bounces=3", "camera.fow=60deg"});
  REQUIRE_FALSE(read);
  CHECK(to_text(read.error()).find("   1 | camera.fow=60deg\n     |        ^^^\n") != std::string::npos);
}

TEST_CASE("mistakes of the file come first, then those of the overrides in their order", "[scene]") {
  const auto read = with({"camera.fow=1", "room.hight=1"}, std::string(kScene) + "exposre: 2\n");
  REQUIRE_FALSE(read);
  REQUIRE(read.error().size() == 3);
  CHECK(read.error()[0].span.source->name == "s.yaml");
  CHECK(read.error()[1].span.source->name == "<--set 1>");
  CHECK(read.error()[2].span.source->name == "<--set 2>");
}

TEST_CASE("a path without end neither crashes nor grows", "[scene]") {
  std::string path = "a";
  for (int i = 0; i < 60000; ++i) path += ".a";
  CHECK(refusal(path + "=1").find("error[scene.too-deep]") != std::string::npos);
  CHECK(refusal("a.b=" + std::string(60000, '[')).find("error[scene.too-deep]") != std::string::npos);
}
