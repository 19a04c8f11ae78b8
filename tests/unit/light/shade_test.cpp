#include "compiler/light/shade.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "compiler/geometry/chart.h"
#include "compiler/light/bake.h"
#include "compiler/light/falloff.h"
#include "compiler/light/frame.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/place/locate.h"
#include "compiler/room/realise.h"
#include "compiler/room/room.h"
#include "compiler/scene/defaults.h"
#include "compiler/trace/analytic.h"

using namespace orbc;
using geometry::Position;
using geometry::Space;

namespace {

constexpr double kHalfTurn = std::numbers::pi;

scene::Scene lit_scene(const std::string& orbifold, scene::LampKind kind, bool mirrors) {
  scene::Scene scene = scene::default_scene(notation::parse(orbifold).value());
  for (scene::Wall& wall : scene.room.walls)
    if (!mirrors) wall.mirrors.clear();
  scene::Lamp lamp;
  lamp.kind = kind;
  lamp.place.floor = scene::AtPolar{0.1, Angle::from_degrees(20)};
  lamp.place.z = 0.6;
  scene.lamps = {lamp};
  return scene;
}

struct Lit {
  scene::Scene scene;
  place::PlacedRoom room;
  light::LightField field;
};

Lit lit(scene::Scene scene, int bounces) {
  Lit result{scene, place::furnish(scene, room::realise(scene.orbifold, scene.room.shape).value()).value().room, {}};
  light::LightOptions options;
  options.bounces = bounces;
  options.cut = 0;
  result.field = light::prepare_light(result.scene, result.room, options).value();
  return result;
}

double on_floor(const Lit& l, const geometry::Point& p, double z, double up) {
  return light::irradiance(l.field, {{p, z}, {{0, 0, 0}, up}, {p, z}, -1, false}).r;
}

// Power that arrives on floor, ceiling and walls together: midpoint sums over polar coordinates and over (arc, height).
double flux(const Lit& l) {
  const room::Room& room = l.room.room;
  const double height = l.room.height;
  double sum = 0;
  constexpr int kTurn = 120, kOut = 60, kAlong = 60;
  for (int i = 0; i < kTurn; ++i) {
    const double phi = 2 * kHalfTurn * (i + 0.5) / kTurn, reach = place::reach(room, phi);
    for (int j = 0; j < kOut; ++j) {
      const double r = reach * (j + 0.5) / kOut, area = geometry::sin_k(room.space, r) * reach / kOut * 2 * kHalfTurn / kTurn;
      const geometry::Point p = geometry::point_along(room.space, {}, geometry::Tangent(0, std::cos(phi), std::sin(phi)), r);
      sum += area * (on_floor(l, p, 0, 1) + on_floor(l, p, height, -1));
    }
  }
  for (int w = 0; w < static_cast<int>(room.walls.size()); ++w)
    for (int i = 0; i < kAlong; ++i)
      for (int j = 0; j < kAlong; ++j) {
        const Position at{room::point_on_wall(room, w, room.walls[w].length * (i + 0.5) / kAlong), height * (j + 0.5) / kAlong};
        sum += room.walls[w].length / kAlong * height / kAlong *
               light::irradiance(l.field, {at, trace::normal_of_wall(room.space, room.walls[w]), at, w, false}).r;
      }
  return sum;
}

}  // namespace

TEST_CASE("the falloff of E² is the inverse square, and all spaces agree with it near the lamp", "[light]") {
  CHECK(light::geodesic_falloff(Space::euclidean, 2, 1.3, 0.01) == Approx(1 / (16 * kHalfTurn)));
  for (const Space space : {Space::hyperbolic, Space::spherical})
    CHECK(light::geodesic_falloff(space, 0.02, 0.015, 0.001) == Approx(1 / (4 * kHalfTurn * 0.0004)).epsilon(1e-4));
  CHECK(light::geodesic_falloff(Space::euclidean, 1e-9, 0, 0.05) == Approx(1 / (4 * kHalfTurn * 0.0025)));
}

