#include "view.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "compiler/cover/unfold.h"
#include "compiler/image/image.h"
#include "compiler/image/srgb.h"
#include "compiler/render/draw.h"

namespace orbc::test {

using geometry::Vector3;

driver::LoadedScene open_or_fail(const std::string& path) {
  auto loaded = driver::load(path);
  if (!loaded) FAIL(path + ": " + to_text(loaded.error()));
  loaded->scene.cover.background = {};  // no panels where paths are cut off: they would hide holes
  return std::move(loaded).value();
}

void move_eye(driver::LoadedScene& loaded, std::mt19937& random, int width, int height) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto& room = *loaded.interior;
  scene::Scene scene = loaded.scene;
  scene.camera.size = {width, height};
  scene.camera.projection = scene::Projection::perspective;
  scene.camera.look_at.value = scene::LookDirection{};
  const double far = room.polygon.circumradius;
  for (int trial = 0; trial < 1000; ++trial) {
    scene.camera.place.floor = scene::AtPolar{far * std::sqrt(unit(random)), Angle::from_degrees(360 * unit(random))};
    scene.camera.place.z = room.height * (0.03 + 0.94 * unit(random));
    const auto eye = place::make_camera(scene, room);
    if (!eye) continue;
    loaded.eye = *eye;
    const double yaw = 2 * M_PI * unit(random), pitch = std::asin(1.9 * unit(random) - 0.95) * unit(random),
                 roll = unit(random) < 0.5 ? 0 : 6 * unit(random);
    const Vector3 forward{std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)},
        level{std::sin(yaw), -std::cos(yaw), 0};
    const Vector3 upright = cross(level, forward);
    loaded.eye.forward = forward;
    loaded.eye.right = std::cos(roll) * level + std::sin(roll) * upright;
    loaded.eye.up = std::cos(roll) * upright + (-std::sin(roll)) * level;
    return;
  }
  FAIL("no place for the eye");
}

namespace {

constexpr double kNear = 1e-3;

Vector3 vertex(const driver::Product& product, std::uint32_t i) {
  const auto& p = product.positions[i];
  return (1 / product.scale) * Vector3{p[0], p[1], p[2]} - Vector3{0, 0, product.eye.z};
}

/// The corner of a box of pixels that holds the triangle, cut at a plane just before the eye.
struct Box {
  double low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
  void add(const place::Camera& eye, const Vector3& p) {
    const double f = dot(p, eye.forward), wide = std::tan(eye.fov.radians / 2);
    const double x = (dot(p, eye.right) / f / wide + 1) * eye.width / 2, y = eye.height / 2.0 - dot(p, eye.up) / f / wide * eye.width / 2;
    low[0] = std::min(low[0], x), high[0] = std::max(high[0], x);
    low[1] = std::min(low[1], y), high[1] = std::max(high[1], y);
  }
};

Box box_of(const place::Camera& eye, const Vector3 (&corner)[3]) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    const Vector3 &a = corner[k], &b = corner[(k + 1) % 3];
    const double fa = dot(a, eye.forward), fb = dot(b, eye.forward);
    if (fa > kNear) box.add(eye, a);
    if ((fa > kNear) != (fb > kNear)) box.add(eye, a + ((kNear - fa) / (fb - fa)) * (b - a));
  }
  return box;
}

bool meets(const Vector3 (&corner)[3], const Vector3& d) {
  double s[3];
  for (int k = 0; k < 3; ++k) {
    // The same bits, but for the sign, from both sides of an edge.
    const Vector3 &a = corner[k], &b = corner[(k + 1) % 3];
    const bool turned = std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z);
    s[k] = turned ? -dot(cross(b, a), d) : dot(cross(a, b), d);
  }
  if (!((s[0] >= 0 && s[1] >= 0 && s[2] >= 0) || (s[0] <= 0 && s[1] <= 0 && s[2] <= 0))) return false;
  const Vector3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double along = dot(normal, d), at = dot(normal, corner[0]);
  return along == 0 || at / along > 0;
}

}  // namespace

