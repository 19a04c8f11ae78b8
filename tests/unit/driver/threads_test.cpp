#include "compiler/driver/threads.h"

#include <atomic>
#include <catch2/catch.hpp>

#include "compiler/base/progress.h"

using namespace orbc;

TEST_CASE("work on many threads ends soon after the user asked to stop", "[driver]") {
  for (const int threads : {1, 2}) {
    std::atomic<bool> cancelled{false};
    std::atomic<int> done{0};
    const Executor executor = driver::parallel_executor(threads, &cancelled);
    executor(10, [&](std::size_t) { ++done; });
    CHECK(done == 10);
    CHECK_THROWS_AS(executor(100'000,
                             [&](std::size_t) {
                               ++done;
                               cancelled = true;
                             }),
                    Cancelled);
    CHECK(done < 1000);
  }
}
