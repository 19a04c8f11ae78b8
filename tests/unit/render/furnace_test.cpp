// Furnaces: closed rooms of mirrors that glow. All alike: every path sees the series E(1 + ρ + ρ² + …) = E/(1 − ρ). Where each mirror of
// reflectance ρᵢ glows with (1 − ρᵢ)·B, as a black body would at the brightness B, every path sees B (Kirchhoff), whatever its word is.
#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/render/draw.h"
#include "compiler/room/realise.h"
#include "compiler/mesh_io/load.h"
#include "compiler/scene/defaults.h"

using namespace orbc;

namespace {

/// Wall i has reflectance[i % 3] and glow[i % 3]; so have floor and ceiling.
scene::Scene furnace(const char* notation, const std::array<double, 3>& reflectance, const std::array<scene::Color, 3>& glow) {
  scene::Scene s = scene::default_scene(*notation::parse(notation));
  s.room.height = 0.6;
  std::size_t i = 0;
  const auto set = [&](scene::Mirror& mirror) {
    mirror.reflectance = reflectance[i % 3], mirror.emission = glow[i % 3], mirror.frame.reset();
    ++i;
  };
  for (scene::Wall& wall : s.room.walls)
    for (scene::Mirror& mirror : wall.mirrors) set(mirror);
  set(s.room.floor.mirror.emplace());
  set(s.room.ceiling.mirror.emplace());
  return s;
}

place::Interior room_of(const scene::Scene& s) {
  return place::furnish(s, *room::realise(s.orbifold), mesh_io::assets_from_files())->interior;
}

place::Camera furnace_eye(const place::Interior& room) {
  place::Camera eye;
  eye.room_from_eye = geometry::translation_by(room.polygon.space, 0.06 * room.polygon.inradius, 0.03 * room.polygon.inradius);
  eye.z = 0.2;
  eye.width = 32, eye.height = 24;
  return eye;
}

render::Film draw(const place::Interior& room, int bounces) {
  render::DrawOptions options;
  options.max_bounces = bounces;
  options.max_depth = 1000;
  return render::draw(trace::prepare(room), furnace_eye(room), options, serial_executor());
}

/// The same sum by a way of its own: in long double, the geodesic unreflected and the lines of the walls moved instead; storeys by
/// division.
scene::Color unfolded(const place::Interior& room, const trace::Ray& ray, int bounces) {
  using Real = long double;
  const Real k = geometry::curvature(room.polygon.space);
  struct Line {
    Real w, x, y;
  };
  std::vector<Line> lines;
  for (const room::Wall& wall : room.polygon.walls) lines.push_back({wall.line.w, wall.line.x, wall.line.y});
  const auto mirror_on = [&](int wall) {
    for (const place::PlacedMirror& mirror : room.mirrors)
      if (mirror.wall == wall) return mirror;
    return place::PlacedMirror{};
  };
  Real gone = 0;
  int left = -1, storeys = 0;
  scene::Color weight{1, 1, 1}, sum;
  for (int i = 0; i < bounces; ++i) {
    // tanκ of the arc to each line: −at/towards; the nearest ahead of what is gone already.
    Real best = 1e30L;
    int wall = 0;
    for (int j = 0; j < static_cast<int>(lines.size()); ++j) {
      if (j == left) continue;
      const Line& n = lines[static_cast<std::size_t>(j)];
      const Real at = n.w * ray.at.w + n.x * ray.at.x + n.y * ray.at.y, towards = n.w * ray.along.w + n.x * ray.along.x + n.y * ray.along.y;
      Real s = 0;
      if (k == 0) s = -at / towards;
      if (k < 0) s = std::fabs(at) < std::fabs(towards) ? std::atanh(-at / towards) : -1;
      if (k > 0) {
        s = std::atan2(-at, towards);
        while (s < gone + 1e-12L) s += 3.141592653589793238462643L;
      }
      if (s > gone && s < best) best = s, wall = j;
    }
    // Height gained at the next plane
    const Real storey = ray.m > 0 ? (storeys + 1) * room.height - ray.z : -storeys * room.height - ray.z;
    const Real to_plane = ray.m != 0 ? storey / ray.m : 1e30L, to_wall = ray.c > 0 ? best / ray.c : 1e30L;
    const bool plane = to_plane < to_wall;
    const bool up = (ray.m > 0) == (storeys % 2 == 0);
    const place::PlacedMirror mirror = mirror_on(plane ? (up ? trace::kCeiling : trace::kFloor) : wall);
    sum = sum + weight * mirror.emission;
    weight = weight * mirror.throughput;
    if (plane) {
      ++storeys;
      continue;
    }
    gone = best, left = wall;
    const Line a = lines[static_cast<std::size_t>(wall)];
    for (int j = 0; j < static_cast<int>(lines.size()); ++j) {
      if (j == wall) continue;
      Line& n = lines[static_cast<std::size_t>(j)];
      const Real f = 2 * (k * a.w * n.w + a.x * n.x + a.y * n.y);  // of covectors ⟨a, n⟩ = κ·w·w + x·x + y·y
      n = {n.w - f * a.w, n.x - f * a.x, n.y - f * a.y};
    }
    lines[static_cast<std::size_t>(wall)] = {-a.w, -a.x, -a.y};
  }
  return sum;
}

}  // namespace

