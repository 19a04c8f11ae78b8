// Light changes slowly except at shadow borders, so it is asked where it changes: adaptive sampling of each block (Whitted, An improved
// illumination model for shaded display, 1980, §4, on grids instead of pixels). Vertices are lit once and shared by all blocks that meet
// there. What is interpolated is irradiance, in linear light; what is compared is the encoded picture. Textures and solid patterns are then
// looked up texel by texel.
#include "compiler/bake/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>

#include "compiler/bake/blocks.h"
#include "compiler/bake/lit_part.h"
#include "compiler/bake/passing.h"
#include "compiler/bake/pattern_density.h"
#include "compiler/base/elementary.h"
#include "compiler/image/srgb.h"
#include "compiler/light/connection.h"
#include "compiler/place/texel.h"
#include "compiler/surface/albedo.h"

namespace orbc::bake {
namespace {

using place::PlacedMesh;
using scene::Color;
using Texel = std::array<std::uint8_t, 4>;

constexpr double kMaxDiffuseStep = 5;  // steps of 1/255 between neighbouring points that ask for a point between them

/// A block on its way: irradiance on a grid, every point of it known in the end.
struct Grid {
  int w = 1, h = 1;  ///< points
  std::vector<Color> light;
  std::vector<std::uint8_t> rough;  ///< a mean of its neighbours would have missed it, or one of them
  std::vector<std::uint8_t> blind;  ///< covered by a closed thing: nobody sees it, its neighbours' light goes on there
  std::uint64_t asked = 0;
};

struct BakedBlock {
  Box box;
  std::vector<Texel> texels;
  std::vector<std::array<std::uint16_t, 3>> texels16;  ///< the same with 16 bits a channel, where asked for
  std::uint64_t asked = 0;
};

class BlockBaker {
 public:
  BlockBaker(const LitPart& part, const Block& block) : part_(part), block_(block) {
    const int look = part.mesh.look[block.first];
    varies_ = surface::varies_in_triangle(part.room, part.mesh, look);
    material_ = &part.room.looks[static_cast<std::size_t>(look)].material;
    plain_ = part.room.looks[static_cast<std::size_t>(look)].color;
  }

  /// Irradiance from lamps, as finely as it asks for.
  LightGrid light() {
    const int a0 = level_of(block_.length_u * part_.options.coarse), b0 = level_of(block_.length_v * part_.options.coarse);
    const int a = std::max(a0, level_of(block_.length_u * part_.options.fine)),
              b = std::max(b0, level_of(block_.length_v * part_.options.fine));
    grid_.w = (1 << a) + 1, grid_.h = (1 << b) + 1;
    grid_.light.resize(static_cast<std::size_t>(grid_.w) * grid_.h);
    grid_.rough.assign(grid_.light.size(), 0);
    grid_.blind.assign(grid_.light.size(), 0);
    int su = 1 << (a - a0), sv = 1 << (b - b0);
    for (int j = 0; j < grid_.h; j += sv)
      for (int i = 0; i < grid_.w; i += su)
        if (valid(i, j)) ask(i, j);
    int used_u = su, used_v = sv;
    while (su > 1 || sv > 1) {
      const int nu = std::max(1, su / 2), nv = std::max(1, sv / 2);
      if (refine(su, sv, nu, nv)) used_u = nu, used_v = nv;
      su = nu, sv = nv;
    }
    go_on_where_blind(used_u, used_v);
    return thinned(used_u, used_v);
  }

