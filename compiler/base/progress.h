#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string_view>

namespace orbc {

/// How a long computation reports its progress, and how it is cancelled. Both members may be empty.
struct Progress {
  /// stage: "bending"; done: number of finished units; total: number of all units, 0 when it is unknown; unit: "triangles"
  std::function<void(std::string_view stage, std::uint64_t done, std::uint64_t total, std::string_view unit)> report;
  const std::atomic<bool>* cancelled = nullptr;
};

/// Thrown by a long computation that its caller has cancelled.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled") {}
};

/// Throws Cancelled when the caller has cancelled the computation. For loops that report nothing.
inline void stop_if_cancelled(const Progress& progress) {
  if (progress.cancelled && progress.cancelled->load(std::memory_order_relaxed)) throw Cancelled();
}

/// Reports progress. Throws Cancelled when the caller has cancelled the computation.
inline void report(const Progress& progress, std::string_view stage, std::uint64_t done, std::uint64_t total, std::string_view unit = "") {
  stop_if_cancelled(progress);
  if (progress.report) progress.report(stage, done, total, unit);
}

}  // namespace orbc
