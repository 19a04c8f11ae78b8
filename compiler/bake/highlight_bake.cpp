// Highlights move with the eye, so every copy has its own; but they are small. A block of a copy is asked at its corners and on a grid of a
// few pixels; where nothing shines it stays the shared one. Elsewhere it gets texels of its own, about one for each pixel that it takes in
// the picture, thinned out again where they are even.
#include "compiler/bake/highlight_bake.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "compiler/bake/block_texels.h"
#include "compiler/bake/eye_image.h"
#include "compiler/bake/highlight_pack.h"
#include "compiler/bake/shiny_parts.h"
#include "compiler/base/elementary.h"
#include "compiler/image/srgb.h"
#include "compiler/light/connection.h"
#include "compiler/place/texel.h"
#include "compiler/surface/ggx.h"

namespace orbc::bake {
namespace {

using geometry::Position;
using geometry::Space;
using place::PlacedMesh;
using scene::Color;
using trace::Direction;

constexpr int kMaxHighlightLevel = 10;   // of a block: 1025 texels a side
constexpr double kMaxHighlightStep = 3;  // steps of 1/255 between neighbouring points that ask for a point between them
constexpr double kGraze = 0.02;          // cosine: nothing is seen more from the side
constexpr double kRough = 0.05;          // α: what metals as rough as that show is seen at single points as by many ways as in means
constexpr std::size_t kBatch = 16;       // copies between two looks at the bound

struct BakedHighlightBlock {
  std::size_t block = 0;
  Box box;
  std::vector<Color> shown;         ///< encoded 0…1
  std::vector<std::uint8_t> holes;  ///< per texel, of looks that have some
};

struct Job {
  const place::PlacedRoom& room;
  const light::LightingContext& lighting;
  const HighlightOptions& options;
  const Baked& baked;
  const surface::PartNormals& normals;
  std::size_t part;
  const cover::Copy& copy;
  const place::Eye& camera;
  EyeImage eye;
  Color weight;  ///< of the copy: what is faint needs no detail
  double per_radian, beside;
  const Progress& progress;
};

/// The highlights of a part in one copy.
class PartShine {
 public:
  explicit PartShine(const Job& job)
      : job_(job), mesh_(job.room.parts[job.part]), normals_(job.normals), blocks_(job.baked.blocks[job.part]) {}

  std::vector<BakedHighlightBlock> run() {
    std::vector<BakedHighlightBlock> done;
    known_.assign(normals_.vertices.size(), -1);
    at_vertex_.resize(normals_.vertices.size());
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      stop_if_cancelled(job_.progress);
      const place::Look& look = job_.room.looks[mesh_.look[blocks_[i].first]];
      whole_ = job_.options.seen_in && shows_room(look.material, job_.lighting.lit);
      if (!whole_ && !shines(look.material)) continue;
      holes_ = place::has_holes(look);
      if (auto finished = bake_block(i, look)) done.push_back(std::move(*finished));
    }
    return done;
  }

 private:
  struct Grid {
    int w = 2, h = 2;
    std::vector<Color> light;  ///< highlights, linear, times the exposure
    std::vector<std::uint8_t> rough;
    [[nodiscard]] std::size_t index(int i, int j) const {
      return static_cast<std::size_t>(j) * static_cast<std::size_t>(w) + static_cast<std::size_t>(i);
    }
  };