  /// Its texels: light times colour. In: what lamps give, and what surfaces pass on (over π), if they do.
  BakedBlock finish(const LightGrid& lamps, const LightGrid* passed) {
    BakedBlock done;
    done.asked = lamps.asked;
    const double fine = varies_ ? pattern_density(part_.room, part_.mesh, block_, part_.options) : 0;
    const auto points = [&](double length, int own, int other) { return std::max({own, other, (1 << level_of(length * fine)) + 1}); };
    const int w = done.box.width = points(block_.length_u, lamps.w, passed ? finer(lamps.w, passed->w) : 0);
    const int h = done.box.height = points(block_.length_v, lamps.h, passed ? finer(lamps.h, passed->h) : 0);
    std::vector<Color> shown_at(static_cast<std::size_t>(w) * h);
    for (int j = 0; j < h; ++j)
      for (int i = 0; i < w; ++i) {
        Color& c = shown_at[static_cast<std::size_t>(j) * w + i];
        const double u = static_cast<double>(i) / (w - 1), v = static_cast<double>(j) / (h - 1);
        if (block_.second >= 0 || u + v <= 1 + 1e-9) {
          Color light = light_at(lamps, u, v);
          if (passed) light = light + std::numbers::pi * light_at(*passed, u, v);
          c = part_.lighting.exposure * light::outgoing_radiance(part_.lighting, *material_, varies_ ? albedo(u, v) : plain_, light);
        } else {  // a single triangle beyond its long side, which the lookup only touches one texel deep
          const auto at = [&](int x, int y) { return shown_at[static_cast<std::size_t>(y) * w + x]; };
          c = at(i - 1, j) + at(i, j - 1) + -1.0 * at(i - 1, j - 1);
          c = {std::clamp(c.r, 0.0, 1.0), std::clamp(c.g, 0.0, 1.0), std::clamp(c.b, 0.0, 1.0)};
        }
      }
    done.texels.reserve(shown_at.size());
    for (const Color& c : shown_at) {
      done.texels.push_back({image::encode_srgb8(c.r), image::encode_srgb8(c.g), image::encode_srgb8(c.b), 255});
      if (part_.options.with_image16)
        done.texels16.push_back({image::encode_srgb16(c.r), image::encode_srgb16(c.g), image::encode_srgb16(c.b)});
    }
    cut_holes(done);
    return done;
  }

 private:
  void cut_holes(BakedBlock& done) const {
    if (!place::has_holes(part_.room.looks[part_.mesh.look[block_.first]])) return;
    const int w = done.box.width, h = done.box.height;
    for (int j = 0; j < h; ++j)
      for (int i = 0; i < w; ++i)
        if (in_hole(part_.room, block_, static_cast<double>(i) / (w - 1), static_cast<double>(j) / (h - 1)))
          done.texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(w) + static_cast<std::size_t>(i)][3] = 0;
  }
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * grid_.w + i; }
  bool valid(int i, int j) const { return on_block(block_, i, j, grid_.w, grid_.h); }

  void ask(int i, int j) {
    Color& light = grid_.light[index(i, j)];
    if (material_->kind == scene::MaterialKind::emissive) return;
    const bool corner = (i == 0 || i == grid_.w - 1) && (j == 0 || j == grid_.h - 1);
    if (corner) {
      const bool far_u = i > 0, far_v = j > 0;
      const std::size_t t = far_u && far_v ? static_cast<std::size_t>(block_.second) : block_.first;
      const int k = far_u && far_v ? block_.second_turn[0] : block_.turn[far_u ? 1 : far_v ? 2 : 0];
      light = part_.at_vertex[part_.normals.corners[t][k]];
      grid_.blind[index(i, j)] = part_.blind_vertex[part_.normals.corners[t][k]];
      return;
    }
    const InTriangle at =
        within_block(block_, static_cast<double>(i) / (grid_.w - 1), static_cast<double>(j) / (grid_.h - 1), surface::kInset);
    const PointToLight asked = point_to_light(part_, at.triangle, at.b, std::max(block_.length_u, block_.length_v) / 2);
    grid_.blind[index(i, j)] = 0;
    if (asked.known) {
      light = *asked.known;
      return;
    }
    ++grid_.asked;
    if (!near_known_) near_ = images_near_block(), near_known_ = true;
    light = light::irradiance(part_.lighting, asked.point, near_);
    grid_.blind[index(i, j)] = light == Color{} && light::is_enclosed(part_.lighting, asked.point);
  }

