#pragma once
#include <atomic>
#include <thread>
#include <vector>

#include "compiler/base/executor.h"

namespace orbc::testing {

/// An executor of plain threads that take the next task each: real sharing, and nothing in it that ThreadSanitizer cannot see through.
inline Executor threads(int count) {
  return [count](std::size_t tasks, const std::function<void(std::size_t)>& task) {
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> all;
    for (int i = 0; i < count; ++i)
      all.emplace_back([&] {
        for (std::size_t t = next++; t < tasks; t = next++) task(t);
      });
    for (std::thread& thread : all) thread.join();
  };
}

}  // namespace orbc::testing
