#include "compiler/driver/prepared.h"

namespace orbc::driver {

const Prepared& prepared(const Opened& opened, const Executor& executor) {
  if (!opened.prepared) {
    // The lamps have been hung once already, when the scene was opened, and their images counted: they hang.
    opened.prepared = std::make_shared<const Prepared>(
        Prepared{orbc::trace::prepare(*opened.room, executor),
                 light::prepare_light(opened.scene, *opened.room, light::light_options(opened.scene), executor).value()});
  }
  return *opened.prepared;
}

}  // namespace orbc::driver