  std::vector<std::uint32_t> images_near_block() const {
    const geometry::Space space = part_.room.room.space;
    const InTriangle middle = in_triangle(block_, 0.5, 0.5);
    const geometry::Position centre = surface::shading_point(part_.room, part_.mesh, part_.normals, middle.triangle, middle.b).at;
    double radius = 0;
    for (int k = 0; k < 6; ++k) {
      if (k > 2 && block_.second < 0) break;
      const std::uint32_t v =
          part_.mesh.triangles[k < 3 ? block_.first : static_cast<std::size_t>(block_.second)][static_cast<std::size_t>(k % 3)];
      radius = std::max(radius, math::hypot(geometry::distance(space, centre.floor, part_.mesh.floor[v]), part_.mesh.z[v] - centre.z));
    }
    return light::images_within(part_.lighting, centre, 1.2 * radius);
  }

  std::array<double, 3> shown(const Color& light) const {
    const Color c = part_.lighting.exposure * light::outgoing_radiance(part_.lighting, *material_, plain_, light);
    return {255 * image::encode_srgb(c.r), 255 * image::encode_srgb(c.g), 255 * image::encode_srgb(c.b)};
  }
  double difference(const Color& a, const Color& b) const {
    if (a == b) return 0;
    const auto x = shown(a), y = shown(b);
    return std::max({std::fabs(x[0] - y[0]), std::fabs(x[1] - y[1]), std::fabs(x[2] - y[2])});
  }

  // Fills the points between those of distance (su, sv); whether any of them had to be lit.
  bool refine(int su, int sv, int nu, int nv) {
    bool any = false;
    std::vector<std::uint8_t> rough(grid_.rough.size(), 0);
    for (int j = 0; j < grid_.h; j += nv)
      for (int i = 0; i < grid_.w; i += nu) {
        const bool odd_u = i % su != 0, odd_v = j % sv != 0;
        if ((!odd_u && !odd_v) || !valid(i, j)) continue;
        const int i0 = i - i % su, i1 = odd_u ? i0 + su : i0, j0 = j - j % sv, j1 = odd_v ? j0 + sv : j0;
        std::array<std::size_t, 4> parents{index(i0, j1), index(i1, j0), index(i0, j0), index(i1, j1)};
        const int count = odd_u && odd_v && valid(i1, j1) ? 4 : 2;
        if (!odd_u || !odd_v) parents[0] = index(i0, j0), parents[1] = index(i1, j1);
        any = fill(i, j, parents, count, rough) || any;
      }
    grid_.rough = std::move(rough);
    return any;
  }

  bool fill(int i, int j, const std::array<std::size_t, 4>& parents, int count, std::vector<std::uint8_t>& rough) {
    Color sum;
    int seen = 0;
    bool needed = false;
    for (int k = 0; k < count; ++k) {
      needed = needed || grid_.rough[parents[k]];
      if (!grid_.blind[parents[k]]) sum = sum + grid_.light[parents[k]], ++seen;
    }
    needed = needed || (seen > 0 && seen < count);
    for (int k = 0; k + 1 < count + (count & 1) && !needed; k += 2)
      needed = difference(grid_.light[parents[k]], grid_.light[parents[k + 1]]) > kMaxDiffuseStep;
    const std::size_t at = index(i, j);
    const Color mean = seen > 0 ? (1.0 / seen) * sum : Color{};
    grid_.light[at] = mean;
    grid_.blind[at] = seen == 0;
    if (!needed) return false;
    ask(i, j);
    if (grid_.blind[at] || difference(grid_.light[at], mean) <= part_.options.tolerance) return true;
    rough[at] = 1;
    for (int k = 0; k < count; ++k) rough[parents[k]] = 1;
    return true;
  }

