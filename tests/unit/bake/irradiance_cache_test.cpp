#include "compiler/bake/irradiance_cache.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/lit_room.h"

using namespace orbc;
using test::light_room;
using test::lit_scene;
using test::LitRoom;

namespace {

/// A room with a ball, lit by a lamp with an extent over two mirrors.
LitRoom room_with_ball(const std::string& orbifold) {
  scene::Scene scene = lit_scene(orbifold, scene::LampKind::sphere, true);
  scene.objects.resize(1);
  scene.objects[0].shape = scene::SphereSpec{0.1};
  scene.objects[0].place.floor = scene::AtPolar{0.25, Angle::from_degrees(200)};
  return light_room(scene, 1);
}

/// A point of the room on which a ray from its middle ends.
struct Seen {
  trace::Hit hit;
  trace::SurfacePoint point;
};
Seen look(const trace::TraceScene& scene, int i) {
  const double turn = 2.399963 * i, rise = -0.95 + 1.9 * (i % 97) / 97.0, level = std::sqrt(1 - rise * rise);
  const trace::Ray ray = trace::ray_from(scene.prism.space, {{}, 0.5 * scene.prism.height},
                                         {{0, level * std::cos(turn), level * std::sin(turn)}, rise});
  const trace::Hit hit = trace::closest(scene, ray);
  return {hit, trace::surface_at(scene, ray, hit)};
}

double worst(const scene::Color& a, const scene::Color& b) {
  return std::max({std::fabs(a.r - b.r), std::fabs(a.g - b.g), std::fabs(a.b - b.b)});
}

}  // namespace

TEST_CASE("looked-up light is that of the point", "[bake]") {
  const LitRoom l = room_with_ball(GENERATE("*222", "*333", "*22222"));
  const trace::TraceScene traced = trace::prepare(l.interior);
  bake::BakeOptions options;
  options.min_density = 24, options.max_density = 96;
  const bake::IrradianceCache cache(l.interior, l.lighting, options);
  constexpr int kCount = 600;
  int off = 0, far_off = 0;
  double brightest = 0;
  for (int i = 0; i < kCount; ++i) {
    const Seen seen = look(traced, i);
    const surface::ShadingPoint lit = light::shading_point(l.lighting, l.interior, seen.point, seen.hit);
    const scene::Color truth = light::irradiance(l.lighting, lit), light = cache.at(seen.point, seen.hit, lit);
    brightest = std::max(brightest, scene::max_channel(truth));
    off += worst(light, truth) > 0.02 * scene::max_channel(truth) + 0.01;
    far_off += worst(light, truth) > 0.1 * scene::max_channel(truth) + 0.02;
  }
  CHECK(brightest > 0.2);
  CHECK(off <= kCount / 50);
  CHECK(far_off <= kCount / 300);
}

TEST_CASE("looked-up light does not depend on what was looked up before", "[bake]") {
  const LitRoom l = room_with_ball("*22222");
  const trace::TraceScene traced = trace::prepare(l.interior);
  const bake::BakeOptions options;
  const bake::IrradianceCache forwards(l.interior, l.lighting, options), backwards(l.interior, l.lighting, options);
  const auto look_up = [&](const bake::IrradianceCache& cache, int i) {
    const Seen seen = look(traced, i);
    return cache.at(seen.point, seen.hit, light::shading_point(l.lighting, l.interior, seen.point, seen.hit));
  };
  constexpr int kCount = 120;
  std::vector<scene::Color> found;
  for (int i = 0; i < kCount; ++i) found.push_back(look_up(forwards, i));
  for (int i = kCount; i-- > 0;) CHECK(look_up(backwards, i) == found[static_cast<std::size_t>(i)]);
  CHECK(forwards.lit_points() == backwards.lit_points());
}

TEST_CASE("where neighbours are wrong about an image, checks find out", "[bake]") {
  const LitRoom l = room_with_ball("*333");
  const trace::TraceScene traced = trace::prepare(l.interior);
  const Seen seen = look(traced, 3);
  const surface::ShadingPoint lit = light::shading_point(l.lighting, l.interior, seen.point, seen.hit);
  const std::vector<std::uint32_t> images = light::images_at(l.lighting, lit.at);
  const light::VisibleIrradiance truth = light::irradiance(l.lighting, lit, light::ExpectedImages{images, {}});
  REQUIRE(truth.irradiance == light::irradiance(l.lighting, lit));
  std::vector<light::ImageVisibility> wrong = truth.visibility;
  int open = 0;
  for (light::ImageVisibility& image : wrong)
    if (image.kind == light::Visibility::open) image = {light::Visibility::blocked, {}}, ++open;
  REQUIRE(open >= 2);
  for (std::uint32_t phase = 0; phase < 4; ++phase) {
    // Right neighbours give the same light by fewer rays; wrong ones are found out if the phase checks one of the open images.
    CHECK(worst(light::irradiance(l.lighting, lit, {images, truth.visibility, phase}).irradiance, truth.irradiance) < 1e-6);
    bool is_checked = false;
    for (std::size_t k = 0; k < images.size(); ++k)
      is_checked = is_checked || ((k + phase) % 4 == 0 && truth.visibility[k].kind == light::Visibility::open);
    if (is_checked) CHECK(worst(light::irradiance(l.lighting, lit, {images, wrong, phase}).irradiance, truth.irradiance) < 1e-6);
  }
}
