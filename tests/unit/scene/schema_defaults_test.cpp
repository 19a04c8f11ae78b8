// The defaults that the schema tells are those that the reader fills in.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "compiler/notation/parse.h"
#include "compiler/scene/animation.h"
#include "compiler/scene/check.h"
#include "compiler/scene/defaults.h"
#include "compiler/scene/read.h"

using namespace orbc;
using namespace orbc::scene;
using Json = nlohmann::json;

namespace {

Json schema() {
  std::ifstream file(std::string(ORBC_SOURCE_DIR) + "/schema/orbc-scene.schema.json");
  return Json::parse(file);
}

// Every `default` of the schema by the place where it stands; keys of a material stand in four maps.
void collect(const Json& part, const std::string& place, std::map<std::string, Json>& found) {
  if (part.is_object() && part.contains("default")) found[place] = part["default"];
  if (part.is_structured())
    for (auto it = part.begin(); it != part.end(); ++it)
      collect(*it, place + "/" + (part.is_object() ? it.key() : std::to_string(it - part.begin())), found);
}

// As a scene writes a colour from 0 to 1 in sRGB: three digits.
Json srgb(const Color& color) {
  const auto encoded = [](double v) {
    const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    return std::round(s * 1000) / 1000;
  };
  return Json::array({encoded(color.r), encoded(color.g), encoded(color.b)});
}

std::string degrees(const Angle& angle) { return std::to_string(static_cast<int>(std::lround(angle.degrees()))) + "deg"; }

}  // namespace

