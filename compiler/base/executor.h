#pragma once
#include <cstddef>
#include <functional>

namespace orbc {

/// Runs task(0) … task(count-1), in any order, perhaps on many threads, and returns when all are done.
/// Whoever uses it writes results by index, so that the outcome does not depend on the order.
using Executor = std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// The executor of one thread: plain order.
[[nodiscard]] inline Executor serial_executor() {
  return [](std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = 0; i < count; ++i) task(i);
  };
}

}  // namespace orbc
