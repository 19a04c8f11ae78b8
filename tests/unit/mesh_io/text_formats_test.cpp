// What files of others look like: colours, materials, line ends, headers. Each case was met in public files.
#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "compiler/image_io/png.h"
#include "compiler/mesh/analyse.h"
#include "compiler/mesh_io/load.h"
#include "tests/unit/mesh_io/files.h"

using namespace orbc;
using namespace orbc::mesh_io;
using namespace orbc::mesh_io::test;
using mesh::LinearColor;
using mesh::MaterialKind;

namespace {

const std::string kQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kQuadUv = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

mesh::LoadedMesh loaded_from(Format format, const std::string& bytes) {
  auto loaded = load_mesh_bytes(bytes, format, "file", "");
  if (!loaded) FAIL(to_text(loaded.error()));
  return *std::move(loaded);
}

std::string red_png() { return image_io::encode_png(image::Image{1, 1, {255, 0, 0, 255}}); }

/// The colour of the vertex at (x, y).
LinearColor color_at(const mesh::Mesh& mesh, double x, double y) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (mesh.positions[v].x == x && mesh.positions[v].y == y) return mesh.colors.at(v);
  FAIL("no such vertex");
  return {};
}

std::array<double, 3> triangle_color(const mesh::Mesh& mesh, std::size_t t) {
  return mesh.materials.at(mesh.triangle_material.empty() ? 0 : mesh.triangle_material[t]).color;
}

constexpr LinearColor kRed{1, 0, 0}, kBlue{0, 0, 1};

}  // namespace

TEST_CASE("colours of vertices are read from OBJ, PLY and OFF, in either scale", "[mesh_io]") {
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string bytes = "0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 255 255 0\n4 0 1 2 3\n";
  const std::string units = "0 0 0 1 0 0\n1 0 0 0 1 0\n1 1 0 0 0 1\n0 1 0 1 1 0\n4 0 1 2 3\n";
  const std::vector<std::pair<Format, std::string>> files{
      {Format::obj, "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 0\nf 1 2 3 4\n"},
      {Format::obj, "v 0 0 0 255 0 0\nv 1 0 0 0 255 0\nv 1 1 0 0 0 255\nv 0 1 0 255 255 0\nf 1 2 3 4\n"},
      {Format::obj, kQuad + "#MRGB ffff0000ff00ff00ff0000ffffffff00\nf 1 2 3 4\n"},
      {Format::ply, ply + "property uchar red\nproperty uchar green\nproperty uchar blue\n" + faces + bytes},
      {Format::ply, ply + "property float r\nproperty float g\nproperty float b\n" + faces + units},
      {Format::ply, ply + "property float diffuse_red\nproperty float diffuse_green\nproperty float diffuse_blue\n" + faces + units},
      {Format::off, "COFF\n4 1 0\n" + bytes},
      {Format::off, "COFF\n4 1 0\n" + units},
      {Format::off, "CNOFF\n4 1 0\n0 0 0 0 0 1 1 0 0 1\n1 0 0 0 0 1 0 1 0 1\n1 1 0 0 0 1 0 0 1 1\n0 1 0 0 0 1 1 1 0 1\n4 0 1 2 3\n"}};
  for (const auto& [format, text] : files) {
    INFO(text);
    const auto loaded = loaded_from(format, text);
    CHECK(color_at(loaded.mesh, 0, 0) == kRed);
    CHECK(color_at(loaded.mesh, 1, 0) == LinearColor{0, 1, 0});
    CHECK(color_at(loaded.mesh, 1, 1) == kBlue);
    CHECK(color_at(loaded.mesh, 0, 1) == LinearColor{1, 1, 0});
    CHECK(triangle_color(loaded.mesh, 0) == std::array<double, 3>{1, 1, 1});
  }
}

