#include "compiler/cutoff/impostor.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace orbc::cutoff {
namespace {

// Of the room's height: how far panels reach into floor and ceiling. Edges of floors far away are off by less.
constexpr double kFloorOverlap = 0.25;
// Shares of the way from the eye's height to floor and ceiling. Near the eye's height paths are longest.
constexpr double kBandShares[] = {0.08, 0.22, 0.42, 0.68};
// Of larger copies the step at the edge of the floor would be seen.
constexpr double kMaxUnsplitPx = 8;
constexpr double kMaxWallPieces = 64;

bool has_storeys(const place::Interior& room) {
  return std::any_of(room.mirrors.begin(), room.mirrors.end(), [](const place::PlacedMirror& m) { return m.wall < 0; });
}

/// The heights of a panel's vertices, and the styles between them.
struct PanelRows {
  std::vector<double> heights;
  std::vector<std::uint16_t> styles;  ///< one fewer
};

PanelRows panel_rows(double bottom, double top, std::uint16_t first_style, const std::vector<double>& bands) {
  PanelRows rows{{bottom}, {}};
  for (std::size_t b = 0; b <= bands.size(); ++b) {
    const double height = b < bands.size() ? std::min(bands[b], top) : top;
    if (!(height > rows.heights.back())) continue;
    rows.heights.push_back(height);
    rows.styles.push_back(static_cast<std::uint16_t>(first_style + b));
  }
  return rows;
}

/// A panel on a wall. Walls may be long, and long triangles are split into many: so the panel has columns of about unit length.
place::PlacedMesh wall_panel(const place::Interior& room, const place::PlacedMirror& mirror, const PanelRows& rows, bool unsplit) {
  place::PlacedMesh panel;
  panel.kind = place::PartKind::wall;
  panel.wall = mirror.wall;
  const double length = mirror.span[1] - mirror.span[0];
  const auto columns = unsplit ? 1U : static_cast<std::uint32_t>(std::clamp(std::ceil(length), 1.0, kMaxWallPieces));
  const auto height_count = static_cast<std::uint32_t>(rows.heights.size());
  for (std::uint32_t k = 0; k <= columns; ++k) {
    const geometry::Point p = room::point_on_wall(room.polygon, mirror.wall, mirror.span[0] + length * k / columns);
    for (const double z : rows.heights) {
      panel.floor.push_back(p);
      panel.z.push_back(z);
    }
    for (std::uint32_t j = 0; k < columns && j + 1 < height_count; ++j) {
      const std::uint32_t at = height_count * k + j;
      panel.triangles.push_back({at, at + height_count, at + height_count + 1});
      panel.triangles.push_back({at, at + height_count + 1, at + 1});
      panel.style.insert(panel.style.end(), 2, rows.styles[j]);
    }
  }
  return panel;
}

place::PlacedMesh horizontal_panel(const place::Interior& room, bool floor, std::uint16_t style) {
  place::PlacedMesh panel;
  panel.kind = floor ? place::PartKind::floor : place::PartKind::ceiling;
  panel.floor = room.polygon.outline;
  panel.floor.emplace_back();
  panel.z.assign(panel.floor.size(), floor ? 0 : room.height);
  const auto n = static_cast<std::uint32_t>(room.polygon.outline.size());
  for (std::uint32_t k = 0; k < n; ++k)
    panel.triangles.push_back(floor ? mesh::Triangle{n, k, (k + 1) % n} : mesh::Triangle{n, (k + 1) % n, k});
  panel.style.assign(panel.triangles.size(), style);
  return panel;
}

}  // namespace

std::vector<place::PlacedMesh> impostor_panels(const place::Interior& room, std::uint16_t first_style, const std::vector<double>& bands,
                                               bool unsplit) {
  std::vector<place::PlacedMesh> panels;
  const bool storeys = has_storeys(room);
  for (const place::PlacedMirror& mirror : room.mirrors) {
    if (mirror.wall >= 0) {
      // The edges of the panel and of floor and ceiling are split differently. Overlapping them leaves no gap between.
      const double bottom = mirror.height[0] - (storeys || mirror.height[0] > 0 ? 0 : kFloorOverlap * room.height);
      const double top = mirror.height[1] + (storeys || mirror.height[1] < room.height ? 0 : kFloorOverlap * room.height);
      panels.push_back(wall_panel(room, mirror, panel_rows(bottom, top, first_style, bands), unsplit));
    } else {
      panels.push_back(horizontal_panel(room, mirror.wall == -1, first_style));
    }
    panels.back().name = "curtain";
  }
  return panels;
}

bool can_skip_splitting(const place::Interior& room, double pixels) {
  return room.polygon.space != geometry::Space::spherical && pixels <= kMaxUnsplitPx;
}

std::vector<double> height_bands(const place::Interior& room, const place::Camera& eye) {
  std::vector<double> bands;
  if (has_storeys(room)) return bands;
  for (const double share : kBandShares) bands.insert(bands.begin(), eye.z * (1 - share));
  bands.push_back(eye.z);
  for (const double share : kBandShares) bands.push_back(eye.z + (room.height - eye.z) * share);
  return bands;
}

ImpostorPanels impostor_panels(const place::Interior& room, const place::Camera& eye) {
  const auto depth_style = static_cast<std::uint16_t>(room.styles.size()), first_band_style = static_cast<std::uint16_t>(depth_style + 1);
  const std::vector<double> bands = height_bands(room, eye);
  return {impostor_panels(room, depth_style), impostor_panels(room, first_band_style, bands),
          impostor_panels(room, first_band_style, bands, true)};
}

ModelsWithImpostors attach_impostors(const Endings& endings, const std::vector<cover::Copy>& copies, const Impostors& impostors,
                                     std::vector<bend::Model> models, std::vector<std::uint32_t> model_of_copy) {
  ModelsWithImpostors made{std::move(models), std::move(model_of_copy), 0};
  std::map<std::pair<std::uint32_t, std::vector<Ending>>, std::uint32_t> known;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    std::vector<Ending> ends = endings.of(copies[i]);
    if (impostors.depth.empty()) std::replace(ends.begin(), ends.end(), Ending::depth, Ending::none);
    if (impostors.size.empty()) std::replace(ends.begin(), ends.end(), Ending::size, Ending::none);
    const auto count = static_cast<std::uint64_t>(std::count_if(ends.begin(), ends.end(), [](Ending end) { return end != Ending::none; }));
    if (count == 0) continue;
    made.attached += count;
    const auto [at, is_new] = known.try_emplace({made.model_of_copy[i], ends}, static_cast<std::uint32_t>(made.models.size()));
    if (is_new) {
      bend::Model model = made.models[made.model_of_copy[i]];
      for (std::size_t m = 0; m < ends.size(); ++m)
        if (ends[m] != Ending::none) model.parts.push_back(ends[m] == Ending::depth ? impostors.depth[m] : impostors.size[m]);
      made.models.push_back(std::move(model));
    }
    made.model_of_copy[i] = at->second;
  }
  return made;
}

}  // namespace orbc::cutoff
