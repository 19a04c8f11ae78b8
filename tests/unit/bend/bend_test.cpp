#include "compiler/bend/bend.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstring>
#include <thread>

#include "tests/unit/bend/fixture.h"

using namespace orbc;
using namespace orbc::bend;
using namespace orbc::bend::test;

namespace {

Executor threads(int count) {
  return [count](std::size_t tasks, const std::function<void(std::size_t)>& task) {
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> all;
    for (int i = 0; i < count; ++i) {
      all.emplace_back([&] {
        for (std::size_t t = next++; t < tasks; t = next++) task(t);
      });
    }
    for (auto& thread : all) thread.join();
  };
}

BentCover bent(const Interior& room, const std::vector<cover::Copy>& copies, const place::Camera& eye, const BendOptions& options = {},
               const Executor& executor = serial_executor()) {
  auto result = bend_whole(room, plain_uv(room), copies, eye, options, executor);
  if (!result) FAIL(to_text(result.error()));
  return std::move(result).value();
}

}  // namespace

TEST_CASE("bending gives the same bytes for any number of threads", "[bend]") {
  Furnishing with;
  with.knot_along = 60;
  with.walls = true;
  const auto room = regular_room(GENERATE(3, 4, 5), 2, with);
  auto copies = copies_of(room, 3);
  if (room.polygon.space == Space::spherical) copies = with_sheets(copies, 3, 2);
  const auto eye = eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1);
  const auto one = bent(room, copies, eye), three = bent(room, copies, eye, {}, threads(3));
  REQUIRE(one.positions.size() == three.positions.size());
  CHECK(std::memcmp(one.positions.data(), three.positions.data(), one.positions.size() * sizeof(one.positions[0])) == 0);
  CHECK(one.uv == three.uv);
  CHECK(one.indices == three.indices);
}

TEST_CASE("every copy owns its range and nothing is left between", "[bend]") {
  const auto room = regular_room(5, 2);
  const auto copies = copies_of(room, 3);
  const auto cover = bent(room, copies, eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1));
  std::size_t vertex = 0, index = 0;
  REQUIRE(cover.copies.size() == copies.size());
  for (const auto& range : cover.copies) {
    CHECK(range.first_vertex == vertex);
    CHECK(range.first_index == index);
    for (std::size_t i = 0; i < range.index_count; ++i) {
      const auto v = cover.indices[range.first_index + i];
      if (v < vertex || v >= vertex + range.vertex_count) FAIL("an index leaves its copy");
    }
    vertex += range.vertex_count;
    index += range.index_count;
  }
  CHECK(cover.positions.size() == vertex);
  CHECK(cover.indices.size() == index);
  CHECK(cover.error_bound_px <= 0.25);
  CHECK(cover.error_bound_px > 0.01);
}

TEST_CASE("in the plane bending only moves", "[bend]") {
  const auto room = regular_room(4, 2);
  const auto copies = copies_of(room, 4);
  const auto cover = bent(room, copies, eye_at(Space::euclidean, 0.3, 1.0, 0.4, 0.3, 0.1));
  CHECK(cover.split_parts == 0);
  CHECK(cover.error_bound_px == 0);
  for (std::size_t c = 0; c < copies.size(); ++c) {
    const auto p = copies[c].cover_from_room * room.parts[0].floor[1];
    const auto& got = cover.positions[cover.copies[c].first_vertex + 1];
    CHECK(got[0] == Approx(p.x - 0.3 * std::cos(1.0)).margin(1e-6));
    CHECK(got[1] == Approx(p.y - 0.3 * std::sin(1.0)).margin(1e-6));
    CHECK(got[2] == 0);
  }
}

TEST_CASE("a wall is drawn by the nearer of its two copies only", "[bend]") {
  Furnishing with;
  with.walls = true;
  const auto room = regular_room(4, 2, with);
  const auto copies = copies_of(room, 2);
  const auto cover = bent(room, copies, eye_at(Space::euclidean, 0.3, 1.0, 0.4, 0.3, 0.1));
  const std::size_t level = room.parts[0].triangles.size() + room.parts[1].triangles.size();
  for (std::size_t c = 0; c < copies.size(); ++c) {
    int drawn = 0;
    for (int wall = 0; wall < 4; ++wall) drawn += !((copies[c].eye_facing_walls >> wall) & 1);
    CHECK(cover.copies[c].index_count == 3 * (level + 2 * static_cast<std::size_t>(drawn)));
  }
}

TEST_CASE("triangles keep their outside in mirror images", "[bend]") {
  const auto room = regular_room(GENERATE(3, 4, 5), 2);
  auto copies = copies_of(room, 3);
  if (room.polygon.space == Space::spherical) copies = with_sheets(copies, 3, 3);
  auto eye = eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1);
  eye.projection = scene::Projection::panorama;
  BendOptions options;
  options.tolerance_px = 0.02;
  const auto cover = bent(room, copies, eye, options);
  double turned = 0, whole = 0;
  for (std::size_t i = 0; i < cover.indices.size(); i += 3) {
    const auto &a = cover.positions[cover.indices[i]], &b = cover.positions[cover.indices[i + 1]],
               &c = cover.positions[cover.indices[i + 2]];
    if (a[2] != 0 || b[2] != 0 || c[2] != 0) continue;
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (area < -0.05) FAIL("a floor triangle shows its underside: " << area);
    if (area < 0) turned -= area;
    whole += area;
  }
  CHECK(turned < 0.01 * whole);  // slivers may turn over within the tolerance
}

