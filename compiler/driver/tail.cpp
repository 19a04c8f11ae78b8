// A path that ends at a mirror shows weight × T, T the colour expected beyond: in exports a panel of colour T in the mirror, which its copy
// multiplies by its weight like everything else. Of what is cut off by bounces or weight both roads show the same T, and the sum over
// endless mirrors is closed instead of cut. Copies left out for their size the tracer does see: there T stands for many small things, by
// the height at which one looks through the mirror.
#include "compiler/driver/tail.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "compiler/bend/screen_size.h"
#include "compiler/cover/projected_size.h"
#include "compiler/driver/prepared.h"
#include "compiler/light/lighting.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/growth.h"
#include "compiler/render/radiance.h"

namespace orbc::driver {
namespace {

constexpr int kColumns = 64, kRows = 48;  // of the picture
constexpr int kCloser = 3;                // times as many of each where copies left out are looked for: they are few
constexpr int kDeeper = 96;               // bounces beyond the cut-off
constexpr double kNothing = 1e-4;         // weight
constexpr double kInto = 0.25;            // of the room's height: more than the edges of floors are off by, far away
constexpr double kSlack = 1e-6;           // of a size
// Of the way from the height of the eye to floor and ceiling: near it paths are longest
constexpr double kBands[] = {0.08, 0.22, 0.42, 0.68};

struct Sum {
  scene::Color weight, radiance;
  void add(const Sum& more) { weight = weight + more.weight, radiance = radiance + more.radiance; }
  [[nodiscard]] bool empty() const { return !(max_channel(weight) > 0); }
  [[nodiscard]] scene::Color color() const {
    const auto share = [](double r, double w) { return w > 0 ? r / w : 0; };
    return {share(radiance.r, weight.r), share(radiance.g, weight.g), share(radiance.b, weight.b)};
  }
};

struct Row {
  Sum depth;
  std::vector<Sum> bands;
  double lost = 0, merged = 0;
};

/// Where a path goes into the first copy that is left out.
class Missing {
 public:
  Missing(const place::Interior& room, const BeyondOptions& options) : room_(room), options_(options) {
    for (std::size_t wall = 0; wall < room_.polygon.walls.size(); ++wall)
      mirrors_.push_back(room::reflection_in_wall(room_.polygon, static_cast<int>(wall)));
    const bool tiles = notation::is_orbifold(room_.polygon.orbifold);
    if (room_.polygon.space == geometry::Space::spherical && tiles)
      half_turn_ = notation::longest_length(room_.polygon.orbifold).value_or(1);
  }

  /// How many mirrors are passed before it; the number of all when there is none.
  [[nodiscard]] std::size_t first(const std::vector<std::int16_t>& word) const {
    cover::Copy copy;
    copy.cover_from_room = geometry::identity(room_.polygon.space);
    int walls = 0;
    for (std::size_t i = 0; i < word.size(); ++i) {
      if (word[i] < 0) continue;  // a storey is as far away as the one before
      copy.cover_from_room = copy.cover_from_room * mirrors_[static_cast<std::size_t>(word[i])];
      copy.bounces = static_cast<int>(i) + 1;
      // Every half turn passes as many mirrors.
      copy.sheet = half_turn_ > 0 ? walls++ / half_turn_ : 0;
      if (options_.left_out(copy)) return i;
    }
    return word.size();
  }

  [[nodiscard]] std::size_t band_at(const orbc::trace::Path& path, const orbc::trace::Ray& ray) const {
    const double z = ray.z + path.length * ray.m;
    return static_cast<std::size_t>(std::upper_bound(options_.bands.begin(), options_.bands.end(), z) - options_.bands.begin());
  }

