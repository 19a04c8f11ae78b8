#include <algorithm>
#include <catch2/catch.hpp>

#include "compiler/bend/log_map.h"
#include "compiler/lod/budget.h"
#include "compiler/lod/build.h"
#include "compiler/mesh/analyse.h"
#include "tests/unit/bend/fixture.h"

using namespace orbc;
using namespace orbc::bend::test;

namespace {

place::Interior room_with_knot(int corners) {
  Furnishing with;
  with.knot_along = 200;
  with.knot_around = 16;
  auto room = regular_room(corners, 2, with);
  for (auto& part : room.parts) part.style.assign(part.triangles.size(), 2);
  return room;
}

/// The surface in the disk, as a plain mesh.
mesh::Mesh in_disk(geometry::Space space, const place::PlacedMesh& part) {
  mesh::Mesh mesh;
  for (std::size_t i = 0; i < part.floor.size(); ++i) {
    const auto z = geometry::disk_from_point(space, part.floor[i]);
    mesh.positions.push_back({z.real(), z.imag(), part.z[i]});
  }
  mesh.triangles = part.triangles;
  return mesh;
}

}  // namespace

TEST_CASE("levels are made of the heavy part alone, ever coarser, closed as it is, of its own vertices", "[lod]") {
  const auto room = room_with_knot(GENERATE(3, 4, 5));
  const auto lods = lod::build_lods(room, serial_executor());
  REQUIRE(room_part_count(lods) == room.parts.size());
  REQUIRE(lods.surface_offset.size() == lods.interior.parts.size());
  for (std::size_t p = 0; p + 1 < room.parts.size(); ++p)
    CHECK(lods.part_of_level[p] == std::vector<std::uint32_t>(1, static_cast<std::uint32_t>(p)));
  const auto& part = room.parts.back();
  const auto& chain = lods.part_of_level.back();
  REQUIRE(chain.size() >= 5);
  CHECK(lods.surface_offset[chain[0]] == 0);
  std::size_t triangles = part.triangles.size();
  double offset = 0;
  for (std::size_t level = 1; level < chain.size(); ++level) {
    const place::PlacedMesh& mesh = lods.interior.parts[chain[level]];
    CHECK(mesh.triangles.size() < triangles);
    CHECK(lods.surface_offset[chain[level]] >= offset);
    CHECK(mesh::analyse(in_disk(room.polygon.space, mesh)).closed);
    CHECK(mesh.style.size() == mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.floor.size(); i += 7)
      CHECK(std::any_of(part.floor.begin(), part.floor.end(),
                        [&](const auto& p) { return p.w == mesh.floor[i].w && p.x == mesh.floor[i].x && p.y == mesh.floor[i].y; }));
    triangles = mesh.triangles.size();
    offset = lods.surface_offset[chain[level]];
  }
  CHECK(lods.surface_offset[chain[1]] > 0);
  CHECK(offset < 0.2);
}

TEST_CASE("no point of the picture is displaced by more than the levels' bound", "[lod]") {
  const auto room = room_with_knot(GENERATE(3, 4, 5));
  const auto space = room.polygon.space;
  const auto lods = lod::build_lods(room, serial_executor());
  auto copies = copies_of(room, 4);
  if (space == geometry::Space::spherical) copies = with_sheets(copies, 3, 2);
  const auto eye = eye_at(space, 0.2, 1.0, 0.4, 0.3, 0.1);
  const bend::BendOptions options;
  const auto selection = lod::select_lods(lods, copies, eye, options);
  CHECK(selection.error_px <= options.tolerance_px);
  REQUIRE(selection.model_of_copy.size() == copies.size());
  const bend::ScreenSize detail(eye, options);
  const auto& part = room.parts.back();
  const auto extent = bend::bounding_cylinder(space, part);
  const bend::ScreenMetric metric = bend::screen_metric(eye, options);
  bool any = false;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    any = any || selection.levels_of_model[selection.model_of_copy[i]].back() > 0;
    const double pixels = detail.pixels_per_length(copies[i], extent, 0.01);
    if (!(pixels < 1e6)) continue;
    // Small steps in the three directions move a seen point by no more than the bound says.
    const bend::LogMap map{space, geometry::matrix(inverse(eye.room_from_eye) * copies[i].cover_from_room), copies[i].sheet};
    for (std::size_t v = 0; v < part.floor.size(); v += 97) {
      const auto p = bend::bent_position(map, part.floor[v], part.z[v]) - metric.eye;
      const auto frame = geometry::translation_to(space, part.floor[v]);
      for (int axis = 0; axis < 3; ++axis) {
        constexpr double step = 1e-5;
        const auto moved = frame * geometry::point_from_log(space, {axis == 0 ? step : 0, axis == 1 ? step : 0});
        const auto q = bend::bent_position(map, moved, part.z[v] + (axis == 2 ? step : 0)) - metric.eye;
        const double angle = length(cross(p, q)) / length(p) / length(q);
        const double seen = angle * (dot(p, eye.forward) > 0 ? bend::pixels_per_radian_at(metric, geometry::normalised(p)) : 0);
        CHECK(seen <= pixels * step * 1.001 * bend::kOffscreenFactor);
        if (bend::pixels_per_radian_at(metric, geometry::normalised(p)) > 0 && place::pixel_of(eye, p)) {
          const auto at = *place::pixel_of(eye, p);
          if (at[0] > 0 && at[1] > 0 && at[0] < eye.width && at[1] < eye.height) CHECK(seen <= pixels * step * 1.001);
        }
      }
    }
  }
  CHECK(any);
}

