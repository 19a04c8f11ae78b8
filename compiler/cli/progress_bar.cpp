#include "compiler/cli/progress_bar.h"

#include <fmt/format.h>

#include "compiler/cli/streams.h"

namespace orbc::cli {
namespace {

std::string scaled(double value) {
  return value >= 1e9 ? fmt::format("{:.2f} G", value / 1e9) : value >= 1e6 ? fmt::format("{:.2f} M", value / 1e6)
       : value >= 1e4 ? fmt::format("{:.1f} k", value / 1e3) : fmt::format("{:.0f} ", value);
}

std::string clock_text(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60) : fmt::format("{}:{:02}", s / 60, s % 60);
}

constexpr std::size_t kBarWidth = 24;

}  // namespace

Progress ProgressBar::progress() {
  Progress progress;
  if (shown_)
    progress.report = [this](std::string_view stage, std::uint64_t done, std::uint64_t total, std::string_view unit) {
      show(stage, done, total, unit);
    };
  return progress;
}

void ProgressBar::show(std::string_view stage, std::uint64_t done, std::uint64_t total, std::string_view unit) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (stage != stage_) stage_ = stage, stage_start_ = now;
  if (drawn_ && now - last_draw_ < std::chrono::milliseconds(100)) return;
  last_draw_ = now;
  drawn_ = true;
  const double seconds = std::chrono::duration<double>(now - stage_start_).count();
  const double share = total ? std::min(1.0, static_cast<double>(done) / static_cast<double>(total)) : 0;
  std::string line = fmt::format("\r\033[K{:<12}", stage);
  if (total) {
    const auto full = static_cast<std::size_t>(share * kBarWidth);
    line += fmt::format(" [{}{}] {:3.0f} %", std::string(full, '='), std::string(kBarWidth - full, ' '), share * 100);
  }
  line += fmt::format("  {}{}", scaled(static_cast<double>(done)), unit);
  if (seconds > 0.5 && done > 0) {
    line += fmt::format("  {}{}/s", scaled(static_cast<double>(done) / seconds), unit);
    if (total && share > 0) line += "  " + clock_text(seconds / share - seconds) + " left";
  }
  print_message(line);
}

void ProgressBar::clear() {
  if (drawn_) print_message("\r\033[K");
  drawn_ = false;
}

}  // namespace orbc::cli
