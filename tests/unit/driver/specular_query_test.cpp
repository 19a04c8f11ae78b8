// What an export shows in a mirror or in glass is what the tracer's own ray from the eye brings back.
#include "compiler/driver/specular_query.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "compiler/bake/unfolded_eye.h"
#include "compiler/cover/unfold.h"
#include "compiler/driver/trace_film.h"
#include "compiler/render/draw.h"
#include "compiler/render/radiance.h"

using namespace orbc;

namespace {

driver::LoadedScene loaded(const std::string& orbifold, const std::string& material) {
  const auto path = std::filesystem::temp_directory_path() / ("orbc-see-in-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(path) << "orbc: 1\norbifold: \"" + orbifold +
                             "\"\nroom: {height: 0.9}\nobjects:\n"
                             "  - {sphere: {radius: 0.15}, at: {polar: [0.1, 60deg]}, material: " +
                             material +
                             "}\n"
                             "  - {box: {size: [0.1, 0.1, 0.1]}, at: {polar: [0.3, 100deg]}, material: tomato}\n"
                             "lights:\n  - {kind: point, at: {polar: [0.05, 200deg], z: 0.8}, power: 8}\n"
                             "camera: {at: {polar: [0.3, 230deg], z: 0.45}, fov: 100deg, size: [40, 30]}\n"
                             "cover: {max_bounces: 2}\n";
  auto done = driver::load(path.string());
  std::filesystem::remove(path);
  REQUIRE(done);
  return std::move(done).value();
}

}  // namespace

TEST_CASE("what is seen in mirrors, metals and glass of any copy is what the eye's own ray brings back", "[driver]") {
  for (const std::string orbifold : {"*222", "*2222", "*22222"}) {
    for (const std::string material : {"mirror", "glass", "silver", "gold"}) {
      CAPTURE(orbifold, material);
      const driver::PreparedScene scene(loaded(orbifold, material));
      const Executor executor = serial_executor();
      const Progress silent;
      const driver::Run run{executor, silent};
      const place::Camera& eye = scene.loaded().eye;
      const auto query = driver::specular_query(scene, eye, nullptr, run);
      const trace::TraceScene& tracer = scene.trace_context(run).tracer;
      render::DrawOptions draw = driver::draw_options(scene, eye, run);
      draw.specular_samples = 128;  // as many as exports of normal quality look for
      const auto copies = cover::unfold(scene.interior(), eye, scene.scene().cover).value();
      int met = 0, same = 0, shared = 0;
      for (int y = 0; y < eye.height; ++y) {
        for (int x = 0; x < eye.width; ++x) {
          const render::RayResult seen = render::radiance(tracer, render::eye_ray(eye, x + 0.5, y + 0.5), draw);
          const bool ball = seen.hit && seen.surface.kind == place::PartKind::object &&
                            scene.interior().parts[static_cast<std::size_t>(seen.surface.part)].name == "sphere";
          if (!ball) continue;
          // the copy that the eye's ray has come to: the one whose image of the eye it comes from
          for (const cover::Copy& copy : copies) {
            if (copy.bounces != seen.path.bounces || copy.sheet != 0) continue;
            const trace::Direction to_eye = bake::direction_to_eye(copy, eye, seen.surface.at);
            const trace::Direction off = to_eye + seen.surface.incoming;
            if (trace::inner(scene.interior().polygon.space, off, off) > 1e-12) continue;
            const scene::Color c = copy.weight * query(seen.surface.at, to_eye, copy, 0, {});
            scene::Color in_turns;  // as the points that are one texel share its ways out
            for (int k = 0; k < 4; ++k) in_turns = in_turns + 0.25 * (copy.weight * query(seen.surface.at, to_eye, copy, 0, {k, 4}));
            shared += std::fabs(c.r - in_turns.r) < 2e-3 && std::fabs(c.g - in_turns.g) < 2e-3 && std::fabs(c.b - in_turns.b) < 2e-3;
            ++met;
            same += std::fabs(c.r - seen.radiance.r) < 1e-3 && std::fabs(c.g - seen.radiance.g) < 1e-3 &&
                    std::fabs(c.b - seen.radiance.b) < 1e-3;
          }
        }
      }
      CHECK(met > 20);
      CHECK(shared >= met - met / 50);
      CHECK(same >= met - met / 50);  // an edge seen in the ball may fall on either side
    }
  }
}
