// Builds the trees with a binned SAH (Wald, On fast construction of SAH-based bounding volume hierarchies, 2007) whose cost counts blocks
// of eight triangles, not triangles. A node's range with the largest area is split until there are eight ranges. The top of the tree is
// split on the calling thread with parallel binning. Ranges below 1/64 of all triangles become tasks whose results are stored by index, so
// that the tree is the same for any number of threads.
#include <algorithm>
#include <cmath>
#include <limits>

#include "compiler/base/elementary.h"
#include "compiler/trace/bvh/bvh.h"

namespace orbc::trace {
namespace {

struct Box {
  float lo[3] = {kEmptyBound, kEmptyBound, kEmptyBound}, hi[3] = {-kEmptyBound, -kEmptyBound, -kEmptyBound};
  void add(const Box& b) {
    for (int i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], b.lo[i]);
      hi[i] = std::max(hi[i], b.hi[i]);
    }
  }
  float half_area() const {
    const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
  }
};

struct Primitive {
  Box box;
  std::uint32_t triangle = 0;
  float centre(int axis) const { return box.lo[axis] + box.hi[axis]; }
};

struct Range {
  std::size_t begin = 0, end = 0;
  Box box, centres;  ///< bounds of the triangles' boxes, and of the boxes' doubled centres
  std::size_t size() const { return end - begin; }
};

// Outwards rounding that never gives a subnormal number. The floor's plane z = 0 would become one, and each node test would take a hundred
// cycles longer.
constexpr float kMinPlaneMagnitude = 1e-30f;
float round_down(double v) {
  const float f = std::nextafter(static_cast<float>(v), -kEmptyBound);
  return std::fabs(f) < kMinPlaneMagnitude ? -kMinPlaneMagnitude : f;
}
float round_up(double v) {
  const float f = std::nextafter(static_cast<float>(v), kEmptyBound);
  return std::fabs(f) < kMinPlaneMagnitude ? kMinPlaneMagnitude : f;
}

constexpr int kBins = 16;

float blocks_of(std::size_t n) { return static_cast<float>((n + 7) / 8); }

struct Bins {
  Box box[kBins], centres[kBins];
  std::size_t count[kBins] = {};
};

struct Binning {
  float base[3], scale[3];
  explicit Binning(const Box& centres) {
    for (int a = 0; a < 3; ++a) {
      const float width = centres.hi[a] - centres.lo[a];
      base[a] = centres.lo[a];
      scale[a] = width > 0 ? 0.9999f * kBins / width : 0;
    }
  }
  int of(const Primitive& p, int axis) const {
    return std::min(kBins - 1, std::max(0, static_cast<int>((p.centre(axis) - base[axis]) * scale[axis])));
  }
};

void fill_bins(const std::vector<Primitive>& prims, std::size_t begin, std::size_t end, const Binning& binning, Bins bins[3]) {
  for (std::size_t i = begin; i < end; ++i) {
    const Primitive& p = prims[i];
    Box c;
    for (int a = 0; a < 3; ++a) c.lo[a] = c.hi[a] = p.centre(a);
    for (int a = 0; a < 3; ++a) {
      const int b = binning.of(p, a);
      bins[a].box[b].add(p.box);
      bins[a].centres[b].add(c);
      ++bins[a].count[b];
    }
  }
}

void merge(Bins into[3], const Bins from[3]) {
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < kBins; ++b) {
      into[a].box[b].add(from[a].box[b]);
      into[a].centres[b].add(from[a].centres[b]);
      into[a].count[b] += from[a].count[b];
    }
}

struct Split {
  int axis = -1, bin = 0;
  Range left, right;
};

Split best_split(const Range& range, const Bins bins[3]) {
  Split best;
  float best_cost = std::numeric_limits<float>::infinity();
  for (int a = 0; a < 3; ++a) {
    Box box[kBins], centres[kBins];  // of the bins from b on
    std::size_t count[kBins];
    box[kBins - 1] = bins[a].box[kBins - 1];
    centres[kBins - 1] = bins[a].centres[kBins - 1];
    count[kBins - 1] = bins[a].count[kBins - 1];
    for (int b = kBins - 2; b > 0; --b) {
      box[b] = box[b + 1];
      box[b].add(bins[a].box[b]);
      centres[b] = centres[b + 1];
      centres[b].add(bins[a].centres[b]);
      count[b] = count[b + 1] + bins[a].count[b];
    }
    Box left, left_centres;
    std::size_t n = 0;
    for (int b = 1; b < kBins; ++b) {
      left.add(bins[a].box[b - 1]);
      left_centres.add(bins[a].centres[b - 1]);
      n += bins[a].count[b - 1];
      if (n == 0 || count[b] == 0) continue;
      const float cost = left.half_area() * blocks_of(n) + box[b].half_area() * blocks_of(count[b]);
      if (cost < best_cost) {
        best_cost = cost;
        best.axis = a;
        best.bin = b;
        best.left = {range.begin, range.begin + n, left, left_centres};
        best.right = {range.begin + n, range.end, box[b], centres[b]};
      }
    }
  }
  return best;
}

