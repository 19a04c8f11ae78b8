// All bodies are grids of quads over a parameter rectangle; where the rectangle's borders meet, positions are taken from the same
// numbers, so that both sides of a uv seam agree bit by bit.
#include "compiler/mesh/primitives.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "compiler/base/check.h"
#include "compiler/base/elementary.h"
#include "compiler/mesh/weld.h"

namespace orbc::mesh {
namespace {

using geometry::Vector3;
using std::numbers::pi;

/// Points on the unit circle, closed exactly: point `count` is point 0.
std::vector<std::array<double, 2>> circle(int count) {
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i <= count; ++i) {
    const int at = i % count;
    // Quarter turns are exact, so that boxes of extent are too.
    const double angle = 2 * pi * at / count;
    points.push_back({4 * at == count || 4 * at == 3 * count ? 0 : math::cos(angle), at == 0 || 2 * at == count ? 0 : math::sin(angle)});
  }
  return points;
}

/// A grid of (columns+1) × (rows+1) vertices; row 0 at v = 0.
class Grid {
 public:
  Grid(Mesh& mesh, int columns, int rows)
      : mesh_(mesh), columns_(columns), base_(static_cast<std::uint32_t>(mesh.positions.size())), rows_(rows) {}
  void vertex(const Vector3& p, double u, double v) {
    mesh_.positions.push_back(p);
    mesh_.uv.push_back({static_cast<float>(u), static_cast<float>(v)});
  }
  std::uint32_t at(int column, int row) const { return base_ + static_cast<std::uint32_t>(row * (columns_ + 1) + column); }
  /// Seen from outside, u goes right and v goes down. Rows that are a single point get one triangle a column.
  void triangles(bool top_is_point = false, bool bottom_is_point = false) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const auto a = at(column, row), b = at(column + 1, row), c = at(column, row + 1), d = at(column + 1, row + 1);
        const bool skip_top = row == 0 && top_is_point, skip_bottom = row + 1 == rows_ && bottom_is_point;
        if (skip_top) {
          mesh_.triangles.push_back({a, c, d});
        } else if (skip_bottom) {
          mesh_.triangles.push_back({a, c, b});
        } else if ((row + column) % 2 == 0) {
          mesh_.triangles.push_back({a, c, d});
          mesh_.triangles.push_back({a, d, b});
        } else {
          mesh_.triangles.push_back({a, c, b});
          mesh_.triangles.push_back({b, c, d});
        }
      }
    }
  }

 private:
  Mesh& mesh_;
  int columns_;
  std::uint32_t base_;
  int rows_;
};

}  // namespace

Mesh make_sphere(double radius, int around, int rings) {
  ORBC_CHECK(radius, >, 0);
  ORBC_CHECK(around, >=, 3);
  ORBC_CHECK(rings, >=, 2);
  Mesh mesh;
  Grid grid(mesh, around, rings);
  const auto c = circle(around);
  for (int j = 0; j <= rings; ++j) {
    const double z = j == 0 ? 1 : j == rings ? -1 : math::cos(pi * j / rings), r = j == 0 || j == rings ? 0 : math::sin(pi * j / rings);
    for (int i = 0; i <= around; ++i) {
      // At a pole each column has its own vertex, with uv in the middle of its triangle.
      const double u = (j == 0 || j == rings ? i + 0.5 : i) / around;
      const auto& e = c[static_cast<std::size_t>(i)];
      grid.vertex({radius * r * e[0], radius * r * e[1], radius * z}, std::min(u, 1.0), static_cast<double>(j) / rings);
    }
  }
  grid.triangles(true, true);
  return remove_unused_vertices(std::move(mesh)).mesh;
}

Mesh make_cylinder(double radius, double height, int around, int bands, int cap_rings) {
  ORBC_CHECK(radius, >, 0);
  ORBC_CHECK(height, >, 0);
  ORBC_CHECK(around, >=, 3);
  ORBC_CHECK(bands, >=, 1);
  ORBC_CHECK(cap_rings, >=, 1);
  Mesh mesh;
  const auto c = circle(around);
  // The side takes the middle half of the picture, the caps its top and bottom quarter as discs would be cut open.
  Grid side(mesh, around, bands);
  for (int j = 0; j <= bands; ++j) {
    const double t = static_cast<double>(j) / bands;
    for (int i = 0; i <= around; ++i) {
      const auto& e = c[static_cast<std::size_t>(i)];
      side.vertex({radius * e[0], radius * e[1], height * (0.5 - t)}, static_cast<double>(i) / around, 0.25 + 0.5 * t);
    }
  }
  side.triangles();
  for (const bool top : {true, false}) {
    Grid cap(mesh, around, cap_rings);
    for (int j = 0; j <= cap_rings; ++j) {
      const double t = static_cast<double>(top ? j : cap_rings - j) / cap_rings;  // 0 on the axis, 1 at the rim
      for (int i = 0; i <= around; ++i) {
        const auto& e = c[static_cast<std::size_t>(i)];
        const bool point = top ? j == 0 : j == cap_rings;
        const double u = std::min((point ? i + 0.5 : i) / around, 1.0), v = static_cast<double>(j) / cap_rings;
        cap.vertex({radius * t * e[0], radius * t * e[1], top ? height / 2 : -height / 2}, u, top ? 0.25 * v : 0.75 + 0.25 * v);
      }
    }
    cap.triangles(top, !top);
  }
  return remove_unused_vertices(std::move(mesh)).mesh;
}

