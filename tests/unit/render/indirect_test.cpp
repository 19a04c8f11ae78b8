#include "compiler/render/indirect.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "compiler/bake/baked_light.h"
#include "compiler/geometry/chart.h"
#include "compiler/image/srgb.h"
#include "compiler/mesh_io/load.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/render/radiance.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"

using namespace orbc;

namespace {

struct Lit {
  scene::Scene scene;
  place::Interior room;
  light::LightingContext lighting;
  trace::TraceScene traced;
};

std::unique_ptr<Lit> lit(const scene::Scene& scene, int passes, int mirrors = 2) {
  auto result = std::make_unique<Lit>();
  result->scene = scene;
  result->room =
      place::furnish(scene, room::realise(scene.orbifold, scene.room.shape).value(), mesh_io::assets_from_files()).value().interior;
  light::LightOptions options;
  options.bounces = mirrors, options.indirect_bounces = passes, options.cull_below = 0, options.path_bounces = 400;
  result->lighting = light::prepare_light(result->scene, result->room, options).value();
  result->traced = trace::prepare(result->room);
  return result;
}

render::DrawOptions drawing(const Lit& l, int samples) {
  render::DrawOptions options;
  options.lighting = &l.lighting;
  options.samples = samples;
  options.paths = 2;
  options.max_bounces = 400;
  return options;
}

place::Camera eye_in(const place::Interior& room, int width, int height) {
  place::Camera eye;
  eye.room_from_eye = geometry::translation_by(room.polygon.space, 0.05 * room.polygon.inradius, 0.03 * room.polygon.inradius);
  eye.z = 0.3 * room.height;
  eye.width = width, eye.height = height;
  return eye;
}

// A room whose every surface has one colour, without lamps; a ball stands in it.
scene::Scene bare(const char* notation, const scene::Color& albedo, bool mirrors) {
  scene::Scene s = scene::default_scene(notation::parse(notation).value());
  scene::Material plain;
  plain.color = albedo;
  s.room.floor.material = s.room.ceiling.material = plain;
  for (scene::Wall& wall : s.room.walls) {
    wall.material = plain;
    if (!mirrors) wall.mirrors.clear();
    for (scene::Mirror& mirror : wall.mirrors) mirror.frame.reset(), mirror.reflectance = 0.9;
  }
  s.objects.resize(1);
  s.objects[0].shape = scene::SphereSpec{0.12};
  s.objects[0].place.floor = scene::AtPolar{0.3, Angle::from_degrees(5)};
  s.objects[0].material = plain;
  s.lamps.clear();
  return s;
}

struct Mean {
  double value = 0, error = 0;  ///< of the picture, red
};
Mean mean_of(const render::Film& film) {
  Mean mean;
  double squares = 0;
  for (std::size_t i = 0; i < film.color.size(); ++i)
    mean.value += film.color[i].r, squares += static_cast<double>(film.error[i]) * film.error[i];
  const double n = static_cast<double>(film.color.size());
  mean.value /= n, mean.error = std::sqrt(squares) / n;
  return mean;
}

const char* const kRooms[] = {"*222", "*2222", "*22222"};  // S², E², H²

/// A matte ball of 0.5 in a room that gives off 0.4 everywhere.
scene::Scene glowing(const char* notation) {
  scene::Scene s = bare(notation, {0.5, 0.5, 0.5}, false);
  scene::Material glow;
  glow.kind = scene::MaterialKind::emissive;
  glow.color = {0.4, 0.4, 0.4};
  s.room.floor.material = s.room.ceiling.material = glow;
  for (scene::Wall& wall : s.room.walls) wall.material = glow;
  return s;
}

}  // namespace

TEST_CASE("a room all of one colour under ambient light glows like a furnace: ρ·a/(1 − ρ)", "[render]") {
  for (const char* notation : kRooms)
    for (const double albedo : {0.3, 0.7}) {
      scene::Scene s = bare(notation, {albedo, albedo, albedo}, false);
      s.ambient = {0.1, 0.1, 0.1};
      const auto l = lit(s, 64);
      const Mean seen = mean_of(render::draw(l->traced, eye_in(l->room, 24, 18), drawing(*l, 64), serial_executor()));
      const double expected = 0.1 * albedo / (1 - albedo);
      INFO(notation << ", albedo " << albedo << ": " << seen.value << " ± " << seen.error << ", expected " << expected);
      CHECK(seen.error < 0.004 * expected);
      CHECK(std::fabs(seen.value - expected) < std::min(4 * seen.error, 0.01 * expected));
    }
}

