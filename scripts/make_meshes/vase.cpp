// A painted amphora: a lathed body, hollow, and two handles, with bands of meanders, rays and checkers in one picture.
#include "scripts/make_meshes/vase.h"

#include <numbers>

#include "compiler/image/image.h"
#include "compiler/mesh/weld.h"

namespace make_meshes {
namespace {

using orbc::image::Image;
using orbc::mesh::Mesh;
using std::numbers::pi;

/// Outside from the foot up to the lip, over it, and down inside: radius and height, both ends on the axis.
std::vector<Knot> profile() {
  const std::vector<Knot> knots = {{{0.0, 0, 0.0}, 0},    {{0.1, 0, 0.0}, 0},     {{0.165, 0, 0.0}, 0},  {{0.172, 0, 0.022}, 0},
                                   {{0.145, 0, 0.05}, 0}, {{0.105, 0, 0.085}, 0}, {{0.115, 0, 0.13}, 0}, {{0.2, 0, 0.25}, 0},
                                   {{0.29, 0, 0.42}, 0},  {{0.325, 0, 0.58}, 0},  {{0.3, 0, 0.72}, 0},   {{0.21, 0, 0.83}, 0},
                                   {{0.135, 0, 0.9}, 0},  {{0.118, 0, 0.98}, 0},  {{0.128, 0, 1.06}, 0}, {{0.175, 0, 1.115}, 0},
                                   {{0.18, 0, 1.135}, 0}, {{0.165, 0, 1.142}, 0}, {{0.11, 0, 1.06}, 0},  {{0.098, 0, 0.98}, 0},
                                   {{0.115, 0, 0.9}, 0},  {{0.19, 0, 0.82}, 0},   {{0.28, 0, 0.71}, 0},  {{0.303, 0, 0.58}, 0},
                                   {{0.268, 0, 0.42}, 0}, {{0.18, 0, 0.26}, 0},   {{0.09, 0, 0.16}, 0},  {{0.0, 0, 0.14}, 0}};
  auto points = curve(knots, 4);
  for (auto& p : points) p.at.x = std::max(p.at.x, 0.0), p.at.z = std::max(p.at.z, 0.0);
  return points;
}

struct Colour {
  std::uint8_t r, g, b;
};
constexpr Colour kClay{206, 104, 56}, kInk{30, 24, 24}, kCream{238, 208, 164}, kRed{150, 40, 30};

/// The paint at u round the body, v from foot (0) to lip (1) along the outside.
Colour paint(double u, double v) {
  static const char* kMeander[8] = {"#######.", "#.....#.", "#.###.#.", "#.#.#.#.", "#.#...#.", "#.#####.", "#.......", "########"};
  const auto within = [&](double low, double high, double& t) { return t = (v - low) / (high - low), t >= 0 && t < 1; };
  const auto meander = [&](int count, double t) {
    const int column = static_cast<int>(u * count * 8) % 8, row = static_cast<int>(t * 10) - 1;
    if (row < 0 || row > 7) return kClay;
    return kMeander[7 - row][column] == '#' ? kInk : kClay;
  };
  double t = 0;
  if (within(0.0, 0.21, t)) return kInk;
  if (within(0.21, 0.36, t)) return std::abs(std::fmod(u * 24, 1.0) - 0.5) < 0.46 * (1 - t) ? kInk : kClay;  // rays
  if (within(0.36, 0.375, t)) return kInk;
  if (within(0.375, 0.39, t)) return kRed;
  if (within(0.39, 0.47, t)) return (static_cast<int>(u * 64) + static_cast<int>(t * 4)) % 2 ? kCream : kInk;  // checkers
  if (within(0.47, 0.485, t)) return kRed;
  if (within(0.485, 0.57, t)) {  // the wave
    const double x = std::fmod(u * 16, 1.0), wave = 0.5 + 0.36 * std::sin(2 * pi * x);
    return std::abs(t - wave) < 0.13 ? kCream : kInk;
  }
  if (within(0.57, 0.68, t)) return meander(18, t);
  if (within(0.68, 0.695, t)) return kInk;
  if (within(0.695, 0.765, t))
    return std::abs(std::fmod(u * 40, 1.0) - 0.5) < 0.4 * std::sqrt(std::max(0.0, 1 - (2 * t - 1) * (2 * t - 1))) ? kInk
                                                                                                                  : kClay;  // tongues
  if (within(0.765, 0.78, t)) return kInk;
  if (within(0.78, 0.9, t)) return meander(9, t);
  return kInk;
}

}  // namespace

Image vase_paint() {
  Image image{1024, 1024, {}};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      int sum[3] = {0, 0, 0};
      for (int s = 0; s < 16; ++s) {
        const auto c = paint((x + (s % 4 + 0.5) / 4) / image.width, 1 - (y + (s / 4 + 0.5) / 4) / image.height);
        sum[0] += c.r, sum[1] += c.g, sum[2] += c.b;
      }
      for (const int c : sum) image.rgba.push_back(static_cast<std::uint8_t>((c + 8) / 16));
      image.rgba.push_back(255);
    }
  }
  return image;
}

