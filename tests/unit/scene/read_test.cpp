// What good scenes mean, value by value.
#include "compiler/scene/read.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "compiler/notation/parse.h"
#include "compiler/scene/check.h"
#include "compiler/scene/defaults.h"
#include "tests/unit/scene/corpus.h"

using namespace orbc;
using namespace orbc::scene;

namespace {

ReadResult good(const std::string& name) {
  auto read = load_scene(std::string(ORBC_SOURCE_DIR) + "/tests/scenes/good/" + name + ".yaml");
  if (!read) FAIL(to_text(read.error()));
  return std::move(*read);
}

Result<ReadResult> read_text(const std::string& rest) { return read_scene(SourceText{"s.yaml", "orbc: 1\norbifold: \"*22222\"\n" + rest}); }

}  // namespace

TEST_CASE("the smallest scene is two lines and gets every default", "[scene]") {
  const Scene scene = good("smallest").scene;
  REQUIRE(scene.room.walls.size() == 5);
  for (const Wall& wall : scene.room.walls) {
    REQUIRE(wall.mirrors.size() == 1);
    CHECK(wall.mirrors[0].reflectance == 0.9);
    CHECK_FALSE(wall.mirrors[0].arc);
    CHECK_FALSE(wall.mirrors[0].frame);
  }
  CHECK(scene.room.height == 1);
  CHECK(scene.room.shape.kind == ShapeKind::tangential);
  CHECK(scene.room.floor.material.pattern == Pattern::checker);
  CHECK(scene.room.ceiling.material.pattern == Pattern::plain);
  CHECK(scene.room.ceiling.material.color.g > 0.7);
  CHECK(scene.lamps.empty());
  CHECK(scene.cover.max_bounces == 4);   // 166 copies
  CHECK(scene.camera.size == std::array<int, 2>{800, 600});
  CHECK(scene.camera.fov.degrees() == Approx(75));
  CHECK(std::holds_alternative<LookDirection>(scene.camera.look_at.value));
  CHECK(default_scene(scene.orbifold).room.walls.size() == 5);
  CHECK(check(default_scene(scene.orbifold)).empty());
}

TEST_CASE("the sketch of the design means what it says", "[scene]") {
  const ReadResult read = good("sketch");
  const Scene& scene = read.scene;
  CHECK(read.notes.empty());
  CHECK(scene.room.height == 1.2);
  CHECK(scene.room.floor.material.color == *named_color("ivory"));
  CHECK(scene.room.floor.material.second == *named_color("slategray"));
  CHECK(scene.room.ceiling.material.color == from_hex(0xdfe6f0));
  CHECK(scene.room.ceiling.material.pattern == Pattern::plain);
  REQUIRE(scene.room.walls[0].mirrors[0].frame);
  CHECK(scene.room.walls[0].mirrors[0].frame->material.color == *named_color("goldenrod"));
  const Wall& second = scene.room.walls[1];
  CHECK(second.material.color == *named_color("brown"));
  REQUIRE(second.mirrors.size() == 1);
  CHECK(*second.mirrors[0].arc == std::array<double, 2>{0.1, 0.5});
  CHECK(*second.mirrors[0].height == std::array<double, 2>{0.2, 0.9});
  CHECK(second.mirrors[0].tint == from_hex(0xffeedd));
  CHECK(second.mirrors[0].frame);  // of `all`
  REQUIRE(scene.objects.size() == 2);
  const Object& statue = scene.objects[0];
  CHECK(statue.name == "statue");
  CHECK(std::get<MeshFile>(statue.shape).path.value == "meshes/statue.obj");
  CHECK(std::get<MeshFile>(statue.shape).path.span.line == 12);
  CHECK(statue.size == 0.4);
  CHECK(statue.size_span.line == 13);
  const auto toward = std::get<AtToward>(statue.place.floor);
  CHECK((toward.corner && toward.number == 2 && toward.distance == 0.3));
  CHECK_FALSE(statue.place.z);
  CHECK(statue.place.span.line == 14);
  CHECK(statue.turn.degrees() == Approx(30));
  CHECK(statue.material->color == *named_color("coral"));
  CHECK(scene.objects[1].place.z == 0.6);
  CHECK(std::get<AtPolar>(scene.objects[1].place.floor).angle.radians == Approx(std::numbers::pi / 2));
  REQUIRE(scene.lamps.size() == 1);
  CHECK(scene.lamps[0].power == 12);
  CHECK(scene.lamps[0].place.z == 1.1);
  CHECK(std::get<LookAtObject>(scene.camera.look_at.value).name == "statue");
  CHECK(scene.folder == std::string(ORBC_SOURCE_DIR) + "/tests/scenes/good");
}

