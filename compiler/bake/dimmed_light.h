#pragma once
#include "compiler/bake/view_dependent.h"

namespace orbc::bake {

/// Gives copies texels of their own where light is above white and mirrors dim it. A picture of 8 bits holds nothing above white, and what
/// is cut off before mirrors dim it is too dark in them; so these texels are dimmed first.
/// In:    what the copies are drawn from, and their picture so far.
/// Makes: the picture with the dimmed texels below all others, and their places. Copies of equal weight share them. Dimmed texels show as
///        they are: ViewBake::first_dimmed_v tells them apart. Where they need more than `max_texels`, or do not fit into the picture,
///        what is above white stays cut off.
[[nodiscard]] ViewBake add_dimmed_light(ViewBake view, const DiffuseBake& diffuse, const std::vector<cover::Copy>& copies,
                                        const DrawnParts& drawn, const ViewBakeOptions& options);

}  // namespace orbc::bake