 private:
  const place::Interior& room_;
  const BeyondOptions& options_;
  std::vector<geometry::Isometry> mirrors_;
  int half_turn_ = 0;
};

}  // namespace

LeftOut left_out_below(const Opened& opened, double budget_px) {
  const scene::CoverSpec& spec = opened.scene.cover;
  if (!(spec.min_pixels > 0) && !(budget_px > 0)) return {};
  const place::Interior& room = *opened.room;
  const bend::BoundingCylinder whole{{}, room.polygon.circumradius, 0, room.height};
  return [spec, budget_px, whole, size = cover::ProjectedSize(room, opened.eye),
          detail = bend::ScreenSize(opened.eye, {})](const cover::Copy& copy) {
    if (copy.bounces == 0) return false;
    if (spec.min_pixels > 0 && cover::is_culled(size.of(copy.cover_from_room), spec, kSlack)) return true;
    return budget_px > 0 && detail.smaller_side_px(copy, whole) < budget_px * (1 + kSlack);
  };
}

namespace {

/// Looks along the rays of a grid.
class Looker {
 public:
  Looker(const Opened& opened, const place::Interior& room, const BeyondOptions& options, const Executor& executor)
      : opened_(opened),
        options_(options),
        executor_(executor),
        scene_(&room == opened.room.get() ? prepared(opened, executor).scene : orbc::trace::prepare(room, executor)),
        missing_(room, options) {
    const scene::CoverSpec& spec = opened.scene.cover;
    if (options.color || options.left_out) {
      light_ = prepared(opened, executor).light;  // in: the opened room
      light_.options.indirect_bounces = 0;
    }
    shown_.max_bounces = spec.max_bounces, shown_.min_weight = spec.min_weight;
    shown_.lighting = light_.lit ? &light_ : nullptr;
    shown_.background = opened.scene.exposure > 0 ? (1 / opened.scene.exposure) * spec.background : spec.background;
    deep_ = shown_;
    deep_.background = {};
    deep_.max_bounces = spec.max_bounces + kDeeper, deep_.min_weight = kNothing;
  }

  /// Those that the tracer itself does not follow.
  Beyond cut_off() {
    Beyond beyond{0, 0, opened_.scene.cover.background, {}};
    Sum all;
    for (const Row& row : rows(kColumns, kRows, [&](const orbc::trace::Ray&ray, Row&row) { cut_off(ray, row); })) {
      all.add(row.depth);
      beyond.weight_lost += row.lost / (kColumns * kRows);
    }
    if (options_.color && !all.empty()) beyond.color = all.color();
    return beyond;
  }

  /// Those that meet a copy left out. `expected`: what the tracer shows where it cuts off.
  void merged(bool expected, Beyond& beyond) {
    if (expected) shown_.background = beyond.color;
    constexpr int columns = kCloser * kColumns, lines = kCloser * kRows;
    std::vector<Sum> bands(options_.bands.size() + 1);
    for (const Row& row : rows(columns, lines, [&](const orbc::trace::Ray&ray, Row&row) { merged(ray, row); })) {
      for (std::size_t b = 0; b < bands.size(); ++b) bands[b].add(row.bands[b]);
      beyond.weight_merged += row.merged / (columns * lines);
    }
    Sum all;
    for (const Sum& band : bands) all.add(band);
    // Too few to be met: they show what the others show.
    if (all.empty())
      for (const Row& row : rows(kColumns, kRows, [&](const orbc::trace::Ray&ray, Row&row) { everything(ray, row); })) all.add(row.depth);
    for (const Sum& band : bands) beyond.by_height.push_back(band.empty() ? all.color() : band.color());
  }

 private:
  template <class Look>
  std::vector<Row> rows(int columns, int lines, const Look& look) const {
    std::vector<Row> rows(static_cast<std::size_t>(lines));
    executor_(rows.size(), [&](std::size_t j) {
      rows[j].bands.resize(options_.bands.size() + 1);
      for (int i = 0; i < columns; ++i)
        look(render::eye_ray(opened_.eye, (i + 0.5) * opened_.eye.width / columns,
                             (static_cast<double>(j) + 0.5) * opened_.eye.height / lines),
             rows[j]);
    });
    return rows;
  }

  void cut_off(const orbc::trace::Ray& ray, Row& row) const {
    const orbc::trace::Path path = orbc::trace::follow(scene_, ray, render::follow_options(shown_));
    if (!path.cut_off) return;
    row.lost += max_channel(path.throughput);
    if (options_.color) row.depth.add({path.throughput, render::radiance(scene_, ray, deep_).radiance});
  }

  void merged(const orbc::trace::Ray& ray, Row& row) const {
    orbc::trace::FollowOptions follow = render::follow_options(shown_);
    follow.record_word = true;
    const orbc::trace::Path path = orbc::trace::follow(scene_, ray, follow);
    const std::size_t mirrors = missing_.first(path.word);
    if (mirrors == path.word.size()) return;
    follow.max_bounces = static_cast<int>(mirrors);
    const orbc::trace::Path short_path = orbc::trace::follow(scene_, ray, follow);
    row.merged += max_channel(short_path.throughput);
    row.bands[missing_.band_at(short_path, ray)].add({short_path.throughput, render::radiance(scene_, path, shown_).radiance});
  }