TEST_CASE("colours of faces are read from PLY, OFF and STL, and become materials", "[mesh_io]") {
  std::string stl(80, ' ');
  put(stl, std::uint32_t{2});
  for (const auto bits : {0x8000u | 31u << 10, 0x8000u | 31u}) {
    for (const float x : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, bits & 31u ? 0.f : 1.f, 1.f, 0.f}) put(stl, x);
    put(stl, static_cast<std::uint16_t>(bits));
  }
  const std::vector<std::pair<Format, std::string>> files{
      {Format::off, "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n"},
      {Format::off, "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 1.0 0.0 0.0 1.0\n3 0 2 3 0 0 1.0 1.0\n"},
      {Format::ply,
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
       "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
       "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n"},
      {Format::stl, stl}};
  for (const auto& [format, text] : files) {
    const auto loaded = loaded_from(format, text);
    CHECK(loaded.mesh.colors.empty());
    CHECK(triangle_color(loaded.mesh, 0) == std::array<double, 3>{1, 0, 0});
    CHECK(triangle_color(loaded.mesh, 1) == std::array<double, 3>{0, 0, 1});
  }
  CHECK(warns(loaded_from(Format::off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n"), "mesh.ignored", "by index"));
}

TEST_CASE("an OBJ names materials anywhere, in several libraries, with blanks, in any case, with any path", "[mesh_io]") {
  const Folder folder("mtllib");
  folder.write("red.png", red_png());
  folder.write("m.mtl", "\xef\xbb\xbfnewmtl m\nKd 0 0 0\nmap_Kd red.png\n");
  folder.write("my stuff.mtl", "newmtl m\nMAP_Kd -clamp off C:\\Users\\Ann\\Desktop\\Red.PNG\n");
  const std::string panel = kQuad + kQuadUv + "usemtl m\nf 1/1 2/2 3/3 4/4\n";
  for (const std::string statement :
       {"mtllib m.mtl\n", "mtllib none.mtl m.mtl\n", "mtllib my stuff.mtl\n", "mtllib M.MTL\n", "mtllib ..\\art\\m.mtl\n"}) {
    for (const bool last : {false, true}) {
      INFO(statement);
      const auto loaded = load_mesh(folder.write("p.obj", last ? panel + statement : statement + panel));
      REQUIRE(loaded);
      CHECK(loaded->warnings.empty());
      REQUIRE(loaded->mesh.materials.size() == 1);
      CHECK(loaded->mesh.materials[0].texture == 0);
      CHECK(loaded->mesh.materials[0].color == std::array<double, 3>{1, 1, 1});
    }
  }
}

TEST_CASE("options of an MTL's picture scale, shift and clamp it", "[mesh_io]") {
  const Folder folder("mtl_options");
  folder.write("red.png", red_png());
  const std::string panel = "mtllib m.mtl\n" + kQuad + kQuadUv + "usemtl m\nf 1/1 2/2 3/3 4/4\n";
  folder.write("m.mtl", "newmtl m\nmap_Kd -s 2 3 1 -o 0.5 0.25 -mm 0 1 red.png\n");
  const auto scaled = load_mesh(folder.write("p.obj", panel));
  REQUIRE(scaled);
  for (std::size_t v = 0; v < 4; ++v) {
    const auto& p = scaled->mesh.positions[v];
    CHECK(scaled->mesh.uv[v] == std::array<float, 2>{static_cast<float>(2 * p.x + 0.5), static_cast<float>(0.75 - 3 * p.y)});
  }
  folder.write("m.mtl", "newmtl m\nmap_Kd -clamp on -s 3 3 -o -1 -1 red.png\n");
  const auto clamped = load_mesh(folder.write("p.obj", panel));
  REQUIRE(clamped);
  CHECK(mesh::analyse(clamped->mesh).area == Approx(1));
  for (const auto& uv : clamped->mesh.uv) CHECK((uv[0] == 0.5f && uv[1] == 0.5f));  // the one texel's middle
}

TEST_CASE("an MTL makes holes, metal, glass and light, and says what it leaves out", "[mesh_io]") {
  const Folder folder("mtl_kinds");
  folder.write("mask.png", image_io::encode_png(image::Image{2, 1, {255, 255, 255, 255, 0, 0, 0, 255}}));
  const auto material = [&](const std::string& mtl) {
    folder.write("m.mtl", "newmtl m\n" + mtl + "newmtl plain\n");
    auto loaded =
        load_mesh(folder.write("p.obj", "mtllib m.mtl\n" + kQuad + kQuadUv + "usemtl m\nf 1/1 2/2 3/3 4/4\nusemtl plain\nf 1 2 3\n"));
    REQUIRE(loaded);
    return *std::move(loaded);
  };
  const auto holes = material("map_d mask.png\n");
  REQUIRE(holes.mesh.materials[0].texture >= 0);
  const auto& picture = holes.mesh.textures[static_cast<std::size_t>(holes.mesh.materials[0].texture)];
  CHECK(picture.rgba == std::vector<std::uint8_t>{255, 255, 255, 255, 255, 255, 255, 0});
  CHECK(holes.mesh.materials[0].alpha_cutoff == 0.5);
  const auto light = material("Kd 1 1 1\nKe 0 4 2\n").mesh.materials[0];
  CHECK(light.kind == MaterialKind::emissive);
  CHECK(light.emission == 4);
  CHECK(light.color == std::array<double, 3>{0, 1, 0.5});
  CHECK(material("Pm 1\nPr 0.2\n").mesh.materials[0].kind == MaterialKind::metal);
  const auto glass = material("d 0.1\nNi 1.33\nillum 7\n").mesh.materials[0];
  CHECK(glass.kind == MaterialKind::glass);
  CHECK(glass.index == 1.33);
  const auto faint = material("d 0.15\n");
  CHECK(warns(faint, "mesh.blended"));
  CHECK(faint.mesh.triangles.size() == 1);
  const auto veil = material("Tr 0.3\n");
  CHECK(warns(veil, "mesh.blended"));
  CHECK(veil.mesh.triangles.size() == 3);
  CHECK(material("Tr 1\n").warnings.empty());
  CHECK(warns(material("bump b.png\nrefl r.png\n"), "mesh.ignored", "bump, refl"));
}

TEST_CASE("an OBJ may name vertices before they come", "[mesh_io]") {
  CHECK(loaded_from(Format::obj, "f 1 2 3 4\n" + kQuad).mesh.triangles.size() == 2);
  CHECK(loaded_from(Format::obj, "f 1/1 2/2 3/3 4/4\n" + kQuad + kQuadUv).mesh.uv.size() == 4);
  const auto wrong = load_mesh_bytes("f 1 2 5\n" + kQuad, Format::obj, "file", "");
  REQUIRE_FALSE(wrong);
  CHECK(wrong.error().front().code == "mesh.bad-index");
  CHECK(wrong.error().front().message.find("line 1") != std::string::npos);
}

TEST_CASE("a bridge makes a hole in a polygon, and long polygons are cut inside of them", "[mesh_io]") {
  const auto frame = loaded_from(Format::obj,
                                 "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\n"
                                 "f 1 2 3 4 1 5 6 7 8 5\n");
  CHECK(frame.mesh.triangles.size() == 8);
  CHECK(mesh::analyse(frame.mesh).area == Approx(12));
  for (const int points : {150, 2000, 50'000}) {
    std::string text, face = "f";
    double exact = 0;
    for (int i = 0; i < 2 * points; ++i) {
      const double r = i % 2 ? 0.6 : 1, a = M_PI * i / points;
      text += fmt::format("v {:.17g} {:.17g} 0\n", r * std::cos(a), r * std::sin(a));
      face += fmt::format(" {}", i + 1);
      exact += 0.5 * 0.6 * std::sin(M_PI / points);
    }
    const auto star = loaded_from(Format::obj, text + face + "\n");
    CHECK(star.mesh.triangles.size() == static_cast<std::size_t>(2 * points - 2));
    CHECK(mesh::analyse(star.mesh, {.crossings = false}).area == Approx(exact));
  }
}

TEST_CASE("byte order marks, old line ends and UTF-16 change nothing", "[mesh_io]") {
  const auto with_returns = [](std::string text) {
    for (auto& c : text) c = c == '\n' ? '\r' : c;
    return text;
  };
  const auto in_utf16 = [](const std::string& text, bool big) {
    std::string wide = big ? "\xfe\xff" : "\xff\xfe";
    for (const char c : text) wide += big ? std::string{'\0', c} : std::string{c, '\0'};
    return wide;
  };
  for (const auto& [format, text] : std::vector<std::pair<Format, std::string>>{
           {Format::obj, tetra_obj()}, {Format::off, tetra_off()}, {Format::stl, tetra_stl()}, {Format::ply, tetra_ply()}}) {
    const auto plain = loaded_from(format, text).mesh;
    std::vector<std::string> same{"\xef\xbb\xbf" + text, with_returns(text)};
    if (format != Format::ply) same.insert(same.end(), {in_utf16(text, false), in_utf16(text, true)});
    for (const auto& other : same) {
      const auto mesh = loaded_from(format, other).mesh;
      CHECK(mesh.triangles == plain.triangles);
      CHECK(mesh.positions.size() == plain.positions.size());
      CHECK(mesh.positions[1].x == plain.positions[1].x);
    }
  }
}

TEST_CASE("an OFF may lack its keyword, have it glued or small, count no edges and say its dimension", "[mesh_io]") {
  const std::string body = "\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
  for (const std::string head : {"OFF4 1 0", "off\n4 1 0", "nOFF\n3\n4 1 0", "4 1 0", "OFF\n4 1", "OFF 4 1 0", "OFF\n4\n1\n0"}) {
    INFO(head);
    CHECK(loaded_from(Format::off, head + body).mesh.triangles.size() == 2);
  }
  CHECK(code_of(load_mesh_bytes("nOFF\n4\n4 1 0" + body, Format::off, "file", "")) == "mesh.unsupported");
  CHECK(code_of(load_mesh_bytes("4OFF\n4 1 0" + body, Format::off, "file", "")) == "mesh.unsupported");
}

TEST_CASE("an STL may be in capitals, lack its end, or have no count", "[mesh_io]") {
  std::string text = tetra_stl();
  for (auto& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  CHECK(loaded_from(Format::stl, text).mesh.triangles.size() == 4);
  const auto open = loaded_from(Format::stl, tetra_stl().substr(0, tetra_stl().find("endsolid")));
  CHECK(open.mesh.triangles.size() == 4);
  CHECK(warns(open, "mesh.repaired", "endsolid"));
  for (const std::uint32_t count : {0u, 0xffffffffu}) {
    auto bytes = tetra_binary_stl();
    std::memcpy(&bytes[80], &count, 4);
    const auto counted = loaded_from(Format::stl, bytes);
    CHECK(counted.mesh.triangles.size() == 4);
    CHECK(warns(counted, "mesh.repaired", "its size holds 4"));
  }
}

TEST_CASE("coordinates of surveys keep their centimetres", "[mesh_io]") {
  const auto field =
      loaded_from(Format::obj, "v 4500000.00 5400000.00 200.00\nv 4500000.01 5400000.00 200.00\nv 4500000.01 5400000.00 200.01\nf 1 2 3\n");
  CHECK(field.mesh.positions[1].x - field.mesh.positions[0].x == Approx(0.01).epsilon(1e-6));
  CHECK(mesh::analyse(field.mesh).area == Approx(5e-5).epsilon(1e-5));
}

TEST_CASE("a PLY may have a texture for each face", "[mesh_io]") {
  const Folder folder("ply_textures");
  folder.write("red.png", red_png());
  folder.write("blue.png", image_io::encode_png(image::Image{1, 1, {0, 0, 255, 255}}));
  const auto loaded = load_mesh(
      folder.write("p.ply",
                   "ply\nformat ascii 1.0\ncomment TextureFile red.png\ncomment TextureFile blue.png\nelement vertex 4\nproperty float x\n"
                   "property float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\n"
                   "property list uchar float texcoord\nproperty int texnumber\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                   "3 0 1 2 6 0 0 1 0 1 1 0\n3 0 2 3 6 0 0 1 1 0 1 1\n"));
  REQUIRE(loaded);
  const auto& mesh = loaded->mesh;
  REQUIRE(mesh.triangle_material.size() == 2);
  CHECK(mesh.textures[static_cast<std::size_t>(mesh.materials[mesh.triangle_material[0]].texture)].rgba[0] == 255);
  CHECK(mesh.textures[static_cast<std::size_t>(mesh.materials[mesh.triangle_material[1]].texture)].rgba[2] == 255);
}

TEST_CASE("a mesh may have thousands of materials", "[mesh_io]") {
  const Folder folder("materials");
  std::string mtl, obj = "mtllib m.mtl\n" + kQuad;
  for (int i = 0; i < 3000; ++i) {
    mtl += fmt::format("newmtl m{}\nKd {} 0 0\n", i, i / 3000.0);
    obj += fmt::format("usemtl m{}\nf 1 2 3\n", i);
  }
  folder.write("m.mtl", mtl);
  const auto loaded = load_mesh(folder.write("p.obj", obj));
  REQUIRE(loaded);
  CHECK(loaded->warnings.empty());
  CHECK(loaded->mesh.materials.size() == 3000);
  CHECK(loaded->mesh.triangle_material.back() == 2999);
}

TEST_CASE("an OBJ by a program that turns y up says so", "[mesh_io]") {
  CHECK(warns(loaded_from(Format::obj, "# Blender 3.4.1\n# www.blender.org\n" + tetra_obj()), "mesh.y-up", "Blender"));
  CHECK(loaded_from(Format::obj, tetra_obj()).warnings.empty());
}

TEST_CASE("decimal commas and foreign formats get a hint", "[mesh_io]") {
  const auto comma = load_mesh_bytes("v -0,5 0 0\n", Format::obj, "file", "");
  REQUIRE_FALSE(comma);
  CHECK(comma.error().front().hint.find("decimal") != std::string::npos);
  const Folder folder("foreign");
  for (const std::string ending : {"dae", "fbx", "usdz", "blend"}) {
    const auto foreign = load_mesh(folder.write("thing." + ending, "x"));
    REQUIRE_FALSE(foreign);
    CHECK(foreign.error().front().code == "mesh.unknown-format");
    CHECK(foreign.error().front().hint.find("Blender") != std::string::npos);
  }
}