TEST_CASE("the focus at the antipode is as bright as a lamp of that radius allows, and no more", "[light]") {
  const double at = light::geodesic_falloff(Space::spherical, kHalfTurn, kHalfTurn, 0.05),
               beside = light::geodesic_falloff(Space::spherical, kHalfTurn - 0.05, kHalfTurn - 0.05, 0.05);
  CHECK(std::isfinite(at));
  CHECK(at == Approx(1 / (4 * kHalfTurn * kHalfTurn * std::sin(0.05))).epsilon(0.01));
  CHECK(at == Approx(beside).epsilon(0.05));
}

TEST_CASE("the falloff counts the geodesics that reach a small patch", "[light]") {
  for (const Space space : {Space::hyperbolic, Space::euclidean, Space::spherical}) {
    // Geodesics of all directions alike from height 0.5 over the origin; the patch: floor between the arcs 0.9 and 1.0.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    constexpr int kCount = 2'000'000;
    int arrived = 0;
    for (int i = 0; i < kCount; ++i) {
      const double m = 2 * uniform(random) - 1;
      if (m >= 0) continue;
      const double t = 0.5 / -m, s = t * std::sqrt(1 - m * m);
      arrived += s > 0.9 && s < 1.0;
    }
    double expected = 0;
    for (int i = 0; i < 100; ++i) {
      const double s = 0.9 + (i + 0.5) * 0.001, l = std::hypot(s, 0.5);
      expected += light::geodesic_falloff(space, l, s, 0.01) * (0.5 / l) * 2 * kHalfTurn * geometry::sin_k(space, s) * 0.001;
    }
    CHECK(static_cast<double>(arrived) / kCount == Approx(expected).epsilon(0.01));
  }
}

TEST_CASE("all the power of a lamp arrives in a closed room, in all three spaces and for every kind", "[light]") {
  for (const char* orbifold : {"*222", "*2222", "*22222"})
    for (const scene::LampKind kind : {scene::LampKind::point, scene::LampKind::spot, scene::LampKind::disk, scene::LampKind::sphere}) {
      if (kind != scene::LampKind::point && std::string(orbifold) == "*222") continue;
      const Lit l = lit(lit_scene(orbifold, kind, false), 0);
      INFO(orbifold << ", kind " << static_cast<int>(kind));
      CHECK(flux(l) == Approx(10).epsilon(0.012));
    }
}

TEST_CASE("light over a mirror is the light of an image behind it, times the reflectance", "[light]") {
  scene::Scene scene = lit_scene("*2222", scene::LampKind::point, true);
  const Lit straight = lit(scene, 0), once = lit(scene, 1);
  const geometry::Point p = geometry::point_from_log(Space::euclidean, {0.05, -0.1});
  double expected = on_floor(straight, p, 0, 1);
  const Position lamp = straight.field.lamps[0].centre;
  for (int w = 0; w < 4; ++w) {
    const geometry::Point image = room::reflection_in_wall(straight.room.room, w) * lamp.floor;
    const double l = std::hypot(geometry::distance(Space::euclidean, image, p), lamp.z);
    expected += 0.9 * 10 / (4 * kHalfTurn * l * l) * lamp.z / l;
  }
  CHECK(on_floor(once, p, 0, 1) == Approx(expected).epsilon(1e-9));
}

TEST_CASE("on a half sphere light comes back from the mirror, past the antipode", "[light]") {
  scene::Scene scene = lit_scene("*", scene::LampKind::point, true);
  const Lit l = lit(scene, 2);
  REQUIRE(l.field.images.size() == 5);  // straight, and around both ways; by the mirror, near and far
  const geometry::Point p = geometry::point_from_log(Space::spherical, {-0.4, 0.3});
  const Position lamp = l.field.lamps[0].centre;
  double expected = 0;
  const double d = geometry::distance(Space::spherical, p, lamp.floor);
  const double e = geometry::distance(Space::spherical, p, room::reflection_in_wall(l.room.room, 0) * lamp.floor);
  const std::pair<double, double> ways[] = {
      {d, 1}, {2 * kHalfTurn - d, 0.81}, {2 * kHalfTurn + d, 0.81}, {e, 0.9}, {2 * kHalfTurn - e, 0.9}};
  for (const auto& [arc, weight] : ways) {
    const double length = std::hypot(arc, lamp.z);
    expected += weight * 10 * light::geodesic_falloff(Space::spherical, length, arc, 0.02) * lamp.z / length;
  }
  CHECK(on_floor(l, p, 0, 1) == Approx(expected).epsilon(1e-6));
}

