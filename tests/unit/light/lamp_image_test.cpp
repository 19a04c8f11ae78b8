#include "compiler/light/lamp_image.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "compiler/light/lighting.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"

using namespace orbc;

namespace {

struct Hung {
  scene::Scene scene;
  place::Interior room;
  std::vector<light::PlacedLamp> lamps;
};

Hung hung(const char* notation, int lamps) {
  Hung h;
  h.scene = scene::default_scene(notation::parse(notation, {{}, true}).value());
  scene::Lamp lamp;
  lamp.kind = scene::LampKind::point;
  lamp.place.floor = scene::AtPolar{0.02, Angle::from_degrees(20)};
  lamp.place.z = 0.6;
  lamp.power = 0.05;
  h.scene.lamps.assign(static_cast<std::size_t>(lamps), lamp);
  const room::Room room = room::realise(h.scene.orbifold, h.scene.room.shape, true).value();
  h.room = place::furnish(h.scene, room).value().interior;
  h.lamps = light::place_lamps(h.scene, room).value().lamps;
  return h;
}

}  // namespace

TEST_CASE("however little light images give, none is left out", "[light]") {
  for (const char* notation : {"*22222", "*2222", "*2222222"}) {
    CAPTURE(notation);
    const Hung h = hung(notation, 1);
    light::LightOptions options;
    options.bounces = 5;
    light::LightingContext lighting = light::prepare_light(h.scene, h.room, options).value();
    const std::size_t kept = lighting.lamps->images.size();
    double faint = 0;
    for (const light::LampImage& image : lighting.lamps->faint) faint += image.multiplicity;
    const auto irradiance = [&](double r, double z) {
      const geometry::Point p = geometry::point_along(h.room.polygon.space, {}, geometry::Tangent(0, 0.6, 0.8), r);
      return light::irradiance(lighting, {{p, z}, {{0, 0, 0}, z > 0 ? -1.0 : 1.0}, {p, z}, -1, false}).r;
    };
    const double reach = 0.9 * h.room.polygon.inradius;
    const double centre = irradiance(0, 0), rim = irradiance(reach, 0), above = irradiance(reach, h.room.height);
    light::LampSet all = *lighting.lamps;
    all.faint.clear();
    all.images = light::lamp_images(all.lamps, h.room, {5, 1, 0}).value().images;
    lighting.lamps = std::make_shared<const light::LampSet>(std::move(all));
    lighting.cull_grid = {0, 0, 0, 0, {std::vector<std::uint32_t>(lighting.lamps->images.size())}};
    for (std::uint32_t i = 0; i < lighting.lamps->images.size(); ++i) lighting.cull_grid.images[0][i] = i;
    CHECK(kept < lighting.lamps->images.size());
    CHECK(static_cast<double>(kept) + faint == Approx(static_cast<double>(lighting.lamps->images.size())).epsilon(0.1));
    CHECK(irradiance(0, 0) == Approx(centre).epsilon(1e-4));
    CHECK(irradiance(reach, 0) == Approx(rim).epsilon(1e-4));
    CHECK(irradiance(reach, h.room.height) == Approx(above).epsilon(1e-4));
  }
}

TEST_CASE("lamps with more images than can be kept are refused, with the number of mirrors that fits", "[light]") {
  const Hung many = hung("*22222222", 3);
  const auto refused = light::lamp_images(many.lamps, many.room, {12, 1e6, 1e-9});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().front().code == "light.too-many-images");
  const std::string& hint = refused.error().front().hint;
  const int fits = std::stoi(hint.substr(hint.find("mirrors: ") + 9));
  CHECK(light::lamp_images(many.lamps, many.room, {fits, 1e6, 1e-9}));
  CHECK_FALSE(light::lamp_images(many.lamps, many.room, {fits + 1, 1e6, 1e-9}));
  // Rooms that are no orbifolds have an image for every word of mirrors.
  const Hung words = hung("*(5/2)(5/2)(5/2)(5/2)", 2);
  const auto also = light::lamp_images(words.lamps, words.room, {12, 1e6, 1e-9});
  REQUIRE_FALSE(also);
  CHECK(also.error().front().code == "light.too-many-images");
}

TEST_CASE("what the scene says of mirrors is where too many images are reported", "[light]") {
  Hung many = hung("*22222222", 3);
  const auto source = std::make_shared<const SourceText>(SourceText{"scene.yaml", "bake: {mirrors: 12}\n"});
  many.scene.bake.mirror_bounces = 12, many.scene.bake.mirror_bounces_span = {source, 1, 17, 2};
  many.scene.exposure = 1e6;
  const auto lighting = light::prepare_light(many.scene, many.room, light::light_options(many.scene));
  REQUIRE_FALSE(lighting);
  CHECK(lighting.error().front().span.line == 1);
  CHECK(lighting.error().front().span.column == 17);
}
