#pragma once
#include "compiler/base/diagnostic.h"
#include "compiler/driver/open.h"

namespace orbc::driver {

/// Why a picture of this scene looks flat, if it will: a scene with neither lamps nor `integrator: path` is shown in its plain colours.
/// Makes: a note with a line of YAML that lights this very room: its lamp is inside of the room, in no object, and about as bright as the
///        picture wants. Nothing for scenes that are lit.
[[nodiscard]] Diagnostics unlit_note(const Opened& opened);

}  // namespace orbc::driver