  Color shine(const surface::ShadingPoint& point, const scene::Material& material, const light::SampleStratum& stratum = {}) {
    const light::Connection sight = connect(job_.eye, point.at);
    if (!sight.valid) return {};
    if (whole_) return job_.options.seen_in(point.at, turned_out(point, sight.direction), job_.copy, job_.beside, stratum);
    return job_.lighting.exposure * light::highlight(job_.lighting, point, sight.direction, material, {1, 1, 1});
  }
  // A metal's lobe is seen by many ways. What shows detail in it is asked again by `soften`, all ways between its points: so that a part of
  // them is enough here, the second, in the middle between the sharpest and the widest.
  [[nodiscard]] light::SampleStratum at_single_points(const scene::Material& material) const {
    const int parts = job_.options.rays_per_texel * job_.options.rays_per_texel;
    if (parts < 2 || material.kind != scene::MaterialKind::metal || surface::ggx_alpha(material) >= kRough) return {};
    return {1, parts};
  }
  /// Where a block turns away from the eye there is nothing to be seen; what is asked there shall continue what is seen at the outline.
  [[nodiscard]] Direction turned_out(const surface::ShadingPoint& point, Direction to_eye) const {
    for (const Direction& n : {point.normal, point.geometric_normal})
      if (const double facing = trace::inner(job_.eye.space, to_eye, n); facing < kGraze) to_eye = to_eye + (kGraze - facing) * n;
    return (1 / std::sqrt(trace::inner(job_.eye.space, to_eye, to_eye))) * to_eye;
  }
  /// Of a colour in the copy's weight, as the picture encodes it.
  [[nodiscard]] std::array<double, 3> seen(const Color& c) const {
    const auto code = [](double v) { return 255 * image::encode_srgb(std::clamp(v, 0.0, 1.0)); };
    return {code(job_.weight.r * std::min(c.r, 1.0)), code(job_.weight.g * std::min(c.g, 1.0)), code(job_.weight.b * std::min(c.b, 1.0))};
  }
  [[nodiscard]] double difference(const Color& a, const Color& b) const {
    if (a == b) return 0;
    const auto x = seen(a), y = seen(b);
    return std::max({std::fabs(x[0] - y[0]), std::fabs(x[1] - y[1]), std::fabs(x[2] - y[2])});
  }

  // Corners are shared by the blocks that meet there.
  Color corner(const Block& block, const place::Look& look, int far_u, int far_v) {
    const std::size_t t = far_u && far_v ? static_cast<std::size_t>(block.second) : block.first;
    const int k = far_u && far_v ? block.second_turn[0] : block.turn[static_cast<std::size_t>(far_u ? 1 : far_v ? 2 : 0)];
    const std::uint32_t v = normals_.corners[t][static_cast<std::size_t>(k)];
    const int number = mesh_.look[t];
    if (known_[v] == number) return at_vertex_[v];
    surface::ShadingPoint point = surface::shading_point(job_.room, mesh_, normals_, t, surface::inset_corner(static_cast<std::size_t>(k)));
    if (stand_in() && !whole_) point = light::project_to_surface(job_.lighting, point, light::kVertexTolerance).point;
    at_vertex_[v] = shine(point, look.material, at_single_points(look.material));
    known_[v] = number;
    return at_vertex_[v];
  }

  Color ask(const Block& block, const place::Look& look, const Grid& grid, int i, int j) {
    const bool end_u = i == 0 || i == grid.w - 1, end_v = j == 0 || j == grid.h - 1;
    if (end_u && end_v) return corner(block, look, i > 0, j > 0);
    const double u = static_cast<double>(i) / (grid.w - 1), v = static_cast<double>(j) / (grid.h - 1);
    const InTriangle at = within_block(block, u, v, surface::kInset);
    surface::ShadingPoint point = surface::shading_point(job_.room, mesh_, normals_, at.triangle, at.b);
    if (stand_in() && !whole_) point = light::project_to_surface(job_.lighting, point, std::max(block.length_u, block.length_v) / 2).point;
    return shine(point, look.material, at_single_points(look.material));
  }
  /// A coarser level: what shines is the part itself (seen_in puts its points there by itself).
  [[nodiscard]] bool stand_in() const { return job_.lighting.lit && job_.part >= job_.lighting.normals.size(); }

  static bool valid(const Block& block, const Grid& grid, int i, int j) { return on_block(block, i, j, grid.w, grid.h); }

