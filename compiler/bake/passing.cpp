#include "compiler/bake/passing.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "compiler/bake/surface_map.h"
#include "compiler/light/connection.h"
#include "compiler/light/guide.h"
#include "compiler/light/light_path.h"
#include "compiler/surface/albedo.h"
#include "compiler/surface/tangent_frame.h"

namespace orbc::bake {
namespace {

using scene::Color;

constexpr int kLinked = 4;  // of so many directions one carries on what has been passed on: that is smoother than what lamps give
constexpr std::size_t kMostLinks = std::size_t{1} << 24;  // 400 MB: where they would be more, fewer directions carry on
// Of a cell, or of the way to the neighbours: how far inside of a surface its outermost vertices are asked
constexpr double kInside = 0.25;
constexpr int kStream = 512;       // rays followed at once
constexpr int kMostPoints = 129;   // along a side of a block
constexpr double kSettled = 2e-4;  // of white: change at which the iteration ends

/// Where a direction of a point ends.
struct Link {
  OnBlock to;
  std::array<float, 3> weight{};  ///< of what the surface there has been passed
};
struct Node {
  surface::ShadingPoint at;
  Color given;                       ///< from surfaces under their lamps, from those that glow, from the background
  Color passed;                      ///< all that surfaces pass on to it
  bool blind = false;                ///< sees the inside of things
  OnBlock stands_for;                ///< of a coarser level: where the part itself has its light, if that is known
  std::size_t first = 0, count = 0;  ///< links
};

int points_on(double length, double density) {
  return std::clamp(static_cast<int>(std::ceil(length * density - 1e-9)), 1, kMostPoints - 1) + 1;
}

/// The net: vertices of the parts, and points inside the blocks.
class Net {
 public:
  Net(const LitSurfaces& surfaces, const PassOptions& options) : s_(surfaces), options_(options), map_(surfaces.room, surfaces.blocks) {
    for (std::size_t p = 0; p < s_.room.parts.size(); ++p) {
      const surface::PartNormals& normals = *s_.normals[p];
      const std::size_t vertices = nodes_.size();
      const bool stand_in = p >= s_.lighting.normals.size();
      add_vertices(s_.room.parts[p], normals, stand_in);
      for (const Block& block : s_.blocks[p]) add_block(s_.room.parts[p], normals, block, vertices, stand_in);
    }
    const auto asking = std::count_if(nodes_.begin(), nodes_.end(), [](const Node& node) { return node.stands_for.block < 0; });
    const std::size_t directions = static_cast<std::size_t>(asking) * static_cast<std::size_t>(options_.samples);
    linked_ = static_cast<int>(std::clamp((directions + kMostLinks - 1) / kMostLinks, std::size_t{kLinked},
                                          static_cast<std::size_t>(std::max(kLinked, options_.samples))));
  }

  void gather(const Executor& executor, const Progress& progress) {
    constexpr std::size_t kChunk = 16;
    const std::size_t chunks = (nodes_.size() + kChunk - 1) / kChunk;
    std::vector<std::vector<Link>> links(chunks);
    std::atomic<std::uint64_t> done{0};
    executor(chunks, [&](std::size_t c) {
      for (std::size_t i = c * kChunk; i < std::min(nodes_.size(), (c + 1) * kChunk); ++i)
        if (nodes_[i].stands_for.block < 0) ask(nodes_[i], i, links[c]);
      report(progress, "passing light on", done.fetch_add(kChunk), nodes_.size(), "points");
    });
    for (std::size_t c = 0; c < chunks; ++c) {
      for (std::size_t i = c * kChunk; i < std::min(nodes_.size(), (c + 1) * kChunk); ++i) nodes_[i].first += links_.size();
      if (links_.empty())
        links_.reserve(std::min(kMostLinks + nodes_.size(), nodes_.size() * static_cast<std::size_t>(options_.samples / linked_ + 1)));
      links_.insert(links_.end(), links[c].begin(), links[c].end());
      std::vector<Link>().swap(links[c]);
    }
  }