  void everything(const orbc::trace::Ray& ray, Row& row) const {
    const render::RayResult seen = render::radiance(scene_, ray, shown_);
    row.depth.add({seen.path.throughput, seen.radiance});
  }

  const Opened& opened_;
  const BeyondOptions& options_;
  const Executor& executor_;
  orbc::trace::TraceScene scene_;
  Missing missing_;
  light::LightingContext light_;
  render::DrawOptions shown_, deep_;
};

}  // namespace

bool shows_beyond(const Opened& opened) { return opened.expected_background || max_channel(opened.scene.cover.background) > 0; }

Beyond look_beyond(const Opened& opened, const place::Interior& room, const BeyondOptions& options, const Executor& executor) {
  Looker looker(opened, room, options, executor);
  Beyond beyond = looker.cut_off();
  if (options.left_out) looker.merged(options.color, beyond);
  return beyond;
}

std::vector<double> bands_of(const place::Interior& room, const place::Camera& eye) {
  std::vector<double> bands;
  if (std::any_of(room.mirrors.begin(), room.mirrors.end(), [](const place::PlacedMirror& m) { return m.wall < 0; })) return bands;
  for (const double share : kBands) bands.insert(bands.begin(), eye.z * (1 - share));
  bands.push_back(eye.z);
  for (const double share : kBands) bands.push_back(eye.z + (room.height - eye.z) * share);
  return bands;
}

namespace {

/// A panel on a wall: columns of pieces, since walls may be long and long triangles are split into many, and rows of bands.
place::PlacedMesh wall_panel(const place::Interior& room, const place::PlacedMirror& mirror, double bottom, double top,
                             std::uint16_t first_look, const std::vector<double>& bands, bool flat) {
  place::PlacedMesh panel;
  panel.kind = place::PartKind::wall, panel.wall = mirror.wall;
  std::vector<double> heights{bottom};
  std::vector<std::uint16_t> looks;
  for (std::size_t b = 0; b <= bands.size(); ++b) {
    const double to = b < bands.size() ? std::min(bands[b], top) : top;
    if (to > heights.back()) heights.push_back(to), looks.push_back(static_cast<std::uint16_t>(first_look + b));
  }
  const double length = mirror.span[1] - mirror.span[0];
  const auto pieces = flat ? 1U : static_cast<std::uint32_t>(std::clamp(std::ceil(length), 1.0, 64.0));
  const auto rows = static_cast<std::uint32_t>(heights.size());
  for (std::uint32_t k = 0; k <= pieces; ++k) {
    const geometry::Point p = room::point_on_wall(room.polygon, mirror.wall, mirror.span[0] + length * k / pieces);
    for (const double z : heights) panel.floor.push_back(p), panel.z.push_back(z);
    for (std::uint32_t j = 0; k < pieces && j + 1 < rows; ++j) {
      const std::uint32_t at = rows * k + j;
      panel.triangles.push_back({at, at + rows, at + rows + 1});
      panel.triangles.push_back({at, at + rows + 1, at + 1});
      panel.style.insert(panel.style.end(), 2, looks[j]);
    }
  }
  return panel;
}

place::PlacedMesh level_panel(const place::Interior& room, bool floor, std::uint16_t look) {
  place::PlacedMesh panel;
  panel.kind = floor ? place::PartKind::floor : place::PartKind::ceiling;
  panel.floor = room.polygon.outline;
  panel.floor.emplace_back();
  panel.z.assign(panel.floor.size(), floor ? 0 : room.height);
  const auto n = static_cast<std::uint32_t>(room.polygon.outline.size());
  for (std::uint32_t k = 0; k < n; ++k)
    panel.triangles.push_back(floor ? mesh::Triangle{n, k, (k + 1) % n} : mesh::Triangle{n, (k + 1) % n, k});
  panel.style.assign(panel.triangles.size(), look);
  return panel;
}

}  // namespace

std::vector<place::PlacedMesh> curtains(const place::Interior& room, std::uint16_t first_look, const std::vector<double>& bands,
                                        bool flat) {
  std::vector<place::PlacedMesh> panels;
  const bool stacked = std::any_of(room.mirrors.begin(), room.mirrors.end(), [](const place::PlacedMirror& m) { return m.wall < 0; });
  for (const place::PlacedMirror& mirror : room.mirrors) {
    if (mirror.wall >= 0) {
      // Into floor and ceiling, which hide it there: their edges are split otherwise, and nothing shall shine through between.
      const double bottom = mirror.height[0] - (stacked || mirror.height[0] > 0 ? 0 : kInto * room.height);
      const double top = mirror.height[1] + (stacked || mirror.height[1] < room.height ? 0 : kInto * room.height);
      panels.push_back(wall_panel(room, mirror, bottom, top, first_look, bands, flat));
    } else {
      panels.push_back(level_panel(room, mirror.wall == -1, first_look));
    }
    panels.back().name = "curtain";
  }
  return panels;
}

bool may_be_flat(const place::Interior& room, double pixels) {
  constexpr double kMost = 8;  // of larger ones the step at the floor's edge would be seen
  return room.polygon.space != geometry::Space::spherical && pixels <= kMost;
}

CutOffs::CutOffs(const place::Interior& room, const scene::CoverSpec& spec, LeftOut left_out)
    : room_(room), spec_(spec), left_out_(std::move(left_out)) {
  for (const place::PlacedMirror& mirror : room.mirrors)
    behind_.push_back(mirror.wall < 0 ? geometry::identity(room.polygon.space) : room::reflection_in_wall(room.polygon, mirror.wall));
}

std::vector<CutOff> CutOffs::of(const cover::Copy& copy) const {
  std::vector<CutOff> ends(room_.mirrors.size(), CutOff::no);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const place::PlacedMirror& mirror = room_.mirrors[i];
    const bool last = copy.bounces >= spec_.max_bounces || max_channel(mirror.throughput * copy.weight) < spec_.min_weight;
    if (mirror.wall < 0) {
      // On a storey above one looks up, through what is its ceiling, or its floor when it stands on its head.
      const int way = mirror.wall == -2 ? 1 : -1, towards = copy.storey.sign > 0 ? way : -way;
      if (last && copy.storey.number * towards >= 0) ends[i] = CutOff::depth;
      continue;
    }
    if (last) {
      ends[i] = CutOff::depth;
    } else if (left_out_ && !cover::faces_eye(copy, mirror.wall)) {
      cover::Copy next;
      next.cover_from_room = copy.cover_from_room * behind_[i];
      next.bounces = copy.bounces + 1, next.sheet = copy.sheet, next.storey = copy.storey;
      if (left_out_(next)) ends[i] = CutOff::size;
    }
  }
  return ends;
}