TEST_CASE("a closed room of mirrors that glow has the radiance E/(1 − ρ)", "[render]") {
  const scene::Color e{0.3, 0.2, 0.05};
  for (const char* notation : {"*222", "*235", "*2222", "*333", "*22222", "*237"})
    for (const double rho : {0.5, 0.8, 0.9}) {
      const int bounces = static_cast<int>(std::ceil(std::log(1e-5) / std::log(rho)));
      const render::Film film = draw(room_of(furnace(notation, {rho, rho, rho}, {e, e, e})), bounces);
      double worst = 0;
      for (const scene::Color& c : film.color)
        worst = std::max(
            {worst, std::fabs(c.r * (1 - rho) / e.r - 1), std::fabs(c.g * (1 - rho) / e.g - 1), std::fabs(c.b * (1 - rho) / e.b - 1)});
      INFO(notation << " ρ = " << rho << ", " << bounces << " bounces: " << worst);
      CHECK(worst < 2e-5);
    }
}

TEST_CASE("a ball that reflects all is not to be seen in a furnace", "[render]") {
  const scene::Color e{0.25, 0.25, 0.25};
  for (const char* notation : {"*222", "*2222", "*22222"}) {
    scene::Scene s = furnace(notation, {0.5, 0.5, 0.5}, {e, e, e});
    scene::Object ball;
    ball.shape = scene::SphereSpec{0.1};
    ball.material.emplace().kind = scene::MaterialKind::mirror;
    ball.material->color = {1, 1, 1};
    ball.place.floor = scene::AtPolar{0.25, Angle::from_degrees(15)};
    s.objects = {ball};
    const render::Film film = draw(room_of(s), 20);
    int balls = 0;
    for (std::size_t i = 0; i < film.color.size(); ++i) {
      CHECK(film.color[i].g == Approx(0.5).epsilon(1e-5));
      balls += film.object[i] >= 0;
    }
    CHECK(balls > 20);
  }
}

TEST_CASE("mirrors that differ but glow like black bodies of one brightness show that brightness", "[render]") {
  const std::array<double, 3> rho{0.3, 0.6, 0.85};
  const scene::Color b{0.9, 0.6, 0.3};
  for (const char* notation : {"*222", "*234", "*2222", "*333", "*22222", "*2323"}) {
    const render::Film film = draw(room_of(furnace(notation, rho, {0.7 * b, 0.4 * b, 0.15 * b})), 71);
    for (const scene::Color& c : film.color) CHECK((std::fabs(c.r / b.r - 1) < 2e-5 && std::fabs(c.b / b.b - 1) < 2e-5));
  }
}

TEST_CASE("mirrors that differ in reflectance and glow are summed up in the order in which they are met", "[render]") {
  for (const char* notation : {"*222", "*233", "*2222", "*333", "*22222", "*2323"}) {
    const place::Interior room =
        room_of(furnace(notation, {0.7, 0.35, 0.5}, {scene::Color{0.5, 0, 0.1}, scene::Color{0, 0.4, 0.1}, scene::Color{0.1, 0.1, 0.6}}));
    const place::Camera eye = furnace_eye(room);
    const render::Film film = draw(room, 14);
    double worst = 0, least = 9, most = 0;
    for (int y = 0; y < eye.height; ++y)
      for (int x = 0; x < eye.width; ++x) {
        const scene::Color want = unfolded(room, render::eye_ray(eye, x + 0.5, y + 0.5), 14),
                           got = film.color[static_cast<std::size_t>(y * eye.width + x)];
        worst = std::max({worst, std::fabs(want.r - got.r), std::fabs(want.g - got.g), std::fabs(want.b - got.b)});
        least = std::min(least, want.r), most = std::max(most, want.r);
      }
    INFO(notation << ": " << worst);
    CHECK(worst < 1e-6);
    CHECK(most > least + 0.1);
  }
}
