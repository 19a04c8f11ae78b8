#include "compiler/mesh_io/load.h"

#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <ctime>
#include <random>

#include "compiler/image_io/png.h"
#include "compiler/mesh/analyse.h"
#include "tests/unit/mesh_io/files.h"

using namespace orbc;
using namespace orbc::mesh;
using namespace orbc::mesh_io;
using namespace orbc::mesh_io::test;

namespace {

Result<LoadedMesh> load(Format format, const std::string& bytes) { return load_mesh_bytes(bytes, format, "file", ""); }

}  // namespace

TEST_CASE("a tetrahedron is the same in every format", "[mesh_io]") {
  const Folder folder("formats");
  for (const auto& [name, file] : good_files()) {
    INFO(name);
    const auto loaded = load_mesh(folder.write(name, file.second));
    REQUIRE(loaded);
    CHECK(loaded->warnings.empty());
    CHECK(loaded->mesh.triangles.size() == 4);
    const auto found = analyse(loaded->mesh);
    CHECK(found.closed);
    CHECK(found.volume == Approx(1.0 / 6));
    CHECK(found.centroid.x == Approx(0.25));
    CHECK(found.centroid.z == Approx(0.25));
    CHECK(found.euler == 2);
  }
}

TEST_CASE("endings may be in capitals, and a link is followed", "[mesh_io]") {
  const Folder folder("endings");
  folder.write("T.OBJ", tetra_obj());
  CHECK(load_mesh(folder("T.OBJ")));
  std::filesystem::create_symlink("T.OBJ", folder("link.obj"));
  CHECK(load_mesh(folder("link.obj")));
}

TEST_CASE("an OBJ keeps uv per corner by splitting vertices, with v from the top", "[mesh_io]") {
  const auto loaded =
      load(Format::obj, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0.5 0.25\nf 1/1 2/2 3/3\nf 1/4 3/3 4/1\n");
  REQUIRE(loaded);
  const auto& mesh = loaded->mesh;
  CHECK(mesh.positions.size() == 5);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {3, 2, 4}});
  CHECK(mesh.uv[0] == std::array<float, 2>{0, 1});
  CHECK(mesh.uv[1] == std::array<float, 2>{1, 1});
  CHECK(mesh.uv[2] == std::array<float, 2>{1, 0});
  CHECK(mesh.uv[3] == std::array<float, 2>{0.5f, 0.75f});
}

TEST_CASE("an OBJ may have comments, continued lines, normals, groups and double corners", "[mesh_io]") {
  const auto loaded = load(Format::obj,
                           "# x\r\no thing\r\ng a b\r\ns off\r\nv 0 0 0 1.0\r\nv 1 0 0 0.5 0.5 0.5\r\nv 1 1 0\r\nv 0 1 0\r\nvn 0 0 1\r\n"
                           "f 1//1 2//1 \\\r\n 3//1 # last\r\nl 1 2\r\nf 1 3 3 4\r\nf 1 2 1\r\nf 1 2\r\n");
  REQUIRE(loaded);
  CHECK(loaded->mesh.triangles.size() == 2);
  CHECK(loaded->mesh.uv.empty());
  REQUIRE(loaded->warnings.size() == 1);
  CHECK(loaded->warnings[0].code == "mesh.skipped-faces");
}

TEST_CASE("an OBJ takes colours and pictures from its MTL", "[mesh_io]") {
  const Folder folder("mtl");
  folder.write("pic/red.png", image_io::encode_png(image::Image{2, 1, {255, 0, 0, 255, 0, 0, 255, 255}}));
  folder.write("a.mtl", "newmtl one\nKd 0.1 0.2 0.3\nnewmtl two\nmap_Kd -s 1 1 1 pic/red.png\nnewmtl three\nmap_Kd gone.png\n");
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
  const auto loaded = load_mesh(folder.write(
      "a.obj", "mtllib a.mtl\n" + points +
                   "usemtl one\nf 1/1 2/1 3/1\nusemtl two\nf 1/1 2/1 3/1\nusemtl three\nf 1/1 2/1 3/1\nusemtl two\nf 1/1 3/1 2/1\n"));
  REQUIRE(loaded);
  const auto& mesh = loaded->mesh;
  REQUIRE(mesh.materials.size() == 4);
  CHECK(mesh.triangle_material == std::vector<std::uint16_t>{0, 1, 2, 3, 2});
  CHECK(mesh.materials[1].color == std::array<double, 3>{0.1, 0.2, 0.3});
  CHECK(mesh.materials[2].texture == 0);
  CHECK(mesh.materials[3].texture == -1);
  REQUIRE(mesh.textures.size() == 1);
  CHECK(mesh.textures[0].rgba == std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 255});
  REQUIRE(loaded->warnings.size() == 1);
  CHECK(loaded->warnings[0].code == "mesh.bad-texture");
}

