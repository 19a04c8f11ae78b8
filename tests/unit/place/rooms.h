#pragma once
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "compiler/geometry/chart.h"
#include "compiler/geometry/isometry.h"
#include "compiler/notation/parse.h"
#include "compiler/place/interior.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"

namespace orbc::place::test {

inline room::Room make_room(const std::string& notation) {
  notation::ParseOptions any;
  any.allow_non_orbifold = true;
  return room::realise(notation::parse(notation, any).value(), {}, true).value();
}

inline const std::vector<std::string>& notations() {
  static const std::vector<std::string> all = {"*",     "*22",   "*55",  "*222",   "*235",   "*22(12)", "**", "*22∞", "*333", "*244",
                                               "*2222", "*237",  "*666", "*22222", "*2323",  "*23456789(10)(11)", "*(3/2)(12)(12)"};
  return all;
}

/// Angles of the geodesic triangle pqr by Gauss–Bonnet's area; E²: half the cross product.
inline double area(geometry::Space space, const geometry::Point& p, const geometry::Point& q, const geometry::Point& r) {
  const double k = geometry::curvature(space);
  const double det = p.w * (q.x * r.y - q.y * r.x) - p.x * (q.w * r.y - q.y * r.w) + p.y * (q.w * r.x - q.x * r.w);
  if (k == 0) return det / 2;
  const auto form = [k](const geometry::Point& a, const geometry::Point& b) { return a.w * b.w + k * (a.x * b.x + a.y * b.y); };
  // tan(area/2) = det / (1 + pq + qr + rp), Oosterom and Strackee 1983; the same with the Lorentz form.
  return 2 * std::atan2(det, 1 + form(p, q) + form(q, r) + form(r, p));
}

using Key = std::array<double, 4>;
inline Key key(const PlacedMesh& mesh, std::uint32_t v) {
  return {mesh.floor[v].w + 0.0, mesh.floor[v].x + 0.0, mesh.floor[v].y + 0.0, mesh.z[v] + 0.0};
}

/// Directed edges that have no partner running the other way, by bitwise positions, over all the meshes together.
inline std::vector<std::pair<Key, Key>> open_edges(const std::vector<PlacedMesh>& meshes) {
  std::map<std::pair<Key, Key>, int> count;
  for (const PlacedMesh& mesh : meshes)
    for (const mesh::Triangle& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) {
        const Key a = key(mesh, t[i]), b = key(mesh, t[(i + 1) % 3]);
        if (a == b) continue;
        const auto partner = count.find({b, a});
        if (partner == count.end()) ++count[{a, b}];
        else if (--partner->second == 0) count.erase(partner);
      }
  std::vector<std::pair<Key, Key>> open;
  for (const auto& [edge, n] : count)
    for (int i = 0; i < n; ++i) open.push_back(edge);
  return open;
}

/// A random point of the room, uniform enough: a random mixture of the outline and the centre.
inline geometry::Point random_point(const room::Room& room, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const std::size_t n = room.outline.size(), i = std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  const double a = std::sqrt(unit(random)), b = unit(random);
  return geometry::normalised_point(room.space,
                                    (1 - a) * geometry::Point{} + a * ((1 - b) * room.outline[i] + b * room.outline[(i + 1) % n]));
}

}  // namespace orbc::place::test
