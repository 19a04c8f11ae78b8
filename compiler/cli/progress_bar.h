#pragma once
#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "compiler/base/progress.h"

namespace orbc::cli {

/// One line on a terminal that tells stage, share done, rate and the time that remains; redrawn ten times a second at most, erased at the
/// end. Writes nothing at all unless `shown`.
class ProgressBar {
 public:
  explicit ProgressBar(bool shown) : shown_(shown) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// What the rooms report to. The bar must outlive it.
  [[nodiscard]] Progress progress();
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void show(std::string_view stage, std::uint64_t done, std::uint64_t total, std::string_view unit);

  bool shown_;
  bool drawn_ = false;
  std::mutex mutex_;
  std::string stage_;
  Clock::time_point stage_start_{}, last_draw_{};
};

}  // namespace orbc::cli
