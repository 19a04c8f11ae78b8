#include "exporters/svg/draw_room.h"

#include "compiler/notation/print.h"
#include "compiler/room/cuts.h"
#include "exporters/svg/hyperboloid.h"

namespace orbc::svg {

RoomDrawing draw_room(const room::Room& room, const RoomPicture& picture) {
  RoomDrawing drawing;
  SvgOptions look = picture.look;
  look.smallest = picture.fill.smallest;
  const double caption = look.labels ? caption_height(picture.width) : 0;
  const Page page = make_room_page(room, picture.chart, {picture.width, picture.height, caption, !look.labels});
  for (Polyline& line : look.motif)
    for (std::complex<double>& z : line) z *= std::conj(page.turn);  // so that it stands upright on the page
  if (!look.motif.empty()) look.motif = placed_motif(look.motif, room);
  if (look.cuts && room::cut_segments(room).empty())
    drawing.notes.push_back(
        make_warning("svg.no-cuts", notation::to_text(room.orbifold) + " is not cut: only hyperbolic rooms of four corners or more are",
                     "leave out --cuts"));
  Filled filled = fill(room, page, picture.fill);
  drawing.notes.insert(drawing.notes.end(), filled.notes.begin(), filled.notes.end());
  driver::Tiling tiling;
  tiling.title = notation::to_text(room.orbifold);
  tiling.room = room;
  tiling.copies = std::move(filled.copies);
  tiling.model = picture.chart == Chart::klein ? driver::Tiling::Model::klein : driver::Tiling::Model::disk;
  tiling.coloring = picture.coloring;
  tiling.room_from_eye = geometry::identity(room.space);
  drawing.copies = tiling.copies.size();
  drawing.width = page.width;
  drawing.height = page.height;
  if (picture.chart == Chart::hyperboloid) {
    drawing.height = kHyperboloidHeight * page.width;
    drawing.svg = draw_hyperboloid(tiling, page.width, look);
    return drawing;
  }
  drawing.svg = draw_tiling(tiling, page, caption, look);
  return drawing;
}

}  // namespace orbc::svg