namespace {

/// Calls hit(triangle, pixel, direction) for every pixel whose centre sees a triangle, nearest or not.
template <class Hit>
void for_hits(const driver::Product& product, const Hit& hit) {
  const place::Camera& eye = product.eye;
  std::vector<Vector3> rays;
  for (int y = 0; y < eye.height; ++y)
    for (int x = 0; x < eye.width; ++x) rays.push_back(place::direction_through(eye, x + 0.5, y + 0.5));
  for (std::size_t i = 0; i < product.indices.size(); i += 3) {
    const Vector3 corner[3] = {vertex(product, product.indices[i]), vertex(product, product.indices[i + 1]),
                               vertex(product, product.indices[i + 2])};
    const Box box = box_of(eye, corner);
    const int x0 = std::max(0, static_cast<int>(std::max(box.low[0] - 1, -1.0))),
              x1 = static_cast<int>(std::min<double>(eye.width - 1, box.high[0] + 1));
    const int y0 = std::max(0, static_cast<int>(std::max(box.low[1] - 1, -1.0))),
              y1 = static_cast<int>(std::min<double>(eye.height - 1, box.high[1] + 1));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(eye.width) + static_cast<std::size_t>(x);
        if (meets(corner, rays[pixel])) hit(i, corner, pixel, rays[pixel]);
      }
    }
  }
}

}  // namespace

std::vector<bool> covered(const driver::Product& product) {
  std::vector<bool> seen(static_cast<std::size_t>(product.eye.width) * static_cast<std::size_t>(product.eye.height));
  for_hits(product, [&](std::size_t, const Vector3(&)[3], std::size_t pixel, const Vector3&) { seen[pixel] = true; });
  return seen;
}

std::vector<scene::Color> picture(const driver::Product& product) {
  struct Seen {
    double depth = 1e30;
    std::size_t triangle = 0;
    double u = 0, v = 0;
  };
  std::vector<Seen> nearest(static_cast<std::size_t>(product.eye.width) * static_cast<std::size_t>(product.eye.height));
  for_hits(product, [&](std::size_t triangle, const Vector3(&corner)[3], std::size_t pixel, const Vector3& d) {
    const Vector3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double t = dot(normal, corner[0]) / dot(normal, d), area = dot(normal, normal);
    if (!(t < nearest[pixel].depth) || !(area > 0)) return;
    const Vector3 p = t * d;
    const double b1 = dot(cross(p - corner[0], corner[2] - corner[0]), normal) / area,
                 b2 = dot(cross(corner[1] - corner[0], p - corner[0]), normal) / area;
    const auto uv = [&](std::size_t k) { return product.uv[product.indices[triangle + k]]; };
    nearest[pixel] = {t, triangle, uv(0)[0] + b1 * (uv(1)[0] - uv(0)[0]) + b2 * (uv(2)[0] - uv(0)[0]),
                      uv(0)[1] + b1 * (uv(1)[1] - uv(0)[1]) + b2 * (uv(2)[1] - uv(0)[1])};
  });
  std::vector<scene::Color> colors(nearest.size(), product.background);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (nearest[i].depth > 1e29) continue;
    const auto copy = std::upper_bound(product.copies.begin(), product.copies.end(), nearest[i].triangle,
                                       [](std::size_t at, const driver::ProductCopy& c) { return at < c.first_index; });
    const auto texel = [](double at, int size) { return std::clamp(static_cast<int>(at * size), 0, size - 1); };
    const image::Image& atlas = product.atlas;
    const std::size_t at = 4 * (static_cast<std::size_t>(texel(nearest[i].v, atlas.height)) * static_cast<std::size_t>(atlas.width) +
                                static_cast<std::size_t>(texel(nearest[i].u, atlas.width)));
    const auto linear = [&](std::size_t k) { return image::decode_srgb(atlas.rgba[at + k] / 255.0); };
    colors[i] = scene::Color{linear(0), linear(1), linear(2)} * (copy - 1)->weight;
  }
  return colors;
}

