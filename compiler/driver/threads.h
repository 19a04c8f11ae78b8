#pragma once
#include <atomic>

#include "compiler/base/executor.h"

namespace orbc::driver {

/// An executor of up to `threads` threads (0 = all there are). Tasks are handed out in ranges; the outcome does not depend on them.
/// With `cancelled`, tasks that begin after it was set throw `Cancelled` out of the executor.
[[nodiscard]] Executor parallel_executor(int threads = 0, const std::atomic<bool>* cancelled = nullptr);

}  // namespace orbc::driver
