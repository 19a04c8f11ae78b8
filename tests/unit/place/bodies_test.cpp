// Bodies of stated lengths have them, in all three spaces: closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "compiler/geometry/chart.h"
#include "compiler/place/furnish.h"
#include "compiler/place/locate.h"
#include "compiler/room/realise.h"
#include "compiler/mesh_io/load.h"
#include "compiler/scene/read.h"

using namespace orbc;

namespace {

struct Measured {
  double least = 1e300, most = 0;   ///< horizontal distances of vertices from the foot
  double low = 1e300, high = 0;     ///< heights
  double along = 0, across = 0;     ///< farthest vertices on the body's two axes
};

Measured measured(const char* notation, const std::string& object, double foot = 0.1) {
  const std::string text = std::string("orbc: 1\norbifold: \"") + notation + "\"\nroom: {height: 3}\nobjects: [{" + object +
                           ", at: {polar: [" + std::to_string(foot) + ", 30deg]}}]\n";
  const auto read = scene::read_scene(SourceText{"scene.yaml", text});
  if (!read) FAIL(to_text(read.error()));
  const auto room = room::realise(read->scene.orbifold);
  REQUIRE(room);
  const auto furnished = place::furnish(read->scene, *room, mesh_io::assets_from_files());
  if (!furnished) FAIL(to_text(furnished.error()));
  const geometry::Point at = place::locate(read->scene.objects[0].place, *room).value();
  const geometry::Isometry foot_from_room = geometry::inverse(geometry::translation_to(room->space, at));
  Measured m;
  for (const place::PlacedMesh& part : furnished->interior.parts) {
    if (part.kind != place::PartKind::object) continue;
    for (std::size_t i = 0; i < part.floor.size(); ++i) {
      const std::complex<double> log = geometry::log_from_point(room->space, foot_from_room * part.floor[i]);
      m.least = std::min(m.least, std::abs(log)), m.most = std::max(m.most, std::abs(log));
      m.low = std::min(m.low, part.z[i]), m.high = std::max(m.high, part.z[i]);
      if (std::fabs(log.imag()) < 1e-9) m.along = std::max(m.along, std::fabs(log.real()));
      if (std::fabs(log.real()) < 1e-9) m.across = std::max(m.across, std::fabs(log.imag()));
    }
  }
  return m;
}

}  // namespace

TEST_CASE("a sphere, cylinder, torus or box reaches as far as its lengths say, on the sphere, in the plane and in the hyperbolic plane",
          "[place]") {
  // Wide rooms: a half sphere, a flat one, and a hyperbolic one of many corners, whose circle has a radius above 2.
  const char* room = GENERATE("*", "*2222", "*(12)(12)(12)(12)(12)(12)(12)(12)(12)(12)(12)(12)");
  const double r = std::string(room) == "*2222" ? 0.8 : 1;
  const std::string radius = std::to_string(r);
  CAPTURE(room);
  const Measured sphere = measured(room, "sphere: {radius: " + radius + "}");
  CHECK(sphere.most == Approx(r).epsilon(1e-12));
  CHECK(sphere.high - sphere.low == Approx(2 * r).epsilon(1e-12));
  const Measured cylinder = measured(room, "cylinder: {radius: " + radius + ", height: 0.5}");
  CHECK(cylinder.most == Approx(r).epsilon(1e-12));
  CHECK(cylinder.high - cylinder.low == Approx(0.5).epsilon(1e-12));
  const Measured torus = measured(room, "torus: {radius: 0.6, tube: 0.15}");
  CHECK(torus.most == Approx(0.75).epsilon(1e-12));
  CHECK(torus.least == Approx(0.45).epsilon(1e-12));
  const Measured box = measured(room, "box: {size: [1.1, 0.5, 0.4]}");
  CHECK(box.along == Approx(0.55).epsilon(1e-12));
  CHECK(box.across == Approx(0.25).epsilon(1e-12));
  CHECK(box.high - box.low == Approx(0.4).epsilon(1e-12));
  // `size` is the longest extent, whatever the body says of itself; it stays a sphere.
  const Measured sized = measured(room, "sphere: {radius: 0.3}, size: 1.2");
  CHECK(sized.most == Approx(0.6).epsilon(1e-12));
  CHECK(sized.high - sized.low == Approx(1.2).epsilon(1e-12));
}

TEST_CASE("a body that asks for the conformal embedding gets it", "[place]") {
  const char* room = "*(12)(12)(12)(12)(12)(12)(12)(12)(12)(12)(12)(12)";
  CHECK(measured(room, "sphere: {radius: 1}, embedding: conformal").most == Approx(2 * std::atanh(0.5)).epsilon(1e-12));   // 1.0986
}