Holes holes(const driver::LoadedScene& loaded, const driver::Product& product, const trace::TraceScene& scene) {
  const place::Camera& eye = loaded.eye;
  const std::vector<bool> seen = covered(product);
  trace::FollowOptions options;
  options.max_bounces = loaded.scene.cover.max_bounces;
  options.min_weight = loaded.scene.cover.min_weight;
  Holes found;
  for (int y = 0; y < eye.height; ++y) {
    for (int x = 0; x < eye.width; ++x) {
      if (seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(eye.width) + static_cast<std::size_t>(x)]) continue;
      ++found.open;
      // Rings within the tolerance of a chord: the background may be a slit.
      bool cut_off = false;
      for (int j = 0; j < 37 && !cut_off; ++j) {
        const double r = j == 0 ? 0 : j < 13 ? 0.05 : j < 25 ? 0.12 : 0.3, dx = r * std::cos(j * M_PI / 6), dy = r * std::sin(j * M_PI / 6);
        cut_off = trace::follow(scene, render::eye_ray(eye, x + 0.5 + dx, y + 0.5 + dy), options).cut_off;
      }
      if (cut_off) continue;
      if (found.wrong++ == 0) found.first = fmt::format("pixel ({}, {}) of {}x{}", x, y, eye.width, eye.height);
    }
  }
  return found;
}

Seams seams(const driver::Product& product, const std::vector<cover::Copy>& copies) {
  using Key = std::array<float, 3>;
  Seams found;
  for (std::size_t c = 0; c < product.copies.size(); ++c) {
    const driver::ProductCopy& copy = product.copies[c];
    std::map<std::pair<Key, Key>, int> edges;
    for (std::size_t i = 0; i < copy.index_count; ++i) {
      const std::size_t first = copy.first_index + i / 3 * 3, k = i % 3;
      Key a = product.positions[product.indices[first + k]], b = product.positions[product.indices[first + (k + 1) % 3]];
      if (b < a) std::swap(a, b);
      ++edges[{a, b}];
    }
    std::vector<Key> vertices(product.positions.begin() + static_cast<std::ptrdiff_t>(copy.first_vertex),
                              product.positions.begin() + static_cast<std::ptrdiff_t>(copy.first_vertex + copy.vertex_count));
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const auto& [edge, count] : edges) {
      if (count != 1 || edge.first == edge.second) continue;
      const auto at = [](const Key& p) { return Vector3{p[0], p[1], p[2]}; };
      const Vector3 a = at(edge.first), b = at(edge.second), ab = b - a;
      const auto on_border = [&](const cover::Bearing& border) {
        const double on = 1e-5;
        return std::fabs(cover::cross(border, cover::Bearing{a.x, a.y})) < on * (1 + std::hypot(a.x, a.y)) &&
               std::fabs(cover::cross(border, cover::Bearing{b.x, b.y})) < on * (1 + std::hypot(b.x, b.y));
      };
      if (copies[c].wedge && (on_border(copies[c].wedge->from) || on_border(copies[c].wedge->to))) continue;
      if (!copies[c].height_bounds.empty()) continue;
      ++found.edges;
      // Sorted by x: only what lies between the ends can lie on the edge.
      const float least = std::min(edge.first[0], edge.second[0]), most = std::max(edge.first[0], edge.second[0]);
      for (auto v = std::lower_bound(vertices.begin(), vertices.end(), Key{least, -1e30F, -1e30F}); v != vertices.end() && (*v)[0] <= most;
           ++v) {
        if (*v == edge.first || *v == edge.second) continue;
        const Vector3 p = at(*v);
        const double t = dot(p - a, ab) / dot(ab, ab), off = length(p - (a + t * ab)), size = length(ab);
        if (t * size < 1e-5 || (1 - t) * size < 1e-5 || off > 1e-6 * (1 + length(p))) continue;
        if (found.torn++ == 0) {
          found.first = fmt::format(
              "copy {} '{}': ({:.7g}, {:.7g}, {:.7g}) within ({:.7g}, {:.7g}, {:.7g}) - ({:.7g}, {:.7g}, {:.7g}), t = {:.4g}, off {:.3g}",
              c, cover::to_string(copy.word), p.x, p.y, p.z, a.x, a.y, a.z, b.x, b.y, b.z, t, off);
        }
      }
    }
  }
  return found;
}

}  // namespace orbc::test