  // Covered points take on what their neighbours have, ring by ring: what is interpolated up to the line where a thing stands on the floor
  // is then light of the floor in front of it, not the dark below it.
  void go_on_where_blind(int step_u, int step_v) {
    std::vector<std::array<int, 2>> blind, rest;
    bool any = false;
    for (int j = 0; j < grid_.h; j += step_v)
      for (int i = 0; i < grid_.w; i += step_u) {
        if (!valid(i, j)) continue;
        if (grid_.blind[index(i, j)]) blind.push_back({i, j});
        else any = true;
      }
    while (any && !blind.empty()) {
      std::vector<std::pair<std::size_t, Color>> found;
      rest.clear();
      for (const auto& [i, j] : blind) {
        Color sum;
        int count = 0;
        const auto look = [&](int x, int y) {
          if (x < 0 || y < 0 || x >= grid_.w || y >= grid_.h || !valid(x, y) || grid_.blind[index(x, y)]) return;
          sum = sum + grid_.light[index(x, y)], ++count;
        };
        look(i - step_u, j), look(i + step_u, j), look(i, j - step_v), look(i, j + step_v);
        if (count > 0) found.push_back({index(i, j), (1.0 / count) * sum});
        else rest.push_back({i, j});
      }
      for (const auto& [at, light] : found) grid_.light[at] = light, grid_.blind[at] = 0;
      any = !found.empty();
      std::swap(blind, rest);
    }
  }

  Color albedo(double u, double v) const {
    const InTriangle at = in_triangle(block_, u, v);
    return surface::triangle_albedo(part_.room, part_.mesh, at.triangle, at.b);
  }

  // Every step-th point; those beyond the long side of a single triangle continue it.
  LightGrid thinned(int step_u, int step_v) const {
    LightGrid thin;
    thin.asked = grid_.asked;
    thin.w = (grid_.w - 1) / step_u + 1, thin.h = (grid_.h - 1) / step_v + 1;
    thin.light.resize(static_cast<std::size_t>(thin.w) * thin.h);
    for (int j = 0; j < thin.h; ++j)
      for (int i = 0; i < thin.w; ++i) {
        std::array<float, 3>& to = thin.point(i, j);
        if (valid(i * step_u, j * step_v)) {
          const Color& c = grid_.light[index(i * step_u, j * step_v)];
          to = {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
        } else {
          for (std::size_t k = 0; k < 3; ++k)
            to[k] = std::max(0.0f, thin.point(i - 1, j)[k] + thin.point(i, j - 1)[k] - thin.point(i - 1, j - 1)[k]);
        }
      }
    return thin;
  }

  // The least multiple of a grid's cells that is as fine as another's: texels on the points of the first stay on them.
  static int finer(int own, int other) {
    int cells = own - 1;
    while (cells < other - 1) cells *= 2;
    return cells + 1;
  }

  const LitPart& part_;
  const Block& block_;
  Grid grid_;
  const scene::Material* material_ = nullptr;
  Color plain_;
  bool varies_ = false;
  std::vector<std::uint32_t> near_;  ///< images that matter here
  bool near_known_ = false;
};

// The part with vertices of its own for every block, and where they lie in the atlas.
void rebuild(const std::vector<Block>& blocks, const BakedBlock* finished, int width, int height, PlacedMesh& part,
             std::vector<std::array<float, 2>>& uv) {
  const PlacedMesh own = part;
  part.floor.clear(), part.z.clear(), part.uv.clear(), part.pattern_position.clear();
  const auto add = [&](std::uint32_t v, double x, double y) {
    part.floor.push_back(own.floor[v]);
    part.z.push_back(own.z[v]);
    uv.push_back({static_cast<float>(x / width), static_cast<float>(y / height)});
    return static_cast<std::uint32_t>(part.floor.size() - 1);
  };
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& block = blocks[i];
    const Box& box = finished[i].box;
    const double x0 = box.x + 0.5, y0 = box.y + 0.5, x1 = box.x + box.width - 0.5, y1 = box.y + box.height - 0.5;
    const mesh::Triangle& first = own.triangles[block.first];
    const std::uint32_t v00 = add(first[block.turn[0]], x0, y0), v10 = add(first[block.turn[1]], x1, y0),
                        v01 = add(first[block.turn[2]], x0, y1);
    mesh::Triangle& t = part.triangles[block.first];
    t[block.turn[0]] = v00, t[block.turn[1]] = v10, t[block.turn[2]] = v01;
    if (block.second < 0) continue;
    mesh::Triangle& s = part.triangles[static_cast<std::size_t>(block.second)];
    const std::uint32_t v11 = add(own.triangles[static_cast<std::size_t>(block.second)][block.second_turn[0]], x1, y1);
    s[block.second_turn[0]] = v11, s[block.second_turn[1]] = v01, s[block.second_turn[2]] = v10;
  }
}

