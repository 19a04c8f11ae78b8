#pragma once
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/trace/intersect.h"

namespace orbc::trace {

/// The triangles of a scene in one list: corners as indices into `vertices`.
struct Soup {
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  struct Part {
    std::uint32_t first = 0;        ///< its first triangle
    std::int32_t part = 0;          ///< index into PlacedRoom::parts
  };
  std::vector<Part> parts;          ///< in order
};

struct BvhHit {
  std::uint32_t triangle = ~0u;     ///< index into Soup::triangles; ~0 = none
  double t = kEndless;
  double b[3] = {0, 0, 0};
};

class Bvh {
 public:
  Bvh(geometry::Space space, Soup soup, const Executor&) : space_(space), soup_(std::move(soup)) {}
  BvhHit closest(const Ray& ray, double t_max) const {
    BvhHit best;
    best.t = t_max;
    const RayPlane plane = plane_of(space_, ray);
    for (std::uint32_t i = 0; i < soup_.triangles.size(); ++i) {
      const auto& v = soup_.triangles[i];
      const TriangleHit hit = intersect(plane, soup_.vertices[v[0]], soup_.vertices[v[1]], soup_.vertices[v[2]], best.t);
      if (hit.found) best = {i, hit.t, {hit.b[0], hit.b[1], hit.b[2]}};
    }
    return best;
  }
  const Soup& soup() const { return soup_; }
 private:
  geometry::Space space_;
  Soup soup_;
};

}  // namespace orbc::trace
