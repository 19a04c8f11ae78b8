#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "compiler/diff/compare.h"
#include "compiler/image/image.h"
#include "compiler/image/srgb.h"
#include "compiler/image_io/decode.h"
#include "compiler/image_io/exr.h"
#include "compiler/image_io/png.h"
#include "compiler/scene/color.h"

namespace orbc::diff {
namespace {

struct PixelPlace {
  const EncodedPicture& a;
  const EncodedPicture& b;
  [[nodiscard]] Difference at(std::size_t x, std::size_t y, const std::string& what) const {
    return {fmt::format("{}, pixel ({}, {})", a.name, x, y), fmt::format("{}, pixel ({}, {})", b.name, x, y), what};
  }
};

/// Takes down how many steps a pixel is off.
void take_pixel(double steps, const Limits& limits, Finding& finding, const std::function<Difference()>& place) {
  ++finding.pixels;
  if (steps == 0) return;
  ++finding.pixels_differing;
  if (steps > finding.largest_step) finding.largest_step = steps, finding.largest_step_at = place().at;
  if (steps <= limits.pixels) return;
  ++finding.pixels_beyond;
  if (!finding.differs) finding.differ(place());
}

/// Compares pictures whose channels are codes; 255 or 65535 of them are white.
template <typename Picture>
void compare_codes(const Picture& a, const Picture& b, const PixelPlace& place, const Limits& limits, Finding& finding) {
  const auto width = static_cast<std::size_t>(a.width);
  constexpr double kPerStep = sizeof(a.rgba[0]) == 1 ? 1 : 257;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int codes = 0;
    for (std::size_t c = 0; c < 4; ++c) codes = std::max(codes, std::abs(int{a.rgba[i + c]} - int{b.rgba[i + c]}));
    take_pixel(codes / kPerStep, limits, finding, [&] {
      const auto text = [&](const Picture& image) {
        return fmt::format("({}, {}, {}, {})", image.rgba[i], image.rgba[i + 1], image.rgba[i + 2], image.rgba[i + 3]);
      };
      return place.at(i / 4 % width, i / 4 / width, text(a) + " against " + text(b));
    });
  }
}

/// Steps of 1/255 between two channels of linear light.
double steps_between(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  if (!std::isfinite(a) || !std::isfinite(b)) return HUGE_VAL;
  const auto code = [](float v) { return v < 0 ? 255 * 12.92 * static_cast<double>(v) : 255 * image::encode_srgb(v); };
  return std::max(std::fabs(code(a) - code(b)), 1e-300);  // two different values are never no step apart
}

void compare_channels(const image::FloatImage& a, const image::FloatImage& b, const PixelPlace& place, const Limits& limits,
                      Finding& finding) {
  const auto width = static_cast<std::size_t>(a.width), count = width * static_cast<std::size_t>(a.height);
  std::vector<double> steps(count, 0.0);
  std::vector<std::string> colors;
  for (const auto& channel : a.channels) {
    const std::string& name = channel.first;
    const std::vector<float>& values = channel.second;
    const std::vector<float>& others = b.channels.at(name);
    const std::string last = name.substr(name.rfind('.') == std::string::npos ? 0 : name.rfind('.') + 1);
    const bool is_color = name == last && (name == "R" || name == "G" || name == "B" || name == "A");
    for (std::size_t i = 0; i < count; ++i) {
      if (is_color) {
        steps[i] = std::max(steps[i], steps_between(values[i], others[i]));
      } else {
        (void)take_numbers(values[i], others[i], limits, finding,
                           [&] { return place.at(i % width, i / width, fmt::format("{} is {} against {}", name, values[i], others[i])); });
      }
    }
    if (is_color) colors.push_back(name);
  }
  if (colors.empty()) return;
  for (std::size_t i = 0; i < count; ++i)
    take_pixel(steps[i], limits, finding, [&] { return place.at(i % width, i / width, fmt::format("{:.3g} steps apart", steps[i])); });
}

Diagnostics compare_exr(const EncodedPicture& a, const EncodedPicture& b, const Limits& limits, Finding& finding) {
  const auto left = image_io::decode_exr(a.bytes), right = image_io::decode_exr(b.bytes);
  if (!left) return {bad_file(a.name, left.error().front().message)};
  if (!right) return {bad_file(b.name, right.error().front().message)};
  const auto names = [](const image::FloatImage& picture) {
    std::string text = fmt::format("{} x {} pixels of", picture.width, picture.height);
    for (const auto& [name, values] : picture.channels) text += ' ' + name;
    return text;
  };
  if (names(*left) != names(*right))
    return finding.differ_in_structure({a.name, b.name, names(*left) + " against " + names(*right)}), Diagnostics{};
  compare_channels(*left, *right, {a, b}, limits, finding);
  return {};
}

/// Whether a PNG file has 16 bits a channel: the byte after width and height of its header says so.
bool is_deep_png(std::string_view bytes) {
  constexpr std::size_t kBitDepth = 24;
  return image_io::is_png(bytes) && bytes.size() > kBitDepth && bytes[kBitDepth] == 16;
}

/// Both pictures are an image::Image or an image_io::DeepImage.
template <typename Picture>
Diagnostics compare_decoded(const Result<Picture>& left, const Result<Picture>& right, const PixelPlace& place, const Limits& limits,
                            Finding& finding) {
  if (!left) return {bad_file(left.error().front().message, "as a picture it cannot be read")};
  if (!right) return {bad_file(right.error().front().message, "as a picture it cannot be read")};
  if (left->width == right->width && left->height == right->height)
    return compare_codes(*left, *right, place, limits, finding), Diagnostics{};
  const auto size = [](const Picture& image) { return fmt::format("{} x {} pixels", image.width, image.height); };
  return finding.differ_in_structure({place.a.name, place.b.name, size(*left) + " against " + size(*right)}), Diagnostics{};
}

}  // namespace

Diagnostics compare_pictures(const EncodedPicture& a, const EncodedPicture& b, const Limits& limits, Finding& finding) {
  ++finding.pictures;
  if (image_io::is_exr(a.bytes) != image_io::is_exr(b.bytes))
    return finding.differ_in_structure({a.name, b.name, "one of the pictures is EXR, the other is not"}), Diagnostics{};
  if (image_io::is_exr(a.bytes)) return compare_exr(a, b, limits, finding);
  const bool deep = is_deep_png(a.bytes) || is_deep_png(b.bytes);
  if (deep && image_io::is_png(a.bytes) && image_io::is_png(b.bytes))
    return compare_decoded(image_io::decode_deep_png(a.bytes, a.name), image_io::decode_deep_png(b.bytes, b.name), {a, b}, limits, finding);
  return compare_decoded(image_io::decode_image(a.bytes, a.name), image_io::decode_image(b.bytes, b.name), {a, b}, limits, finding);
}

}  // namespace orbc::diff
