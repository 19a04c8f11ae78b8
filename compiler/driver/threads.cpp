#include "compiler/driver/threads.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>

#include "compiler/base/progress.h"

namespace orbc::driver {

Executor parallel_executor(int threads, const std::atomic<bool>* cancelled) {
  const Progress stop{{}, cancelled};
  if (threads == 1)
    return [stop](std::size_t count, const std::function<void(std::size_t)>& task) {
      for (std::size_t i = 0; i < count; ++i) {
        stop_if_cancelled(stop);
        task(i);
      }
    };
  // TBB starts no more threads than there are cores unless it is told to, and warns on standard error where an arena asks for more.
  std::shared_ptr<tbb::global_control> more;
  if (threads > 0 && static_cast<std::size_t>(threads) > tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))
    more = std::make_shared<tbb::global_control>(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  const auto arena = std::make_shared<tbb::task_arena>(threads > 0 ? threads : static_cast<int>(tbb::task_arena::automatic));
  return [arena, more, stop](std::size_t count, const std::function<void(std::size_t)>& task) {
    const auto run = [&](std::size_t i) {
      stop_if_cancelled(stop);
      task(i);
    };
    arena->execute([&] { tbb::parallel_for(std::size_t{0}, count, run); });
  };
}

}  // namespace orbc::driver
