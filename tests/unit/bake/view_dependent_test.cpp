#include "compiler/bake/view_dependent.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/bake/unfolded_eye.h"
#include "compiler/cover/unfold.h"
#include "compiler/image/image.h"
#include "compiler/image/srgb.h"
#include "compiler/light/connection.h"
#include "compiler/mesh_io/load.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"
#include "compiler/trace/analytic.h"

using namespace orbc;

namespace {

/// A room with a shiny ball under a lamp, and an eye.
struct Stage {
  scene::Scene scene;
  place::Interior room;
  place::Camera eye;
  std::vector<cover::Copy> copies;
};

Stage stage(const std::string& orbifold, int bounces, scene::MaterialKind kind) {
  Stage s;
  s.scene = scene::default_scene(notation::parse(orbifold).value());
  scene::Object ball;
  ball.name = "ball";
  ball.shape = scene::SphereSpec{0.12};
  ball.place.floor = scene::AtPolar{0.1, Angle::from_degrees(70)};
  ball.material = scene::Material{};
  ball.material->kind = kind;
  ball.material->roughness = 0.3;
  s.scene.objects = {ball};
  scene::Lamp lamp;
  lamp.place.floor = scene::AtPolar{0.15, Angle::from_degrees(200)};
  lamp.place.z = 0.7;
  lamp.power = 4;
  s.scene.lamps = {lamp};
  s.scene.camera.place.floor = scene::AtPolar{0.3, Angle::from_degrees(250)};
  s.scene.camera.place.z = 0.4;
  s.scene.camera.size = {160, 120};
  s.scene.cover.max_bounces = bounces;
  s.room =
      place::furnish(s.scene, room::realise(s.scene.orbifold, s.scene.room.shape).value(), mesh_io::assets_from_files()).value().interior;
  s.eye = place::make_camera(s.scene, s.room).value();
  s.copies = cover::unfold(s.room, s.eye, s.scene.cover).value();
  return s;
}

bake::DiffuseBake baked_of(const Stage& s, const light::LightingContext& lighting) {
  bake::BakeOptions options;
  options.min_density = 8, options.max_density = 16;
  return bake::bake_diffuse(s.room, lighting, options, serial_executor()).value();
}

}  // namespace

TEST_CASE("a point of a copy sees the eye where real mirrors bring its light to the eye", "[bake]") {
  const std::string orbifold = GENERATE("*222", "*333", "*22222", "*");
  const Stage s = stage(orbifold, orbifold == "*" ? 5 : 3, scene::MaterialKind::glossy);
  const geometry::Space space = s.room.polygon.space;
  const trace::Prism prism{space, s.room.height, s.room.polygon.walls};
  const geometry::Position eye{s.eye.room_from_eye * geometry::Point(), s.eye.z};
  const geometry::Position at{geometry::point_along(space, {}, geometry::Tangent(0, 0.6, 0.8), 0.17), 0.55};
  std::size_t seen = 0;
  for (const cover::Copy& copy : s.copies) {
    trace::Ray ray = trace::ray_from(space, at, bake::direction_to_eye(copy, s.eye, at));
    for (int i = 0; i < copy.bounces; ++i) {
      const trace::Exit exit = trace::exit_of(prism, ray);
      if (exit.surface < 0) break;
      ray = trace::reflected_in_wall(prism, ray, exit.t, exit.surface);
    }
    const light::Connection rest = light::connect(space, {ray.at, ray.z}, eye, 0);
    INFO(orbifold << " copy " << cover::to_string(copy.word) << " sheet " << copy.sheet);
    CHECK(trace::inner(space, rest.direction, {ray.c * ray.along, ray.m}) == Approx(1).margin(1e-9));
    seen += copy.sheet > 0;
  }
  CHECK((orbifold != "*" || seen > 0));
}

TEST_CASE("baked highlights are the light that a shiny ball sends to the eye, copy by copy", "[bake]") {
  const Stage s = stage("*333", 2, scene::MaterialKind::glossy);
  const auto lighting = light::prepare_light(s.scene, s.room).value();
  REQUIRE(bake::needs_view_bake(s.room, lighting));
  const bake::DiffuseBake diffuse = baked_of(s, lighting);
  const image::Image& before = diffuse.atlas.image;
  const bake::ViewBake view = bake::bake_view_dependent({s.room, lighting, diffuse, s.copies, {}, s.eye}, {}, serial_executor());
  REQUIRE(view.copy_uv.size() > s.copies.size() / 2);
  CHECK(view.counts.copies_left_out == 0);
  double brightest = 0;
  for (const bake::CopyUv& own : view.copy_uv) {
    const place::PlacedMesh& part = s.room.parts[own.part];
    REQUIRE(part.name == "ball");
    const place::PlacedMesh& vertices = diffuse.atlas.room.parts[own.part];
    std::size_t checked = 0;
    for (std::size_t t = 0; t < part.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = vertices.triangles[t][k];
        if (own.uv[v] == view.uv[own.part][v]) continue;
        const surface::ShadingPoint point =
            surface::shading_point(s.room, part, lighting.normals[own.part].vertices[lighting.normals[own.part].corners[t][k]]);
        const scene::Material& material = s.room.styles[part.style[t]].material;
        const scene::Color gloss =
            light::highlight(lighting, point, bake::direction_to_eye(s.copies[own.copy], s.eye, point.at), material, material.color);
        const scene::Color all = light::outgoing_radiance(lighting, material, material.color, light::irradiance(lighting, point)) + gloss;
        const int x = static_cast<int>(static_cast<double>(own.uv[v][0]) * view.image.width),
                  y = static_cast<int>(static_cast<double>(own.uv[v][1]) * view.image.height);
        const int code =
            view.image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(view.image.width) + static_cast<std::size_t>(x))];
        CHECK(code == Approx(255 * image::encode_srgb(std::min(1.0, lighting.exposure * all.r))).margin(2.1));
        brightest = std::max(brightest, gloss.r);
        ++checked;
      }
    CHECK(checked > 0);
  }
  CHECK(brightest > 0.2);
  // What all copies share keeps its texels.
  for (int y = 0; y < before.height; ++y)
    CHECK(std::equal(before.rgba.begin() + 4 * y * before.width, before.rgba.begin() + 4 * (y + 1) * before.width,
                     view.image.rgba.begin() + 4 * y * view.image.width));
}

