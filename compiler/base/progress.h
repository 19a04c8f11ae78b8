#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string_view>

namespace orbc {

/// Where long work tells how far it is, and learns whether it should stop. Both members may be empty.
struct Progress {
  /// stage ("bending"), what is done and of how much (0 = unknown), the unit ("triangles").
  std::function<void(std::string_view stage, std::uint64_t done, std::uint64_t total, std::string_view unit)> report;
  const std::atomic<bool>* cancelled = nullptr;
};

/// Thrown out of long work when the user has asked to stop; caught once, in `main`.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled") {}
};

/// For loops that have nothing to report.
inline void stop_if_cancelled(const Progress& progress) {
  if (progress.cancelled && progress.cancelled->load(std::memory_order_relaxed)) throw Cancelled();
}

inline void report(const Progress& progress, std::string_view stage, std::uint64_t done, std::uint64_t total, std::string_view unit = "") {
  stop_if_cancelled(progress);
  if (progress.report) progress.report(stage, done, total, unit);
}

}  // namespace orbc