Diagnostic too_large(const place::PlacedRoom& room, const std::vector<std::vector<Block>>& blocks, const std::vector<BakedBlock>& finished,
                     int max_side) {
  std::size_t at = 0, worst = 0;
  std::uint64_t most = 0;
  for (std::size_t p = 0; p < blocks.size(); ++p) {
    std::uint64_t texels = 0;
    for (std::size_t i = 0; i < blocks[p].size(); ++i, ++at) texels += finished[at].texels.size();
    if (texels > most) most = texels, worst = p;
  }
  return make_error(
      "light.atlas-too-large", fmt::format("the baked light of this scene does not fit into a picture of {0}×{0} pixels", max_side),
      fmt::format(
          "most of it, {} texels, is on \"{}\": a simpler mesh there, larger lamps with softer shadows, or --quality draft need less", most,
          room.parts[worst].name));
}

}  // namespace

BakeOptions bake_options(const scene::BakeSpec& spec) {
  BakeOptions options;
  if (spec.quality == scene::BakeQuality::draft) {
    options.coarse = 12, options.fine = 48, options.texture_fine = 200, options.tolerance = 5;
    options.passing = {64, 10};
  }
  if (spec.quality == scene::BakeQuality::fine) {
    options.coarse = 48, options.fine = 400, options.texture_fine = 600, options.tolerance = 1;
    options.passing = {1024, 48};
  }
  if (spec.samples) options.passing.samples = *spec.samples;
  return options;
}

light::LightOptions baked_light_options(const scene::Scene& scene) {
  light::LightOptions options = light::light_options(scene);
  if (scene.bake.quality == scene::BakeQuality::draft) options.cull_below = 1.0 / 128, options.max_step = 0.025;
  if (scene.bake.quality == scene::BakeQuality::fine) options.max_step = 0.003;
  return options;
}

bool shows_room(const scene::Material& material, bool lit) {
  using Kind = scene::MaterialKind;
  return material.kind == Kind::mirror || material.kind == Kind::glass || (lit && material.kind == Kind::metal);
}

bool shows_room(const place::PlacedRoom& room, bool lit) {
  return std::any_of(room.looks.begin(), room.looks.end(), [&](const place::Look& look) { return shows_room(look.material, lit); });
}

bool needs_bake(const scene::Scene& scene, const place::PlacedRoom& room) {
  if (!scene.lamps.empty() || shows_room(room, false) || scene.integrator == scene::Integrator::path) return true;
  return std::any_of(room.parts.begin(), room.parts.end(), [&](const PlacedMesh& part) {
    return std::any_of(part.look.begin(), part.look.end(),
                       [&](std::uint16_t look) { return room.looks[look].texture < 0 && surface::varies_in_triangle(room, part, look); });
  });
}

