// A cut-off path shows weight × T, T the colour expected beyond: in exports a panel of colour T in the mirror, which its copy multiplies by its weight like
// everything else. So both roads show the same, and the sum over endless mirrors is closed instead of cut.
#include "compiler/driver/tail.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "compiler/light/shade.h"
#include "compiler/render/shade.h"

namespace orbc::driver {
namespace {

constexpr int kColumns = 64, kRows = 48;   // of the picture
constexpr int kDeeper = 96;                // bounces beyond the cut-off
constexpr double kNothing = 1e-4;          // weight
constexpr double kInto = 0.01;             // of the room's height

}  // namespace

Beyond look_beyond(const Opened& opened, bool with_color, const Executor& executor) {
  const scene::CoverSpec& spec = opened.scene.cover;
  const orbc::trace::TraceScene scene = orbc::trace::prepare(*opened.room, executor);
  light::LightField light;
  if (with_color) {
    light::LightOptions direct = light::light_options(opened.scene);
    direct.passes = 0;
    light = light::prepare_light(opened.scene, *opened.room, direct, executor).value();
  }
  render::DrawOptions shown, deep;
  shown.max_bounces = spec.max_bounces, shown.min_weight = spec.min_weight;
  deep.max_bounces = spec.max_bounces + kDeeper, deep.min_weight = kNothing;
  deep.light = light.lit ? &light : nullptr;
  struct Row {
    scene::Color weight, radiance;
    double lost = 0;
  };
  std::vector<Row> rows(kRows);
  executor(kRows, [&](std::size_t j) {
    for (int i = 0; i < kColumns; ++i) {
      const orbc::trace::Ray ray = render::eye_ray(opened.eye, (i + 0.5) * opened.eye.width / kColumns, (static_cast<double>(j) + 0.5) * opened.eye.height / kRows);
      const orbc::trace::Path path = orbc::trace::follow(scene, ray, render::follow_options(shown));
      if (!path.cut_off) continue;
      rows[j].lost += largest(path.weight);
      rows[j].weight = rows[j].weight + path.weight;
      if (with_color) rows[j].radiance = rows[j].radiance + render::radiance(scene, ray, deep).radiance;
    }
  });
  Row all;
  for (const Row& row : rows) all.weight = all.weight + row.weight, all.radiance = all.radiance + row.radiance, all.lost += row.lost;
  Beyond beyond{all.lost / (kColumns * kRows), spec.background};
  const auto share = [](double radiance, double weight) { return weight > 0 ? radiance / weight : 0; };
  if (with_color && all.lost > 0)
    beyond.color = {share(all.radiance.r, all.weight.r), share(all.radiance.g, all.weight.g), share(all.radiance.b, all.weight.b)};
  return beyond;
}

std::vector<place::PlacedMesh> curtains(const place::PlacedRoom& room, std::uint16_t look) {
  std::vector<place::PlacedMesh> panels;
  const bool stacked = std::any_of(room.mirrors.begin(), room.mirrors.end(), [](const place::PlacedMirror& m) { return m.wall < 0; });
  for (const place::PlacedMirror& mirror : room.mirrors) {
    place::PlacedMesh panel;
    panel.name = "curtain";
    const auto add = [&](const geometry::Point& p, double z) { panel.floor.push_back(p), panel.z.push_back(z); };
    if (mirror.wall >= 0) {
      panel.kind = place::PartKind::wall, panel.wall = mirror.wall;
      // Into floor and ceiling, which hide it there: their edges are split otherwise, and nothing shall shine through between.
      const double bottom = mirror.height[0] - (stacked || mirror.height[0] > 0 ? 0 : kInto * room.height);
      const double top = mirror.height[1] + (stacked || mirror.height[1] < room.height ? 0 : kInto * room.height);
      const double length = mirror.span[1] - mirror.span[0];
      const auto pieces = static_cast<std::uint32_t>(std::clamp(std::ceil(length), 1.0, 64.0));   // walls of S² are long
      for (std::uint32_t k = 0; k <= pieces; ++k) {
        const geometry::Point p = room::point_on_wall(room.room, mirror.wall, mirror.span[0] + length * k / pieces);
        add(p, bottom), add(p, top);
        if (k == pieces) break;
        panel.triangles.push_back({2 * k, 2 * k + 2, 2 * k + 3});
        panel.triangles.push_back({2 * k, 2 * k + 3, 2 * k + 1});
      }
    } else {
      const bool floor = mirror.wall == -1;
      panel.kind = floor ? place::PartKind::floor : place::PartKind::ceiling;
      for (const geometry::Point& p : room.room.outline) add(p, floor ? 0 : room.height);
      const auto n = static_cast<std::uint32_t>(panel.floor.size());
      add({}, floor ? 0 : room.height);
      for (std::uint32_t k = 0; k < n; ++k) panel.triangles.push_back(floor ? mesh::Triangle{n, k, (k + 1) % n} : mesh::Triangle{n, (k + 1) % n, k});
    }
    panel.look.assign(panel.triangles.size(), look);
    panels.push_back(std::move(panel));
  }
  return panels;
}

std::vector<bool> cut_mirrors(const place::PlacedRoom& room, const scene::CoverSpec& spec, const cover::Copy& copy) {
  std::vector<bool> cut(room.mirrors.size(), false);
  for (std::size_t i = 0; i < room.mirrors.size(); ++i) {
    const place::PlacedMirror& mirror = room.mirrors[i];
    const bool last = copy.bounces >= spec.max_bounces || largest(mirror.reflectance * (mirror.tint * copy.weight)) < spec.min_weight;
    if (!last) continue;
    if (mirror.wall < 0) {
      // On a storey above one looks up, through what is its ceiling, or its floor when it stands on its head.
      const int way = mirror.wall == -2 ? 1 : -1, towards = copy.storey.sign > 0 ? way : -way;
      if (copy.storey.number * towards < 0) continue;
    }
    cut[i] = true;
  }
  return cut;
}

void hang(const place::PlacedRoom& room, const scene::CoverSpec& spec, const std::vector<cover::Copy>& copies, const std::vector<bend::Model::Part>& curtain,
          std::vector<bend::Model>& models, std::vector<std::uint32_t>& model_of_copy) {
  std::map<std::pair<std::uint32_t, std::vector<bool>>, std::uint32_t> known;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const std::vector<bool> cut = cut_mirrors(room, spec, copies[i]);
    if (std::find(cut.begin(), cut.end(), true) == cut.end()) continue;
    const auto [at, is_new] = known.try_emplace({model_of_copy[i], cut}, static_cast<std::uint32_t>(models.size()));
    if (is_new) {
      bend::Model model = models[model_of_copy[i]];
      for (std::size_t m = 0; m < curtain.size(); ++m)
        if (cut[m]) model.parts.push_back(curtain[m]);
      models.push_back(std::move(model));
    }
    model_of_copy[i] = at->second;
  }
}

}  // namespace orbc::driver
