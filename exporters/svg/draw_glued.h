#pragma once
#include "compiler/room/glued_polygon.h"
#include "exporters/svg/draw_room.h"

namespace orbc::svg {

/// Draws the tiling of any orbifold by its fundamental polygon, as far as copies can be seen.
/// Makes: copies in the order of the number of sides that are crossed; the polygon itself with a mark on each side: mirrors as thick lines,
///        and on sides that are glued the name of the pair with an arrow. Glued arrows run alike when each other's sides meet; those of a
///        glide point to opposite hands. The same bytes for the same polygon and picture.
/// In:    any chart but hyperboloid; `picture.look` without cuts.
[[nodiscard]] RoomDrawing draw_glued(const std::string& title, const room::GluedPolygon& polygon, const RoomPicture& picture);

}  // namespace orbc::svg