  /// Pixels that the block's two sides take in the picture, at the corner where it is most; nothing when all of it turns away from the eye.
  /// Side by side, not by the larger one: near the antipode the picture is drawn out around the eye, but not in height.
  [[nodiscard]] std::optional<std::array<double, 2>> pixels_of(const Block& block) const {
    const auto corner_of = [&](int c) -> const surface::ShadingVertex& {
      const std::size_t t = c == 3 ? static_cast<std::size_t>(block.second) : block.first;
      const int k = c == 3 ? block.second_turn[0] : block.turn[static_cast<std::size_t>(c)];
      return normals_.vertices[normals_.corners[t][static_cast<std::size_t>(k)]];
    };
    const auto side = [&](int to) {
      const std::uint32_t a = corner_of(0).vertex, b = corner_of(to).vertex;
      return Direction{geometry::Ambient(mesh_.floor[b]) + -1.0 * geometry::Ambient(mesh_.floor[a]), mesh_.z[b] - mesh_.z[a]};
    };
    const Direction u = side(1), v = side(2);
    std::array<double, 2> most{};
    bool towards = false;
    std::vector<geometry::Vector3> directions;
    for (int c = 0; c < (block.second >= 0 ? 4 : 3); ++c) {
      const surface::ShadingVertex& corner = corner_of(c);
      const Position at{mesh_.floor[corner.vertex], mesh_.z[corner.vertex]};
      const light::Connection sight = connect(job_.eye, at);
      const auto seen = direction_from_eye(job_.copy, job_.camera, at);
      if (!sight.valid || !seen) continue;
      directions.push_back(*seen);
      towards = towards || trace::inner(job_.eye.space, sight.direction, corner.normal) > 0;
      most[0] = std::max(most[0], block.length_u * pixels_along(job_.eye, sight, at, u, job_.per_radian));
      most[1] = std::max(most[1], block.length_v * pixels_along(job_.eye, sight, at, v, job_.per_radian));
    }
    if (!towards) return std::nullopt;
    if (beside_picture(job_.camera, directions))
      for (double& pixels : most) pixels /= job_.options.coarser_beside;
    return most;
  }

  std::optional<BakedHighlightBlock> bake_block(std::size_t number, const place::Look& look) {
    const Block& block = blocks_[number];
    const auto pixels = pixels_of(block);
    if (!pixels) return std::nullopt;
    const BlockTexels base(job_.baked.atlas.image, job_.baked.boxes[job_.part][number], whole_);
    const auto level = [](double cells) {
      return std::clamp(static_cast<int>(std::ceil(math::log2(std::max(1.0, cells)) - 1e-9)), 0, kMaxHighlightLevel);
    };
    const int a = level((*pixels)[0] / job_.options.fine_px), b = level((*pixels)[1] / job_.options.fine_px);
    const int a0 = std::min(a, level((*pixels)[0] / job_.options.probe_px)), b0 = std::min(b, level((*pixels)[1] / job_.options.probe_px));
    Grid grid;
    grid.w = (1 << a) + 1, grid.h = (1 << b) + 1;
    int su = 1 << (a - a0), sv = 1 << (b - b0);
    // Most blocks end here, so the grid itself is not yet made.
    std::vector<Color> probes;
    bool any = whole_;
    for (int j = 0; j < grid.h; j += sv)
      for (int i = 0; i < grid.w; i += su) {
        probes.push_back(valid(block, grid, i, j) ? ask(block, look, grid, i, j) : Color{});
        if (probes.back() == Color{}) continue;
        const Color under = base.at(static_cast<double>(i) / (grid.w - 1), static_cast<double>(j) / (grid.h - 1));
        any = any || difference(under + probes.back(), under) > 0.5 * job_.options.tolerance;
      }
    if (!any) return std::nullopt;
    grid.light.resize(static_cast<std::size_t>(grid.w) * static_cast<std::size_t>(grid.h));
    grid.rough.assign(grid.light.size(), 0);
    std::size_t next = 0;
    for (int j = 0; j < grid.h; j += sv)
      for (int i = 0; i < grid.w; i += su) grid.light[grid.index(i, j)] = probes[next++];
    while (su > 1 || sv > 1) {
      const int nu = std::max(1, su / 2), nv = std::max(1, sv / 2);
      refine(block, look, grid, su, sv, nu, nv);
      su = nu, sv = nv;
    }
    if (whole_) soften(block, look, grid);
    return finish(number, block, grid, base);
  }

