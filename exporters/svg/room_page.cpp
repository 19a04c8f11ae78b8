// Pages for whole tilings: how large the room lies on them is chosen here.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "exporters/svg/page.h"

namespace orbc::svg {
namespace {

using Complex = std::complex<double>;
using geometry::Space;

constexpr double kRoomsAcross = 4.2;                             // circumradii of a flat room from the middle to the edge of the page
constexpr double kStripCopies = 8.4;                             // widths of a strip across the page
constexpr double kHalfPlaneAspect = 0.6;

/// The turn that makes wall `wall` run to the right on the page.
Complex level(const room::Room& room, std::size_t wall) {
  const geometry::Tangent& along = room.walls[wall].along;
  return std::conj(Complex(along.x, along.y));
}

bool is_rectangle(const room::Room& room) {
  return room.space == Space::euclidean && room.walls.size() == 4 &&
         std::all_of(room.corners.begin(), room.corners.end(),
                     [](const room::Corner& c) { return std::fabs(c.angle - std::numbers::pi / 2) < 1e-12; });
}

void lay_flat(Page& page, const room::Room& room, const PageSize& size, double margin) {
  if (is_rectangle(room)) page.turn = level(room, 0);
  if (!room.orbifold.strip) {
    if (page.height == 0) page.height = page.width + size.caption;
    const Box area{margin, margin, page.width - margin, page.height - size.caption - margin};
    page.scale = std::max(area.right - area.left, area.bottom - area.top) / 2 / (kRoomsAcross * room.circumradius);
    page.middle = {(area.left + area.right) / 2, (area.top + area.bottom) / 2};
    page.window = area;
    return;
  }
  // A band: mirrors stand upright side by side, plain ends close it above and below; the half strip has a mirror at its foot.
  const bool half = notation::is_half_strip(room.orbifold);
  if (!half) page.turn = level(room, 0) * Complex(0, 1);
  const double across = room.walls[half ? 0 : 1].length, length = room.walls[half ? 1 : 0].length * (half ? 2 : 1);
  page.scale = (page.width - 2 * margin) / (kStripCopies * across);
  if (page.height == 0) page.height = length * page.scale + 2 * margin + size.caption;
  const double high = page.height - size.caption - 2 * margin;
  page.scale = std::min(page.scale, high / length);
  page.middle = {page.width / 2, margin + high / 2 - (half ? page.scale * length / 4 : 0)};
  page.window = Box{margin, margin, page.width - margin, page.height - size.caption - margin};
}

}  // namespace

Page make_room_page(const room::Room& room, Chart chart, const PageSize& size) {
  Page page;
  page.space = room.space;
  page.width = size.width;
  page.height = size.height;
  page.unit = size.width / 1000;
  page.straight = chart == Chart::klein && room.space != Space::euclidean;
  page.half_plane = chart == Chart::half_plane && room.space == Space::hyperbolic;
  const double margin = size.full_bleed && (room.space == Space::euclidean || page.half_plane) ? 0 : kMargin * page.unit;
  if (room.space == Space::euclidean) {
    lay_flat(page, room, size, margin);
    return page;
  }
  if (page.half_plane) {
    if (page.height == 0) page.height = kHalfPlaneAspect * page.width + size.caption;
    const double bottom = page.height - size.caption - margin;
    page.scale = (bottom - margin) / std::clamp(1.2 * math::exp(room.circumradius), 1.8, 5.0);
    page.middle = {page.width / 2, bottom};
    page.window = Box{margin, margin, page.width - margin, bottom};
    return page;
  }
  if (page.height == 0) page.height = page.width + size.caption;
  page.frame = room.space == Space::hyperbolic ? 1 : page.straight ? kGnomonicFrame : kStereographicFrame;
  const double high = page.height - size.caption;
  page.scale = (std::min(page.width, high) / 2 - margin) / page.frame;
  page.middle = {page.width / 2, high / 2};
  return page;
}

}  // namespace orbc::svg