TEST_CASE("the half strip has four walls, of which three are mirrors", "[scene]") {
  const Scene scene = good("half-strip").scene;
  CHECK(notation::is_half_strip(scene.orbifold));
  REQUIRE(scene.room.walls.size() == 4);
  for (const std::size_t wall : {0, 1, 3}) CHECK(scene.room.walls[wall].mirrors.size() == 1);
  CHECK(scene.room.walls[2].mirrors.empty());
  CHECK(scene.room.shape.strip_length == 3);
}

TEST_CASE("the strip has four walls, of which two are mirrors", "[scene]") {
  const Scene scene = good("strip").scene;
  REQUIRE(scene.room.walls.size() == 4);
  CHECK(scene.orbifold.strip);
  CHECK(scene.room.walls[0].mirrors.size() == 1);
  CHECK(scene.room.walls[1].mirrors.empty());
  CHECK(scene.room.walls[2].mirrors[0].reflectance == 0.8);
  CHECK(scene.room.walls[3].mirrors.empty());
  CHECK(scene.room.walls[1].material.color == from_hex(0x884422));
  CHECK(scene.room.walls[3].material.color == *named_color("tan"));
  CHECK(scene.room.shape.scale == 0.5);
  CHECK(scene.room.shape.strip_length == 6);
}

TEST_CASE("a wall's own words replace those of all, one by one", "[scene]") {
  const Scene scene = good("walls").scene;
  const auto& walls = scene.room.walls;
  CHECK(walls[0].mirrors[0].reflectance == 0.8);
  CHECK(walls[0].mirrors[0].frame->width == 0.05);
  CHECK(walls[0].material.color == *named_color("tan"));
  CHECK(walls[1].mirrors[0].reflectance == 1);
  CHECK_FALSE(walls[1].mirrors[0].height);            // a mirror replaces a mirror, not its keys
  CHECK(walls[1].mirrors[0].frame);
  CHECK(walls[2].mirrors[0].reflectance == 0.8);
  CHECK_FALSE(walls[2].mirrors[0].frame);
  CHECK(walls[3].mirrors.empty());
  CHECK(walls[3].material.color == *named_color("brown"));
  REQUIRE(walls[4].mirrors.size() == 3);
  CHECK(walls[4].mirrors[0].frame->width == 0.05);
  CHECK(walls[4].mirrors[0].reflectance == 0.9);
  CHECK_FALSE(walls[4].mirrors[1].frame);
  CHECK(walls[4].mirrors[2].frame->width == 0.01);
  CHECK(walls[4].mirrors[2].frame->material.kind == MaterialKind::metal);
  CHECK(walls[4].material.color == *named_color("tan"));
  CHECK(walls[5].mirrors[0].height == std::array<double, 2>{0.1, 1.1});
  CHECK(scene.room.floor.mirror->reflectance == 0.5);
  CHECK_FALSE(scene.room.ceiling.mirror);
}

TEST_CASE("objects are posed by up, scale and rotate, and cameras rolled and focused", "[scene]") {
  const Scene scene = good("poses").scene;
  const Object& statue = scene.objects[0];
  CHECK(statue.up == Axis::minus_y);
  CHECK(statue.scale == std::array<double, 3>{1, 1, -1.5});
  CHECK(statue.rotate[0].degrees() == Approx(90));
  CHECK(statue.rotate[1].radians == 0.5);
  CHECK(statue.rotate[2].degrees() == Approx(-30));
  CHECK(std::get<AtXy>(statue.place.floor).y == -0.1);
  CHECK(scene.objects[1].up == Axis::plus_x);
  CHECK(scene.objects[2].up == Axis::minus_x);
  CHECK(scene.objects[3].up == Axis::minus_z);
  CHECK(std::get<AtXy>(scene.lamps[0].place.floor).y == 0.2);
  CHECK(scene.camera.roll.degrees() == Approx(-12));
  REQUIRE(scene.camera.lens);
  CHECK(scene.camera.lens->radius == 0.02);
  CHECK(std::get<LookAtObject>(scene.camera.lens->focus.value).name == "statue");
  CHECK(std::get<double>(good("lens").scene.camera.lens->focus.value) == 2.5);
  CHECK(std::get<Place>(good("lens-focus-place").scene.camera.lens->focus.value).z == 0.2);
  CHECK_FALSE(good("smallest").scene.camera.lens);
}