  void settle(const Executor& executor) {
    for (Node& node : nodes_) node.passed = node.given;
    spread_to_blind();
    constexpr std::size_t kChunk = 256;
    const double enough = kSettled / std::max(s_.lighting.exposure, 1e-300);
    for (int pass = 1; pass < s_.lighting.options.indirect_bounces; ++pass) {
      const std::vector<LightGrid> before = grids();
      std::vector<Color> next(nodes_.size());
      executor((nodes_.size() + kChunk - 1) / kChunk, [&](std::size_t c) {
        for (std::size_t i = c * kChunk; i < std::min(nodes_.size(), (c + 1) * kChunk); ++i) next[i] = carried(nodes_[i], before);
      });
      double change = 0;
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        change = std::max(change, largest(next[i] + -1.0 * nodes_[i].passed) * !nodes_[i].blind);
        nodes_[i].passed = next[i];
      }
      spread_to_blind();
      if (change < enough) break;
    }
    lend_to_stand_ins();
  }

  [[nodiscard]] std::vector<LightGrid> grids() const {
    std::vector<LightGrid> all;
    for (const Mesh& mesh : meshes_) {
      LightGrid& grid = all.emplace_back();
      grid.w = mesh.w, grid.h = mesh.h;
      grid.light.resize(mesh.node.size());
      for (std::size_t k = 0; k < mesh.node.size(); ++k) {
        if (mesh.node[k] < 0) continue;
        const Color& c = nodes_[static_cast<std::size_t>(mesh.node[k])].passed;
        grid.light[k] = {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
      }
      // Beyond the long side of a single triangle its light is continued.
      for (int j = 0; j < mesh.h; ++j)
        for (int i = 0; i < mesh.w; ++i) {
          if (mesh.node[static_cast<std::size_t>(j * mesh.w + i)] >= 0) continue;
          for (std::size_t c = 0; c < 3; ++c)
            grid.point(i, j)[c] = std::max(0.0f, grid.point(i - 1, j)[c] + grid.point(i, j - 1)[c] - grid.point(i - 1, j - 1)[c]);
        }
    }
    return all;
  }

 private:
  /// The nodes of a block, row by row; −1 beyond the long side of a single triangle.
  struct Mesh {
    int w = 2, h = 2;
    std::vector<std::int32_t> node;
  };

  // Vertices of objects are asked a little inside of the smooth surface that they belong to: at a foot on the floor all that lies below is
  // one point, and just there shadows begin. In the middle of a surface that is the vertex itself.
  void add_vertices(const place::PlacedMesh& part, const surface::PartNormals& normals, bool stand_in) {
    const geometry::Space space = s_.room.room.space;
    const bool flat = part.kind != place::PartKind::object && part.kind != place::PartKind::frame;
    struct Around {
      geometry::Ambient floor{0, 0, 0};
      double z = 0;
      int count = 0;
    };
    std::vector<Around> around(normals.vertices.size());
    for (std::size_t t = 0; !flat && t < part.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t other = 0; other < 3; ++other) {
          if (other == k) continue;
          Around& a = around[normals.corners[t][k]];
          a.floor = a.floor + part.floor[part.triangles[t][other]], a.z += part.z[part.triangles[t][other]], ++a.count;
        }
    std::vector<std::array<std::size_t, 2>> corner(normals.vertices.size());  // triangle, which of it
    for (std::size_t t = 0; t < part.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) corner[normals.corners[t][k]] = {t, k};
    for (std::size_t v = 0; v < normals.vertices.size(); ++v) {
      surface::ShadingPoint point = surface::shading_point(s_.room, part, normals.vertices[v]);
      double reach = light::kVertexTolerance;
      if (around[v].count > 0) {
        const surface::TangentFrame frame = surface::tangent_frame(space, point.at.floor);
        const double share = 1.0 / around[v].count;
        const geometry::Vector3 n = surface::to_local(space, frame, point.normal);
        const geometry::Vector3 to =
            surface::to_local(space, frame, {share * around[v].floor - point.at.floor, share * around[v].z - point.at.z});
        const geometry::Vector3 along = to - dot(to, n) * n;
        const double length = geometry::length(along), step = std::min(kInside * length, kInside / options_.density);
        if (length > 1e-9) point.at = point.ray_origin = surface::exponential(space, point.at, frame, (step / length) * along);
        reach = std::max(reach, step);
      }
      const auto [t, k] = corner[v];
      add_node(point, stand_in ? reach : 0, part.look[t]);
      if (!stand_in) continue;
      // It is a vertex of the surface, too, and has the light of that vertex.
      const light::SurfaceProjection foot = light::project_to_surface(
          s_.lighting, surface::shading_point(s_.room, part, normals, t, surface::inset_corner(k)), light::kVertexTolerance);
      if (const OnBlock on = map_.stood_for(foot.hit, part.look[t]); on.block >= 0) nodes_.back().stands_for = on;
    }
  }

  // In: of stand-ins, how far off their surface it may be.
  void add_node(const surface::ShadingPoint& point, double reach, std::uint16_t look) {
    Node& node = nodes_.emplace_back();
    node.at = point;
    if (reach == 0) return;
    const light::SurfaceProjection foot = light::project_to_surface(s_.lighting, point, reach);
    node.at = foot.point;
    node.stands_for = map_.stood_for(foot.hit, look);
  }

  void lend_to_stand_ins() {
    const std::vector<LightGrid> passed = grids();
    for (Node& node : nodes_)
      if (const OnBlock& on = node.stands_for; on.block >= 0)
        node.passed = light_at(passed[static_cast<std::size_t>(on.block)], on.u, on.v);
    spread_to_blind();
  }

  void add_block(const place::PlacedMesh& part, const surface::PartNormals& normals, const Block& block, std::size_t vertices,
                 bool stand_in) {
    Mesh mesh;
    mesh.w = points_on(block.length_u, options_.density), mesh.h = points_on(block.length_v, options_.density);
    if (block.second < 0) mesh.w = mesh.h = std::max(mesh.w, mesh.h);
    for (int j = 0; j < mesh.h; ++j)
      for (int i = 0; i < mesh.w; ++i) {
        const bool far_u = i == mesh.w - 1, far_v = j == mesh.h - 1;
        if (block.second < 0 && i + j > mesh.w - 1) {
          mesh.node.push_back(-1);
        } else if ((i == 0 || far_u) && (j == 0 || far_v)) {
          const std::size_t t = far_u && far_v ? static_cast<std::size_t>(block.second) : block.first;
          const int k = far_u && far_v ? block.second_turn[0] : block.turn[far_u ? 1 : far_v ? 2 : 0];
          mesh.node.push_back(static_cast<std::int32_t>(vertices + normals.corners[t][static_cast<std::size_t>(k)]));
        } else {
          const InTriangle at =
              within_block(block, static_cast<double>(i) / (mesh.w - 1), static_cast<double>(j) / (mesh.h - 1), surface::kInset);
          mesh.node.push_back(static_cast<std::int32_t>(nodes_.size()));
          add_node(surface::shading_point(s_.room, part, normals, at.triangle, at.b),
                   stand_in ? std::max(block.length_u, block.length_v) / 2 : 0, part.look[at.triangle]);
        }
      }
    meshes_.push_back(std::move(mesh));
  }

  // Sends a node's directions out; its links start at node.first of `links`.
  void ask(Node& node, std::size_t id, std::vector<Link>& links) const {
    const light::Guide guide = light::guide_at(s_.lighting, node.at);
    node.first = links.size();
    surface::Random random(id);
    Asked asked;
    for (int k = 0; k < options_.samples; k += kStream)
      ask_some(guide, k, std::min(k + kStream, options_.samples), random, node, links, asked);
    node.count = links.size() - node.first;
    node.blind = 2 * asked.inside > asked.all;
  }

  struct Asked {
    int all = 0, inside = 0;  ///< directions; those that end on the inside of things
  };

  void ask_some(const light::Guide& guide, int from, int to, surface::Random& random, Node& node, std::vector<Link>& links,
                Asked& asked) const {
    const light::LightingContext& lighting = s_.lighting;
    std::vector<trace::Ray> rays;
    std::vector<double> weights;
    std::vector<bool> linked;
    for (int k = from; k < to; ++k) {
      const light::DirectionSample chosen = light::sample_direction(guide, surface::r3_point(k));
      if (chosen.weight <= 0) continue;
      rays.push_back(light::spawn_ray(lighting, node.at, chosen.direction));
      weights.push_back(chosen.weight / options_.samples);
      linked.push_back(k % linked_ == 0);
    }
    std::vector<trace::Path> paths = trace::follow(lighting.scene, rays, light::path_follow_options(lighting));
    asked.all += static_cast<int>(paths.size());
    const double carry = static_cast<double>(options_.samples) / ((options_.samples + linked_ - 1) / linked_);
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const light::LightPath start{{}, {weights[k], weights[k], weights[k]}, {}};
      const light::LightPath path = light::extend_path(s_.room, lighting, start, std::move(paths[k]), random);
      node.given = node.given + path.radiance;
      if (!path.end) continue;
      asked.inside += !path.end->point.outside;
      const OnBlock place = map_.find(path.end->point, path.end->hit);
      const Color weight = path.throughput * surface::hit_albedo(s_.room, path.end->point);
      Color shown = lighting.ambient;
      if (place.block >= 0)
        shown = shown + (1 / std::numbers::pi) * light_at(s_.direct[static_cast<std::size_t>(place.block)], place.u, place.v);
      node.given = node.given + weight * shown;
      if (place.block < 0 || !linked[k]) continue;
      links.push_back(
          {place, {static_cast<float>(carry * weight.r), static_cast<float>(carry * weight.g), static_cast<float>(carry * weight.b)}});
    }
  }