TEST_CASE("every matte surface in an emissive room takes on ρ times its light", "[render]") {
  for (const char* notation : kRooms) {
    const scene::Scene s = glowing(notation);
    const auto l = lit(s, 8);
    const render::Film film = render::draw(l->traced, eye_in(l->room, 32, 24), drawing(*l, 16), serial_executor());
    double on_ball = 0;
    int ball = 0;
    for (std::size_t i = 0; i < film.color.size(); ++i) {
      const auto part = static_cast<std::size_t>(std::max(film.object[i], 0));
      if (film.object[i] < 0 || l->room.parts[part].kind != place::PartKind::object) {
        CHECK(film.color[i].r == Approx(0.4).margin(0.2));  // pixels at the ball's edge are mixed
        continue;
      }
      on_ball += film.color[i].r, ++ball;
    }
    INFO(notation << ": " << ball << " pixels of the ball");
    REQUIRE(ball > 3);
    CHECK(on_ball / ball == Approx(0.2).margin(0.03));
  }
}

TEST_CASE("metal shows what it keeps of a furnace: white all of it, however rough, others their colour, white when grazing", "[render]") {
  for (const char* notation : kRooms)
    for (const double roughness : {0.0, 0.05, 0.2, 0.6, 1.0}) {
      scene::Scene s = glowing(notation);
      s.objects[0].material->kind = scene::MaterialKind::metal;
      s.objects[0].material->roughness = roughness;
      s.objects[0].material->color = {1, 0.5, 0.25};
      const auto l = lit(s, 8);
      const place::Camera eye = eye_in(l->room, 32, 24);
      render::Film film = render::draw(l->traced, eye, drawing(*l, 1), serial_executor());
      int ball = 0;
      double sum = 0;
      for (std::size_t i = 0; i < film.color.size(); ++i) {
        const auto part = static_cast<std::size_t>(std::max(film.object[i], 0));
        if (film.object[i] < 0 || l->room.parts[part].kind != place::PartKind::object) continue;
        ++ball;
        INFO(notation << ", roughness " << roughness);
        // At the outline some ways of its smooth normals lead into the triangles.
        CHECK(film.color[i].r < 0.406);
        CHECK(film.color[i].r > 0.37);
        sum += film.color[i].r;
        // More than its half at grazing angles, where all metals are white; less where light meets several facets.
        CHECK(film.color[i].g >= (roughness < 0.1 ? 0.5 : roughness < 0.3 ? 0.48 : roughness < 0.7 ? 0.44 : 0.3) * film.color[i].r - 1e-6);
        CHECK(film.color[i].b < film.color[i].g);
      }
      CHECK(ball > 3);
      CHECK(sum / ball == Approx(0.4).epsilon(0.01));
    }
}

TEST_CASE("gloss and metal under lamps are as bright by few samples a pixel as by many", "[render]") {
  for (const char* notation : kRooms)
    for (const auto kind : {scene::MaterialKind::glossy, scene::MaterialKind::metal}) {
      scene::Scene s = bare(notation, {0, 0, 0}, false);  // so that all light is of the ball
      s.objects[0].material->kind = kind, s.objects[0].material->roughness = kind == scene::MaterialKind::metal ? 0.3 : 0.15;
      s.objects[0].material->color = kind == scene::MaterialKind::metal ? scene::Color{0.9, 0.6, 0.3} : scene::Color{};
      scene::Lamp lamp;
      lamp.kind = scene::LampKind::sphere, lamp.radius = 0.05, lamp.power = 4;
      lamp.place.z = 0.8;
      s.lamps = {lamp};
      const auto l = lit(s, 0);
      const place::Camera eye = eye_in(l->room, 48, 36);
      std::vector<double> means;
      for (const int samples : {4, 9, 36}) {
        render::DrawOptions options = drawing(*l, samples);
        options.specular_samples = 4;  // the room is black
        const render::Film film = render::draw(l->traced, eye, options, serial_executor());
        double sum = 0;
        for (const scene::Color& c : film.color) sum += c.r;
        means.push_back(sum);
      }
      REQUIRE(means.back() > 0.25);
      INFO(notation << ": " << means[0] << " " << means[1] << " " << means[2]);
      CHECK(means[0] == Approx(means[2]).epsilon(0.03));  // pixels are large beside a highlight
      CHECK(means[1] == Approx(means[2]).epsilon(0.02));
    }
}