TEST_CASE("objects have names, sizes and looks", "[scene]") {
  const Scene scene = good("objects").scene;
  std::vector<std::string> names;
  for (const Object& object : scene.objects) names.push_back(object.name);
  CHECK(names == std::vector<std::string>{"Statue.of.liberty", "dragon", "sphere", "sphere-3", "sphere-2", "cylinder", "box", "torus",
                                          "the knot", "beam"});
  CHECK(scene.objects[0].embedding == Embedding::exponential);
  CHECK(scene.objects[0].up == Axis::plus_y);
  CHECK(scene.objects[0].turn.radians == -0.5);
  CHECK(scene.objects[0].material->color == from_srgb(0.5, 0.25, 1));
  CHECK(scene.objects[1].up == Axis::plus_y);
  CHECK_FALSE(scene.objects[1].material);
  CHECK(scene.objects[2].up == Axis::plus_z);
  CHECK(std::get<SphereSpec>(scene.objects[3].shape).radius == 0.02);
  CHECK(std::get<CylinderSpec>(scene.objects[5].shape).height == 0.7);
  CHECK(std::get<BoxSpec>(scene.objects[6].shape).size == std::array<double, 3>{0.1, 0.2, 0.3});
  CHECK(scene.objects[6].turn.degrees() == Approx(45));
  CHECK(std::get<TorusSpec>(scene.objects[7].shape).tube == 0.02);
  CHECK(scene.objects[7].material->kind == MaterialKind::metal);
  CHECK(std::get<TorusKnotSpec>(scene.objects[8].shape).q == 4);
  const auto& beam = std::get<BarSpec>(scene.objects[9].shape);
  CHECK(std::get<AtToward>(beam.to.floor).number == 3);
  CHECK(beam.to.z == 0.8);
  CHECK_FALSE(beam.from.z);
  CHECK(beam.width == 0.01);
}

TEST_CASE("places are written in eight ways", "[scene]") {
  const Scene scene = good("places").scene;
  const auto& o = scene.objects;
  CHECK(std::holds_alternative<AtCentre>(o[0].place.floor));
  CHECK(std::holds_alternative<AtCentre>(o[1].place.floor));
  CHECK(o[2].place.z == 0.4);
  CHECK(std::get<AtDisk>(o[3].place.floor).z == std::complex<double>(0.05, -0.02));
  CHECK(std::get<AtPolar>(o[4].place.floor).angle.radians == Approx(std::numbers::pi / 6));
  CHECK(std::get<AtPolar>(o[5].place.floor).angle.radians == std::get<AtPolar>(o[4].place.floor).angle.radians);
  CHECK(std::get<AtPolar>(o[6].place.floor).angle.radians == 0.5);
  CHECK(o[6].place.z == 0.2);
  CHECK(std::get<AtToward>(o[7].place.floor).number == 3);
  CHECK_FALSE(std::get<AtToward>(o[8].place.floor).corner);
  CHECK(o[8].place.z == 0.0);
  CHECK(std::get<AtWalls>(o[9].place.floor).walls == std::array<int, 2>{3, 1});
  CHECK(std::get<AtWalls>(o[9].place.floor).distances == std::array<double, 2>{0.1, 0.05});
}