TEST_CASE("rooms that are no orbifolds get each image only through its own mirrors", "[light]") {
  scene::Scene scene = scene::default_scene(notation::parse("*2222").value());
  const Lit by_group = lit(lit_scene("*2222", scene::LampKind::point, true), 2);
  std::vector<light::LampImage> images = by_group.field.images;
  CHECK(images.size() == 13);
  // The same room, asked word by word, gives the same light.
  Lit by_words = lit(lit_scene("*2222", scene::LampKind::point, true), 2);
  place::PlacedRoom other = by_words.room;
  other.room.orbifold.corners[0] = Rational(5, 2);  // only what decides how images are listed
  by_words.field.images = light::lamp_images(by_words.field.lamps, other).value();
  by_words.field.near = light::near_images(by_words.field, serial_executor());
  CHECK(by_words.field.images.size() == 1 + 4 + 12);
  for (const double x : {0.03, 0.21, -0.17}) {
    const geometry::Point p = geometry::point_from_log(Space::euclidean, {x, 0.111});
    CHECK(on_floor(by_words, p, 0, 1) == Approx(on_floor(by_group, p, 0, 1)).epsilon(1e-9));
  }
}

TEST_CASE("a lamp that reaches through a wall is refused; one without power is told", "[light]") {
  scene::Scene scene = lit_scene("*2222", scene::LampKind::sphere, true);
  scene.lamps[0].place.z = scene.room.height;
  const auto room = room::realise(scene.orbifold, scene.room.shape).value();
  const auto refused = light::hang_lamps(scene, room);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().front().code == "light.lamp-in-wall");
  scene.lamps[0].place.z = 0.5;
  scene.lamps[0].power = 0;
  CHECK(light::hang_lamps(scene, room)->warnings.front().code == "light.no-power");
}

TEST_CASE("the samples of a pixel together see the light that one alone sees, with fewer shadow rays each", "[light]") {
  for (const char* orbifold : {"*222", "*333", "*22222"})
    for (const scene::LampKind kind : {scene::LampKind::point, scene::LampKind::sphere, scene::LampKind::rectangle}) {
      scene::Scene scene = lit_scene(orbifold, kind, true);
      scene.lamps.front().power = 3;
      const Lit l = lit(scene, 3);
      REQUIRE(l.field.images.size() > 5);
      for (const int samples : {2, 4, 9, 16, 64}) {
        double most = 0, spread = 0;
        for (int k = 0; k < 20; ++k) {
          const geometry::Point p =
              geometry::point_along(l.room.room.space, {}, geometry::Tangent(0, std::cos(0.3 * k), std::sin(0.3 * k)), 0.02 * k);
          const light::LightPoint point{{p, 0}, {{0, 0, 0}, 1}, {p, 0}, -1, false};
          const double whole = light::irradiance(l.field, point).r / kHalfTurn;
          double sum = 0;
          for (int s = 0; s < samples; ++s) {
            const double one = light::irradiance(l.field, point, light::Turn{s, samples}).r / kHalfTurn;
            sum += one, spread = std::max(spread, std::fabs(one - whole));
          }
          most = std::max(most, std::fabs(sum / samples - whole));
        }
        INFO(orbifold << ", " << samples << " samples");
        CHECK(most < l.field.options.step);
        CHECK(spread < 0.25);  // each may be off by its steps, since only the mean is seen
        if (samples == 64) CHECK(spread > 0);
      }
    }
}

TEST_CASE("a white surface under E = π shows as white", "[light]") {
  light::LightField field;
  const scene::Color shown = light::radiance_out(field, {}, {1, 1, 1}, {kHalfTurn, kHalfTurn / 2, 0});
  CHECK(shown.r == Approx(1));
  CHECK(shown.g == Approx(0.5));
}

