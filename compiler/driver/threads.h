#pragma once
#include <atomic>

#include "compiler/base/executor.h"

namespace orbc::driver {

/// An executor of up to `threads` threads (0: as many as there are cores). Results do not depend on their number.
/// In: `cancelled`, which may be null and outlives the executor. Tasks that begin after it is set throw `Cancelled` out of the executor.
[[nodiscard]] Executor parallel_executor(int threads = 0, const std::atomic<bool>* cancelled = nullptr);

}  // namespace orbc::driver