  Color carried(const Node& node, const std::vector<LightGrid>& passed) const {
    Color sum = node.given;
    for (std::size_t k = node.first; k < node.first + node.count; ++k) {
      const Link& link = links_[k];
      const Color c = light_at(passed[static_cast<std::size_t>(link.to.block)], link.to.u, link.to.v);
      sum = sum + Color{link.weight[0] * c.r, link.weight[1] * c.g, link.weight[2] * c.b};
    }
    return sum;
  }

  // From their neighbours on the grids of blocks that see the room, ring by ring.
  void spread_to_blind() {
    std::vector<std::uint8_t> blind(nodes_.size());
    bool any = false;
    for (std::size_t i = 0; i < nodes_.size(); ++i) blind[i] = nodes_[i].blind, any = any || nodes_[i].blind;
    for (int ring = 0; ring < 256 && any; ++ring) {
      std::vector<Color> sum(nodes_.size());
      std::vector<int> count(nodes_.size(), 0);
      for (const Mesh& mesh : meshes_) {
        const auto tell = [&](std::int32_t from, std::int32_t to) {
          if (from < 0 || to < 0 || blind[static_cast<std::size_t>(from)] || !blind[static_cast<std::size_t>(to)]) return;
          sum[static_cast<std::size_t>(to)] = sum[static_cast<std::size_t>(to)] + nodes_[static_cast<std::size_t>(from)].passed;
          ++count[static_cast<std::size_t>(to)];
        };
        for (std::size_t k = 0; k < mesh.node.size(); ++k) {
          const auto w = static_cast<std::size_t>(mesh.w);
          if ((k + 1) % w != 0) tell(mesh.node[k], mesh.node[k + 1]), tell(mesh.node[k + 1], mesh.node[k]);
          if (k + w < mesh.node.size()) tell(mesh.node[k], mesh.node[k + w]), tell(mesh.node[k + w], mesh.node[k]);
        }
      }
      any = false;
      bool moved = false;
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (!blind[i]) continue;
        if (count[i] == 0) {
          any = true;
          continue;
        }
        nodes_[i].passed = (1.0 / count[i]) * sum[i];
        blind[i] = 0, moved = true;
      }
      if (!moved) break;
    }
  }

  const LitSurfaces& s_;
  const PassOptions& options_;
  SurfaceMap map_;
  std::vector<Node> nodes_;
  std::vector<Mesh> meshes_;  ///< per block
  std::vector<Link> links_;
  int linked_ = kLinked;  ///< of so many directions one is linked
};

}  // namespace

std::vector<LightGrid> pass_on(const LitSurfaces& surfaces, const PassOptions& options, const Executor& executor,
                               const Progress& progress) {
  Net net(surfaces, options);
  net.gather(executor, progress);
  net.settle(executor);
  return net.grids();
}

}  // namespace orbc::bake
