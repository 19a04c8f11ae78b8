#include "compiler/room/summary.h"

#include <fmt/format.h>

#include "compiler/notation/print.h"
#include "compiler/room/certificate.h"
#include "compiler/room/polygon.h"
#include "compiler/room/round_to_doubles.h"

namespace orbc::room {
namespace {

// Order of the point group: the torus group has as many cosets (paper, "Euclidean orbifolds": 4, 6, 8, 12).
int translational_cover(const Room& room) {
  if (room.space != geometry::Space::euclidean || room.orbifold.strip) return 0;
  const std::string name = notation::to_text(notation::canonical(room.orbifold));
  if (name == "*2222") return 4;
  if (name == "*333") return 6;
  if (name == "*244") return 8;
  if (name == "*236") return 12;
  return 0;
}

}  // namespace

Summary summarise(const Room& room) {
  Summary s;
  for (const Wall& wall : room.walls) s.sides.push_back(wall.length);
  for (const Corner& corner : room.corners) s.angles.push_back(corner.angle);
  s.inradius = room.inradius;
  s.circumradius = room.circumradius;
  s.area = room.area;
  s.certificate = room.certificate;
  s.certified = passes(room, room.certificate);
  s.translational_cover = translational_cover(room);
  const int walls = static_cast<int>(room.orbifold.corners.size());
  if (room.space == geometry::Space::hyperbolic && walls > 3) {
    const Result<std::vector<scene::Cut>> cuts = complete_cuts(walls, {}, 1);
    for (const scene::Cut& cut : *cuts) s.moduli_names.push_back(fmt::format("cut of walls {} and {}", cut.walls[0], cut.walls[1]));
  } else if (s.translational_cover == 4) {
    s.moduli_names.push_back("aspect");
  }
  s.moduli = static_cast<int>(s.moduli_names.size());
  return s;
}

Result<Summary> summarise(const notation::Orbifold& orbifold, const scene::Shape& shape, bool allow_non_orbifold) {
  const Result<Room> room = realise_uncertified(orbifold, shape, allow_non_orbifold);
  if (!room) return located(room.error(), shape.span);
  return summarise(*room);
}

}  // namespace orbc::room
