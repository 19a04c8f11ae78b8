// Writes products made by hand for the tests that draw them with real renderers: sample_products SAMPLE FORMAT FOLDER
//   SAMPLE  squares | codes | balls-PROJECTION | flat | empty | hollow | many | huge | one-texel, or a notation such as *237 for svg
//   FORMAT  pov | pipe | glb | gltf | nodes | svg | klein
// leaves FOLDER/SAMPLE.EXT and what belongs to it, and prints what is known of the sample as JSON.
#include <fmt/core.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "compiler/cover/enumerate.h"
#include "compiler/notation/parse.h"
#include "compiler/room/realise.h"
#include "compiler/scene/color.h"
#include "exporters/gltf/write_gltf.h"
#include "exporters/pov/write_pov.h"
#include "exporters/standpoint.h"
#include "exporters/svg/page.h"
#include "exporters/svg/palette.h"
#include "exporters/svg/write_svg.h"
#include "tests/support/products.h"

using namespace orbc;
using geometry::Vector3;

namespace {

std::array<float, 3> float3(const Vector3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// All 256 codes of an sRGB texel in 16 rows of other channels, drawn pixel by texel, at four weights in four bands of the picture.
driver::Product codes() {
  driver::Product product;
  product.title = "codes";
  product.eye.width = 256, product.eye.height = 64;
  product.eye.fov = Angle{2 * std::atan(0.5)};
  product.background = {0, 0, 0};
  product.atlas.width = 256, product.atlas.height = 16;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 256; ++x)
      for (const int v : {x, (x * 7 + y * 16) % 256, 255 - x, 255}) product.atlas.rgba.push_back(static_cast<std::uint8_t>(v));
  const scene::Color tints[4] = {{1, 1, 1}, {0.9, 0.9, 0.9}, {0.81, 0.6561, 0.5}, {0.1, 0.01, 0.0625}};
  for (int band = 0; band < 4; ++band) {
    // The picture's plane at distance 1 is 1 wide and 1/4 high; y falls to the right, z rises.
    const float top = 0.125f - 0.0625f * static_cast<float>(band), bottom = top - 0.0625f;
    test::add_copy(product, {{1, 0.5f, top}, {1, -0.5f, top}, {1, -0.5f, bottom}, {1, 0.5f, bottom}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                   {0, 1, 2, 0, 2, 3})
        .weight = tints[band];
  }
  return product;
}

struct Ball {
  Vector3 at;
  std::array<std::uint8_t, 3> color;
};

/// Small octahedra on every side of an eye with a tilted head, each in a colour of its own.
std::vector<Ball> add_balls(driver::Product& product, int count, const Vector3& center) {
  std::vector<Ball> balls;
  product.atlas = {};
  for (int i = 0; i < count; ++i) {
    // A Fibonacci sphere, at distances 2 to 6.
    const double z = 1 - 2 * (i + 0.5) / count, turn = 2.399963229728653 * i, radius = 2 + 4.0 * ((i * 7) % count) / count;
    const double rho = std::sqrt(1 - z * z);
    const Vector3 direction{rho * std::cos(turn), rho * std::sin(turn), z};
    Ball ball{
        center + radius * direction,
        {static_cast<std::uint8_t>(30 + 15 * (i % 15)), static_cast<std::uint8_t>(30 + 15 * (i / 15)), static_cast<std::uint8_t>(255 - i)}};
    test::add_texel(product.atlas, ball.color);
    balls.push_back(ball);
  }
  for (int i = 0; i < count; ++i) {
    const Ball& ball = balls[static_cast<std::size_t>(i)];
    const double r = 0.035 * length(ball.at - center);
    std::vector<std::array<float, 3>> positions;
    for (const Vector3& axis : {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}})
      for (const double sign : {1.0, -1.0}) positions.push_back(float3(ball.at + sign * r * axis));
    const std::array<float, 2> uv{static_cast<float>((i + 0.5) / count), 0.5f};
    test::add_copy(product, positions, std::vector<std::array<float, 2>>(6, uv),
                   {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5});
  }
  return balls;
}

/// Two thousand copies of a quad, each with its own weight.
driver::Product many() {
  driver::Product product = test::empty_product();
  for (int i = 0; i < 2000; ++i) {
    const float y = 0.02f * static_cast<float>(i % 50 - 25), z = 0.02f * static_cast<float>(i / 50 - 20);
    auto& copy = test::add_copy(product, {{1, y, z}, {1, y + 0.02f, z}, {1, y + 0.02f, z + 0.02f}, {1, y, z + 0.02f}},
                                {{0.25f, 0.5f}, {0.25f, 0.5f}, {0.25f, 0.5f}, {0.25f, 0.5f}}, {0, 1, 2, 0, 2, 3});
    copy.weight = {1 - i / 2000.0, 1, i / 2000.0};
    copy.word.assign(static_cast<std::size_t>(i % 12), static_cast<std::uint8_t>(i % 5));
    copy.bounces = i % 12;
  }
  return product;
}

driver::Product huge() {
  driver::Product product = test::two_squares();
  product.eye.width = 1, product.eye.height = 997;
  test::add_copy(product, {{1e30f, 0, 0}, {0, 3e38f, 0}, {0, 0, -3e38f}, {1e-38f, 1e-45f, -1e-20f}}, {{0, 0}, {1, 1}, {1e20f, -5}, {0, 0}},
                 {0, 1, 2, 3, 3, 3});
  return product;
}

std::string json(const Vector3& v) { return fmt::format("[{},{},{}]", v.x, v.y, v.z); }

void print_facts(const driver::Product& product, const std::vector<Ball>& balls) {
  const exporters::Standpoint at = exporters::standpoint(product);
  const place::Camera& eye = product.eye;
  fmt::print(
      "{{\"width\":{},\"height\":{},\"fov\":{},\"projection\":{},\"location\":{},\"forward\":{},\"right\":{},\"up\":{},\"background\":[{},{"
      "},{}],\"balls\":[",
      eye.width, eye.height, eye.fov.radians, static_cast<int>(eye.projection), json(at.location), json(at.forward), json(at.right),
      json(at.up), product.background.r, product.background.g, product.background.b);
  for (std::size_t i = 0; i < balls.size(); ++i)
    fmt::print("{}{{\"at\":{},\"color\":[{},{},{}]}}", i ? "," : "", json(balls[i].at), balls[i].color[0], balls[i].color[1],
               balls[i].color[2]);
  fmt::print("],\"tints\":[");
  for (std::size_t i = 0; i < product.copies.size() && i < 4; ++i)
    fmt::print("{}[{},{},{}]", i ? "," : "", product.copies[i].weight.r, product.copies[i].weight.g, product.copies[i].weight.b);
  fmt::print("]}}\n");
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

driver::Product make(const std::string& sample, std::vector<Ball>& balls) {
  if (sample == "squares") return test::two_squares();
  if (sample == "codes") return codes();
  if (sample == "empty") return test::empty_product();
  if (sample == "many") return many();
  if (sample == "huge") return huge();
  if (sample == "hollow") {
    driver::Product product = test::two_squares();
    product.copies[0].index_count = 0;
    return product;
  }
  if (sample == "one-texel") {
    driver::Product product = test::two_squares();
    product.atlas = {};
    test::add_texel(product.atlas, {200, 100, 50});
    return product;
  }
  driver::Product product = test::empty_product();
  product.eye = test::looking(0.7, -0.35, 0.4, 1.25);
  product.eye.width = 640, product.eye.height = 400;
  if (sample == "balls-perspective") {
    product.eye.fov = Angle::from_degrees(110);
  } else if (sample == "balls-panorama") {
    product.eye.projection = scene::Projection::panorama;
    product.eye.width = 800;
  } else if (sample == "balls-cylinder") {
    product.eye.projection = scene::Projection::cylinder;
    product.eye.fov = Angle::from_degrees(250);
  } else if (sample == "flat") {
    product.disk_view = true;
    product.eye.room_from_eye =
        geometry::translation_by(geometry::Space::hyperbolic, 0.8, -0.5) * geometry::rotation(geometry::Space::hyperbolic, 1.1);
    product.eye.fov = Angle::from_degrees(100);
  } else {
    throw std::runtime_error("unknown sample " + sample);
  }
  balls = add_balls(product, 150, exporters::standpoint(product).location);
  return product;
}

/// A tiling drawn as SVG; prints where the centre of each large copy must be on the page, and in which colour.
void write_tiling(const std::string& notation, bool klein, const std::string& folder) {
  driver::Tiling tiling;
  tiling.title = notation;
  tiling.model = klein ? driver::Tiling::Model::klein : driver::Tiling::Model::disk;
  tiling.room = room::realise(*notation::parse(notation)).value();
  std::vector<geometry::Isometry> reflections;
  for (std::size_t i = 0; i < tiling.room.walls.size(); ++i)
    if (tiling.room.walls[i].reflects) reflections.push_back(room::reflection_in_wall(tiling.room, static_cast<int>(i)));
  const int depth = 12;
  cover::enumerate(cover::Automaton(tiling.room.orbifold, depth), reflections, depth,
                   [&](const cover::Element& element, const geometry::Isometry& map) {
                     cover::Copy copy;
                     copy.cover_from_room = map;
                     copy.word.assign(element.word.begin(), element.word.end());
                     tiling.copies.push_back(copy);
                     return (map * geometry::Point()).w > 40 ? cover::Visit::prune : cover::Visit::descend;  // near the rim of the disk
                   });
  write(folder + "/tiling.svg", svg::write_svg(tiling)[0].bytes);
  const std::vector<svg::Piece> pieces = svg::outline_pieces(tiling.room);
  const svg::Page page = svg::make_page(tiling, pieces, svg::SvgOptions().width);
  fmt::print("{{\"centres\":[");
  bool first = true;
  int longest = 1;
  for (const cover::Copy& copy : tiling.copies) {
    const geometry::Point center = copy.cover_from_room * geometry::Point();
    // Unseen, or on the dotted equator
    if (tiling.room.space == geometry::Space::spherical && (center.w < (klein ? 0.5 : -0.9) || std::abs(center.w) < 0.02)) continue;
    const std::complex<double> at = svg::on_page(page, center);
    if (svg::tile_path(page, pieces, copy.cover_from_room).diameter < 60 || std::abs(at - page.middle) > 0.97 * page.width / 2) continue;
    fmt::print("{}[{},{},\"{}\"]", first ? "" : ",", at.real(), at.imag(), svg::fill_of(copy, longest, tiling.coloring));
    first = false;
  }
  fmt::print("]}}\n");
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) {
    fmt::print(stderr, "usage: sample_products SAMPLE FORMAT FOLDER\n");
    return 2;
  }
  const std::string sample = argv[1], format = argv[2], folder = argv[3];
  if (format == "svg" || format == "klein") {
    write_tiling(sample, format == "klein", folder);
    return 0;
  }
  std::vector<Ball> balls;
  const driver::Product product = make(sample, balls);
  std::vector<driver::File> files;
  std::string extension = format;
  if (format == "pov" || format == "pipe") {
    files = pov::write_pov(product, {.name = sample, .inline_atlas = format == "pipe"});
    extension = "pov";
  } else {
    files = gltf::write_gltf(product, {.name = sample, .binary = format != "gltf", .nodes_per_copy = format == "nodes"});
    if (format == "nodes") extension = "glb";
  }
  for (const driver::File& file : files) write(folder + "/" + (file.name.empty() ? sample + "." + extension : file.name), file.bytes);
  print_facts(product, balls);
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "sample_products: {}\n", error.what());
  return 1;
}