TEST_CASE("the defaults of the schema are the reader's", "[scene]") {
  const Scene scene;
  const Shape shape;
  const Material material;
  const Mirror mirror;
  const Object object;
  const Lamp lamp;
  REQUIRE(shape.kind == ShapeKind::tangential);
  REQUIRE(object.embedding == Embedding::conformal);
  REQUIRE(material.kind == MaterialKind::matte);
  REQUIRE(material.pattern == Pattern::plain);
  REQUIRE(lamp.kind == LampKind::sphere);
  REQUIRE(lamp.falloff == Falloff::geodesic);
  REQUIRE(lamp.color == *named_color("white"));
  REQUIRE(mirror.tint == *named_color("white"));
  REQUIRE(mirror.emission == *named_color("black"));
  REQUIRE(scene.ambient == *named_color("black"));
  REQUIRE(scene.cover.background == *named_color("black"));
  REQUIRE_FALSE(scene.cover.background_expected);
  REQUIRE(scene.integrator == Integrator::direct);
  REQUIRE(scene.rays == Rays::curved);
  REQUIRE(scene.bake.atlas == AtlasFormat::srgb8);
  REQUIRE(scene.bake.lights == LightMode::baked);
  REQUIRE(scene.bake.quality == BakeQuality::normal);
  REQUIRE(scene.camera.projection == Projection::perspective);
  REQUIRE(object.turn.degrees() == 0);
  REQUIRE_FALSE(Animation{}.fixed_noise);
  REQUIRE(Keyframes{}.interpolation == Interpolation::linear);
  REQUIRE(WallWalk{}.start == 1);
  REQUIRE(scene.camera.roll.degrees() == 0);
  for (const Angle& angle : object.rotate) REQUIRE(angle.degrees() == 0);
  // By the end of their place in the schema.
  const std::map<std::string, Json> ours = {{"allow_non_orbifold", scene.allow_non_orbifold},
                                            {"room/properties/shape", "tangential"},
                                            {"room/properties/cut", shape.cut},
                                            {"cuts/items/properties/length", shape.cut},
                                            {"room/properties/scale", shape.scale},
                                            {"room/properties/aspect", shape.aspect},
                                            {"room/properties/length", shape.strip_length},
                                            {"room/properties/height", scene.room.height},
                                            {"sphere/properties/radius", SphereSpec{}.radius},
                                            {"cylinder/properties/radius", CylinderSpec{}.radius},
                                            {"cylinder/properties/height", CylinderSpec{}.height},
                                            {"box/properties/size", BoxSpec{}.size},
                                            {"torus/properties/radius", TorusSpec{}.radius},
                                            {"torus/properties/tube", TorusSpec{}.tube},
                                            {"torus_knot/properties/p", TorusKnotSpec{}.p},
                                            {"torus_knot/properties/q", TorusKnotSpec{}.q},
                                            {"torus_knot/properties/radius", TorusKnotSpec{}.radius},
                                            {"torus_knot/properties/tube", TorusKnotSpec{}.tube},
                                            {"beam/properties/width", BarSpec{}.width},
                                            {"properties/embedding", "conformal"},
                                            {"properties/turn", 0},
                                            {"objects/items/properties/scale", object.scale},
                                            {"properties/rotate", Json::array({0, 0, 0})},
                                            {"properties/roll", 0},
                                            {"lens/properties/radius", Lens{}.radius},
                                            {"lights/items/properties/kind", "sphere"},
                                            {"lights/items/properties/radius", lamp.radius},
                                            {"lights/items/properties/size", lamp.size},
                                            {"lights/items/properties/power", lamp.power},
                                            {"lights/items/properties/color", "white"},
                                            {"properties/cone", degrees(lamp.cone)},
                                            {"properties/visible", lamp.visible},
                                            {"properties/falloff", "geodesic"},
                                            {"properties/ambient", "black"},
                                            {"properties/exposure", scene.exposure},
                                            {"properties/integrator", "direct"},
                                            {"properties/rays", "curved"},
                                            {"bake/properties/atlas", 8},
                                            {"bake/properties/lights", "baked"},
                                            {"bake/properties/bounces", scene.bake.indirect_bounces},
                                            {"bake/properties/mirrors", scene.bake.mirror_bounces},
                                            {"bake/properties/quality", "normal"},
                                            {"bake/properties/seed", scene.bake.seed},
                                            {"properties/azimuth", 0},
                                            {"properties/elevation", 0},
                                            {"properties/projection", "perspective"},
                                            {"properties/fov", degrees(scene.camera.fov)},
                                            {"camera/properties/size", scene.camera.size},
                                            {"properties/min_weight", scene.cover.min_weight},
                                            {"properties/min_pixels", scene.cover.min_pixels},
                                            {"properties/background", "black"},
                                            {"properties/kind", "matte"},
                                            {"properties/color", srgb(material.color)},
                                            {"properties/pattern", "plain"},
                                            {"properties/cell", material.cell},
                                            {"properties/roughness", material.roughness},
                                            {"properties/index", material.index},
                                            {"properties/emission", material.emission},
                                            {"properties/cutoff", material.alpha_cutoff},
                                            {"properties/width", Frame{}.width},
                                            {"properties/reflectance", mirror.reflectance},
                                            {"properties/tint", "white"},
                                            {"properties/glow", "black"},
                                            {"animation/properties/frames", Animation{}.frames},
                                            {"animation/properties/rate", Animation{}.rate},
                                            {"animation/properties/seed", "per-frame"},
                                            {"properties/interpolate", "linear"},
                                            {"anyOf/3/properties/distance", WallWalk{}.distance},
                                            {"anyOf/3/properties/start", "corner 1"},
                                            {"anyOf/3/properties/laps", WallWalk{}.laps},
                                            {"ahead/properties/lead", Ahead{}.lead},
                                            {"ahead/properties/offset", 0}};
  std::map<std::string, Json> told;
  collect(schema(), "", told);
  REQUIRE(told.size() > 60);
  for (const auto& [place, value] : told) {
    const std::pair<const std::string, Json>* nearest = nullptr;
    for (const auto& entry : ours) {
      const std::string end = "/" + entry.first;
      const bool ends = place.size() >= end.size() && place.compare(place.size() - end.size(), end.size(), end) == 0;
      if (ends && (!nearest || entry.first.size() > nearest->first.size())) nearest = &entry;
    }
    CAPTURE(place);
    REQUIRE(nearest);  // a new default: its twin in scene.h belongs into the list
    CHECK(value == nearest->second);
  }
}

TEST_CASE("a scene that furnishes too few walls is refused", "[scene]") {
  Scene scene = default_scene(*notation::parse("*22222"));
  scene.room.walls.pop_back();
  const Diagnostics found = check(scene);
  REQUIRE(found.size() == 1);
  CHECK(found[0].code == "scene.wall-count");
}
