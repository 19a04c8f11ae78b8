#include "scripts/make_meshes/sdf.h"

#include <cstdio>
#include <limits>

#include "compiler/mesh/analyse.h"
#include "compiler/mesh/decimate.h"
#include "compiler/mesh/weld.h"

namespace make_meshes {

using orbc::mesh::Mesh;

namespace {

Vector3 gradient(const Field& f, const Vector3& p, double h) {
  return {(f({p.x + h, p.y, p.z}) - f({p.x - h, p.y, p.z})) / (2 * h), (f({p.x, p.y + h, p.z}) - f({p.x, p.y - h, p.z})) / (2 * h),
          (f({p.x, p.y, p.z + h}) - f({p.x, p.y, p.z - h})) / (2 * h)};
}

}  // namespace

Mesh surface_of(const Field& field, const Vector3& low, const Vector3& high, double step, double lipschitz) {
  constexpr int kBlock = 8;
  int n[3];
  const double size[3] = {high.x - low.x, high.y - low.y, high.z - low.z};
  for (int k = 0; k < 3; ++k) n[k] = (static_cast<int>(size[k] / step) / kBlock + 1) * kBlock + 1;
  const auto index = [&](int i, int j, int k) {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(n[1]) + static_cast<std::size_t>(j)) * static_cast<std::size_t>(n[0]) +
           static_cast<std::size_t>(i);
  };
  const auto point = [&](double i, double j, double k) { return Vector3{low.x + i * step, low.y + j * step, low.z + k * step}; };
  std::vector<float> value(index(0, 0, n[2]), 1e9f);
  // Only blocks that the surface can meet are filled in finely.
  for (int bk = 0; bk + kBlock < n[2]; bk += kBlock) {
    for (int bj = 0; bj + kBlock < n[1]; bj += kBlock) {
      for (int bi = 0; bi + kBlock < n[0]; bi += kBlock) {
        const double d = field(point(bi + 4, bj + 4, bk + 4));
        const bool near = std::abs(d) < lipschitz * step * (kBlock / 2 + 1) * std::sqrt(3.0);
        for (int k = bk; k <= bk + kBlock; ++k) {
          for (int j = bj; j <= bj + kBlock; ++j) {
            for (int i = bi; i <= bi + kBlock; ++i) {
              auto& v = value[index(i, j, k)];
              if (near) v = static_cast<float>(field(point(i, j, k)));
              else if (v == 1e9f) v = d > 0 ? 1e8f : -1e8f;
            }
          }
        }
      }
    }
  }
  // Where inside and outside meet only along a diagonal of a cell's side, the surface would touch itself: such gaps are filled.
  for (bool changed = true; changed;) {
    changed = false;
    for (int k = 1; k + 1 < n[2]; ++k) {
      for (int j = 1; j + 1 < n[1]; ++j) {
        for (int i = 1; i + 1 < n[0]; ++i) {
          for (int axis = 0; axis < 3; ++axis) {
            int u[3] = {0, 0, 0}, v[3] = {0, 0, 0};
            u[(axis + 1) % 3] = 1, v[(axis + 2) % 3] = 1;
            float* c[4] = {&value[index(i, j, k)], &value[index(i + u[0], j + u[1], k + u[2])],
                           &value[index(i + u[0] + v[0], j + u[1] + v[1], k + u[2] + v[2])], &value[index(i + v[0], j + v[1], k + v[2])]};
            if ((*c[0] < 0) != (*c[2] < 0) || (*c[1] < 0) != (*c[3] < 0) || (*c[0] < 0) == (*c[1] < 0)) continue;
            auto*& outside = *c[0] < 0 ? (*c[1] < *c[3] ? c[1] : c[3]) : (*c[0] < *c[2] ? c[0] : c[2]);
            *outside = -1e-6f;
            changed = true;
          }
          // The same where they meet only along a diagonal of a whole cell.
          int inside = 0;
          float* least = nullptr;
          for (int c = 0; c < 8; ++c) {
            float& v = value[index(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2))];
            if (v < 0) ++inside;
            else if (!least || v < *least) least = &v;
          }
          const auto is_inside = [&](int c) { return value[index(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2))] < 0; };
          const bool diagonal = (inside == 2 || inside == 6) && (is_inside(0) == is_inside(7)) && (is_inside(1) == is_inside(6)) &&
                                (is_inside(2) == is_inside(5)) && (is_inside(3) == is_inside(4));
          if (diagonal) *least = -1e-6f, changed = true;
        }
      }
    }
  }
  Mesh mesh;
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> vertex(value.size(), kNone);
  for (int k = 0; k + 1 < n[2]; ++k) {
    for (int j = 0; j + 1 < n[1]; ++j) {
      for (int i = 0; i + 1 < n[0]; ++i) {
        Vector3 sum;
        int crossings = 0;
        for (int e = 0; e < 12; ++e) {
          const int axis = e / 4, u = e % 2, v = e / 2 % 2;
          int a[3] = {i, j, k}, b[3];
          a[(axis + 1) % 3] += u, a[(axis + 2) % 3] += v;
          std::copy(a, a + 3, b);
          ++b[axis];
          const double fa = value[index(a[0], a[1], a[2])], fb = value[index(b[0], b[1], b[2])];
          if ((fa < 0) == (fb < 0)) continue;
          const double t = fa / (fa - fb);
          sum = sum + point(mix(a[0], b[0], t), mix(a[1], b[1], t), mix(a[2], b[2], t));
          ++crossings;
        }
        if (crossings == 0) continue;
        vertex[index(i, j, k)] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(1.0 / crossings * sum);
      }
    }
  }
  for (auto& p : mesh.positions) {
    for (int pass = 0; pass < 3; ++pass) {
      const Vector3 g = gradient(field, p, step / 4);
      const double g2 = dot(g, g);
      if (!(g2 > 0.05)) break;
      const Vector3 move = field(p) / g2 * g;
      const double far = length(move);
      p = p - (far > step / 2 ? step / 2 / far : 1) * move;
    }
  }
  for (int k = 1; k + 1 < n[2]; ++k) {
    for (int j = 1; j + 1 < n[1]; ++j) {
      for (int i = 1; i + 1 < n[0]; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          int b[3] = {i, j, k};
          ++b[axis];
          const bool in = value[index(i, j, k)] < 0, out = value[index(b[0], b[1], b[2])] < 0;
          if (in == out) continue;
          int d1[3] = {0, 0, 0}, d2[3] = {0, 0, 0};
          d1[(axis + 1) % 3] = 1, d2[(axis + 2) % 3] = 1;
          const std::uint32_t a = vertex[index(i, j, k)], q = vertex[index(i - d1[0], j - d1[1], k - d1[2])],
                              c = vertex[index(i - d1[0] - d2[0], j - d1[1] - d2[1], k - d1[2] - d2[2])],
                              e = vertex[index(i - d2[0], j - d2[1], k - d2[2])];
          std::array<std::uint32_t, 4> quad = in ? std::array<std::uint32_t, 4>{a, q, c, e} : std::array<std::uint32_t, 4>{a, e, c, q};
          const auto& p = mesh.positions;
          const bool first = length(p[quad[0]] - p[quad[2]]) <= length(p[quad[1]] - p[quad[3]]);
          if (first) mesh.triangles.insert(mesh.triangles.end(), {{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}});
          else mesh.triangles.insert(mesh.triangles.end(), {{quad[0], quad[1], quad[3]}, {quad[1], quad[2], quad[3]}});
        }
      }
    }
  }
  return mesh;
}

Mesh simplified(const Mesh& mesh, std::size_t triangles, const char* name) {
  auto done = orbc::mesh::decimate(mesh, {.triangles = triangles, .max_error = 0});
  auto found = orbc::mesh::analyse(done.mesh);
  for (std::size_t less = 500; found.crossings > 0 && less <= 2000; less += 500) {
    std::printf("%s: %zu triangles cross\n", name, found.crossings);
    done = orbc::mesh::decimate(mesh, {.triangles = triangles - less, .max_error = 0});
    found = orbc::mesh::analyse(done.mesh);
  }
  for (auto& p : done.mesh.positions) p.z -= found.lowest.z;
  std::printf("%-16s %7zu -> %6zu triangles, error %.2e, %s, Euler %d, %zu bad edges, %zu crossings, box %.3f x %.3f x %.3f\n", name,
              mesh.triangles.size(), done.mesh.triangles.size(), done.error, found.closed ? "closed" : "OPEN", found.euler,
              found.non_manifold_edges, found.crossings, found.highest.x - found.lowest.x, found.highest.y - found.lowest.y,
              found.highest.z - found.lowest.z);
  return done.mesh;
}

}  // namespace make_meshes