Range range_over(const std::vector<Primitive>& prims, std::size_t begin, std::size_t end) {
  Range range{begin, end, {}, {}};
  for (std::size_t i = begin; i < end; ++i) {
    range.box.add(prims[i].box);
    Box c;
    for (int a = 0; a < 3; ++a) c.lo[a] = c.hi[a] = prims[i].centre(a);
    range.centres.add(c);
  }
  return range;
}

/// Splits a range of more than eight triangles; at the median if all centres coincide or if `at_median`.
Split split(std::vector<Primitive>& prims, const Range& range, bool at_median, const Executor* execute) {
  const Binning binning(range.centres);
  Bins bins[3];
  constexpr std::size_t kChunk = 1 << 15;
  if (execute && range.size() > 2 * kChunk) {
    const std::size_t chunks = (range.size() + kChunk - 1) / kChunk;
    std::vector<std::array<Bins, 3>> partial(chunks);
    (*execute)(chunks, [&](std::size_t i) {
      const std::size_t begin = range.begin + i * kChunk;
      fill_bins(prims, begin, std::min(range.end, begin + kChunk), binning, partial[i].data());
    });
    for (const auto& p : partial) merge(bins, p.data());
  } else {
    fill_bins(prims, range.begin, range.end, binning, bins);
  }
  Split best = best_split(range, bins);
  if (best.axis < 0 || at_median) {
    const std::size_t middle = range.begin + range.size() / 2;
    best.left = range_over(prims, range.begin, middle);
    best.right = range_over(prims, middle, range.end);
    return best;
  }
  std::partition(prims.begin() + static_cast<std::ptrdiff_t>(range.begin), prims.begin() + static_cast<std::ptrdiff_t>(range.end),
                 [&](const Primitive& p) { return binning.of(p, best.axis) < best.bin; });
  return best;
}

struct Tree {
  std::vector<Node8> nodes;
  std::vector<Block8> blocks;
};

struct Builder {
  const SceneTriangles& scene;
  const ChartTree& chart;
  std::vector<Primitive>& prims;

  Block8 pack(const Range& range) const {
    Block8 block;
    for (int lane = 0; lane < 8; ++lane) {
      const bool used = static_cast<std::size_t>(lane) < range.size();
      geometry::Vector3 at[3];
      block.triangle[lane] = used ? prims[range.begin + static_cast<std::size_t>(lane)].triangle : kNoTriangle;
      for (int i = 0; i < 3; ++i) {
        geometry::Ambient x{1, 1e6 * (1 + chart.extent), 1e6 * (1 + chart.extent)};  // an unused lane is a point far from every ray
        double z = 0;
        if (used) {
          const Vertex& v = scene.vertices[scene.corners[block.triangle[lane]][i]];
          x = chart.chart_from_room * geometry::Ambient{v.w, v.x, v.y};
          z = v.z;
        }
        block.x[i][lane] = static_cast<float>(x.x / x.w);
        block.y[i][lane] = static_cast<float>(x.y / x.w);
        block.z_by_w[i][lane] = static_cast<float>(z / x.w);
        block.by_w[i][lane] = static_cast<float>(1 / x.w);
        at[i] = {x.x / x.w, x.y / x.w, z};
      }
      double size = 0;
      for (int i = 0; i < 3; ++i) {
        const geometry::Vector3 edge = at[i] - at[(i + 1) % 3];
        size = std::max({size, math::hypot(edge.x, edge.y), std::fabs(edge.z)});
      }
      block.size[lane] = used ? std::max(round_up(size), 1e-9f) : 1.0f;  // larger is safe; products with 0 would be subnormal
    }
    return block;
  }

  /// Splits a range until there are eight ranges, the one with the largest area first.
  std::vector<Range> split_to_eight(const Range& range, int level, const Executor* execute) const {
    std::vector<Range> open{range};
    while (open.size() < 8) {
      int widest = -1;
      for (int i = 0; i < static_cast<int>(open.size()); ++i)
        if (open[i].size() > 8 && (widest < 0 || open[i].box.half_area() > open[widest].box.half_area())) widest = i;
      if (widest < 0) break;
      const Split s = split(prims, open[widest], level > kMaxTreeDepth / 2, execute);
      open[widest] = s.left;
      open.push_back(s.right);
    }
    return open;
  }

  static Node8 make_node(const std::vector<Range>& ranges) {
    Node8 node;
    for (int lane = 0; lane < 8; ++lane) {
      const Box box = lane < static_cast<int>(ranges.size()) ? ranges[lane].box : Box{};
      for (int a = 0; a < 3; ++a) {
        node.bounds[a][0][lane] = box.lo[a];
        node.bounds[a][1][lane] = box.hi[a];
      }
      node.child[lane] = kBlockFlag;
    }
    return node;
  }