  // What is refracted or mirrored is often finer than texels. Where neighbours differ a texel shows the mean over its own size, as a pixel
  // does.
  void soften(const Block& block, const place::Look& look, Grid& grid) {
    const int side = job_.options.rays_per_texel;
    if (side < 2) return;
    const auto beside = [&](int i, int j, const Color& here) {
      return i >= 0 && j >= 0 && i < grid.w && j < grid.h && valid(block, grid, i, j) &&
             difference(grid.light[grid.index(i, j)], here) > kMaxHighlightStep;
    };
    std::vector<Color> soft = grid.light;
    for (int j = 0; j < grid.h; ++j)
      for (int i = 0; i < grid.w; ++i) {
        const Color& here = grid.light[grid.index(i, j)];
        if (!valid(block, grid, i, j)) continue;
        if (!beside(i - 1, j, here) && !beside(i + 1, j, here) && !beside(i, j - 1, here) && !beside(i, j + 1, here)) continue;
        Color sum;
        for (int k = 0; k < side * side; ++k) {
          double u = std::clamp((i - 0.5 + (k % side + 0.5) / side) / (grid.w - 1), 0.0, 1.0);
          double v = std::clamp((j - 0.5 + (k / side + 0.5) / side) / (grid.h - 1), 0.0, 1.0);
          if (block.second < 0 && u + v > 1) {  // a single triangle: back over its long side
            const double out = (u + v - 1) / 2;
            u = std::max(0.0, u - out), v = std::max(0.0, v - out);
          }
          const InTriangle at = in_triangle(block, u, v);
          sum = sum + shine(surface::shading_point(job_.room, mesh_, normals_, at.triangle, at.b), look.material, {k, side * side});
        }
        soft[grid.index(i, j)] = (1.0 / (side * side)) * sum;
      }
    grid.light = std::move(soft);
  }

  void refine(const Block& block, const place::Look& look, Grid& grid, int su, int sv, int nu, int nv) {
    std::vector<std::uint8_t> rough(grid.rough.size(), 0);
    for (int j = 0; j < grid.h; j += nv)
      for (int i = 0; i < grid.w; i += nu) {
        const bool odd_u = i % su != 0, odd_v = j % sv != 0;
        if ((!odd_u && !odd_v) || !valid(block, grid, i, j)) continue;
        const int i0 = i - i % su, i1 = odd_u ? i0 + su : i0, j0 = j - j % sv, j1 = odd_v ? j0 + sv : j0;
        std::array<std::size_t, 4> parents{grid.index(i0, j1), grid.index(i1, j0), grid.index(i0, j0), grid.index(i1, j1)};
        const std::size_t count = odd_u && odd_v && valid(block, grid, i1, j1) ? 4 : 2;
        if (!odd_u || !odd_v) parents[0] = grid.index(i0, j0), parents[1] = grid.index(i1, j1);
        Color mean;
        bool needed = false;
        for (std::size_t k = 0; k < count; ++k) {
          mean = mean + (1.0 / static_cast<double>(count)) * grid.light[parents[k]];
          needed = needed || grid.rough[parents[k]];
        }
        for (std::size_t k = 0; k + 1 < count && !needed; k += 2)
          needed = difference(grid.light[parents[k]], grid.light[parents[k + 1]]) > kMaxHighlightStep;
        Color& light = grid.light[grid.index(i, j)];
        light = mean;
        if (!needed) continue;
        light = ask(block, look, grid, i, j);
        if (difference(light, mean) <= job_.options.tolerance) continue;
        rough[grid.index(i, j)] = 1;
        for (std::size_t k = 0; k < count; ++k) rough[parents[k]] = 1;
      }
    grid.rough = std::move(rough);
  }

