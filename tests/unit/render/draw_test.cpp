#include "compiler/render/draw.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"

using namespace orbc;

namespace {

// A room with emissive floor, ceiling and walls behind mirrors of reflectance rho; nothing stands in it.
place::PlacedRoom glowing_room(const char* notation, double rho, bool mirrors) {
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
  return place::furnish(s, *room)->room;
}

place::Eye eye_in(const place::PlacedRoom& room) {
  place::Eye eye;
  eye.room_from_eye = geometry::translation_by(room.room.space, 0.05 * room.room.inradius, 0.03 * room.room.inradius);
  eye.z = 0.2;
  eye.width = 24, eye.height = 18;
  return eye;
}

}  // namespace

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
    const place::PlacedRoom room = glowing_room(notation, 0, false);
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
    const place::PlacedRoom room = glowing_room(notation, rho, true);
    const trace::TraceScene scene = trace::prepare(room);
    render::DrawOptions options;
    options.max_bounces = 40;
    const render::Film film = render::draw(scene, eye_in(room), options, serial_executor());
    int bounced = 0;
    for (std::size_t i = 0; i < film.color.size(); ++i) {
      if (film.object[i] == -2) continue;   // cut off
      CHECK(film.color[i].b == Approx(std::pow(rho, film.bounces[i])));
      bounced += film.bounces[i] > 0;
    }
    CHECK(bounced > 50);
  }
}

TEST_CASE("the film does not depend on the order in which tiles are drawn", "[render]") {
  const place::PlacedRoom room = glowing_room("*2323", 0.8, true);
  const trace::TraceScene scene = trace::prepare(room);
  const Executor backwards = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = count; i-- > 0;) task(i);
  };
  render::DrawOptions options;
  options.samples = 4;
  const render::Film a = render::draw(scene, eye_in(room), options, serial_executor()), b = render::draw(scene, eye_in(room), options, backwards);
  for (std::size_t i = 0; i < a.color.size(); ++i) CHECK((a.color[i].r == b.color[i].r && a.color[i].b == b.color[i].b && a.depth[i] == b.depth[i]));
  CHECK(render::to_exr(a) == render::to_exr(b));
}

TEST_CASE("what is cut off shows the background as it is", "[render]") {
  const place::PlacedRoom room = glowing_room("*2222", 0.5, true);
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
