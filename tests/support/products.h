#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "compiler/driver/product.h"
#include "compiler/image/image.h"

/// Small products made by hand: what exporters are tested on without compiling a scene.
namespace orbc::test {

/// An eye at (0, 0, z) that looks in azimuth `yaw` and elevation `pitch`, head tilted by `roll` (radians).
inline place::Camera looking(double yaw, double pitch, double roll, double z) {
  const auto c = [](double v) { return std::cos(v); };
  const auto s = [](double v) { return std::sin(v); };
  const geometry::Vector3 forward{c(yaw) * c(pitch), s(yaw) * c(pitch), s(pitch)};
  const geometry::Vector3 level{s(yaw), -c(yaw), 0};
  const geometry::Vector3 upright = cross(level, forward);
  place::Camera eye;
  eye.z = z;
  eye.forward = forward;
  eye.right = c(roll) * level + s(roll) * upright;
  eye.up = c(roll) * upright + (-s(roll)) * level;
  return eye;
}

inline void add_texel(image::Image& image, std::array<std::uint8_t, 3> rgb) {
  image.rgba.insert(image.rgba.end(), {rgb[0], rgb[1], rgb[2], 255});
  ++image.width;
  image.height = 1;
}

/// Appends a copy made of `positions`, `uv` and triangles counted from its own first vertex.
inline driver::ProductCopy& add_copy(driver::Product& product, const std::vector<std::array<float, 3>>& positions,
                                   const std::vector<std::array<float, 2>>& uv, const std::vector<std::uint32_t>& indices) {
  driver::ProductCopy copy;
  copy.first_vertex = product.positions.size(), copy.vertex_count = positions.size();
  copy.first_index = product.indices.size(), copy.index_count = indices.size();
  product.positions.insert(product.positions.end(), positions.begin(), positions.end());
  product.uv.insert(product.uv.end(), uv.begin(), uv.end());
  for (const std::uint32_t index : indices) product.indices.push_back(static_cast<std::uint32_t>(copy.first_vertex) + index);
  product.copies.push_back(copy);
  return product.copies.back();
}

/// One square of two colours and its mirror image at weight (0.81, 0.6561, 0.5), before an eye that looks along +x.
inline driver::Product two_squares() {
  driver::Product product;
  product.title = "*2222";
  product.eye.z = 0.5;
  product.eye.width = 80, product.eye.height = 60;
  product.background = {0.25, 0.5, 0.75};
  add_texel(product.atlas, {255, 128, 0});
  add_texel(product.atlas, {10, 20, 30});
  add_copy(product, {{2, -0.25f, 0}, {2, 0.25f, 0}, {2, 0.25f, 0.75f}, {2, -0.25f, 0.75f}},
           {{0.25f, 0.5f}, {0.25f, 0.5f}, {0.25f, 0.5f}, {0.25f, 0.5f}}, {0, 1, 2, 0, 2, 3});
  driver::ProductCopy& image = add_copy(product, {{3, -1, 0}, {3, 1, 0}, {3, 1, 1.5f}, {3, -1, 1.5f}},
                                      {{0.75f, 0.5f}, {0.75f, 0.5f}, {0.75f, 0.5f}, {0.75f, 0.5f}}, {0, 2, 1, 0, 3, 2});
  image.weight = {0.81, 0.6561, 0.5};
  image.word = {1, 0};
  image.bounces = 2;
  image.reversing = false;
  image.distance = 1.5;
  return product;
}

/// Nothing to draw: no copies at all.
inline driver::Product empty_product() {
  driver::Product product = two_squares();
  product.positions.clear(), product.uv.clear(), product.indices.clear(), product.copies.clear();
  return product;
}

}  // namespace orbc::test