TEST_CASE("what levels save is the difference to full detail", "[lod]") {
  const auto room = room_with_knot(5);
  const auto lods = lod::build_lods(room, serial_executor());
  const auto copies = copies_of(room, 4);
  const auto stats = lod::lod_stats(lods, lod::select_lods(lods, copies, eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1), {}));
  const auto full = lod::lod_stats(lods, lod::full_detail(lods, copies.size()));
  CHECK(full.triangles_saved == 0);
  CHECK(stats.triangles_saved > 0);
  CHECK(stats.triangles + stats.triangles_saved == full.triangles);
  CHECK(*std::max_element(stats.level_of_copy.begin(), stats.level_of_copy.end()) > 0);
  CHECK(*std::max_element(full.level_of_copy.begin(), full.level_of_copy.end()) == 0);
}

TEST_CASE("a budget of triangles is met, with less error the more there may be", "[lod]") {
  const auto room = room_with_knot(GENERATE(4, 5));
  const auto lods = lod::build_lods(room, serial_executor());
  const auto copies = copies_of(room, 4);
  const auto eye = eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1);
  scene::CoverSpec cover;
  auto panels = cutoff::impostor_panels(room, eye);
  if (GENERATE(false, true)) cover.max_bounces = 4;  // panels all round
  else panels.depth.clear();
  lod::BudgetScene scene{lods, {}, eye, cover, panels};
  for (const auto& part : lods.interior.parts) scene.drawn.push_back(&part);
  const auto fit_to = [&](std::uint64_t budget, const bend::BendOptions& options) {
    return lod::fit_to_budget(scene, copies, budget, options, serial_executor());
  };
  const bend::BendOptions options;
  bend::BendOptions one_pixel;
  one_pixel.tolerance_px = 1;
  double last = 1e9;
  bool culls = false;
  for (const std::uint64_t budget : {2'000, 20'000, 1'000'000}) {
    const auto fit = fit_to(budget, options);
    REQUIRE(fit.has_value());
    CHECK(fit->triangles <= budget);
    // The eye stands close to the knot: what is around it becomes coarse last of all.
    if (budget >= 20'000) CHECK(fit->triangles >= std::min<std::uint64_t>(budget, 60'000) / 8);
    CHECK(fit->tolerance_px <= last);
    CHECK(fit->copies.size() + fit->culled == copies.size());
    CHECK((fit->culled > 0) == (fit->cull_px > 0));
    // All copies become coarser before any is culled: without culling a tolerance of one pixel does not suffice either.
    if (fit->culled > 0) {
      culls = true;
      const auto coarse = fit_to(budget, one_pixel);
      CHECK((coarse.has_value() && coarse->culled > 0));
    }
    CHECK(fit->selection.error_px <= fit->tolerance_px);
    last = fit->tolerance_px;
    if (budget == 1'000'000) CHECK(fit->tolerance_px == options.tolerance_px);
  }
  CHECK(culls);
  const auto refused = fit_to(10, options);
  REQUIRE(!refused.has_value());
  CHECK(refused.error().front().code == "bend.too-dense");
}
