// Exports of rooms that are very small or very large, or whose eye stands close to a surface.
#include "compiler/driver/renderer_scale.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace orbc;

namespace {

/// A triangle at a distance in front of the eye, which stands half a unit high, and a point far away.
driver::Product product_at(double distance, double far = 10) {
  driver::Product product;
  product.eye.z = 0.5;
  const auto near = static_cast<float>(distance), away = static_cast<float>(far);
  product.positions = {{near, -1, 0}, {near, 1, 0}, {near, 0, 2}, {away, 0, 0.5f}};
  product.uv.resize(4);
  product.indices = {0, 1, 2, 1, 2, 3};
  return product;
}

}  // namespace

TEST_CASE("the nearest point of a triangle is on its face, an edge or a corner", "[driver]") {
  CHECK(driver::distances_from_eye(product_at(0.25)).nearest == Approx(0.25));
  CHECK(driver::distances_from_eye(product_at(0.25)).farthest == Approx(10));
  driver::Product beside = product_at(3);
  beside.positions = {{3, 4, 0.5f}, {3, 8, 0.5f}, {9, 4, 0.5f}, {9, 9, 0.5f}};
  CHECK(driver::distances_from_eye(beside).nearest == Approx(5));
  beside.positions = {{-4, 3, 0.5f}, {4, 3, 0.5f}, {0, 9, 0.5f}, {9, 9, 0.5f}};
  CHECK(driver::distances_from_eye(beside).nearest == Approx(3));
  CHECK(driver::distances_from_eye({}).farthest == 0);
}

TEST_CASE("what is neither near nor far keeps its size, the rest is multiplied by a power of two", "[driver]") {
  CHECK(driver::renderer_scale({0.02, 100}) == 1);
  CHECK(driver::renderer_scale({0.3, 5e5}) == 1);
  CHECK(driver::renderer_scale({}) == 1);
  for (const double nearest : {1e-2, 1e-3, 1e-5, 3e-8}) {
    const double scale = driver::renderer_scale({nearest, 30 * nearest});
    CHECK(std::log2(scale) == std::floor(std::log2(scale)));
    CHECK(scale * nearest >= 1.0 / 32);
    CHECK(scale * nearest < 1.0 / 16);
  }
  CHECK(driver::renderer_scale({1e3, 1e9}) * 1e9 <= 524288);
  CHECK(driver::renderer_scale({1e-9, 1e3}) * 1e3 <= 524288);
}

TEST_CASE("a product is scaled exactly, with its eye and its lamps", "[driver]") {
  driver::Product product = product_at(1e-5);
  product.native.emplace();
  product.native->lamps.push_back({});
  product.native->lamps[0].at = {1, 2, 3}, product.native->lamps[0].intensity = {1, 1, 1};
  const driver::Product before = product;
  CHECK(driver::scale_for_renderers(product).empty());
  REQUIRE(product.scale > 1);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) CHECK(product.positions[i][k] == static_cast<float>(product.scale * before.positions[i][k]));
  CHECK(product.native->lamps[0].at.y == 2 * product.scale);
  CHECK(product.native->lamps[0].intensity.r == product.scale * product.scale);
  CHECK(product.eye.z == before.eye.z);
}

TEST_CASE("an eye that is too near for any scale is told", "[driver]") {
  driver::Product product = product_at(1e-9, 1000);
  const Diagnostics told = driver::scale_for_renderers(product);
  REQUIRE(told.size() == 1);
  CHECK(told[0].code == "driver.eye-too-near");
  CHECK(told[0].severity == Severity::warning);
}
