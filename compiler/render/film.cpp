#include "compiler/render/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compiler/image/image.h"
#include "compiler/image/srgb.h"

namespace orbc::render {
namespace {

std::uint8_t to_byte(double encoded) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded, 0.0, 1.0))); }

// A hue for each number, by the golden angle: neighbours differ clearly, and a part has the same colour in every picture.
scene::Color distinct_color(std::int32_t id) {
  if (id < 0) return {0.05, 0.05, 0.05};
  const double hue = 6 * std::fmod(0.13 + 0.6180339887498949 * id, 1.0);
  const auto channel = [&](double shift) { return std::clamp(std::fabs(std::fmod(hue + shift, 6.0) - 3) - 1, 0.0, 1.0) * 0.75 + 0.2; };
  return {channel(0), channel(4), channel(2)};
}

template <class Value>
image::Image picture_of(const Film& film, Value&& value) {
  image::Image image{film.width, film.height, {}};
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
  film.width = width;
  film.height = height;
  film.color.resize(n);
  film.depth.assign(n, std::numeric_limits<float>::infinity());
  film.normal.assign(n, {0, 0, 0});
  film.object.assign(n, -2);
  film.bounces.assign(n, 0);
  film.weight.assign(n, 1);
  return film;
}

image::Image to_image(const Film& film, double exposure) {
  image::Image image{film.width, film.height, std::vector<std::uint8_t>(film.color.size() * 4, 255)};
  for (std::size_t i = 0; i < film.color.size(); ++i) {
    const scene::Color c = exposure * (film.shown.empty() ? film.color : film.shown)[i];
    image.rgba[4 * i] = image::encode_srgb8(c.r);
    image.rgba[4 * i + 1] = image::encode_srgb8(c.g);
    image.rgba[4 * i + 2] = image::encode_srgb8(c.b);
  }
  return image;
}

double clipped_share(const Film& film, double exposure) {
  constexpr double kWhite = 1 + 1.0 / 512;  // what rounding adds to white is not above it
  const auto clipped =
      std::count_if(film.color.begin(), film.color.end(), [&](const scene::Color& c) { return exposure * max_channel(c) > kWhite; });
  return static_cast<double>(clipped) / std::max(1.0, static_cast<double>(film.color.size()));
}

image::Image to_image(const Film& film, Pass pass, double exposure) {
  const auto grey = [](double v) { return scene::Color{v, v, v}; };
  switch (pass) {
    case Pass::color:
      return to_image(film, exposure);
    case Pass::depth:
      return picture_of(film, [&](std::size_t i) { return grey(1 / (1 + static_cast<double>(film.depth[i]))); });
    case Pass::normal:
      return picture_of(film, [&](std::size_t i) {
        return scene::Color{(film.normal[i][0] + 1) / 2, (film.normal[i][1] + 1) / 2, (film.normal[i][2] + 1) / 2};
      });
    case Pass::object:
      return picture_of(film, [&](std::size_t i) { return distinct_color(film.object[i]); });
    case Pass::bounces:
      return picture_of(film, [&](std::size_t i) { return grey(1 / (1 + 0.25 * film.bounces[i])); });
    case Pass::weight:
      return picture_of(film, [&](std::size_t i) { return grey(film.weight[i]); });
  }
  return {};
}

image::FloatImage to_float_image(const Film& film) {
  const std::size_t n = film.color.size();
  const char* names[] = {"R", "G", "B", "Z", "N.X", "N.Y", "N.Z", "object.id", "bounces", "weight"};
  image::FloatImage image{film.width, film.height, {}};
  for (const char* name : names) image.channels[name].resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const scene::Color& c = film.color[i];
    const double values[] = {c.r,
                             c.g,
                             c.b,
                             film.depth[i],
                             film.normal[i][0],
                             film.normal[i][1],
                             film.normal[i][2],
                             static_cast<double>(film.object[i]),
                             static_cast<double>(film.bounces[i]),
                             film.weight[i]};
    for (std::size_t k = 0; k < std::size(names); ++k) image.channels[names[k]][i] = static_cast<float>(values[k]);
  }
  return image;
}

}  // namespace orbc::render