TEST_CASE("mirrors that keep everything change nothing in a furnace; others darken it as they must", "[render]") {
  for (const char* notation : kRooms) {
    scene::Scene s = bare(notation, {0.6, 0.6, 0.6}, true);
    s.ambient = {0.1, 0.1, 0.1};
    for (scene::Wall& wall : s.room.walls)
      for (scene::Mirror& mirror : wall.mirrors) mirror.reflectance = 1;
    s.objects[0].material->kind = scene::MaterialKind::mirror;
    s.objects[0].material->color = {1, 1, 1};
    const auto l = lit(s, 64);
    const Mean seen = mean_of(render::draw(l->traced, eye_in(l->room, 24, 18), drawing(*l, 36), serial_executor()));
    INFO(notation << ": " << seen.value << " ± " << seen.error);
    CHECK(std::fabs(seen.value - 0.15) < std::min(4 * seen.error, 0.0015));
  }
}

TEST_CASE("where nothing else reflects, paths bring a ball nothing", "[render]") {
  scene::Scene s = bare("*22222", {0, 0, 0}, false);
  scene::Lamp lamp;
  lamp.place.z = 0.7;
  s.lamps = {lamp};
  s.objects[0].material->color = {0.8, 0.7, 0.6};
  const auto direct = lit(s, 0), path = lit(s, 8);
  const render::Film a = render::draw(direct->traced, eye_in(direct->room, 40, 30), drawing(*direct, 1), serial_executor());
  const render::Film b = render::draw(path->traced, eye_in(path->room, 40, 30), drawing(*path, 1), serial_executor());
  CHECK(a.error.empty());
  for (std::size_t i = 0; i < a.color.size(); ++i) CHECK(b.color[i].g == Approx(a.color[i].g).margin(1e-12));
}

TEST_CASE("the stated error of a path-traced film is the spread between seeds, and a seed is a picture", "[render]") {
  scene::Scene s = bare("*22222", {0.7, 0.6, 0.5}, true);
  scene::Lamp lamp;
  lamp.place.z = 0.75;
  lamp.radius = 0.04;
  lamp.power = 1.5;
  s.lamps = {lamp};
  auto l = lit(s, 16, 1);
  const auto draw = [&](std::uint64_t seed, const Executor& executor) {
    l->lighting.options.seed = seed;
    render::DrawOptions options = drawing(*l, 16);
    options.max_bounces = l->lighting.options.path_bounces = 6;
    return render::draw(l->traced, eye_in(l->room, 32, 24), options, executor);
  };
  const Executor backwards = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = count; i-- > 0;) task(i);
  };
  const render::Film a = draw(1, serial_executor()), b = draw(2, serial_executor()), again = draw(1, backwards);
  double squares = 0, stated = 0;
  for (std::size_t i = 0; i < a.color.size(); ++i) {
    CHECK((a.color[i].r == again.color[i].r && a.error[i] == again.error[i]));
    const double d = a.color[i].r - b.color[i].r;
    squares += d * d, stated += static_cast<double>(a.error[i]) * a.error[i] + static_cast<double>(b.error[i]) * b.error[i];
  }
  INFO("spread " << std::sqrt(squares) << ", stated " << std::sqrt(stated));
  CHECK(squares > 0);
  CHECK(std::sqrt(stated / squares) > 0.8);
  CHECK(std::sqrt(stated / squares) < 1.4);
  CHECK(render::rms_noise(a, 1) > 0);
}