TEST_CASE("highlights are the same bytes for any executor, and none are baked for matte rooms", "[bake]") {
  const Stage s = stage("*22222", 1, scene::MaterialKind::glossy);
  const auto lighting = light::prepare_light(s.scene, s.room).value();
  const bake::DiffuseBake diffuse = baked_of(s, lighting);
  const Executor backwards = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = count; i-- > 0;) task(i);
  };
  const auto a = bake::bake_view_dependent({s.room, lighting, diffuse, s.copies, {}, s.eye}, {}, serial_executor());
  const auto b = bake::bake_view_dependent({s.room, lighting, diffuse, s.copies, {}, s.eye}, {}, backwards);
  CHECK(a.image.rgba == b.image.rgba);
  REQUIRE(a.copy_uv.size() == b.copy_uv.size());
  for (std::size_t i = 0; i < a.copy_uv.size(); ++i) CHECK((a.copy_uv[i].copy == b.copy_uv[i].copy && a.copy_uv[i].uv == b.copy_uv[i].uv));
  const Stage matte = stage("*22222", 1, scene::MaterialKind::matte);
  CHECK_FALSE(bake::needs_view_bake(matte.room, light::prepare_light(matte.scene, matte.room).value()));
}

TEST_CASE("the eye sees a point of a copy where its log map takes it", "[bake]") {
  // Against the map by which copies are bent: two roads to the same picture.
  for (const char* orbifold : {"*333", "*22222", "*222"}) {
    const Stage s = stage(orbifold, 2, scene::MaterialKind::glossy);
    const place::PlacedMesh& ball = s.room.parts[s.room.parts.size() - 1];
    for (const cover::Copy& copy : s.copies) {
      if (copy.sheet != 0) continue;
      const geometry::Position at{ball.floor[7], ball.z[7]};
      const auto seen = bake::direction_from_eye(copy, s.eye, at);
      REQUIRE(seen);
      const geometry::Point there = geometry::inverse(s.eye.room_from_eye) * (copy.cover_from_room * at.floor);
      const double arc = geometry::arc_k(s.eye.room_from_eye.space, there.w, std::hypot(there.x, there.y));
      const double flat = arc / std::hypot(there.x, there.y);
      const geometry::Vector3 bent =
          geometry::normalised({flat * there.x, flat * there.y, copy.storey.sign * at.z + copy.storey.offset - s.eye.z});
      CHECK(geometry::length(*seen - bent) < 1e-9);
    }
  }
}

TEST_CASE("a side takes as many pixels in the picture as its ends lie apart there", "[bake]") {
  for (const char* orbifold : {"*333", "*22222", "*222"}) {
    const Stage s = stage(orbifold, 2, scene::MaterialKind::glossy);
    const auto space = s.eye.room_from_eye.space;
    for (const cover::Copy& copy : s.copies) {
      const bake::UnfoldedEye eye = bake::unfold_eye(copy, s.eye);
      const geometry::Position at{geometry::Point(), 0.3};
      const light::Connection sight = bake::connect(eye, at);
      REQUIRE(sight.valid);
      const double step = 1e-5;
      for (const double turn : {0.2, 1.3, 2.9}) {
        for (const double rise : {0.0, 0.7}) {
          // Straight from the centre of the room, where ambient x and y are lengths.
          const geometry::Position next{geometry::normalised_point(space, {1, step * std::cos(turn), step * std::sin(turn)}),
                                        at.z + rise * step};
          const trace::Direction side{{0, std::cos(turn), std::sin(turn)}, rise};
          const auto a = bake::direction_from_eye(copy, s.eye, at), b = bake::direction_from_eye(copy, s.eye, next);
          REQUIRE((a && b));
          const double apart = 100 * geometry::length(*b - *a) / (step * std::hypot(1.0, rise));
          const double said = bake::pixel_footprint(eye, sight, at, side, 100);
          CHECK(said > 0.999 * apart);
          CHECK(said < 1.001 * std::max(apart, std::hypot(apart, 0.3 * 100 / sight.length)));
        }
      }
    }
  }
}

TEST_CASE("what lies beside the picture has coarser highlights, what lies in it keeps them", "[bake]") {
  Stage s = stage("*333", 0, scene::MaterialKind::glossy);
  const auto lighting = light::prepare_light(s.scene, s.room).value();
  const bake::DiffuseBake shared = baked_of(s, lighting);
  const auto texels = [&](double coarser) {
    bake::ViewBakeOptions options;
    options.offscreen_factor = coarser;
    return bake::bake_view_dependent({s.room, lighting, shared, s.copies, {}, s.eye}, options, serial_executor()).counts.texels;
  };
  const place::PlacedMesh& ball = s.room.parts[s.room.parts.size() - 1];
  s.eye.forward = *bake::direction_from_eye(s.copies[0], s.eye, {ball.floor[7], ball.z[7]});
  CHECK(texels(4) == texels(1));
  s.eye.forward = -1.0 * s.eye.forward;
  CHECK(texels(4) < texels(1) / 2);
}
