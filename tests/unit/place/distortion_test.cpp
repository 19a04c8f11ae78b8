#include "compiler/place/distortion.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "compiler/place/embed.h"
#include "compiler/place/locate.h"
#include "rooms.h"

using namespace orbc;
using namespace orbc::place;
using namespace orbc::place::test;
using geometry::Space;

namespace {

/// Two small right-angled triangles that lie opposite each other about the axis: legs of length h along the radius and across it.
mesh::Mesh two_triangles(double r, double h) {
  mesh::Mesh mesh;
  for (const double s : {1.0, -1.0})
    for (const auto& [x, y] : {std::pair{r, 0.0}, {r - h, 0.0}, {r, h}}) mesh.positions.push_back({s * x, s * y, 0});
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {0, 2, 1}, {3, 5, 4}};
  return mesh;
}

}  // namespace

TEST_CASE("the distortion told of an embedding is that of small triangles at its rim", "[place]") {
  constexpr double h = 1e-4;
  for (const std::string notation : {"*222", "*22222", "*2222"})
    for (const scene::Embedding embedding : {scene::Embedding::conformal, scene::Embedding::exponential}) {
      CAPTURE(notation, embedding == scene::Embedding::conformal);
      const room::Room room = make_room(notation);
      const Space space = room.space;
      scene::Object object;
      object.embedding = embedding;
      object.place.floor = scene::AtPolar{0.05, Angle::from_degrees(20)};
      const PlacedMesh placed = place_object(two_triangles(0.4, h), object, room, 1, {1, 1000}).value();
      const geometry::Point axis = locate(object.place, room).value();
      const EmbeddingDistortion told = embedding_distortion(space, embedding, reach_of(placed, space, axis));
      // On the radius from the axis the reach is that of the corners at r, but for the short leg across it.
      const double along = geometry::distance(space, placed.floor[0], placed.floor[1]) / h,
                   across = geometry::distance(space, placed.floor[0], placed.floor[2]) / h;
      CHECK(told.least_scale == Approx(std::min({1.0, along, across})).epsilon(1e-3));
      CHECK(told.largest_scale == Approx(std::max({1.0, along, across})).epsilon(1e-3));
      CHECK(told.angle == Approx(2 * std::asin(std::fabs(along - across) / (along + across))).margin(2e-4));
      // The diagonals of a square of one horizontal and one upright edge stand at right angles; stretched by p they do not.
      const double p = embedding == scene::Embedding::conformal ? along : across;
      CHECK(told.upright_angle == Approx(std::fabs(std::numbers::pi / 2 - 2 * std::atan(p))).margin(2e-4));
      CHECK((space == Space::spherical    ? told.least_scale < 0.99
             : space == Space::hyperbolic ? told.largest_scale > 1.01
                                          : told.largest_scale == 1));
    }
}
