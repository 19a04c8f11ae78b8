// A cover meets several limits one after the other: copies, beams, the bytes of the product, the triangles of bending. What passes the
// first may fail at the next, so a hint names only bounces that were tried to the end.
#include "compiler/driver/fitting.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>

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

std::optional<int> most_bounces(int too_many, int guess, const std::function<bool(int)>& fits) {
  int low = -1, high = too_many;
  for (int tried = std::clamp(guess, 0, std::max(0, too_many - 1)); high - low > 1; tried = low + (high - low) / 2)
    (fits(tried) ? low : high) = tried;
  return low < 0 ? std::nullopt : std::optional(low);
}

Opened with_bounces(const Opened& opened, int max_bounces) {
  Opened other;
  other.scene = opened.scene;
  other.scene.cover.max_bounces = max_bounces;
  other.eye = opened.eye;
  other.expected_background = opened.expected_background;
  other.room = std::make_unique<place::Interior>(*opened.room);
  return other;
}

Diagnostics with_tried_hint(Diagnostics errors, int max_bounces, const std::function<bool(int)>& fits) {
  for (Diagnostic& error : errors) {
    const bool dense = error.code == "bend.too-dense" && error.hint.find("lower cover.max_bounces") == 0;
    if (error.code != "cover.too-much" && !dense) continue;
    const std::optional<int> told = bounces_in(error.hint);
    if (!told && !dense) continue;   // not even the room itself fits
    const std::optional<int> found = most_bounces(max_bounces, told.value_or(max_bounces / 2), fits);
    error.hint = found ? fmt::format("{}{} fits", kSetting, *found)
                       : std::string("not even the room itself fits: use coarser meshes or allow more memory");
  }
  return errors;
}

}  // namespace orbc::driver
