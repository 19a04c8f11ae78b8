// A cover has several limits: copies, beams, the bytes of the product, the triangles of bending. Bounces that pass the first may fail at
// the next. So a hint names only bounces with which the whole plan was tried.
#include "compiler/driver/fitting_bounces.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

namespace orbc::driver {
namespace {

constexpr std::string_view kSetting = "max_bounces: ";

/// The number in a hint such as "max_bounces: 4 fits".
std::optional<int> bounces_in(const std::string& hint) {
  int bounces = 0;
  if (hint.compare(0, kSetting.size(), kSetting) != 0) return std::nullopt;
  const auto [end, error] = std::from_chars(hint.data() + kSetting.size(), hint.data() + hint.size(), bounces);
  return error == std::errc() ? std::optional(bounces) : std::nullopt;
}

}  // namespace

std::optional<int> max_fitting_bounces(int too_many, int guess, const std::function<bool(int)>& fits) {
  int low = -1, high = too_many;
  for (int tried = std::clamp(guess, 0, std::max(0, too_many - 1)); high - low > 1; tried = low + (high - low) / 2)
    (fits(tried) ? low : high) = tried;
  return low < 0 ? std::nullopt : std::optional(low);
}

Diagnostics with_fitting_bounces(Diagnostics errors, int max_bounces, const std::function<bool(int)>& fits) {
  for (Diagnostic& error : errors) {
    const bool dense = error.code == "bend.too-dense" && error.hint.find("lower cover.max_bounces") == 0;
    if (error.code != "cover.too-much" && !dense) continue;
    const std::optional<int> named = bounces_in(error.hint);
    if (!named && !dense) continue;  // not even the room itself fits
    const std::optional<int> found = max_fitting_bounces(max_bounces, named.value_or(max_bounces / 2), fits);
    error.hint = found ? fmt::format("{}{} fits", kSetting, *found)
                       : std::string("not even the room itself fits: use coarser meshes or allow more memory");
  }
  return errors;
}

}  // namespace orbc::driver