  // Diffuse light and highlight together, on as few texels as show them.
  std::optional<BakedHighlightBlock> finish(std::size_t number, const Block& block, const Grid& grid, const BlockTexels& base) const {
    int w = grid.w, h = grid.h;
    std::vector<Color> sum(grid.light.size());
    bool any = whole_;
    for (int j = 0; j < h; ++j)
      for (int i = 0; i < w; ++i) {
        if (!valid(block, grid, i, j)) continue;
        const Color under = base.at(static_cast<double>(i) / (w - 1), static_cast<double>(j) / (h - 1));
        const Color all = under + grid.light[grid.index(i, j)];
        any = any || difference(all, under) > job_.options.tolerance;
        sum[grid.index(i, j)] = {std::min(all.r, 1.0), std::min(all.g, 1.0), std::min(all.b, 1.0)};
      }
    if (!any) return std::nullopt;
    while (w > 2 && even(block, sum, w, h, true)) sum = thinned(sum, w, h, true), w = (w + 1) / 2;
    while (h > 2 && even(block, sum, w, h, false)) sum = thinned(sum, w, h, false), h = (h + 1) / 2;
    BakedHighlightBlock done;
    done.block = number;
    done.box.width = w, done.box.height = h;
    Grid shape;
    shape.w = w, shape.h = h;
    for (int j = 0; j < h; ++j)
      for (int i = 0; i < w; ++i) {
        Color& c = sum[shape.index(i, j)];
        if (!valid(block, shape, i, j)) {  // a single triangle beyond its long side
          c = sum[shape.index(i - 1, j)] + sum[shape.index(i, j - 1)] + -1.0 * sum[shape.index(i - 1, j - 1)];
          c = {std::clamp(c.r, 0.0, 1.0), std::clamp(c.g, 0.0, 1.0), std::clamp(c.b, 0.0, 1.0)};
        }
        done.shown.push_back({image::encode_srgb(c.r), image::encode_srgb(c.g), image::encode_srgb(c.b)});
        if (holes_) done.holes.push_back(in_hole(job_.room, block, static_cast<double>(i) / (w - 1), static_cast<double>(j) / (h - 1)));
      }
    return done;
  }

  // Whether every second column (or row) is the mean of its neighbours.
  bool even(const Block& block, const std::vector<Color>& sum, int w, int h, bool columns) const {
    Grid shape;
    shape.w = w, shape.h = h;
    for (int j = columns ? 0 : 1; j < h; j += columns ? 1 : 2)
      for (int i = columns ? 1 : 0; i < w; i += columns ? 2 : 1) {
        const int di = columns, dj = !columns;
        if (!valid(block, shape, i + di, j + dj)) {
          if (valid(block, shape, i, j)) return false;
          continue;
        }
        const Color mean = 0.5 * (sum[shape.index(i - di, j - dj)] + sum[shape.index(i + di, j + dj)]);
        if (difference(sum[shape.index(i, j)], mean) > 0.5 * job_.options.tolerance) return false;
      }
    return true;
  }
  static std::vector<Color> thinned(const std::vector<Color>& sum, int w, int h, bool columns) {
    std::vector<Color> few;
    for (int j = 0; j < h; j += columns ? 1 : 2)
      for (int i = 0; i < w; i += columns ? 2 : 1)
        few.push_back(sum[static_cast<std::size_t>(j) * static_cast<std::size_t>(w) + static_cast<std::size_t>(i)]);
    return few;
  }

