#include "compiler/render/draw.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "compiler/image/image.h"
#include "compiler/image/srgb.h"
#include "compiler/image_io/exr.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/render/radiance.h"
#include "compiler/room/realise.h"
#include "compiler/mesh_io/load.h"
#include "compiler/scene/defaults.h"
#include "tests/support/threads.h"

using namespace orbc;

namespace {

// A room with emissive floor, ceiling and walls behind mirrors of reflectance rho; nothing stands in it.
place::Interior glowing_room(const char* notation, double rho, bool mirrors) {
  const auto orbifold = *notation::parse(notation);
  scene::Scene s = scene::default_scene(orbifold);
  scene::Material light;
  light.kind = scene::MaterialKind::emissive;
  light.color = {0.5, 0.25, 1};
  s.room.floor.material = s.room.ceiling.material = light;
  s.room.height = 0.5;
  for (scene::Wall& wall : s.room.walls) {
    wall.material = light;
    if (!mirrors) wall.mirrors.clear();
    for (scene::Mirror& mirror : wall.mirrors) mirror.reflectance = rho, mirror.frame.reset();
  }
  const auto room = room::realise(orbifold);
  return place::furnish(s, *room, mesh_io::assets_from_files())->interior;
}

place::Camera eye_in(const place::Interior& room) {
  place::Camera eye;
  eye.room_from_eye = geometry::translation_by(room.polygon.space, 0.05 * room.polygon.inradius, 0.03 * room.polygon.inradius);
  eye.z = 0.2;
  eye.width = 24, eye.height = 18;
  return eye;
}

// A room with a mirror ball, a glass ball and a matte box, its walls mirrors, under one lamp or in its plain colours.
place::Interior furnished_room(const char* notation, bool lamp, scene::Scene& s) {
  s = scene::default_scene(*notation::parse(notation));
  s.room.height = 0.7;
  s.room.floor.material.pattern = scene::Pattern::checker;
  const auto add = [&](auto body, scene::MaterialKind kind, double r, double degrees) {
    scene::Object object;
    object.shape = body;
    object.material.emplace().kind = kind;
    object.material->color = {0.9, 0.7, 0.5};
    object.place.floor = scene::AtPolar{r, Angle::from_degrees(degrees)};
    s.objects.push_back(object);
  };
  add(scene::SphereSpec{0.08}, scene::MaterialKind::mirror, 0.2, 20);
  add(scene::SphereSpec{0.07}, scene::MaterialKind::glass, 0.2, 150);
  add(scene::BoxSpec{{0.1, 0.1, 0.1}}, scene::MaterialKind::matte, 0.2, 270);
  if (lamp) {
    scene::Lamp hung;
    hung.kind = scene::LampKind::sphere;
    hung.place.floor = scene::AtPolar{0.1, Angle::from_degrees(200)};
    hung.place.z = 0.6;
    s.lamps = {hung};
  }
  return place::furnish(s, *room::realise(s.orbifold), mesh_io::assets_from_files())->interior;
}

}  // namespace

TEST_CASE("clear glass in a room of one colour cannot be seen: what it reflects and lets through is all there is", "[render]") {
  for (const char* notation : {"*222", "*2222", "*22222"}) {
    scene::Scene s = scene::default_scene(*notation::parse(notation));
    scene::Material light;
    light.kind = scene::MaterialKind::emissive;
    light.color = {0.5, 0.25, 1};
    s.room.floor.material = s.room.ceiling.material = light;
    for (scene::Wall& wall : s.room.walls) wall.material = light, wall.mirrors.clear();
    scene::Object ball;
    ball.shape = scene::SphereSpec{0.15};
    ball.material.emplace().kind = scene::MaterialKind::glass;
    ball.material->color = {1, 1, 1};
    ball.place.floor = scene::AtPolar{0.25, Angle::from_degrees(20)};
    s.objects = {ball};
    const place::Interior room = place::furnish(s, *room::realise(s.orbifold), mesh_io::assets_from_files())->interior;
    const render::Film film = render::draw(trace::prepare(room), eye_in(room), {}, serial_executor());
    int through = 0;
    for (std::size_t i = 0; i < film.color.size(); ++i) {
      through += film.object[i] >= 0 && room.parts[static_cast<std::size_t>(film.object[i])].kind == place::PartKind::object;
      CHECK(film.color[i].b <= 1 + 1e-12);
      CHECK(film.color[i].b > 0.97);
    }
    CHECK(through > 5);
  }
}

