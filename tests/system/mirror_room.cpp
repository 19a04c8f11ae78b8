// The Euclidean room as POV-Ray sees it with true mirrors: only the room itself is exported, its mirrors are POV-Ray's own. Whatever
// unfolding and copying do wrong, this picture does right. A scene with point lamps is lit by POV-Ray as well, straight from the lamps:
// nothing of ours but points, triangles and normals is in it.   mirror_room SCENE.yaml OUT.pov
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "compiler/driver/compile.h"
#include "compiler/light/lamp.h"
#include "compiler/room/room.h"
#include "compiler/surface/normals.h"
#include "exporters/pov/write_pov.h"

namespace {

using namespace orbc;

/// A mirror. In: its lengths are multiplied by `factor`, as products have the author's unit of length and loaded scenes one of their own.
std::string mirror_quad(const driver::LoadedScene& loaded, const place::PlacedMirror& mirror, double factor) {
  const geometry::Isometry eye_from_room = geometry::inverse(loaded.eye.room_from_eye);
  const auto corner = [&](int side, int level) {
    const geometry::Point p = eye_from_room * room::point_on_wall(loaded.interior->polygon, mirror.wall, mirror.span[side]);
    return fmt::format("<{:.17g},{:.17g},{:.17g}>", factor * p.x, factor * p.y, factor * mirror.height[level]);
  };
  const scene::Color c = mirror.throughput;
  return fmt::format(
      "mesh2 {{ vertex_vectors {{ 4, {},{},{},{} }} face_indices {{ 2, <0,1,2>,<0,2,3> }} texture {{ pigment {{ rgb 0 }} finish {{ ambient "
      "0 diffuse 0 emission 0 "
      "reflection {{ rgb <{:.17g},{:.17g},{:.17g}> }} }} }} }}\n",
      corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1), c.r, c.g, c.b);
}

std::string vector(double x, double y, double z) { return fmt::format("<{:.9g},{:.9g},{:.9g}>", x, y, z); }
std::string vector(const scene::Color& c) { return vector(c.r, c.g, c.b); }

/// A part as matte triangles with the normals by which it is lit. Ambient light is emission times the pigment, and adds to what lamps give.
std::string matte_part(const driver::LoadedScene& loaded, const place::PlacedMesh& part) {
  const geometry::Isometry eye_from_room = geometry::inverse(loaded.eye.room_from_eye);
  const surface::PartNormals normals = surface::part_normals(*loaded.interior, part);
  if (part.triangles.empty()) return {};
  std::string points, directions, faces, looks;
  for (const surface::ShadingVertex& v : normals.vertices) {
    const geometry::Point at = part.floor[v.vertex], p = eye_from_room * at;
    const geometry::Point beside = eye_from_room * geometry::Point(at.w, at.x + v.normal.floor.x, at.y + v.normal.floor.y);
    points += ", " + vector(p.x, p.y, part.z[v.vertex]);
    directions += ", " + vector(beside.x - p.x, beside.y - p.y, v.normal.z);
  }
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    const auto& c = normals.corners[t];
    faces += fmt::format(", <{},{},{}>,{}", c[0], c[1], c[2], part.style[t]);
  }
  for (const place::SurfaceStyle& look : loaded.interior->styles)
    looks += fmt::format(", texture {{ pigment {{ rgb {} }} finish {{ ambient 0 diffuse 1 emission rgb {} }} }}", vector(look.color),
                         vector(loaded.scene.exposure * loaded.scene.ambient));
  return fmt::format(
      "mesh2 {{ vertex_vectors {{ {0}{1} }} normal_vectors {{ {0}{2} }} texture_list {{ {3}{4} }} face_indices {{ {5}{6} }} }}\n",
      normals.vertices.size(), points, directions, loaded.interior->styles.size(), looks, part.triangles.size(), faces);
}

/// Radiance of a matte surface is albedo · E/π with E = Φ·cosθ/(4πr²); POV-Ray shows albedo · c·cosθ · 2/(1 + (r/D)²), which for D ≪ r is
/// 2cD²/r². So c = exposure · Φ/(8π²D²), too large by D²/r² of itself: with D = 1/1000 less than 1/10,000 from r = 1/10 on.
std::string point_lamp(const driver::LoadedScene& loaded, const light::PlacedLamp& lamp) {
  constexpr double kFadeDistance = 0.001;
  const geometry::Point p = geometry::inverse(loaded.eye.room_from_eye) * lamp.centre.floor;
  const double gain = loaded.scene.exposure / (8 * std::numbers::pi * std::numbers::pi * kFadeDistance * kFadeDistance);
  return fmt::format("light_source {{ {}, rgb {} fade_power 2 fade_distance {} }}\n", vector(p.x, p.y, lamp.centre.z),
                     vector(gain * lamp.power), kFadeDistance);
}

/// The room and its lamps, instead of the room with its light in an atlas.
Result<std::string> lit_room(const driver::LoadedScene& loaded) {
  const auto hung = light::place_lamps(loaded.scene, loaded.interior->polygon);
  if (!hung) return hung.error();
  std::string text;
  for (const place::PlacedMesh& part : loaded.interior->parts) text += matte_part(loaded, part);
  for (const light::PlacedLamp& lamp : hung->lamps) text += point_lamp(loaded, lamp);
  return text;
}

void write(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto loaded = driver::load(argv[1], {{"max_bounces", "cover.max_bounces=0"}});
  if (!loaded) return fmt::print(stderr, "{}", to_text(loaded.error())), 1;
  driver::Product product;  // of a lit room only camera and background
  double factor = 1;
  std::string lit;
  if (loaded->scene.lamps.empty()) {
    auto compiled = driver::compile(*loaded, {}, serial_executor());
    if (!compiled) return fmt::print(stderr, "{}", to_text(compiled.error())), 1;
    product = std::move(compiled->product);
    factor = 1 / loaded->unit_of_length;
  } else {
    auto text = lit_room(*loaded);
    if (!text) return fmt::print(stderr, "{}", to_text(text.error())), 1;
    product.eye = loaded->eye;
    product.background = loaded->scene.cover.background;
    lit = std::move(*text);
  }
  const std::string out = argv[2];
  pov::PovOptions options;
  options.name = out.substr(out.rfind('/') + 1, out.rfind('.') - out.rfind('/') - 1);
  for (driver::File& file : pov::write_pov(product, options)) {
    if (!file.name.empty()) write(out.substr(0, out.rfind('/') + 1) + file.name, file.bytes);
    else {
      file.bytes += "global_settings { assumed_gamma 1.0 adc_bailout 0 max_trace_level 60 }\n" + lit;
      for (const place::PlacedMirror& mirror : loaded->interior->mirrors) file.bytes += mirror_quad(*loaded, mirror, factor);
      write(out, file.bytes);
    }
  }
  return 0;
}
