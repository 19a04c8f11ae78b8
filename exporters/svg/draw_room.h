#pragma once
#include <string>

#include "compiler/base/diagnostic.h"
#include "exporters/svg/fill.h"
#include "exporters/svg/write_svg.h"

namespace orbc::svg {

/// How the tiling by a room is to be drawn, without a scene.
struct RoomPicture {
  Chart chart = Chart::disk;
  double width = 1000, height = 0;  ///< page units; height 0: what suits the room
  driver::Tiling::Coloring coloring = driver::Tiling::Coloring::parity;
  SvgOptions look;                  ///< its motif as its author gave it: it is placed in the room here
  FillOptions fill;
};

struct RoomDrawing {
  std::string svg;
  std::size_t copies = 0;
  double width = 0, height = 0;     ///< page units
  Diagnostics notes;                ///< svg.copies-left-out, svg.no-cuts
};

/// Draws a room and its images until they are too small to be seen, or out of the picture.
/// In: an orbifold's room. Makes: the same bytes for the same room and picture.
[[nodiscard]] RoomDrawing draw_room(const room::Room& room, const RoomPicture& picture);

}  // namespace orbc::svg