Result<Baked> bake(const place::PlacedRoom& room, const light::LightingContext& lighting, const BakeOptions& options,
                   const Executor& executor, const Progress& progress) {
  std::vector<std::vector<Block>> blocks;
  std::vector<std::size_t> first;
  std::vector<surface::PartNormals> own(room.parts.size());  // of fields that have none
  std::vector<const surface::PartNormals*> normals;
  std::vector<LitPart> parts;
  std::vector<LightGrid> lamps;
  std::optional<SurfaceMap> surfaces;
  Baked baked;
  for (std::size_t p = 0; p < room.parts.size(); ++p) {
    if (p >= lighting.normals.size()) own[p] = surface::part_normals(room, room.parts[p]);
    normals.push_back(p < lighting.normals.size() ? &lighting.normals[p] : &own[p]);
    const bool stand_in = lighting.lit && p >= lighting.normals.size();
    if (stand_in && !surfaces) surfaces.emplace(room, blocks);
    LitPart& part =
        parts.emplace_back(LitPart{room, lighting, options, room.parts[p], *normals[p], stand_in ? &*surfaces : nullptr, lamps, {}, {}});
    baked.counts.points += light_vertices(part, executor, progress);
    blocks.push_back(blocks_of(room, static_cast<std::uint32_t>(p), part.normals));
    first.push_back(lamps.size());
    lamps.resize(lamps.size() + blocks.back().size());
    std::atomic<std::uint64_t> done{0};
    executor(blocks.back().size(), [&](std::size_t i) {
      lamps[first[p] + i] = BlockBaker(part, blocks[p][i]).light();
      report(progress, "baking", done.fetch_add(1), blocks[p].size(), "blocks");
    });
  }
  std::vector<LightGrid> passed;
  if (lighting.options.indirect_bounces > 0)
    passed = pass_on({room, lighting, normals, blocks, lamps}, options.passing, executor, progress);
  std::vector<BakedBlock> finished(lamps.size());
  for (std::size_t p = 0; p < room.parts.size(); ++p)
    executor(blocks[p].size(), [&](std::size_t i) {
      const std::size_t at = first[p] + i;
      finished[at] = BlockBaker(parts[p], blocks[p][i]).finish(lamps[at], passed.empty() ? nullptr : &passed[at]);
    });
  std::vector<Box> boxes;
  for (const BakedBlock& f : finished) {
    boxes.push_back(f.box);
    baked.counts.points += f.asked;
    baked.counts.texels += f.texels.size();
  }
  const auto size = pack(boxes, options.max_side);
  if (!size) return too_large(room, blocks, finished, options.max_side);
  Atlas& atlas = baked.atlas;
  atlas.image.width = (*size)[0], atlas.image.height = (*size)[1];
  atlas.image.rgba.assign(4 * static_cast<std::size_t>(atlas.image.width) * static_cast<std::size_t>(atlas.image.height), 128);
  for (std::size_t i = 3; i < atlas.image.rgba.size(); i += 4) atlas.image.rgba[i] = 255;
  if (options.with_image16) {
    atlas.image16.width = atlas.image.width, atlas.image16.height = atlas.image.height;
    atlas.image16.rgb.assign(atlas.image.rgba.size() / 4 * 3, 128 * 257);
  }
  for (std::size_t f = 0; f < finished.size(); ++f) {
    Box& box = finished[f].box;
    box = boxes[f];
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x) {
        const Texel& texel = finished[f].texels[static_cast<std::size_t>(y) * box.width + x];
        std::copy(texel.begin(), texel.end(),
                  atlas.image.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(box.y + y) * atlas.image.width + box.x + x));
        if (!options.with_image16) continue;
        const auto& fine =
            finished[f].texels16[static_cast<std::size_t>(y) * static_cast<std::size_t>(box.width) + static_cast<std::size_t>(x)];
        std::copy(fine.begin(), fine.end(),
                  atlas.image16.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(box.y + y) * atlas.image.width + box.x + x));
      }
  }
  atlas.room = room;
  atlas.uv.resize(room.parts.size());
  for (std::size_t p = 0; p < room.parts.size(); ++p)
    rebuild(blocks[p], finished.data() + first[p], atlas.image.width, atlas.image.height, atlas.room.parts[p], atlas.uv[p]);
  baked.boxes.resize(room.parts.size());
  for (std::size_t p = 0; p < room.parts.size(); ++p)
    for (std::size_t i = 0; i < blocks[p].size(); ++i) baked.boxes[p].push_back(finished[first[p] + i].box);
  baked.blocks = std::move(blocks);
  return baked;
}

}  // namespace orbc::bake