TEST_CASE("drawn in streams the film is that of single rays, bit by bit", "[render]") {
  for (const char* notation : {"*222", "*2222", "*22222"})
    for (const bool lamp : {false, true}) {
      scene::Scene s;
      const place::Interior room = furnished_room(notation, lamp, s);
      const trace::TraceScene scene = trace::prepare(room);
      const light::LightingContext light = *light::prepare_light(s, room);
      render::DrawOptions options;
      options.samples = 3;
      if (lamp) options.lighting = &light;
      const place::Camera eye = eye_in(room);
      const render::Film film = render::draw(scene, eye, options, serial_executor());
      const auto points = render::sample_points(options.samples);
      int different = 0, objects = 0;
      for (int y = 0; y < eye.height; ++y)
        for (int x = 0; x < eye.width; ++x) {
          scene::Color sum;
          const auto pixel = static_cast<std::size_t>(y * eye.width + x);
          for (std::size_t i = 0; i < points.size(); ++i) {
            const render::PixelSampler sampler(light.options.seed, pixel, static_cast<int>(i), options.samples);
            const render::RayResult seen =
                render::radiance(scene, render::eye_ray(eye, x + points[i][0], y + points[i][1]), options, sampler);
            sum = sum + seen.radiance;
            if (i > 0) continue;
            different +=
                film.bounces[pixel] != seen.path.bounces || (seen.hit && film.depth[pixel] != static_cast<float>(seen.path.length));
            objects += seen.hit && seen.surface.kind == place::PartKind::object;
          }
          sum = (1.0 / 3) * sum;
          different += !(sum == film.color[pixel]);
        }
      INFO(notation << (lamp ? " lit" : " unlit"));
      CHECK(different == 0);
      CHECK(objects > 20);
    }
}

TEST_CASE("samples of a pixel are distinct points of it, centred", "[render]") {
  for (const int n : {1, 2, 3, 4, 5, 9, 16, 64}) {
    const auto points = render::sample_points(n);
    REQUIRE(points.size() == static_cast<std::size_t>(n));
    std::set<std::array<double, 2>> distinct(points.begin(), points.end());
    CHECK(distinct.size() == points.size());
    double x = 0;
    for (const auto& p : points) {
      CHECK((p[0] > 0 && p[0] < 1 && p[1] >= 0 && p[1] < 1));
      x += p[0] / n;
    }
    CHECK(x == Approx(0.5));
  }
  CHECK(render::sample_points(1)[0] == std::array<double, 2>{0.5, 0.5});
}

TEST_CASE("inside walls that all glow alike every pixel has their radiance", "[render]") {
  for (const char* notation : {"*222", "*2222", "*22222", "*237"}) {
    const place::Interior room = glowing_room(notation, 0, false);
    const trace::TraceScene scene = trace::prepare(room);
    const render::Film film = render::draw(scene, eye_in(room), {}, serial_executor());
    for (const scene::Color& c : film.color) {
      CHECK(c.r == Approx(0.5));
      CHECK(c.g == Approx(0.25));
      CHECK(c.b == Approx(1));
    }
  }
}

TEST_CASE("seen through mirrors a glowing floor has its radiance times the weight of the path", "[render]") {
  const double rho = 0.7;
  for (const char* notation : {"*222", "*333", "*22222"}) {
    const place::Interior room = glowing_room(notation, rho, true);
    const trace::TraceScene scene = trace::prepare(room);
    render::DrawOptions options;
    options.max_bounces = 40;
    const render::Film film = render::draw(scene, eye_in(room), options, serial_executor());
    int bounced = 0;
    for (std::size_t i = 0; i < film.color.size(); ++i) {
      if (film.object[i] == -2) continue;  // cut off
      CHECK(film.color[i].b == Approx(std::pow(rho, film.bounces[i])));
      bounced += film.bounces[i] > 0;
    }
    CHECK(bounced > 50);
  }
}