  const Job& job_;
  const PlacedMesh& mesh_;
  const surface::PartNormals& normals_;
  const std::vector<Block>& blocks_;
  bool whole_ = false;  ///< the block's whole light depends on the eye: mirror, glass and metal
  bool holes_ = false;
  std::vector<int> known_;  ///< for which look
  std::vector<Color> at_vertex_;
};

/// A finished part of one copy on its way into the atlas.
struct Shining {
  std::size_t copy = 0, part = 0;
  std::vector<BakedHighlightBlock> blocks;
};

std::vector<std::size_t> nearest_first(const std::vector<cover::Copy>& copies, const place::Eye& eye) {
  std::vector<double> distance;
  for (const cover::Copy& copy : copies) distance.push_back(connect(image_of(copy, eye), {geometry::Point(), eye.z}).length);
  std::vector<std::size_t> order(copies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
  return order;
}

/// The places of one part's vertices, block by block as the bake made them: corners 00, 10, 01 and, of pairs, 11.
OwnUv own_uv(const Shining& shining, const Baked& baked) {
  OwnUv own{shining.copy, shining.part, baked.atlas.uv[shining.part]};
  const std::vector<Block>& blocks = baked.blocks[shining.part];
  std::vector<std::size_t> first(blocks.size() + 1, 0);
  for (std::size_t i = 0; i < blocks.size(); ++i) first[i + 1] = first[i] + (blocks[i].second < 0 ? 3 : 4);
  for (const BakedHighlightBlock& f : shining.blocks) {
    const double x0 = f.box.x + 0.5, y0 = f.box.y + 0.5, x1 = f.box.x + f.box.width - 0.5, y1 = f.box.y + f.box.height - 0.5;
    const auto place = [&](double x, double y) {
      return std::array<float, 2>{static_cast<float>(x / baked.atlas.image.width), static_cast<float>(y / baked.atlas.image.height)};
    };
    std::array<float, 2>* at = own.uv.data() + first[f.block];
    at[0] = place(x0, y0), at[1] = place(x1, y0), at[2] = place(x0, y1);
    if (blocks[f.block].second >= 0) at[3] = place(x1, y1);
  }
  return own;
}

}  // namespace

HighlightOptions highlight_options(const scene::BakeSpec& spec) {
  HighlightOptions options;
  if (spec.quality == scene::BakeQuality::draft) options.fine_px = 1.6, options.rays_per_texel = 1, options.tolerance = 3;
  if (spec.quality == scene::BakeQuality::fine) options.fine_px = 0.4, options.tolerance = 0.5;
  return options;
}

Highlights bake_highlights(const place::PlacedRoom& room, const light::LightingContext& lighting, const std::vector<cover::Copy>& copies,
                           const DrawnParts& drawn, const place::Eye& eye, const HighlightOptions& options, Baked& baked,
                           const Executor& executor, const Progress& progress) {
  Highlights result;
  const std::vector<ShinyPart> parts = shiny_parts(room, lighting, drawn, static_cast<bool>(options.seen_in));
  const double per_radian = place::pixels_per_radian(eye);
  std::vector<Shining> all;
  const std::vector<std::size_t> order = nearest_first(copies, eye);
  std::size_t from = 0;
  for (; from < order.size() && result.counts.texels <= options.max_texels; from += kBatch) {
    report(progress, "highlights", from, order.size(), "copies");
    const std::size_t count = std::min(kBatch, order.size() - from);
    std::vector<Shining> batch(count * parts.size());
    executor(batch.size(), [&](std::size_t i) {
      Shining& shining = batch[i];
      const ShinyPart& part = parts[i % parts.size()];
      shining.copy = order[from + i / parts.size()], shining.part = part.part;
      if (!part.in_model.empty() && !part.in_model[drawn.model_of_copy[shining.copy]]) return;
      const cover::Copy& copy = copies[shining.copy];
      const surface::PartNormals& normals = part.part < lighting.normals.size() ? lighting.normals[part.part] : part.own;
      const Job job{room,        lighting,   options,
                    baked,       normals,    shining.part,
                    copy,        eye,        image_of(copy, eye),
                    copy.weight, per_radian, shining.part < drawn.beside.size() ? drawn.beside[shining.part] : 0,
                    progress};
      const Ball& ball = part.ball;
      const light::Connection sight = connect(job.eye, ball.centre);
      const bool near = sight.length < 2 * ball.radius;
      if (!near && sight.valid && 2 * ball.radius * pixels_per_unit(job.eye, sight, per_radian) < part.smallest_px) return;
      PartShine shine(job);
      shining.blocks = shine.run();
    });
    for (Shining& shining : batch) {
      if (shining.blocks.empty()) continue;
      for (const BakedHighlightBlock& f : shining.blocks) result.counts.texels += f.shown.size();
      all.push_back(std::move(shining));
    }
  }
  result.counts.left_out = from < order.size() ? order.size() - from : 0;
  std::sort(all.begin(), all.end(), [](const Shining& a, const Shining& b) { return std::tie(a.copy, a.part) < std::tie(b.copy, b.part); });
  std::vector<Box*> boxes;
  for (Shining& shining : all)
    for (BakedHighlightBlock& f : shining.blocks) boxes.push_back(&f.box);
  const auto size = boxes.empty() ? std::nullopt : pack_below(boxes, baked.atlas.image.width, baked.atlas.image.height, options.max_side);
  if (!size) {
    result.counts.left_out = boxes.empty() ? 0 : copies.size();
    return result;
  }
  enlarge(baked, (*size)[0], (*size)[1]);
  for (const Shining& shining : all) {
    if (result.own.empty() || result.own.back().copy != shining.copy) ++result.counts.copies;
    for (const BakedHighlightBlock& f : shining.blocks) put(f.box, f.shown, f.holes, baked.atlas);
    result.own.push_back(own_uv(shining, baked));
  }
  return result;
}

}  // namespace orbc::bake
