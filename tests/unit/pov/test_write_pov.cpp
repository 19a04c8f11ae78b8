#include <catch2/catch.hpp>
#include <cctype>

#include "compiler/image/image.h"
#include "compiler/image_io/png.h"
#include "exporters/pov/base64.h"
#include "exporters/pov/write_pov.h"
#include "exporters/side_file.h"
#include "tests/support/products.h"

using namespace orbc;

namespace {

std::string base64(std::string_view bytes) {
  std::string out;
  exporters::Pen pen(out);
  pov::write_base64(pen, bytes);
  pen.flush();
  return out;
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

}  // namespace

TEST_CASE("two squares become this scene, byte by byte", "[pov]") {
  const std::vector<driver::File> files = pov::write_pov(test::two_squares(), {.name = "squares"});
  REQUIRE(files.size() == 2);
  CHECK(files[0].name.empty());
  const std::string atlas_name = exporters::side_file_name({"squares", "pov", "-atlas", ".png"}, files[1].bytes);
  CHECK(files[1].name == atlas_name);
  const double half = std::tan(Angle::from_degrees(75).radians / 2);
  const std::string right = fmt::format("{}", -(2 * half)), up = fmt::format("{}", 2 * half * 0.75);
  CHECK(files[0].bytes == R"(// orbc: *2222, 2 copies, 4 triangles
// size: +W80 +H60
// Draw from this folder: povray +Isquares.pov +W80 +H60 -D -A +FN8
#version 3.7;
global_settings { assumed_gamma 1.0 adc_bailout 0 max_trace_level 5 }
background { rgb <0.25,0.5,0.75> }
camera {
  perspective
  location <0,0,0.5>
  direction <1,0,0>
  right <0,)" + right + R"(,0>
  up <0,0,)" + up + R"(>
}
#declare OrbcAtlas = pigment { uv_mapping image_map { png ")" + atlas_name + R"(" } }
// copy 0: word "", 0 bounces, sheet 0, weight <1,1,1>, distance 0
mesh2 {
vertex_vectors { 4,
<2,-0.25,0>,
<2,0.25,0>,
<2,0.25,0.75>,
<2,-0.25,0.75> }
uv_vectors { 4,
<0.25,0.5>,
<0.25,0.5>,
<0.25,0.5>,
<0.25,0.5> }
face_indices { 2,
<0,1,2>,
<0,2,3> }
uv_mapping
texture { pigment { OrbcAtlas } finish { emission rgb <1,1,1> ambient 0 diffuse 0 } }
}
// copy 1: word "2 1", 2 bounces, sheet 0, weight <0.81,0.6561,0.5>, distance 1.5
mesh2 {
vertex_vectors { 4,
<3,-1,0>,
<3,1,0>,
<3,1,1.5>,
<3,-1,1.5> }
uv_vectors { 4,
<0.75,0.5>,
<0.75,0.5>,
<0.75,0.5>,
<0.75,0.5> }
face_indices { 2,
<0,2,1>,
<0,3,2> }
uv_mapping
texture { pigment { OrbcAtlas } finish { emission rgb <0.81,0.6561,0.5> ambient 0 diffuse 0 } }
}
)");
  const Result<image::Image> atlas = image_io::decode_png(files[1].bytes, "PNG");
  REQUIRE(atlas.has_value());
  CHECK(atlas->rgba == test::two_squares().atlas.rgba);
}

TEST_CASE("a scene for a pipe is one file that carries its atlas", "[pov]") {
  const std::vector<driver::File> files = pov::write_pov(test::two_squares(), {.name = "squares", .inline_atlas = true});
  REQUIRE(files.size() == 1);
  const std::string png = image_io::encode_png(test::two_squares().atlas);
  CHECK(contains(files[0].bytes, "/* orbc-file squares-atlas.png base64\n" + base64(png) + "*/\n"));
  CHECK(contains(files[0].bytes, "image_map { png \"squares-atlas.png\" }"));
}

TEST_CASE("base64 agrees with the test vectors of RFC 4648 and breaks its lines", "[pov]") {
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==\n");
  CHECK(base64("fo") == "Zm8=\n");
  CHECK(base64("foo") == "Zm9v\n");
  CHECK(base64("foob") == "Zm9vYg==\n");
  CHECK(base64("fooba") == "Zm9vYmE=\n");
  CHECK(base64("foobar") == "Zm9vYmFy\n");
  CHECK(base64("\xff\xff\xfe") == "///+\n");
  CHECK(base64(std::string(58, 'a')).find('\n') == 76);
}

TEST_CASE("panorama and cylinder cameras are written in the forms that were measured", "[pov]") {
  driver::Product product = test::two_squares();
  product.eye.projection = scene::Projection::panorama;
  CHECK(contains(pov::write_pov(product)[0].bytes,
                 "spherical\n  location <0,0,0.5>\n  direction <1,0,0>\n  right <-0,1,-0>\n  up <-0,-0,-1>\n  angle 360 180"));
  product.eye.projection = scene::Projection::cylinder;
  product.eye.fov = Angle::from_degrees(180);
  const std::string height = fmt::format("{}", product.eye.fov.radians * 0.75);
  CHECK(contains(pov::write_pov(product)[0].bytes,
                 "cylinder 1\n  location <0,0,0.5>\n  direction <1,0,0>\n  right <0,-1,0>\n  up <0,0," + height + ">\n  angle 180"));
}

TEST_CASE("the flat view puts the camera where the eye stands in the disk chart", "[pov]") {
  driver::Product product = test::two_squares();
  product.disk_view = true;
  product.eye.room_from_eye =
      geometry::translation_by(geometry::Space::hyperbolic, 0, 1) * geometry::rotation(geometry::Space::hyperbolic, std::numbers::pi / 2);
  const std::string text = pov::write_pov(product)[0].bytes;
  CHECK(contains(text, fmt::format(",{},0.5>", std::tanh(0.5))));
  const std::size_t at = text.find("direction <") + 11;
  CHECK(std::abs(std::stod(text.substr(at))) < 1e-15);                 // turned by 90°: from +x …
  CHECK(std::stod(text.substr(text.find(',', at) + 1)) == Approx(1));  // … to +y
}

TEST_CASE("copies without triangles are mentioned, not drawn", "[pov]") {
  driver::Product product = test::two_squares();
  product.copies[1].index_count = 0;
  const std::string text = pov::write_pov(product)[0].bytes;
  CHECK(count(text, "mesh2") == 1);
  CHECK(contains(text, "nothing to draw"));
  CHECK(count(pov::write_pov(test::empty_product())[0].bytes, "mesh2") == 0);
}

TEST_CASE("a product without atlas is white times its weights", "[pov]") {
  driver::Product product = test::two_squares();
  product.atlas = {};
  const std::vector<driver::File> files = pov::write_pov(product);
  CHECK(files.size() == 1);
  CHECK(contains(files[0].bytes, "#declare OrbcAtlas = pigment { rgb 1 }"));
}

TEST_CASE("an atlas of baked light is looked up bilinearly, flat colours are not", "[pov]") {
  driver::Product product = test::two_squares();
  CHECK_FALSE(contains(pov::write_pov(product)[0].bytes, "interpolate"));
  CHECK(contains(pov::write_pov(product, {.interpolate = true})[0].bytes, ".png\" interpolate 2 }"));
  product.bilinear_atlas = true;
  CHECK(contains(pov::write_pov(product)[0].bytes, ".png\" interpolate 2 }"));
}

TEST_CASE("a copy with lamps of its own is a light group, what glows is not, and a lamp's body casts no shadow", "[pov]") {
  driver::Product product = test::two_squares();
  product.normals.assign(product.positions.size(), {-1, 0, 0});
  product.copies[1].shading = native_lights::Shading::lamp_body;
  product.native.emplace();
  product.native->ambient = {0.5, 0.5, 0.5};
  native_lights::NativeLamp lamp;
  lamp.at = {1, 2, 3}, lamp.intensity = {0.001, 0.002, 0.003};
  product.native->lamps.push_back(lamp);
  lamp.kind = scene::LampKind::spot, lamp.inverse_square = false, lamp.cone_inner = 1, lamp.cone_outer = 0.5;
  product.native->lamps.push_back(lamp);
  const std::string text = pov::write_pov(product)[0].bytes;
  CHECK(count(text, "light_group {") == 1);
  CHECK(count(text, "light_source {") == 2);
  CHECK(contains(text, "light_source { <1,2,3> rgb <500,1000,1500> fade_power 2 fade_distance 0.001 }"));
  CHECK(contains(text, "spotlight point_at <1,2,2> radius 0 falloff 60"));
  CHECK(contains(text, "finish { emission rgb <0.5,0.5,0.5> ambient 0 diffuse 1 } }\n}\nglobal_lights off"));
  CHECK(contains(text, "finish { emission rgb <0.81,0.6561,0.5> ambient 0 diffuse 0 } } no_shadow"));
  CHECK(count(text, "normal_vectors { 4") == 2);
}

TEST_CASE("an atlas with holes has a mask beside it, one of more bits its own file", "[pov]") {
  driver::Product product = test::two_squares();
  product.masked = true;
  product.atlas.rgba[3] = 0;
  const auto masked = pov::write_pov(product, {.name = "leaf"});
  REQUIRE(masked.size() == 3);
  CHECK(contains(masked[0].bytes,
                 "image_pattern { png \"" + masked[1].name + "\" } pigment_map { [0.5 rgbt 1] [0.5 image_map { png \"" + masked[2].name +
                     "\" }] }"));
  CHECK((masked[1].name.rfind("leaf-mask-", 0) == 0 && masked[2].name.rfind("leaf-atlas-", 0) == 0));
  const image::Image mask = image_io::decode_png(masked[1].bytes, "PNG").value(),
                     atlas = image_io::decode_png(masked[2].bytes, "PNG").value();
  CHECK((mask.rgba[0] == 0 && mask.rgba[4] == 255));
  CHECK((atlas.rgba[0] == 255 && atlas.rgba[3] == 255));
  const std::string piped = pov::write_pov(product, {.name = "leaf", .inline_atlas = true})[0].bytes;
  CHECK(count(piped, "/* orbc-file leaf-") == 2);

  product.masked = false;
  product.depth = scene::AtlasFormat::srgb16;
  product.atlas16 = {2, 1, {65535, 32896, 0, 2570, 5140, 7710}};
  const auto deep = pov::write_pov(product, {.name = "deep"});
  CHECK(exporters::is_side_file(deep[1].name, deep[1].bytes, "deep", "pov"));
  CHECK(deep[1].bytes[24] == 16);  // bit depth in IHDR
  CHECK(image_io::decode_png(deep[1].bytes, "PNG").value().rgba == std::vector<std::uint8_t>{255, 128, 0, 255, 10, 20, 30, 255});
  product.depth = scene::AtlasFormat::exr;
  const auto exr = pov::write_pov(product, {.name = "deep"});
  CHECK(exr[1].name == exporters::side_file_name({"deep", "pov", "-atlas", ".exr"}, exr[1].bytes));
  CHECK(exr[1].bytes.substr(0, 4) == "\x76\x2f\x31\x01");
  CHECK(contains(exr[0].bytes, "image_map { exr \"" + exr[1].name + "\" }"));
}

TEST_CASE("titles and names cannot break out of comments and strings", "[pov]") {
  driver::Product product = test::two_squares();
  product.title = "*22\n#error \"x\"\r*/";
  const std::vector<driver::File> files = pov::write_pov(product, {.name = "Küche \"a\\b\n/../x"});
  CHECK(contains(files[0].bytes, "// orbc: *22 #error \"x\" */, 2 copies"));
  for (const char c : files[1].name) CHECK((std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.'));
  CHECK(contains(files[0].bytes, "png \"" + files[1].name + "\""));
  CHECK(files[1].name != pov::write_pov(product, {.name = "Köche \"a\\b\n/../x"})[1].name);
}

TEST_CASE("every number reads back as the float it was", "[pov]") {
  driver::Product product = test::two_squares();
  const std::vector<float> values{1e-38f, -1e-7f, 3.4e38f, 0.1f, 16777216, -0.0f, 123456.79f, 1.0f / 3, 9.999999f, 1e-45f, -2.5e10f, 7};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) product.positions[i][k] = values[3 * i + k];
  const std::string text = pov::write_pov(product)[0].bytes;
  const char* at = text.c_str() + text.find("vertex_vectors { 4") + 18;
  for (const float value : values) {
    while (*at == ',' || *at == '<' || *at == '>' || *at == '\n') ++at;
    char* end = nullptr;
    CHECK(std::strtof(at, &end) == value);
    at = end;
  }
}

TEST_CASE("the same product gives the same bytes", "[pov]") {
  const auto a = pov::write_pov(test::two_squares()), b = pov::write_pov(test::two_squares());
  CHECK(a[0].bytes == b[0].bytes);
  CHECK(a[1].bytes == b[1].bytes);
}