Mesh vase() {
  Mesh mesh;
  const auto points = profile();
  constexpr int kAround = 64;
  // v runs with the arc length of the outside; the inside is all ink.
  std::vector<double> length(points.size(), 0);
  std::size_t lip = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    length[i] = length[i - 1] + orbc::geometry::length(points[i].at - points[i - 1].at);
    if (points[i].at.z > points[lip].at.z) lip = i;
  }
  const auto add = [&](const Vector3& p, double u, double v) {
    mesh.positions.push_back(p);
    mesh.uv.push_back({static_cast<float>(u), static_cast<float>(1 - v)});
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int j = 0; j <= kAround; ++j) {
      const double a = 2 * pi * (j % kAround) / kAround;
      add({points[i].at.x * std::cos(a), points[i].at.x * std::sin(a), points[i].at.z}, static_cast<double>(j) / kAround,
          i <= lip ? length[i] / length[lip] : 0.99);
    }
  }
  const auto grid = [&](std::uint32_t base, std::uint32_t rows, std::uint32_t columns, bool points_at_ends) {
    for (std::uint32_t i = 0; i < rows; ++i) {
      for (std::uint32_t j = 0; j < columns; ++j) {
        const auto a = base + i * (columns + 1) + j, b = a + 1, c = a + columns + 1, d = c + 1;
        if (!(points_at_ends && i == 0)) mesh.triangles.push_back({a, b, d});
        if (!(points_at_ends && i + 1 == rows)) mesh.triangles.push_back({a, d, c});
      }
    }
  };
  grid(0, static_cast<std::uint32_t>(points.size()) - 1, kAround, true);
  for (const double side : {-1.0, 1.0}) {
    // The handles end a hair above the clay, square to it, so that nothing crosses.
    const auto on_clay = [&](double z, double above) {
      std::size_t i = 8;
      while (points[i].at.z < z) ++i;
      const Vector3 t = normalised(points[i].at - points[i - 1].at), n{t.z, 0, -t.x};
      const Vector3 p = mix(points[i - 1].at, points[i].at, (z - points[i - 1].at.z) / (points[i].at.z - points[i - 1].at.z)) + above * n;
      return Vector3{side * p.x, 0, p.z};
    };
    const auto middle = curve({{on_clay(0.99, 0.003), 0.025},
                               {on_clay(0.99, 0.05), 0.026},
                               {{0.27 * side, 0, 0.995}, 0.027},
                               {{0.335 * side, 0, 0.95}, 0.027},
                               {{0.345 * side, 0, 0.87}, 0.027},
                               {on_clay(0.775, 0.05), 0.028},
                               {on_clay(0.77, 0.003), 0.03}},
                              6);
    constexpr int kAcross = 16;
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    const std::size_t n = middle.size();
    for (std::size_t i = 0; i < n + 2; ++i) {
      const std::size_t at = i == 0 ? 0 : std::min(i - 1, n - 1);
      const bool end = i == 0 || i == n + 1;
      const Vector3 along = normalised(middle[std::min(at + 1, n - 1)].at - middle[at > 0 ? at - 1 : 0].at),
                    e = cross(Vector3{0, 1, 0}, along);
      for (int j = 0; j <= kAcross; ++j) {
        const double a = 2 * pi * (j % kAcross) / kAcross, r = end ? 0 : middle[at].radius;
        add(middle[at].at + r * (std::cos(a) * Vector3{0, 1.25, 0} + std::sin(a) * e), static_cast<double>(j) / kAcross, 0.99);
      }
    }
    const auto first = mesh.triangles.size();
    grid(base, static_cast<std::uint32_t>(n) + 1, kAcross, true);
    for (auto t = first; t < mesh.triangles.size(); ++t) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  return remove_unused_vertices(std::move(mesh)).mesh;
}

}  // namespace make_meshes
