#include "compiler/driver/budget.h"
#include "compiler/driver/levels.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "compiler/bend/log_map.h"
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

TEST_CASE("levels are made of the heavy part alone, ever coarser, closed as it is, of its own vertices", "[driver]") {
  const auto room = room_with_knot(GENERATE(3, 4, 5));
  const auto levels = driver::make_levels(room, serial_executor());
  REQUIRE(levels.size() == room.parts.size());
  for (std::size_t p = 0; p + 1 < levels.size(); ++p) CHECK(levels[p].empty());
  const auto& part = room.parts.back();
  REQUIRE(levels.back().size() >= 4);
  std::size_t triangles = part.triangles.size();
  double error = 0;
  for (const auto& level : levels.back()) {
    CHECK(level.mesh.triangles.size() < triangles);
    CHECK(level.error >= error);
    CHECK(mesh::analyse(in_disk(room.polygon.space, level.mesh)).closed);
    CHECK(level.mesh.style.size() == level.mesh.triangles.size());
    for (std::size_t i = 0; i < level.mesh.floor.size(); i += 7)
      CHECK(std::any_of(part.floor.begin(), part.floor.end(), [&](const auto& p) {
        return p.w == level.mesh.floor[i].w && p.x == level.mesh.floor[i].x && p.y == level.mesh.floor[i].y;
      }));
    triangles = level.mesh.triangles.size(), error = level.error;
  }
  CHECK(levels.back().front().error > 0);
  CHECK(error < 0.2);
}

TEST_CASE("no point of the picture is displaced by more than the levels' bound", "[driver]") {
  const auto room = room_with_knot(GENERATE(3, 4, 5));
  const auto space = room.polygon.space;
  const auto levels = driver::make_levels(room, serial_executor());
  auto copies = copies_of(room, 4);
  if (space == geometry::Space::spherical) copies = with_sheets(copies, 3, 2);
  const auto eye = eye_at(space, 0.2, 1.0, 0.4, 0.3, 0.1);
  const bend::BendOptions options;
  const auto choice = driver::choose_levels(room, levels, copies, eye, options);
  CHECK(choice.error_px <= options.tolerance_px);
  REQUIRE(choice.model_of_copy.size() == copies.size());
  const bend::ScreenSize detail(eye, options);
  const auto& part = room.parts.back();
  const auto extent = bend::bounding_cylinder(space, part);
  const bend::ScreenMetric sight = bend::screen_metric(eye, options);
  bool any = false;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    any = any || choice.models[choice.model_of_copy[i]].back() > 0;
    const double pixels = detail.pixels_per_length(copies[i], extent, 0.01);
    if (!(pixels < 1e6)) continue;
    // Small steps in the three directions move a seen point by no more than the bound says.
    const bend::LogMap map{space, geometry::matrix(inverse(eye.room_from_eye) * copies[i].cover_from_room), copies[i].sheet};
    for (std::size_t v = 0; v < part.floor.size(); v += 97) {
      const auto p = bend::bent_position(map, part.floor[v], part.z[v]) - sight.eye;
      const auto frame = geometry::translation_to(space, part.floor[v]);
      for (int axis = 0; axis < 3; ++axis) {
        constexpr double step = 1e-5;
        const auto moved = frame * geometry::point_from_log(space, {axis == 0 ? step : 0, axis == 1 ? step : 0});
        const auto q = bend::bent_position(map, moved, part.z[v] + (axis == 2 ? step : 0)) - sight.eye;
        const double angle = length(cross(p, q)) / length(p) / length(q);
        const double seen = angle * (dot(p, eye.forward) > 0 ? bend::pixels_per_radian_at(sight, geometry::normalised(p)) : 0);
        CHECK(seen <= pixels * step * 1.001 * bend::kOffscreenFactor);
        if (bend::pixels_per_radian_at(sight, geometry::normalised(p)) > 0 && place::pixel_of(eye, p)) {
          const auto at = *place::pixel_of(eye, p);
          if (at[0] > 0 && at[1] > 0 && at[0] < eye.width && at[1] < eye.height) CHECK(seen <= pixels * step * 1.001);
        }
      }
    }
  }
  CHECK(any);
}

TEST_CASE("the stock holds the levels in use, and each once", "[driver]") {
  const auto room = room_with_knot(5);
  const auto levels = driver::make_levels(room, serial_executor());
  const auto copies = copies_of(room, 4);
  const auto choice = driver::choose_levels(room, levels, copies, eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1), {});
  const auto stock = driver::stock_of(room, levels, choice);
  CHECK(stock.room.parts.size() > room.parts.size());
  CHECK(stock.room.parts.size() <= room.parts.size() + levels.back().size());
  for (const auto& model : choice.models)
    for (std::size_t p = 0; p < model.size(); ++p) {
      const auto& mesh = stock.room.parts[stock.part_of_level[p][model[p]]];
      CHECK(mesh.triangles == (model[p] == 0 ? room.parts[p] : levels[p][model[p] - 1].mesh).triangles);
    }
}

TEST_CASE("a budget of triangles is met, with less error the more there may be", "[driver]") {
  driver::Opened opened;
  opened.room = std::make_unique<place::Interior>(room_with_knot(GENERATE(4, 5)));
  const auto& room = *opened.room;
  const auto levels = driver::make_levels(room, serial_executor());
  const auto copies = copies_of(room, 4);
  opened.eye = eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1);
  const bool expected = GENERATE(false, true);
  if (expected) opened.scene.cover.max_bounces = 4;   // panels all round
  const bend::BendOptions options;
  double last = 1e9;
  for (const std::uint64_t budget : {2'000, 20'000, 1'000'000}) {
    const auto fitted = driver::fit_to_budget(opened, levels, copies, budget, options, expected, serial_executor());
    REQUIRE(fitted.has_value());
    CHECK(fitted->triangles <= budget);
    // The eye stands close to the knot: what is around it becomes coarse last of all.
    if (budget >= 20'000) CHECK(fitted->triangles >= std::min<std::uint64_t>(budget, 60'000) / 8);
    CHECK(fitted->tolerance_px <= last);
    CHECK(fitted->copies.size() + fitted->left_out == copies.size());
    CHECK((fitted->left_out > 0) == (fitted->left_out_px > 0));
    // All copies become coarser before any is left out.
    if (fitted->tolerance_px < 1 && fitted->left_out > 0) CHECK_FALSE(driver::fit_to_budget(opened, levels, copies, budget, [&] {
      bend::BendOptions pixel = options;
      pixel.tolerance_px = 1;
      return pixel;
    }(), expected, serial_executor())->left_out == 0);
    CHECK(fitted->choice.error_px <= fitted->tolerance_px);
    last = fitted->tolerance_px;
    if (budget == 1'000'000) CHECK(fitted->tolerance_px == options.tolerance_px);
  }
  const auto refused = driver::fit_to_budget(opened, levels, copies, 10, options, expected, serial_executor());
  REQUIRE(!refused.has_value());
  CHECK(refused.error().front().code == "bend.too-dense");
}