TEST_CASE("polygons are cut into triangles inside of them, also when they have inward corners", "[mesh_io]") {
  // An L, a star, and a bent quad.
  const auto area = [](const std::string& points, const std::string& face) {
    const auto loaded = load(Format::obj, points + face);
    REQUIRE(loaded);
    for (const auto& t : loaded->mesh.triangles) {
      const auto& p = loaded->mesh.positions;
      CHECK(geometry::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z > 0);
    }
    return analyse(loaded->mesh).area;
  };
  CHECK(area("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n", "f 1 2 3 4 5 6\n") == Approx(3));
  CHECK(area("v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n", "f 1 2 3 4\n") == Approx(4));
  CHECK(area("v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n", "f 3 4 1 2\n") == Approx(4));
  std::string star, face = "f";
  double exact = 0;
  for (int i = 0; i < 40; ++i) {
    const double r = i % 2 ? 0.3 : 1, a = 2 * M_PI * i / 40;
    star += fmt::format("v {} {} 0\n", r * std::cos(a), r * std::sin(a));
    face += fmt::format(" {}", i + 1);
    exact += 0.5 * 0.3 * std::sin(2 * M_PI / 40);
  }
  CHECK(area(star, face + "\n") == Approx(exact).epsilon(1e-4));
}

TEST_CASE("a PLY may have per-corner uv, a picture, strips of triangles and things nobody knows", "[mesh_io]") {
  const Folder folder("ply");
  folder.write("red.png", image_io::encode_png(image::Image{1, 1, {255, 0, 0, 255}}));
  const auto wedge = load_mesh(
      folder.write("wedge.ply",
                   "ply\nformat ascii 1.0\ncomment TextureFile red.png\nelement vertex 3\nproperty float x\nproperty float y\n"
                   "property float z\nelement face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
                   "element edge 1000000000\nend_header\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2 6 0 0 1 0 1 1\n3 0 2 1 6 0 0.5 1 1 1 0\n"));
  REQUIRE(wedge);
  CHECK(wedge->mesh.positions.size() == 4);
  CHECK(wedge->mesh.uv[0] == std::array<float, 2>{0, 1});
  CHECK(wedge->mesh.uv[3] == std::array<float, 2>{0, 0.5f});
  REQUIRE(wedge->mesh.materials.size() == 1);
  CHECK(wedge->mesh.materials[0].texture == 0);
  const auto strips =
      load(Format::ply,
           "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
           "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 -1 0 1 2\n");
  REQUIRE(strips);
  CHECK(strips->mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {0, 1, 2}});
}

TEST_CASE("a PLY gives uv per vertex", "[mesh_io]") {
  const auto loaded = load(Format::ply, tetra_binary_ply(true));
  REQUIRE(loaded);
  REQUIRE(loaded->mesh.uv.size() == 4);
  CHECK(loaded->mesh.uv[0] == std::array<float, 2>{0.25f, 0.25f});
}

