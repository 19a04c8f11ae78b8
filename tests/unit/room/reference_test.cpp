#include "compiler/geometry/chart.h"
#include "tests/unit/room/rooms.h"

namespace orbc::room::testing {
namespace {

constexpr double kAgree = 1e-12;

TEST_CASE("tangential rooms agree with independent constructions to 1e-12", "[room]") {
  for (const ReferenceRoom& reference : reference_rooms()) {
    INFO(reference.name);
    const Room room = made(orbifold_of_reference(reference));
    check_room(room);
    CHECK(std::string(geometry::name(room.space)) == reference.space);
    CHECK(std::fabs(room.area - reference.area) < kAgree * (1 + reference.area));
    CHECK(std::fabs(room.inradius - reference.inradius) < kAgree);
    REQUIRE(room.walls.size() == reference.sides.size());
    for (std::size_t i = 0; i < room.walls.size(); ++i) CHECK(std::fabs(room.walls[i].length - reference.sides[i]) < kAgree);
    for (std::size_t i = 0; i < reference.corners.size(); ++i) {
      const std::complex<double> z = geometry::disk_from_point(room.space, room.corners[i].at);
      CHECK(std::abs(z - std::complex<double>(reference.corners[i][0], reference.corners[i][1])) < kAgree);
    }
    CHECK(room.certificate.angle_residual < 3e-11);
  }
}

TEST_CASE("the paper's rooms agree with independent constructions to 1e-12 in every decomposition", "[room]") {
  int decompositions = 0;
  for (const ReferenceRoom& reference : reference_rooms())
    for (const ReferencePaper& paper : reference.paper) {
      scene::Shape shape = shape_of(scene::ShapeKind::paper);
      for (const auto& walls : paper.cuts) shape.cuts.push_back({walls, 1.4});
      INFO(reference.name << " with the first cut " << paper.cuts[0][0] << "-" << paper.cuts[0][1]);
      const Room room = made(orbifold_of_reference(reference), shape);
      check_room(room);
      for (std::size_t i = 0; i < room.walls.size(); ++i) CHECK(std::fabs(room.walls[i].length - paper.sides[i]) < kAgree);
      // The reference measures from the mean of the corners; rooms with an incentre stand elsewhere.
      if (room.inradius == 0) CHECK(std::fabs(room.circumradius - paper.circumradius) < 1e-11);
      ++decompositions;
    }
  CHECK(decompositions == 71);
}

TEST_CASE("the paper's default is the fan at the last wall, and walls 2 and 4 for quads", "[room]") {
  for (const ReferenceRoom& reference : reference_rooms())
    for (const ReferencePaper& paper : reference.paper) {
      const int n = static_cast<int>(reference.orders.size());
      bool forward = true;
      for (const auto& walls : paper.cuts) forward = forward && (walls[0] == n || walls[1] == n);
      if (!forward) continue;
      INFO(reference.name);
      const Room room = made(orbifold_of_reference(reference), shape_of(scene::ShapeKind::paper));
      for (std::size_t i = 0; i < room.walls.size(); ++i) CHECK(std::fabs(room.walls[i].length - paper.sides[i]) < kAgree);
    }
}

TEST_CASE("known lengths: right-angled pentagon and hexagon, and the paper's quad", "[room]") {
  const Room five = made(orbifold_of({2, 2, 2, 2, 2})), six = made(orbifold_of({2, 2, 2, 2, 2, 2}));
  for (const Wall& wall : five.walls) CHECK(wall.length == Approx(std::acosh((1 + std::sqrt(5.0)) / 2)).epsilon(1e-15));
  for (const Wall& wall : six.walls) CHECK(wall.length == Approx(std::acosh(2.0)).epsilon(1e-15));
  // *2222k with a corner π/k opposite to the uncut wall; eq. (10) of the paper with the corner where it belongs.
  scene::Shape shape = shape_of(scene::ShapeKind::paper);
  shape.cuts = {{{1, 3}, 0.9}};
  const Room quad = made(orbifold_of({2, 2, 3, 5}), shape);
  // Walls 1 and 3 joined by a cut: the quad at corners 2 and 3 has the angles π/2 and π/3.
  const double cut = 0.9, pi = std::numbers::pi;
  CHECK(quad.walls[1].length == Approx(std::acosh((std::cosh(cut) + 0 * std::cos(pi / 3)) / std::sin(pi / 3))).epsilon(1e-14));
}

}  // namespace
}  // namespace orbc::room::testing
