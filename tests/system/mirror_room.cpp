// The Euclidean room as POV-Ray sees it with true mirrors: only the room itself is exported, its mirrors are POV-Ray's own. Whatever unfolding
// and copying do wrong, this picture does right.   mirror_room SCENE.yaml OUT.pov
#include <fmt/format.h>

#include <fstream>

#include "compiler/driver/compile.h"
#include "compiler/room/room.h"
#include "exporters/pov/write_pov.h"

namespace {

using namespace orbc;

std::string mirror_quad(const driver::Opened& opened, const place::PlacedMirror& mirror) {
  const geometry::Isometry eye_from_room = geometry::inverse(opened.eye.room_from_eye);
  const auto corner = [&](int side, int level) {
    const geometry::Point p = eye_from_room * room::point_on_wall(opened.room->room, mirror.wall, mirror.span[side]);
    return fmt::format("<{:.17g},{:.17g},{:.17g}>", p.x, p.y, mirror.height[level]);
  };
  const scene::Color c = mirror.reflectance * mirror.tint;
  return fmt::format("mesh2 {{ vertex_vectors {{ 4, {},{},{},{} }} face_indices {{ 2, <0,1,2>,<0,2,3> }} texture {{ pigment {{ rgb 0 }} finish {{ ambient 0 diffuse 0 emission 0 "
                     "reflection {{ rgb <{:.17g},{:.17g},{:.17g}> }} }} }} }}\n", corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1), c.r, c.g, c.b);
}

void write(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  driver::Overrides overrides;
  overrides.max_bounces = 0;
  const auto opened = driver::open_scene(argv[1], overrides);
  if (!opened) return fmt::print(stderr, "{}", to_text(opened.error())), 1;
  const auto compiled = driver::compile(*opened, {}, serial_executor());
  if (!compiled) return fmt::print(stderr, "{}", to_text(compiled.error())), 1;
  const std::string out = argv[2];
  pov::PovOptions options;
  options.name = out.substr(out.rfind('/') + 1, out.rfind('.') - out.rfind('/') - 1);
  for (driver::File& file : pov::write_pov(compiled->product, options)) {
    if (!file.name.empty()) write(out.substr(0, out.rfind('/') + 1) + file.name, file.bytes);
    else {
      file.bytes += "global_settings { assumed_gamma 1.0 adc_bailout 0 max_trace_level 60 }\n";
      for (const place::PlacedMirror& mirror : opened->room->mirrors) file.bytes += mirror_quad(*opened, mirror);
      write(out, file.bytes);
    }
  }
  return 0;
}
