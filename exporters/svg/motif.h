#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "compiler/base/result.h"
#include "exporters/svg/page.h"
#include "exporters/svg/path_data.h"

namespace orbc::svg {

/// What stands in every tile, as outlines in the room's disk chart, filled by the rule nonzero.
using Motif = std::vector<Polyline>;

/// Makes outlines of a motif as an author gives it: a letter, path data ("M0 0 L1 0 …"), or the text of an SVG file, whose paths are taken
/// together, without their transformations and styles.
/// Diagnostics: svg.bad-motif, svg.bad-path.
[[nodiscard]] Result<Motif> read_motif(std::string_view text);

/// Places a motif in a room: its middle at the room's centre, as large as the walls allow with a little space, conformal in the disk chart.
/// Edges are split finely enough for their images under isometries.
[[nodiscard]] Motif placed_motif(const Motif& motif, const room::Room& room);

/// The image of a motif in a copy, as the data of an SVG path to be filled by the rule nonzero.
struct MotifPath {
  std::string d;
  /// The image holds the antipode of the page's middle, which lies infinitely far away in the stereographic chart: rings around the page
  /// are part of the path, so that no other may stand in one element with it.
  bool is_alone = false;
};

/// Maps a placed motif into a copy, without points that nobody could tell. What a gnomonic page does not show is cut off.
[[nodiscard]] MotifPath motif_path(const Page& page, const Motif& motif, const geometry::Isometry& cover_from_room);

}  // namespace orbc::svg