std::uint64_t hang(const CutOffs& cut_offs, const std::vector<cover::Copy>& copies, const Curtains& curtains,
                   std::vector<bend::Model>& models, std::vector<std::uint32_t>& model_of_copy) {
  std::uint64_t hung = 0;
  std::map<std::pair<std::uint32_t, std::vector<CutOff>>, std::uint32_t> known;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    std::vector<CutOff> ends = cut_offs.of(copies[i]);
    if (curtains.depth.empty()) std::replace(ends.begin(), ends.end(), CutOff::depth, CutOff::no);
    if (curtains.size.empty()) std::replace(ends.begin(), ends.end(), CutOff::size, CutOff::no);
    const auto here = static_cast<std::uint64_t>(std::count_if(ends.begin(), ends.end(), [](CutOff end) { return end != CutOff::no; }));
    if (here == 0) continue;
    hung += here;
    const auto [at, is_new] = known.try_emplace({model_of_copy[i], ends}, static_cast<std::uint32_t>(models.size()));
    if (is_new) {
      bend::Model model = models[model_of_copy[i]];
      for (std::size_t m = 0; m < ends.size(); ++m)
        if (ends[m] != CutOff::no) model.parts.push_back(ends[m] == CutOff::depth ? curtains.depth[m] : curtains.size[m]);
      models.push_back(std::move(model));
    }
    model_of_copy[i] = at->second;
  }
  return hung;
}

std::vector<std::size_t> add_curtains(place::Interior& room, const std::vector<scene::Color>& colors, const std::vector<double>& bands,
                                      bool flat) {
  const std::size_t first = room.styles.size();
  for (const scene::Color& color : colors) {
    place::SurfaceStyle look;
    look.color = color;
    look.material.kind = scene::MaterialKind::emissive;  // it is the light itself
    room.styles.push_back(look);
  }
  std::vector<std::size_t> parts;
  for (place::PlacedMesh& panel : curtains(room, static_cast<std::uint16_t>(first), bands, flat)) {
    parts.push_back(room.parts.size());
    room.parts.push_back(std::move(panel));
  }
  return parts;
}

}  // namespace orbc::driver
