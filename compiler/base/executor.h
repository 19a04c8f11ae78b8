#pragma once
#include <cstddef>
#include <functional>

namespace orbc {

/// Runs task(0) … task(count-1), in any order, on one or more threads, and returns when all are done. Tasks must write their results by
/// index, so that the outcome does not depend on the order.
using Executor = std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// The executor that runs all tasks in their order, on the calling thread.
[[nodiscard]] inline Executor serial_executor() {
  return [](std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = 0; i < count; ++i) task(i);
  };
}

}  // namespace orbc