TEST_CASE("materials are presets, colours or maps", "[scene]") {
  const Scene scene = good("materials").scene;
  CHECK(scene.room.floor.material.pattern == Pattern::marble);
  CHECK(scene.room.ceiling.material.color == from_hex(0xdfe6f0));
  const auto& walls = scene.room.walls;
  CHECK(walls[0].material.texture.value == "bricks.png");
  CHECK(walls[0].material.texture.span.column == 32);
  CHECK(walls[0].material.pattern == Pattern::texture);
  CHECK(walls[0].material.color == Color{1, 1, 1});
  CHECK(walls[1].material.pattern == Pattern::granite);
  CHECK(walls[1].material.cell == 0.02);
  CHECK(walls[2].material.color == *named_color("ivory"));
  CHECK(walls[2].material.roughness == 1);
  CHECK(walls[3].material.pattern == Pattern::wood);
  CHECK(walls[3].material.second == *named_color("sienna"));
  CHECK(walls[4].material.kind == MaterialKind::glossy);
  CHECK(walls[4].material.roughness == 0.2);
  const auto& o = scene.objects;
  CHECK(o[0].material->kind == MaterialKind::glass);
  CHECK(o[1].material->index == 1.33);
  CHECK(o[2].material->emission == 4);
  CHECK(o[3].material->color == *named_color("coral"));
  CHECK(o[4].material->color == Color{1, 0, 0});
  CHECK(o[5].material->pattern == Pattern::marble);
  CHECK(o[5].material->second == from_hex(0x333333));
  CHECK(o[6].material->pattern == Pattern::granite);
  CHECK(o[7].material->pattern == Pattern::marble);
  CHECK(o[8].material->color == *named_color("gold"));   // the colour, not the preset
}

TEST_CASE("lamps are of six kinds", "[scene]") {
  const Scene scene = good("lights").scene;
  REQUIRE(scene.lamps.size() == 7);
  CHECK(scene.lamps[0].kind == LampKind::point);
  CHECK(scene.lamps[1].kind == LampKind::sphere);
  CHECK(scene.lamps[1].color.r == 1);
  CHECK(scene.lamps[1].color.b < 0.5);
  CHECK(scene.lamps[2].size == std::array<double, 2>{0.5, 0.25});
  CHECK_FALSE(scene.lamps[3].visible);
  CHECK(std::get<AtWalls>(scene.lamps[4].to->floor).walls == std::array<int, 2>{3, 4});
  CHECK(scene.lamps[5].cone.degrees() == Approx(40));
  CHECK(scene.lamps[5].falloff == Falloff::inverse_square);
  CHECK(scene.lamps[6].falloff == Falloff::none);
  CHECK(scene.exposure == 1.5);
  CHECK(scene.ambient == from_srgb(0.1, 0.1, 0.12));
  CHECK(scene.room.shape.aspect == 1.5);
}

TEST_CASE("shapes, cameras and covers are read", "[scene]") {
  const Shape paper = good("paper-shape").scene.room.shape;
  CHECK(paper.kind == ShapeKind::paper);
  REQUIRE(paper.cuts.size() == 3);
  CHECK(paper.cuts[0].length == 1.2);
  CHECK(paper.cuts[1].walls == std::array<int, 2>{3, 5});
  CHECK(paper.cuts[1].length == 1.5);
  const Shape lengths = good("lengths-shape").scene.room.shape;
  CHECK(lengths.lengths == std::map<int, double>{{1, 0.9}, {3, 1.1}});
  CHECK(good("stereo").scene.camera.projection == Projection::stereo);
  CHECK(good("stereo").scene.camera.eye_separation == 0.05);
  CHECK(good("straight").scene.rays == Rays::straight);
  CHECK(good("stereo").scene.rays == Rays::curved);
  const Camera panorama = good("panorama").scene.camera;
  CHECK(panorama.projection == Projection::panorama);
  CHECK(std::get<LookDirection>(panorama.look_at.value).elevation.degrees() == Approx(10));
  const Scene cylinder = good("cylinder").scene;
  CHECK(cylinder.camera.fov.degrees() == Approx(360));
  CHECK(cylinder.cover.max_bounces == 20);
  CHECK(cylinder.cover.min_weight == 0.01);
  CHECK(cylinder.cover.min_pixels == 0.5);
  CHECK(cylinder.orbifold.corners.back() == 10);
  const Scene heads = good("non-orbifold").scene;
  CHECK(heads.allow_non_orbifold);
  CHECK(heads.orbifold.corners[0] == Rational(3, 2));
}