  /// Builds a subtree, stored depth first: a node is followed by the subtrees of its children. Makes: the index of its root.
  std::uint32_t build(const Range& range, int level, Tree& tree) const {
    const std::vector<Range> ranges = split_to_eight(range, level, nullptr);
    const auto self = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.push_back(make_node(ranges));
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      std::uint32_t child;
      if (ranges[i].size() <= 8) {
        child = kBlockFlag | static_cast<std::uint32_t>(tree.blocks.size());
        tree.blocks.push_back(pack(ranges[i]));
      } else {
        child = build(ranges[i], level + 1, tree);
      }
      tree.nodes[self].child[i] = child;
    }
    return self;
  }

  /// A subtree that is built later and linked into `lane` of the node `node`.
  struct Task {
    Range range;
    std::uint32_t node, lane;
    int level;
  };
  /// Builds the top of a tree; ranges of at most `small` triangles become tasks.
  void build_top(const Range& range, int level, std::size_t small, const Executor& execute, Tree& top, std::vector<Task>& tasks) const {
    const std::vector<Range> ranges = split_to_eight(range, level, &execute);
    const auto self = static_cast<std::uint32_t>(top.nodes.size());
    top.nodes.push_back(make_node(ranges));
    for (std::uint32_t i = 0; i < ranges.size(); ++i) {
      if (ranges[i].size() <= small) {
        tasks.push_back({ranges[i], self, i, level + 1});
        continue;
      }
      top.nodes[self].child[i] = static_cast<std::uint32_t>(top.nodes.size());
      build_top(ranges[i], level + 1, small, execute, top, tasks);
    }
  }
};

/// Appends a subtree with its indices shifted. Makes: the child index of its root.
std::uint32_t append(ChartTree& chart, const Tree& tree) {
  const auto node = static_cast<std::uint32_t>(chart.nodes.size()), block = static_cast<std::uint32_t>(chart.blocks.size());
  for (Node8 n : tree.nodes) {
    for (std::uint32_t& child : n.child) child += child & kBlockFlag ? block : node;
    chart.nodes.push_back(n);
  }
  chart.blocks.insert(chart.blocks.end(), tree.blocks.begin(), tree.blocks.end());
  return tree.nodes.empty() ? kBlockFlag | block : node;
}

Primitive make_primitive(const SceneTriangles& scene, const ChartTree& chart, std::uint32_t triangle) {
  Primitive prim;
  prim.triangle = triangle;
  for (const std::uint32_t i : scene.corners[triangle]) {
    const Vertex& v = scene.vertices[i];
    const geometry::Ambient x = chart.chart_from_room * geometry::Ambient{v.w, v.x, v.y};
    const double at[3] = {x.x / x.w, x.y / x.w, v.z};
    for (int a = 0; a < 3; ++a) {
      prim.box.lo[a] = std::min(prim.box.lo[a], round_down(at[a]));
      prim.box.hi[a] = std::max(prim.box.hi[a], round_up(at[a]));
    }
  }
  return prim;
}

}  // namespace

void build_tree(const SceneTriangles& scene, const std::vector<std::uint32_t>& triangles, const Executor& execute, ChartTree& chart) {
  std::vector<Primitive> prims(triangles.size());
  constexpr std::size_t kChunk = 1 << 14;
  execute((triangles.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(triangles.size(), (chunk + 1) * kChunk); ++i)
      prims[i] = make_primitive(scene, chart, triangles[i]);
  });
  const Builder builder{scene, chart, prims};
  Tree top;
  std::vector<Builder::Task> tasks;
  const std::size_t small = std::max<std::size_t>(1024, triangles.size() / 64);
  builder.build_top(range_over(prims, 0, prims.size()), 0, small, execute, top, tasks);
  std::vector<Tree> trees(tasks.size());
  execute(tasks.size(), [&](std::size_t i) {
    if (tasks[i].range.size() <= 8) trees[i].blocks.push_back(builder.pack(tasks[i].range));
    else builder.build(tasks[i].range, tasks[i].level, trees[i]);
  });
  std::size_t nodes = top.nodes.size(), blocks = 0;
  for (const Tree& tree : trees) {
    nodes += tree.nodes.size();
    blocks += tree.blocks.size();
  }
  chart.nodes.reserve(nodes);
  chart.blocks.reserve(blocks);
  chart.nodes.assign(top.nodes.begin(), top.nodes.end());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const std::uint32_t child = append(chart, trees[i]);
    chart.nodes[tasks[i].node].child[tasks[i].lane] = child;
    trees[i] = {};
  }
}

Bvh::Bvh(geometry::Space space, SceneTriangles scene, const Executor& execute) : space_(space), triangles_(std::move(scene)) {
  for (const Vertex& v : triangles_.vertices) height_ = std::max(height_, std::fabs(v.z));
  ChartClusters clusters = cluster_into_charts(space, triangles_);
  uncharted_ = std::move(clusters.uncharted);
  for (const ChartCluster& cluster : clusters.charts) {
    charts_.push_back(make_chart(space, cluster, triangles_));
    build_tree(triangles_, cluster.triangles, execute, charts_.back());
  }
}

std::size_t Bvh::bytes() const {
  std::size_t sum = triangles_.vertices.size() * sizeof(Vertex) + triangles_.corners.size() * sizeof(triangles_.corners[0]);
  for (const ChartTree& chart : charts_) sum += chart.nodes.size() * sizeof(Node8) + chart.blocks.size() * sizeof(Block8);
  return sum;
}

}  // namespace orbc::trace
