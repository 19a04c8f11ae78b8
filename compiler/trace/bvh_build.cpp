// Builds the trees: binned SAH (Wald, On fast construction of SAH-based bounding volume hierarchies, 2007) whose cost counts blocks of
// eight triangles, not triangles; of a node's open ranges the one with the largest area is split until there are eight. The top is split on
// the calling thread with parallel binning; what is below 1/64 of it becomes a task, written by index, so the tree is the same for any
// threads.
#include <algorithm>
#include <cmath>
#include <limits>

#include "compiler/base/elementary.h"
#include "compiler/trace/bvh.h"

namespace orbc::trace {
namespace {

struct Box {
  float lo[3] = {kNever, kNever, kNever}, hi[3] = {-kNever, -kNever, -kNever};
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

struct Prim {
  Box box;
  std::uint32_t triangle = 0;
  float centre(int axis) const { return box.lo[axis] + box.hi[axis]; }
};

struct Range {
  std::size_t begin = 0, end = 0;
  Box box, centres;                 ///< of the boxes, and of their centres (doubled)
  std::size_t size() const { return end - begin; }
};

// Outwards, and never to a subnormal number: the floor's plane z = 0 would become one, and each node test would wait a hundred cycles for
// it.
constexpr float kLeast = 1e-30f;
float down(double v) {
  const float f = std::nextafter(static_cast<float>(v), -kNever);
  return std::fabs(f) < kLeast ? -kLeast : f;
}
float up(double v) {
  const float f = std::nextafter(static_cast<float>(v), kNever);
  return std::fabs(f) < kLeast ? kLeast : f;
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
  int of(const Prim& p, int axis) const {
    return std::min(kBins - 1, std::max(0, static_cast<int>((p.centre(axis) - base[axis]) * scale[axis])));
  }
};

void fill(const std::vector<Prim>& prims, std::size_t begin, std::size_t end, const Binning& binning, Bins bins[3]) {
  for (std::size_t i = begin; i < end; ++i) {
    const Prim& p = prims[i];
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
    Box box[kBins], centres[kBins];  // of bins [b, end)
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

Range bounded(const std::vector<Prim>& prims, std::size_t begin, std::size_t end) {
  Range range{begin, end, {}, {}};
  for (std::size_t i = begin; i < end; ++i) {
    range.box.add(prims[i].box);
    Box c;
    for (int a = 0; a < 3; ++a) c.lo[a] = c.hi[a] = prims[i].centre(a);
    range.centres.add(c);
  }
  return range;
}

/// Splits a range of more than eight; when all centres coincide, or in_half, in the middle.
Split split(std::vector<Prim>& prims, const Range& range, bool in_half, const Executor* execute) {
  const Binning binning(range.centres);
  Bins bins[3];
  constexpr std::size_t kChunk = 1 << 15;
  if (execute && range.size() > 2 * kChunk) {
    const std::size_t chunks = (range.size() + kChunk - 1) / kChunk;
    std::vector<std::array<Bins, 3>> partial(chunks);
    (*execute)(chunks, [&](std::size_t i) {
      const std::size_t begin = range.begin + i * kChunk;
      fill(prims, begin, std::min(range.end, begin + kChunk), binning, partial[i].data());
    });
    for (const auto& p : partial) merge(bins, p.data());
  } else {
    fill(prims, range.begin, range.end, binning, bins);
  }
  Split best = best_split(range, bins);
  if (best.axis < 0 || in_half) {
    const std::size_t middle = range.begin + range.size() / 2;
    best.left = bounded(prims, range.begin, middle);
    best.right = bounded(prims, middle, range.end);
    return best;
  }
  std::partition(prims.begin() + static_cast<std::ptrdiff_t>(range.begin), prims.begin() + static_cast<std::ptrdiff_t>(range.end),
                 [&](const Prim& p) { return binning.of(p, best.axis) < best.bin; });
  return best;
}

struct Tree {
  std::vector<Node8> nodes;
  std::vector<Block8> blocks;
};

struct Builder {
  const Soup& soup;
  const Chart& chart;
  std::vector<Prim>& prims;

  Block8 pack(const Range& range) const {
    Block8 block;
    for (int lane = 0; lane < 8; ++lane) {
      const bool used = static_cast<std::size_t>(lane) < range.size();
      geometry::Vector3 at[3];
      block.triangle[lane] = used ? prims[range.begin + static_cast<std::size_t>(lane)].triangle : kNone;
      for (int i = 0; i < 3; ++i) {
        geometry::Ambient x{1, 1e6 * (1 + chart.extent), 1e6 * (1 + chart.extent)};  // an unused lane: one point, far from every ray
        double z = 0;
        if (used) {
          const Vertex& v = soup.vertices[soup.triangles[block.triangle[lane]][i]];
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
      block.size[lane] = used ? std::max(up(size), 1e-9f) : 1.0f;  // larger is safe; products with none would be subnormal
    }
    return block;
  }

  /// Splits until there are eight ranges, the largest area first.
  std::vector<Range> eight(const Range& range, int level, const Executor* execute) const {
    std::vector<Range> open{range};
    while (open.size() < 8) {
      int widest = -1;
      for (int i = 0; i < static_cast<int>(open.size()); ++i)
        if (open[i].size() > 8 && (widest < 0 || open[i].box.half_area() > open[widest].box.half_area())) widest = i;
      if (widest < 0) break;
      const Split s = split(prims, open[widest], level > kDeepest / 2, execute);
      open[widest] = s.left;
      open.push_back(s.right);
    }
    return open;
  }

  static Node8 node_over(const std::vector<Range>& ranges) {
    Node8 node;
    for (int lane = 0; lane < 8; ++lane) {
      const Box box = lane < static_cast<int>(ranges.size()) ? ranges[lane].box : Box{};
      for (int a = 0; a < 3; ++a) {
        node.bounds[a][0][lane] = box.lo[a];
        node.bounds[a][1][lane] = box.hi[a];
      }
      node.child[lane] = kBlock;
    }
    return node;
  }

  /// Depth first: a node is followed by the subtrees of its children.
  std::uint32_t build(const Range& range, int level, Tree& tree) const {
    const std::vector<Range> ranges = eight(range, level, nullptr);
    const auto self = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.push_back(node_over(ranges));
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      std::uint32_t child;
      if (ranges[i].size() <= 8) {
        child = kBlock | static_cast<std::uint32_t>(tree.blocks.size());
        tree.blocks.push_back(pack(ranges[i]));
      } else {
        child = build(ranges[i], level + 1, tree);
      }
      tree.nodes[self].child[i] = child;
    }
    return self;
  }

  /// The top: ranges that are small enough become tasks, to be linked in later.
  struct Task {
    Range range;
    std::uint32_t node, lane;
    int level;
  };
  void build_top(const Range& range, int level, std::size_t small, const Executor& execute, Tree& top, std::vector<Task>& tasks) const {
    const std::vector<Range> ranges = eight(range, level, &execute);
    const auto self = static_cast<std::uint32_t>(top.nodes.size());
    top.nodes.push_back(node_over(ranges));
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

/// Appends a subtree, its indices moved to where it comes to lie.
std::uint32_t append(Chart& chart, const Tree& tree) {
  const auto node = static_cast<std::uint32_t>(chart.nodes.size()), block = static_cast<std::uint32_t>(chart.blocks.size());
  for (Node8 n : tree.nodes) {
    for (std::uint32_t& child : n.child) child += child & kBlock ? block : node;
    chart.nodes.push_back(n);
  }
  chart.blocks.insert(chart.blocks.end(), tree.blocks.begin(), tree.blocks.end());
  return tree.nodes.empty() ? kBlock | block : node;
}

Prim prim_of(const Soup& soup, const Chart& chart, std::uint32_t triangle) {
  Prim prim;
  prim.triangle = triangle;
  for (const std::uint32_t i : soup.triangles[triangle]) {
    const Vertex& v = soup.vertices[i];
    const geometry::Ambient x = chart.chart_from_room * geometry::Ambient{v.w, v.x, v.y};
    const double at[3] = {x.x / x.w, x.y / x.w, v.z};
    for (int a = 0; a < 3; ++a) {
      prim.box.lo[a] = std::min(prim.box.lo[a], down(at[a]));
      prim.box.hi[a] = std::max(prim.box.hi[a], up(at[a]));
    }
  }
  return prim;
}

}  // namespace

void build_tree(const Soup& soup, const std::vector<std::uint32_t>& triangles, const Executor& execute, Chart& chart) {
  std::vector<Prim> prims(triangles.size());
  constexpr std::size_t kChunk = 1 << 14;
  execute((triangles.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(triangles.size(), (chunk + 1) * kChunk); ++i)
      prims[i] = prim_of(soup, chart, triangles[i]);
  });
  const Builder builder{soup, chart, prims};
  Tree top;
  std::vector<Builder::Task> tasks;
  const std::size_t small = std::max<std::size_t>(1024, triangles.size() / 64);
  builder.build_top(bounded(prims, 0, prims.size()), 0, small, execute, top, tasks);
  std::vector<Tree> trees(tasks.size());
  execute(tasks.size(), [&](std::size_t i) {
    if (tasks[i].range.size() <= 8)
      trees[i].blocks.push_back(builder.pack(tasks[i].range));
    else
      builder.build(tasks[i].range, tasks[i].level, trees[i]);
  });
  std::size_t nodes = top.nodes.size(), blocks = 0;
  for (const Tree& tree : trees) nodes += tree.nodes.size(), blocks += tree.blocks.size();
  chart.nodes.reserve(nodes);
  chart.blocks.reserve(blocks);
  chart.nodes.assign(top.nodes.begin(), top.nodes.end());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const std::uint32_t child = append(chart, trees[i]);
    chart.nodes[tasks[i].node].child[tasks[i].lane] = child;
    trees[i] = {};
  }
}

Bvh::Bvh(geometry::Space space, Soup soup, const Executor& execute) : space_(space), soup_(std::move(soup)) {
  for (const Vertex& v : soup_.vertices) height_ = std::max(height_, std::fabs(v.z));
  ChartPlans plans = plan_charts(space, soup_);
  large_ = std::move(plans.large);
  for (const ChartPlan& plan : plans.charts) {
    charts_.push_back(make_chart(space, plan, soup_));
    build_tree(soup_, plan.triangles, execute, charts_.back());
  }
}

std::size_t Bvh::bytes() const {
  std::size_t sum = soup_.vertices.size() * sizeof(Vertex) + soup_.triangles.size() * sizeof(soup_.triangles[0]);
  for (const Chart& chart : charts_) sum += chart.nodes.size() * sizeof(Node8) + chart.blocks.size() * sizeof(Block8);
  return sum;
}

}  // namespace orbc::trace