Mesh make_box(const std::array<double, 3>& size, const std::array<int, 3>& cells) {
  for (int k = 0; k < 3; ++k) {
    ORBC_CHECK(size[static_cast<std::size_t>(k)], >, 0);
    ORBC_CHECK(cells[static_cast<std::size_t>(k)], >=, 1);
  }
  Mesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int sign : {1, -1}) {
      // Seen from outside with the vertical upright: `right` × `up` = outward.
      const std::size_t right = axis == 2 ? 0 : axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
      const double handed = axis == 1 ? -sign : sign;
      Grid grid(mesh, cells[right], cells[up]);
      for (int j = 0; j <= cells[up]; ++j) {
        for (int i = 0; i <= cells[right]; ++i) {
          const double u = static_cast<double>(i) / cells[right], v = static_cast<double>(j) / cells[up];
          std::array<double, 3> p{};
          // (2i − n)/n is odd in the middle, so that opposite sides agree bit by bit.
          p[right] = handed * size[right] / 2 * (2 * i - cells[right]) / cells[right];
          p[up] = size[up] / 2 * (cells[up] - 2 * j) / cells[up];
          p[axis] = sign * size[axis] / 2;
          grid.vertex({p[0], p[1], p[2]}, u, v);
        }
      }
      grid.triangles();
    }
  }
  return mesh;
}

Mesh make_beam(double length, double width, int cells, int across) { return make_box({length, width, width}, {cells, across, across}); }

namespace {

/// A tube around a closed curve; frames are carried along without twist, and what is left at the end is spread evenly.
Mesh sweep(const std::vector<Vector3>& middle, double tube, int across) {
  const auto n = middle.size();
  std::vector<Vector3> tangent(n), normal(n + 1);
  for (std::size_t i = 0; i < n; ++i) tangent[i] = normalised(middle[(i + 1) % n] - middle[(i + n - 1) % n]);
  const Vector3 helper = std::abs(tangent[0].z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0};
  normal[0] = normalised(helper - dot(helper, tangent[0]) * tangent[0]);
  for (std::size_t i = 1; i <= n; ++i) {
    // Double reflection (Wang, Jüttler, Zheng, Liu 2008: Computation of rotation minimizing frames).
    const auto& t0 = tangent[i - 1];
    const auto& t1 = tangent[i % n];
    const Vector3 v1 = middle[i % n] - middle[i - 1];
    const double c1 = dot(v1, v1);
    const Vector3 rl = normal[i - 1] - (2 / c1 * dot(v1, normal[i - 1])) * v1, tl = t0 - (2 / c1 * dot(v1, t0)) * v1;
    const Vector3 v2 = t1 - tl;
    const double c2 = dot(v2, v2);
    normal[i] = c2 > 0 ? rl - (2 / c2 * dot(v2, rl)) * v2 : rl;
  }
  const double left = math::atan2(dot(cross(normal[0], normal[n]), tangent[0]), dot(normal[0], normal[n]));
  const auto c = circle(across);
  Mesh mesh;
  Grid grid(mesh, static_cast<int>(n), across);
  for (int j = 0; j <= across; ++j) {
    for (std::size_t i = 0; i <= n; ++i) {
      const auto at = i % n;
      const double back = -left * static_cast<double>(at) / static_cast<double>(n);
      const Vector3 side = cross(tangent[at], normal[at]);
      const Vector3 e = math::cos(back) * normal[at] + math::sin(back) * side, f = cross(tangent[at], e);
      const auto& unit = c[static_cast<std::size_t>(j)];
      grid.vertex(middle[at] + tube * (unit[0] * e + unit[1] * f), static_cast<double>(i) / static_cast<double>(n),
                  static_cast<double>(j) / across);
    }
  }
  grid.triangles();
  return mesh;
}

}  // namespace

Mesh make_torus(double radius, double tube, int around, int across) {
  ORBC_CHECK(tube, >, 0);
  ORBC_CHECK(radius, >, tube);
  ORBC_CHECK(around, >=, 3);
  ORBC_CHECK(across, >=, 3);
  const auto c = circle(around), d = circle(across);
  Mesh mesh;
  Grid grid(mesh, around, across);
  for (int j = 0; j <= across; ++j) {
    const auto& e = d[static_cast<std::size_t>(across - j)];
    for (int i = 0; i <= around; ++i) {
      const auto& f = c[static_cast<std::size_t>(i)];
      // v runs from the inner equator over the bottom, outside and top back, upwards first on the outside: seen from outside it goes down.
      const double r = radius - tube * e[0];
      grid.vertex({r * f[0], r * f[1], -tube * e[1]}, static_cast<double>(i) / around, static_cast<double>(j) / across);
    }
  }
  grid.triangles();
  return mesh;
}

Mesh make_torus_knot(int p, int q, double radius, double tube, int along, int across) {
  ORBC_CHECK(std::gcd(p, q), ==, 1);
  ORBC_CHECK(tube, >, 0);
  ORBC_CHECK(radius, >, 0);
  ORBC_CHECK(along, >=, 3);
  ORBC_CHECK(across, >=, 3);
  std::vector<Vector3> middle;
  const double minor = radius / 2.5;
  for (int i = 0; i < along; ++i) {
    const double t = 2 * pi * i / along, r = radius + minor * math::cos(q * t);
    middle.push_back({r * math::cos(p * t), r * math::sin(p * t), minor * math::sin(q * t)});
  }
  return sweep(middle, tube, across);
}

}  // namespace orbc::mesh