TEST_CASE("broken files are told by name and fault", "[mesh_io]") {
  const auto refused = [](Format format, const std::string& bytes, const std::string& code, const std::string& part = "") {
    const auto loaded = load(format, bytes);
    REQUIRE_FALSE(loaded);
    INFO(to_text(loaded.error()));
    CHECK(loaded.error().front().code == code);
    CHECK(loaded.error().front().message.find("file: ") == 0);
    CHECK(loaded.error().front().message.find(part) != std::string::npos);
  };
  for (const auto format : {Format::obj, Format::ply, Format::off, Format::stl, Format::gltf, Format::glb})
    refused(format, "", "mesh.truncated", "empty");
  refused(Format::obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "mesh.bad-index", "line 4");
  refused(Format::obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "mesh.bad-index");
  refused(Format::obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "mesh.bad-index");
  refused(Format::obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\n", "mesh.bad-index", "texture");
  refused(Format::obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n", "mesh.bad-index");
  refused(Format::obj, "v 0 nan 0\n", "mesh.not-finite", "line 1");
  refused(Format::obj, "v 0 1e999 0\n", "mesh.not-finite");
  refused(Format::obj, "v 0 1e20 0\n", "mesh.not-finite");
  refused(Format::obj, "v 0 one 0\n", "mesh.bad-number", "\"one\"");
  refused(Format::obj, "v 0 0\n", "mesh.truncated");
  refused(Format::obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "mesh.no-triangles", "3 vertices");
  refused(Format::obj, "hello world\n", "mesh.no-triangles");
  refused(Format::off, "PFF\n", "mesh.bad-header");
  refused(Format::off, "OFF\n4000000000 1 1\n0 0 0\n", "mesh.truncated", "4000000000 vertices");
  refused(Format::off, "OFF\n3 4000000000 1\n0 0 0\n", "mesh.truncated");
  refused(Format::off, "OFF\n-1 1 1\n", "mesh.bad-number");
  refused(Format::off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "mesh.bad-index", "face 0 uses vertex 3");
  refused(Format::off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "mesh.truncated");
  refused(Format::off, "OFF BINARY\n", "mesh.unsupported");
  refused(Format::ply, "plx\n", "mesh.bad-header");
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  refused(Format::ply, "ply\nformat ascii 1.0\nelement vertex 4000000000\n" + xyz + "end_header\n0 0 0\n", "mesh.too-big", "4000000000");
  refused(Format::ply, "ply\nformat binary_little_endian 1.0\nelement vertex 20000000\n" + xyz + "end_header\n0 0 0\n", "mesh.truncated",
          "promises 20000000");
  refused(Format::ply, "ply\nformat ascii 1.0\nelement vertex 99999999999999999999\n" + xyz + "end_header\n", "mesh.bad-header");
  refused(Format::ply, "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n", "mesh.bad-header", "no x, y, z");
  refused(Format::ply,
          "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz +
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0 1\n",
          "mesh.bad-index");
  refused(Format::ply,
          "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz +
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0 0.5\n",
          "mesh.bad-index");
  refused(Format::ply,
          "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz +
              "element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n-3 0 0 0\n",
          "mesh.truncated");
  refused(Format::ply,
          "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz +
              "element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n2000000000 0 0 0\n",
          "mesh.truncated", "2e+09");
  refused(Format::ply, "ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\nend_header\n", "mesh.bad-header");
  refused(Format::ply, "ply\nformat ascii 1.0\nproperty float x\nend_header\n", "mesh.bad-header");
  refused(Format::ply, "ply\nformat strange 1.0\nend_header\n", "mesh.bad-header");
  refused(Format::stl, "solid x\n facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 0 0\n", "mesh.truncated");
  refused(Format::stl, "solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendfacet\nendsolid\n", "mesh.bad-header",
          "more than three");
  refused(Format::stl, "solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\nendsolid\n", "mesh.bad-header");
  refused(Format::stl, "solid x\nendsolid x\n", "mesh.no-triangles");
  std::string stl(80, 'x');
  put(stl, std::uint32_t{0xffffffff});
  refused(Format::stl, stl, "mesh.truncated", "promises 4294967295 triangles");
  auto nan = tetra_binary_stl();
  std::memset(&nan[84 + 12], 0xff, 4);
  refused(Format::stl, nan, "mesh.not-finite", "triangle 0");
}

TEST_CASE("files that are not there, no files, or of no known kind are told apart", "[mesh_io]") {
  const Folder folder("missing");
  folder.write("statue.obj", tetra_obj());
  const auto missing = load_mesh(folder("statu.obj"));
  REQUIRE_FALSE(missing);
  CHECK(missing.error().front().code == "mesh.missing-file");
  CHECK(missing.error().front().hint == "did you mean statue.obj?");
  const auto no_folder = load_mesh(folder("nowhere/statue.obj"));
  CHECK(code_of(no_folder) == "mesh.missing-file");
  CHECK(no_folder.error().front().hint.find("no folder") != std::string::npos);
  std::filesystem::create_directory(folder("folder.obj"));
  CHECK(code_of(load_mesh(folder("folder.obj"))) == "mesh.not-a-file");
  std::filesystem::create_symlink("/dev/zero", folder("zero.obj"));
  CHECK(code_of(load_mesh(folder("zero.obj"))) == "mesh.not-a-file");
  CHECK(code_of(load_mesh(folder.write("statue.max", "x"))) == "mesh.unknown-format");
  CHECK(code_of(load_mesh(folder("gone.max"))) == "mesh.missing-file");
  LoadOptions small;
  small.max_file_bytes = 10;
  CHECK(code_of(load_mesh(folder("statue.obj"), small)) == "mesh.too-big");
  small = {};
  small.max_triangles = 3;
  for (const auto& [name, file] : good_files())
    CHECK(code_of(load_mesh_bytes(file.second, file.first, "file", "", small)) == "mesh.too-big");
}

TEST_CASE("an OBJ reads no file outside its folder", "[mesh_io]") {
  const Folder folder("traversal");
  folder.write("out.mtl", "newmtl a\nKd 1 0 0\n");
  for (const std::string lib : {"../out.mtl", "/etc/passwd", "C:\\x.mtl", "..\\out.mtl", "a/../../out.mtl", "http://a/b.mtl"}) {
    const auto loaded = load_mesh(folder.write("in/a.obj", "mtllib " + lib + "\nusemtl a\n" + tetra_obj()));
    REQUIRE(loaded);
    REQUIRE(loaded->warnings.size() == 1);
    CHECK(loaded->warnings[0].code == "mesh.bad-reference");
    CHECK(loaded->mesh.materials.empty());
  }
}

TEST_CASE("every beginning of every file is a mesh or a diagnostic", "[mesh_io]") {
  for (const auto& [name, file] : good_files()) {
    INFO(name);
    std::size_t fine = 0;
    for (std::size_t length = 0; length < file.second.size(); ++length) {
      const auto loaded = load(file.first, file.second.substr(0, length));
      if (loaded) {
        ++fine;
        for (const auto& t : loaded->mesh.triangles) {
          for (const auto v : t) REQUIRE(v < loaded->mesh.positions.size());
        }
      } else {
        REQUIRE_FALSE(loaded.error().front().message.empty());
      }
    }
    // Text formats without a count are whole before their end; the others only without their last blank or padding.
    if (file.first != Format::obj && name != "text.stl") CHECK(fine <= 10);
  }
}

TEST_CASE("bent bytes are a mesh or a diagnostic, in bounded time", "[mesh_io]") {
  std::mt19937 random(20240229);
  for (const auto& [name, file] : good_files()) {
    INFO(name);
    const auto begin = std::clock();  // of the processor: the machine may be busy with other things
    for (int round = 0; round < 3000; ++round) {
      auto bytes = file.second;
      const auto flips = 1 + random() % 4;
      for (unsigned k = 0; k < flips; ++k) {
        const auto at = random() % bytes.size();
        switch (random() % 4) {
          case 0:
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
            break;
          case 1:
            bytes[at] = static_cast<char>(random());
            break;
          case 2:
            bytes[at] = "0123456789-.e,[]{}\""[random() % 19];
            break;
          default:
            bytes.insert(at, 1, "0123456789-/ \n"[random() % 14]);
            break;
        }
      }
      const auto loaded = load(file.first, bytes);
      if (!loaded) continue;
      REQUIRE_FALSE(loaded->mesh.triangles.empty());
      for (const auto& p : loaded->mesh.positions) REQUIRE((std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)));
      for (const auto& t : loaded->mesh.triangles) {
        for (const auto v : t) REQUIRE(v < loaded->mesh.positions.size());
      }
    }
    CHECK(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC < 60);
  }
}

TEST_CASE("hostile texts end soon", "[mesh_io]") {
  // A polygon of a million corners, a million self-crossing polygons' worth of ears, and brackets without end.
  std::string polygon = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n", zigzag;
  for (int i = 0; i < 200; ++i) zigzag += fmt::format("v {} {} 0\n", i % 2 ? i : -i, i * 7 % 11);
  std::string face = "f";
  for (int i = 1; i <= 200; ++i) face += fmt::format(" {}", i);
  for (int i = 0; i < 2000; ++i) zigzag += face + "\n";
  CHECK(load(Format::obj, zigzag));
  std::string big = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n300000";
  for (int i = 0; i < 300000; ++i) big += fmt::format(" {}", i % 3);
  CHECK(code_of(load(Format::off, big)) == "mesh.no-triangles");
  CHECK(code_of(load(Format::gltf, std::string(1000000, '['))) == "mesh.truncated");
  CHECK(code_of(load(Format::gltf, "{\"extras\":" + std::string(1000000, '[') + std::string(1000000, ']') + "}")) == "mesh.bad-gltf");
  std::string objects = "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{}";
  for (int i = 0; i < 400000; ++i) objects += ",{}";
  CHECK(code_of(load(Format::gltf, objects + "]}")) == "mesh.too-big");
  std::string copies = "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":4000000}";
  for (int i = 0; i < 100000; ++i) copies += ",{\"byteLength\":4000000}";
  CHECK(code_of(load(Format::glb, glb(copies + "]}", std::string(4000000, 'x')))) == "mesh.too-big");
}
