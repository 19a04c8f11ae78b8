#pragma once
#include "compiler/base/diagnostic.h"
#include "compiler/driver/load.h"

namespace orbc::driver {

/// Says why the picture of a scene looks flat: with neither lamps nor `integrator: path` it shows plain colors.
/// Makes: a note with a line of YAML that lights this room: its lamp is inside the room, in no object, and of a power that suits the
/// picture.
///        Nothing for lit scenes.
[[nodiscard]] Diagnostics unlit_note(const LoadedScene& loaded);

}  // namespace orbc::driver