TEST_CASE("the normals of a ball are those of the sphere, those of a box are its faces'", "[light]") {
  scene::Scene scene = lit_scene("*22222", scene::LampKind::point, true);
  scene.objects.resize(2);
  scene.objects[0].shape = scene::SphereSpec{0.1};
  scene.objects[1].shape = scene::BoxSpec{};
  scene.objects[1].place.floor = scene::AtPolar{0.3, Angle::from_degrees(120)};
  const Lit l = lit(scene, 0);
  const std::size_t ball = l.room.parts.size() - 2, box = ball + 1;
  const light::PartNormals& round = l.field.normals[ball];
  CHECK(round.vertices.size() == l.room.parts[ball].floor.size());
  for (const light::ShadingVertex& v : round.vertices) {
    const double z = (l.room.parts[ball].z[v.vertex] - 0.1) / 0.1;
    CHECK(v.normal.z == Approx(z).margin(0.05));
  }
  for (const light::ShadingVertex& v : l.field.normals[box].vertices)
    CHECK(std::min(std::fabs(std::fabs(v.normal.z) - 1), std::fabs(v.normal.z)) < 1e-9);
}

TEST_CASE("the bake holds the light of every point, and the same bytes for any executor", "[light]") {
  scene::Scene scene = lit_scene("*22222", scene::LampKind::sphere, true);
  scene.objects.resize(1);
  scene.objects[0].shape = scene::SphereSpec{0.1};
  scene.objects[0].place.floor = scene::AtPolar{0.25, Angle::from_degrees(200)};
  scene.ambient = {0.2, 0.2, 0.2};
  const Lit l = lit(scene, 1);
  light::BakeOptions options;
  options.coarse = 12, options.fine = 48;
  const light::Baked baked = light::bake(l.room, l.field, options, serial_executor()).value();
  const Executor backwards = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = count; i-- > 0;) task(i);
  };
  CHECK(light::bake(l.room, l.field, options, backwards)->atlas.image.rgba == baked.atlas.image.rgba);
  CHECK(baked.atlas.deep.rgb.empty());
  options.deep = true;
  const light::Atlas deep = light::bake(l.room, l.field, options, serial_executor())->atlas;
  REQUIRE(deep.image.rgba == baked.atlas.image.rgba);
  REQUIRE(deep.deep.rgb.size() == deep.image.rgba.size() / 4 * 3);
  std::size_t finer = 0;
  double apart = 0;   // in steps of 8 bits: both are the same light, rounded
  for (std::size_t i = 0; i < deep.deep.rgb.size(); ++i) {
    apart = std::max(apart, std::fabs(deep.deep.rgb[i] / 257.0 - deep.image.rgba[i / 3 * 4 + i % 3]));
    finer += deep.deep.rgb[i] % 257 != 0;
  }
  CHECK(apart <= 0.502);
  CHECK(finer > deep.deep.rgb.size() / 2);
  int far_off = 0, asked = 0;
  const mesh::Image& image = baked.atlas.image;
  for (std::size_t p = 0; p < l.room.parts.size(); ++p) {
    const place::PlacedMesh& part = l.room.parts[p];
    REQUIRE(baked.atlas.room.parts[p].triangles.size() == part.triangles.size());
    for (std::size_t t = 0; t < part.triangles.size(); t += 7) {
      const std::array<double, 3> b{0.3, 0.5, 0.2};
      const scene::Color e = light::irradiance(l.field, light::light_point(l.room, part, l.field.normals[p], t, b));
      const place::Look& look = l.room.looks[part.look[t]];
      const double expected = 255 * scene::encode_srgb(light::radiance_out(l.field, look.material, look.color, e).g);
      double u = 0, v = 0;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t id = baked.atlas.room.parts[p].triangles[t][k];
        u += b[k] * baked.atlas.uv[p][id][0], v += b[k] * baked.atlas.uv[p][id][1];
      }
      const double x = u * image.width - 0.5, y = v * image.height - 0.5;
      const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
      double linear = 0;
      for (int k = 0; k < 4; ++k) {
        const int xi = std::min(x0 + k % 2, image.width - 1), yi = std::min(y0 + k / 2, image.height - 1);
        const double w = (k % 2 ? x - x0 : 1 - x + x0) * (k / 2 ? y - y0 : 1 - y + y0);
        linear += w * scene::decode_srgb(image.rgba[4 * (static_cast<std::size_t>(yi) * image.width + xi) + 1] / 255.0);
      }
      ++asked;
      far_off += std::fabs(255 * scene::encode_srgb(linear) - expected) > 4;
    }
  }
  CHECK(far_off <= asked / 50);  // shadow borders
}

