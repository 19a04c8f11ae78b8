#include "compiler/driver/threads.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>

namespace orbc::driver {

Executor parallel_executor(int threads) {
  if (threads == 1) return serial_executor();
  const auto arena = std::make_shared<tbb::task_arena>(threads > 0 ? threads : static_cast<int>(tbb::task_arena::automatic));
  return [arena](std::size_t count, const std::function<void(std::size_t)>& task) {
    arena->execute([&] { tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { task(i); }); });
  };
}

}  // namespace orbc::driver