TEST_CASE("too dense a cover is refused with a tolerance that fits", "[bend]") {
  const auto room = regular_room(5, 2);
  const auto copies = copies_of(room, 2);
  const auto eye = eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1);
  BendOptions options;
  options.tolerance_px = 1e-4;
  options.max_triangles = 20'000;
  const auto refused = bend_whole(room, plain_uv(room), copies, eye, options);
  REQUIRE(!refused);
  const auto& diagnostic = refused.error().front();
  CHECK(diagnostic.code == "bend.too-dense");
  double fits = 0;
  REQUIRE(std::sscanf(diagnostic.hint.c_str(), "a tolerance of %lf px fits", &fits) == 1);
  options.tolerance_px = fits;
  CHECK(bend_whole(room, plain_uv(room), copies, eye, options).has_value());
  options.max_triangles = 100;
  const auto never = bend_whole(room, plain_uv(room), copies, eye, options);
  REQUIRE(!never);
  CHECK(never.error().front().hint.find("max_bounces") != std::string::npos);
}

TEST_CASE("the disk view is the conformal chart, whatever the eye", "[bend]") {
  const auto room = regular_room(GENERATE(3, 4, 5), 2);
  auto copies = copies_of(room, 3);
  if (room.polygon.space == Space::spherical) copies = with_sheets(copies, 3, 1);
  BendOptions options;
  options.view = View::disk;
  const auto cover = bent(room, copies, eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1), options);
  for (std::size_t c = 0; c < copies.size(); ++c) {
    if (copies[c].sheet > 0) {
      CHECK(cover.copies[c].index_count == 0);
      continue;
    }
    for (std::size_t i = 0; i < room.parts[0].floor.size(); ++i) {
      const Point p = copies[c].cover_from_room * room.parts[0].floor[i];
      if (p.w < -0.99) continue;
      const auto z = geometry::disk_from_point(room.polygon.space, p);
      const auto& got = cover.positions[cover.copies[c].first_vertex + i];
      CHECK(got[0] == Approx(z.real()).margin(1e-6).epsilon(1e-6));
      CHECK(got[1] == Approx(z.imag()).margin(1e-6).epsilon(1e-6));
    }
  }
}

TEST_CASE("work stops when the user asks", "[bend]") {
  const auto room = regular_room(5, 2);
  std::atomic<bool> cancelled{true};
  Progress progress;
  progress.cancelled = &cancelled;
  const auto uv = plain_uv(room);
  const auto copies = copies_of(room, 2);
  const std::array models{whole_model(room, uv)};
  const auto eye = eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1);
  CHECK_THROWS_AS(bend::bend(room, {copies, models, {}}, eye, {}, serial_executor(), progress), Cancelled);
}

TEST_CASE("each copy is drawn from its own model, and models share what they have in common", "[bend]") {
  const auto room = regular_room(5, 2);
  const auto uv = plain_uv(room);
  const auto copies = copies_of(room, 3);
  const auto eye = eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1);
  const auto plain = bend_whole(room, uv, copies, eye);
  REQUIRE(plain.has_value());

  // The second model lacks the first part and has other colours elsewhere.
  std::vector<Uv> other = uv;
  for (auto& part : other)
    for (auto& at : part) at = {0.75F, 0.25F};
  std::vector<Model> models{whole_model(room, uv), whole_model(room, other)};
  models[1].parts.erase(models[1].parts.begin());
  std::vector<std::uint32_t> model_of_copy;
  for (std::size_t i = 0; i < copies.size(); ++i) model_of_copy.push_back(i % 2);
  const auto mixed = bend::bend(room, {copies, models, model_of_copy}, eye, {}, serial_executor());
  REQUIRE(mixed.has_value());
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const BentRange &a = plain->copies[i], &b = mixed->copies[i];
    if (i % 2 == 1) {
      CHECK(b.vertex_count < a.vertex_count);
      CHECK(std::all_of(mixed->uv.begin() + static_cast<std::ptrdiff_t>(b.first_vertex),
                        mixed->uv.begin() + static_cast<std::ptrdiff_t>(b.first_vertex + b.vertex_count),
                        [](const auto& at) { return at == std::array<float, 2>{0.75F, 0.25F}; }));
      continue;
    }
    REQUIRE(b.vertex_count == a.vertex_count);
    CHECK(std::equal(plain->positions.begin() + static_cast<std::ptrdiff_t>(a.first_vertex),
                     plain->positions.begin() + static_cast<std::ptrdiff_t>(a.first_vertex + a.vertex_count),
                     mixed->positions.begin() + static_cast<std::ptrdiff_t>(b.first_vertex)));
  }
}

TEST_CASE("a part that must not be split is drawn with its own triangles", "[bend]") {
  const auto room = regular_room(5, 2);
  const auto uv = plain_uv(room);
  const auto copies = copies_of(room, 1);
  const auto eye = eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1);
  BendOptions fine;
  fine.tolerance_px = 0.01;
  Model model = whole_model(room, uv);
  std::size_t triangles = 0;
  for (Model::Part& part : model.parts) part.unsplit = true;
  for (const auto& part : room.parts) triangles += part.triangles.size();
  const std::vector<cover::Copy> first{copies.front()};
  const std::array models{model};
  const auto flat = bend::bend(room, {first, models, {}}, eye, fine, serial_executor());
  const auto split = bend_whole(room, uv, first, eye, fine);
  REQUIRE((flat.has_value() && split.has_value()));
  CHECK(flat->indices.size() == 3 * triangles);
  CHECK(split->indices.size() > 3 * triangles);
}