TEST_CASE("no lookup of baked light leaves its block: the nearest texel, or the four that POV-Ray, Cycles and WebGL blend", "[light]") {
  // They blend linear light or codes, wrap or clamp: all the same as long as the four are the block's own.
  scene::Scene scene = lit_scene("*2222", scene::LampKind::sphere, true);
  scene.objects.resize(1);
  scene.objects[0].shape = scene::SphereSpec{0.1};
  const Lit l = lit(scene, 0);
  light::BakeOptions options;
  options.coarse = 6, options.fine = 24;
  const light::Baked baked = light::bake(l.room, l.field, options, serial_executor()).value();
  const mesh::Image& image = baked.atlas.image;
  for (std::size_t p = 0; p < l.room.parts.size(); ++p) {
    std::vector<const light::Box*> box(l.room.parts[p].triangles.size(), nullptr);
    for (std::size_t i = 0; i < baked.blocks[p].size(); ++i) {
      box[baked.blocks[p][i].first] = &baked.boxes[p][i];
      if (baked.blocks[p][i].second >= 0) box[static_cast<std::size_t>(baked.blocks[p][i].second)] = &baked.boxes[p][i];
    }
    for (std::size_t t = 0; t < box.size(); ++t)
      for (const std::array<double, 3>& b : {std::array{1.0, 0.0, 0.0},
                                             {0.0, 1.0, 0.0},
                                             {0.0, 0.0, 1.0},
                                             {0.5, 0.5, 0.0},
                                             {0.0, 0.5, 0.5},
                                             {0.5, 0.0, 0.5},
                                             {0.3, 0.3, 0.4}}) {
        double at[2] = {0, 0};
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t c = 0; c < 2; ++c)
            at[c] += b[k] * static_cast<double>(baked.atlas.uv[p][baked.atlas.room.parts[p].triangles[t][k]][c]);
        const double x = at[0] * image.width - 0.5, y = at[1] * image.height - 0.5;
        constexpr double kNothing = 2e-3;   // of a texel: what single precision leaves
        REQUIRE(x > box[t]->x - kNothing);
        REQUIRE(y > box[t]->y - kNothing);
        REQUIRE(x < box[t]->x + box[t]->width - 1 + kNothing);
        REQUIRE(y < box[t]->y + box[t]->height - 1 + kNothing);
      }
  }
}

TEST_CASE("solid patterns are the same stone everywhere and stay between their colours", "[light]") {
  CHECK(light::solid_pattern(scene::Pattern::granite, {0.1, 0.2, 0.3}, 0.2) ==
        light::solid_pattern(scene::Pattern::granite, {0.1, 0.2, 0.3}, 0.2));
  for (const scene::Pattern pattern : {scene::Pattern::marble, scene::Pattern::wood, scene::Pattern::granite}) {
    double low = 1, high = 0, jump = 0, last = 0;
    for (int i = 0; i < 4000; ++i) {
      const double t = light::solid_pattern(pattern, {i * 0.0005, 0.3 - i * 0.0002, i * 0.0001}, 0.25);
      low = std::min(low, t), high = std::max(high, t);
      if (i > 0) jump = std::max(jump, std::fabs(t - last));
      last = t;
    }
    CHECK(low >= 0);
    CHECK(high <= 1);
    CHECK(high - low > 0.5);
    CHECK(jump < 0.3);
  }
}