TEST_CASE("the film does not depend on the order in which tiles are drawn", "[render]") {
  const place::Interior room = glowing_room("*2323", 0.8, true);
  const trace::TraceScene scene = trace::prepare(room);
  const Executor backwards = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = count; i-- > 0;) task(i);
  };
  render::DrawOptions options;
  options.samples = 4;
  const render::Film a = render::draw(scene, eye_in(room), options, serial_executor()),
                     b = render::draw(scene, eye_in(room), options, backwards);
  for (std::size_t i = 0; i < a.color.size(); ++i)
    CHECK((a.color[i].r == b.color[i].r && a.color[i].b == b.color[i].b && a.depth[i] == b.depth[i]));
  CHECK(image_io::encode_exr(render::to_float_image(a)) == image_io::encode_exr(render::to_float_image(b)));
}

TEST_CASE("bytes of a picture are the rounded encoded values, whichever way they are found", "[render]") {
  render::Film film = render::make_film(4096, 1);
  std::uint64_t state = 5;
  for (std::size_t i = 0; i < film.color.size(); ++i) {
    const auto draw = [&] { return static_cast<double>((state = state * 6364136223846793005u + 1442695040888963407u) >> 11) * 0x1p-53; };
    const double step = image::decode_srgb((static_cast<double>(i % 256) + 0.5) / 255);  // where bytes change
    film.color[i] = {draw() * 1.2 - 0.1, draw() * draw() * 0.01,
                     i < 512    ? step
                     : i < 1024 ? std::nextafter(step, 0.0)
                     : i < 1536 ? std::nextafter(step, 1.0)
                                : draw()};
  }
  const image::Image image = render::to_image(film, 1);
  int different = 0;
  const auto byte = [](double v) { return std::lround(255 * image::encode_srgb(v)); };
  for (std::size_t i = 0; i < film.color.size(); ++i)
    different += image.rgba[4 * i] != byte(film.color[i].r) || image.rgba[4 * i + 1] != byte(film.color[i].g) ||
                 image.rgba[4 * i + 2] != byte(film.color[i].b) || image.rgba[4 * i + 3] != 255;
  CHECK(different == 0);
}

TEST_CASE("threads prepare and draw what one alone does", "[render][threads]") {
  for (const bool lamp : {false, true}) {
    scene::Scene s;
    const place::Interior room = furnished_room("*22222", lamp, s);
    const auto film = [&](const Executor& executor) {
      const trace::TraceScene scene = trace::prepare(room, executor);
      const light::LightingContext light = *light::prepare_light(s, room, {}, executor);
      render::DrawOptions options;
      if (lamp) options.lighting = &light;
      place::Camera eye = eye_in(room);
      eye.width = 48, eye.height = 40;
      return image_io::encode_exr(render::to_float_image(render::draw(scene, eye, options, executor)));
    };
    const std::string alone = film(serial_executor());
    for (const int count : {2, 5}) CHECK(film(testing::threads(count)) == alone);
  }
}

TEST_CASE("what is cut off shows the background as it is", "[render]") {
  const place::Interior room = glowing_room("*2222", 0.5, true);
  const trace::TraceScene scene = trace::prepare(room);
  render::DrawOptions options;
  options.max_bounces = 0;
  options.background = {0.1, 0.2, 0.3};
  const render::Film film = render::draw(scene, eye_in(room), options, serial_executor());
  int background = 0;
  for (std::size_t i = 0; i < film.color.size(); ++i)
    if (film.object[i] == -2) {
      ++background;
      CHECK(film.color[i].g == 0.2);
      CHECK(std::isinf(film.depth[i]));
    }
  CHECK(background > 50);
}