TEST_CASE("every stratum of a pixel occurs once, and strata with equal remainders are spread over the pixel", "[render]") {
  for (int samples = 1; samples <= 100; ++samples) {
    const auto points = render::sample_points(samples);
    std::vector<int> seen(static_cast<std::size_t>(samples), 0);
    for (int s = 0; s < samples; ++s) {
      const light::SampleStratum stratum = render::PixelSampler::stratum_of(s, samples);
      CHECK(stratum.count == samples);
      ++seen.at(static_cast<std::size_t>(stratum.index));
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
    const int side = static_cast<int>(std::lround(std::sqrt(samples)));
    for (int every = 2; every <= samples / 4 && side * side == samples; ++every) {
      if (samples % every != 0) continue;
      for (int rest = 0; rest < every; ++rest) {  // their middle is about that of the pixel
        double x = 0, y = 0;
        for (int s = 0; s < samples; ++s)
          if (render::PixelSampler::stratum_of(s, samples).index % every == rest)
            x += points[static_cast<std::size_t>(s)][0], y += points[static_cast<std::size_t>(s)][1];
        INFO(samples << ": every " << every << ", " << rest);
        CHECK(std::hypot(x * every / samples - 0.5, y * every / samples - 0.5) < 0.26);
      }
    }
  }
}

TEST_CASE("the mean of estimates by one shadow ray is the irradiance of the lamps", "[render]") {
  for (const char* notation : kRooms) {
    scene::Scene s = bare(notation, {0.5, 0.5, 0.5}, true);
    scene::Lamp lamp;
    lamp.place.z = 0.7;
    lamp.place.floor = scene::AtPolar{0.1, Angle::from_degrees(20)};
    s.lamps = {lamp};
    const auto l = lit(s, 1, 2);
    const geometry::Point at = geometry::point_along(l->room.polygon.space, {}, geometry::Tangent(0, 0.6, 0.8), 0.21);
    const surface::ShadingPoint point{{at, 0}, {{0, 0, 0}, 1}, {at, 0}, -1, false};
    surface::Random random(3);
    double sum = 0, squares = 0;
    constexpr int kCount = 40000;
    for (int i = 0; i < kCount; ++i) {
      const double e = light::estimate_irradiance(l->lighting, point, random.next_three()).r;
      sum += e, squares += e * e;
    }
    const double mean = sum / kCount, error = std::sqrt((squares / kCount - mean * mean) / kCount),
                 all = light::irradiance(l->lighting, point).r;
    INFO(notation << ": " << mean << " ± " << error << ", all " << all);
    CHECK(std::fabs(mean - all) < 4 * error + 0.005 * all);
  }
}

TEST_CASE("where a box stands on the floor the bake agrees with path tracing, without a dark or bright band", "[render]") {
  scene::Scene s = bare("*2222", {0.7, 0.7, 0.7}, false);
  s.objects.resize(1);
  s.objects[0].shape = scene::BoxSpec{{0.2, 0.2, 0.3}};
  s.objects[0].place.floor = scene::AtPolar{0.1, Angle::from_degrees(30)};
  scene::Lamp lamp;
  lamp.kind = scene::LampKind::disk;
  lamp.place.floor = scene::AtPolar{0.2, Angle::from_degrees(200)};
  lamp.place.z = 0.9 * s.room.height;
  lamp.power = 3;
  s.lamps = {lamp};
  const auto l = lit(s, 16, 1);
  bake::BakeOptions options;
  const bake::DiffuseBake baked = bake::bake_diffuse(l->room, l->lighting, options, serial_executor()).value();
  const bake::BakedLight known(l->room, baked);
  int compared = 0;
  double worst = 0;
  for (const double above : {0.002, 0.006, 0.02, 0.06}) {
    for (int side = 0; side < 12; ++side) {
      // From outside of the box towards its middle, just above the floor; and on the floor just in front of it.
      const double turn = 2 * std::numbers::pi * (side + 0.5) / 12;
      const geometry::Point middle = geometry::point_from_disk(geometry::Space::euclidean, std::polar(0.1, std::numbers::pi / 6));
      const geometry::Position from{
          geometry::point_along(geometry::Space::euclidean, middle, geometry::Tangent(0, std::cos(turn), std::sin(turn)), 0.2), above};
      for (const double down : {0.0, 0.7}) {
        const trace::Direction d{{0, -std::sqrt(1 - down * down) * std::cos(turn), -std::sqrt(1 - down * down) * std::sin(turn)}, -down};
        const trace::Ray ray = trace::ray_from(geometry::Space::euclidean, from, d);
        const trace::Hit hit = trace::closest(l->traced, ray);
        const trace::SurfacePoint point = trace::surface_at(l->traced, ray, hit);
        const auto shown = known.at(point, hit);
        if (!shown) continue;
        const surface::ShadingPoint at = light::shading_point(l->lighting, l->room, point, hit);
        render::PixelSampler chance(1, static_cast<std::uint64_t>(++compared), 0, 1);
        const scene::Color passed = render::indirect_irradiance(l->room, l->lighting, at, chance, 3000);
        const scene::Color truth =
            light::outgoing_radiance(l->lighting, l->room.styles[static_cast<std::size_t>(point.style)].material, {0.7, 0.7, 0.7},
                                     light::irradiance(l->lighting, at) + std::numbers::pi * passed);
        const double off = 255 * (image::encode_srgb(shown->r) - image::encode_srgb(truth.r));
        worst = std::max(worst, std::fabs(off));
        INFO("at height " << above << ", side " << side << ": baked " << shown->r << ", by paths " << truth.r);
        CHECK(std::fabs(off) < 8);
      }
    }
  }
  CHECK(compared > 60);
  CHECK(worst < 8);
}