TEST_CASE("what means nothing in a room is warned of and left out", "[scene]") {
  const Shape shape = good("warnings").scene.room.shape;
  CHECK(shape.scale == 1);
  CHECK(shape.aspect == 1);
  CHECK(shape.strip_length == Shape{}.strip_length);
  CHECK(shape.cuts.empty());
  CHECK(shape.lengths.empty());
}

TEST_CASE("numbers and texts follow YAML 1.2, not 1.1", "[scene]") {
  const Scene scene = good("numbers").scene;
  CHECK(scene.room.height == 1.5);
  CHECK(scene.room.floor.material.cell == 0.5);
  CHECK(scene.room.floor.material.pattern == Pattern::checker);  // still the default checker
  CHECK(std::get<SphereSpec>(scene.objects[0].shape).radius == 0.01);
  CHECK(scene.objects[0].name == "two words\n");
  CHECK(std::get<AtPolar>(scene.objects[0].place.floor).angle.degrees() == Approx(-30));
  CHECK(scene.camera.size == std::array<int, 2>{800, 600});
  CHECK(scene.camera.fov.degrees() == Approx(60));
  CHECK(good("json").scene.room.height == 1.5);
  CHECK(good("windows-line-ends").scene.room.height == 0.75);
  CHECK(good("byte-order-mark").scene.room.walls.size() == 3);
}

TEST_CASE("all mistakes of a file are reported at once, in its order, with caret and hint", "[scene]") {
  const auto read = read_text("room:\n  heigth: 1.2\n  floor: {color: corla}\ncamera: {look_at: statue}\n");
  REQUIRE_FALSE(read);
  CHECK(corpus::summary(read.error()) == "scene.unknown-key 4:3, scene.bad-color 5:18, scene.unknown-object 6:19");
  CHECK(to_text(read.error()[0]) ==
        "s.yaml:4:3: error[scene.unknown-key] the room has no key `heigth`\n"
        "   4 |   heigth: 1.2\n"
        "     |   ^^^^^^\n"
        "  hint: did you mean `height`?\n");
}

TEST_CASE("columns count characters, not bytes", "[scene]") {
  const auto read = read_text("objects: [{sphere: {}, name: \"häßlich\", colour: red}]\n");
  REQUIRE_FALSE(read);
  CHECK(corpus::summary(read.error()) == "scene.unknown-key 3:41");
  CHECK(read.error()[0].span.length == 6);
  CHECK(read.error()[0].hint == "did you mean `color`?");
}

TEST_CASE("at most a hundred mistakes are reported, and the rest is counted", "[scene]") {
  std::string text = "objects:\n";
  for (int i = 0; i < 5000; ++i) text += "  - sphere: {radios: 1}\n";
  const auto read = read_text(text);
  REQUIRE_FALSE(read);
  REQUIRE(read.error().size() == 101);
  CHECK(read.error().back().code == "scene.too-many-errors");
  CHECK(read.error().back().message == "4900 more are not shown");
  CHECK(read.error().front().span.line == 4);
}

TEST_CASE("a note of the notation is passed on", "[scene]") {
  const auto read = read_scene(SourceText{"s.yaml", "orbc: 1\norbifold: \"*122122\"\n"});
  REQUIRE(read);
  CHECK(read->scene.room.walls.size() == 4);
  REQUIRE_FALSE(read->notes.empty());
  CHECK(read->notes[0].severity == Severity::note);
  CHECK(read->notes[0].span.line == 2);
}

TEST_CASE("the sign of curvature is exact", "[scene]") {
  const std::vector<std::pair<std::string, int>> known = {{"*", 1},     {"*22", 1}, {"*235", 1},  {"*333", 0},   {"*236", 0},
                                                          {"*2222", 0}, {"**", 0},  {"*237", -1}, {"*22222", -1}};
  for (const auto& [text, sign] : known) {
    INFO(text);
    CHECK(curvature_sign(*notation::parse(text)) == sign);
  }
}

TEST_CASE("a scene file that is none is an error with its name", "[scene]") {
  for (const char* path : {"/", "/nowhere/at/all.yaml", ""}) {
    const auto read = load_scene(path);
    REQUIRE_FALSE(read);
    CHECK(read.error()[0].code == "scene.cannot-read");
  }
  const auto endless = load_scene("/dev/zero");
  REQUIRE_FALSE(endless);
  CHECK(endless.error()[0].code == "scene.too-large");
}
