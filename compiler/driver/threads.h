#pragma once
#include "compiler/base/executor.h"

namespace orbc::driver {

/// An executor of up to `threads` threads (0 = all there are). Tasks are handed out in ranges; the outcome does not depend on them.
[[nodiscard]] Executor parallel_executor(int threads = 0);

}  // namespace orbc::driver
