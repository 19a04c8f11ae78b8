#include "compiler/render/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace orbc::render {
namespace {

std::uint8_t to_byte(double encoded) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded, 0.0, 1.0))); }

// A hue per number by the golden angle: neighbours differ clearly, and the same part has the same colour in every picture.
scene::Color distinct(std::int32_t id) {
  if (id < 0) return {0.05, 0.05, 0.05};
  const double hue = 6 * std::fmod(0.13 + 0.6180339887498949 * id, 1.0);
  const auto channel = [&](double shift) { return std::clamp(std::fabs(std::fmod(hue + shift, 6.0) - 3) - 1, 0.0, 1.0) * 0.75 + 0.2; };
  return {channel(0), channel(4), channel(2)};
}

/// round(255·encode_srgb(v)) without its power: the bytes grow with v, so it is a matter of where each begins, found once to the last bit.
class Encoder {
 public:
  Encoder() {
    begin_[0] = 0;
    for (int b = 1; b < 256; ++b) {
      double low = begin_[static_cast<std::size_t>(b - 1)], high = 1;  // the first is below byte b, the second not
      for (double middle = (low + high) / 2; middle > low && middle < high; middle = (low + high) / 2)
        (to_byte(scene::encode_srgb(middle)) >= b ? high : low) = middle;
      begin_[static_cast<std::size_t>(b)] = high;
    }
    std::size_t b = 0;
    for (std::size_t i = 0; i <= kCells; ++i) {
      while (b < 255 && begin_[b + 1] <= static_cast<double>(i) / kCells) ++b;
      first_[i] = static_cast<std::uint8_t>(b);
    }
  }
  std::uint8_t operator()(double v) const {
    const double x = v > 0 ? std::min(v, 1.0) : 0.0;  // what is no number shows as black
    std::size_t b = first_[static_cast<std::size_t>(x * kCells)];
    while (b < 255 && begin_[b + 1] <= x) ++b;
    return static_cast<std::uint8_t>(b);
  }

 private:
  static constexpr std::size_t kCells = 4096;
  std::array<double, 256> begin_;   ///< smallest value of each byte
  std::array<std::uint8_t, kCells + 1> first_;  ///< byte of i/kCells
};

template <class Value>
mesh::Image painted(const Film& film, Value&& value) {
  mesh::Image image{film.width, film.height, {}};
  image.rgba.reserve(film.color.size() * 4);
  for (std::size_t i = 0; i < film.color.size(); ++i) {
    const scene::Color c = value(i);
    for (const double channel : {c.r, c.g, c.b}) image.rgba.push_back(to_byte(channel));
    image.rgba.push_back(255);
  }
  return image;
}

}  // namespace

Film make_film(int width, int height) {
  const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Film film;
  film.width = width, film.height = height;
  film.color.resize(n);
  film.depth.assign(n, std::numeric_limits<float>::infinity());
  film.normal.assign(n, {0, 0, 0});
  film.object.assign(n, -2);
  film.bounces.assign(n, 0);
  film.weight.assign(n, 1);
  return film;
}

mesh::Image to_image(const Film& film, double exposure) {
  static const Encoder encode;
  mesh::Image image{film.width, film.height, std::vector<std::uint8_t>(film.color.size() * 4, 255)};
  for (std::size_t i = 0; i < film.color.size(); ++i) {
    const scene::Color c = exposure * film.color[i];
    image.rgba[4 * i] = encode(c.r);
    image.rgba[4 * i + 1] = encode(c.g);
    image.rgba[4 * i + 2] = encode(c.b);
  }
  return image;
}

mesh::Image to_image(const Film& film, Pass pass, double exposure) {
  const auto grey = [](double v) { return scene::Color{v, v, v}; };
  switch (pass) {
    case Pass::color: return to_image(film, exposure);
    case Pass::depth: return painted(film, [&](std::size_t i) { return grey(1 / (1 + static_cast<double>(film.depth[i]))); });
    case Pass::normal:
      return painted(film, [&](std::size_t i) {
        return scene::Color{(film.normal[i][0] + 1) / 2, (film.normal[i][1] + 1) / 2, (film.normal[i][2] + 1) / 2};
      });
    case Pass::object: return painted(film, [&](std::size_t i) { return distinct(film.object[i]); });
    case Pass::bounces: return painted(film, [&](std::size_t i) { return grey(1 / (1 + 0.25 * film.bounces[i])); });
    case Pass::weight: return painted(film, [&](std::size_t i) { return grey(film.weight[i]); });
  }
  return {};
}

}  // namespace orbc::render
