#include <catch2/catch.hpp>
#include <cstring>

#include "compiler/image_io/png.h"
#include "exporters/gltf/json.h"
#include "exporters/gltf/write_gltf.h"
#include "exporters/side_file.h"
#include "tests/support/products.h"

using namespace orbc;

namespace {

struct Glb {
  std::string json, bin;
};

std::uint32_t u32(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

template <class T>
T at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

Glb split(const std::string& bytes) {
  REQUIRE(bytes.substr(0, 4) == "glTF");
  REQUIRE(u32(bytes, 4) == 2);
  REQUIRE(u32(bytes, 8) == bytes.size());
  const std::size_t json = u32(bytes, 12);
  REQUIRE(json % 4 == 0);
  REQUIRE(bytes.substr(16, 4) == "JSON");
  Glb glb{bytes.substr(20, json), ""};
  if (20 + json < bytes.size()) {
    REQUIRE(bytes.substr(24 + json, 4) == std::string("BIN\0", 4));
    REQUIRE(28 + json + u32(bytes, 20 + json) == bytes.size());
    glb.bin = bytes.substr(28 + json);
  }
  while (!glb.json.empty() && glb.json.back() == ' ') glb.json.pop_back();
  return glb;
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("two squares become one primitive with the weights in its vertices", "[gltf]") {
  const driver::Product product = test::two_squares();
  const std::vector<driver::File> files = gltf::write_gltf(product);
  REQUIRE(files.size() == 1);
  CHECK(files[0].name.empty());
  const Glb glb = split(files[0].bytes);
  const std::string png = image_io::encode_png(product.atlas);
  // positions 8 × 12, uv 8 × 8, colours 8 × 8, indices 12 × 2, atlas
  const std::string total = std::to_string((248 + png.size() + 3) / 4 * 4);
  const double yfov = 2 * std::atan(std::tan(product.eye.fov.radians / 2) / (80.0 / 60));
  CHECK(
      glb.json ==
      R"({"asset":{"version":"2.0","generator":"orbc"},"extensionsUsed":["KHR_materials_unlit"],"scene":0,"scenes":[{"name":"*2222","nodes":[0,1]}],)"
      R"("nodes":[{"name":"camera","camera":0,"matrix":[0,0,1,0,0,1,0,0,-1,-0,0,0,0,0.5,0,1]},{"name":"copies","mesh":0}],)"
      R"("cameras":[{"type":"perspective","perspective":{"yfov":)" +
          fmt::format("{}", yfov) +
          R"(,"aspectRatio":1.3333333333333333,"znear":0.01},)"
          R"("extras":{"orbc_projection":"perspective","orbc_width":80,"orbc_height":60,"orbc_fov_deg":75,"orbc_background":[0.25,0.5,0.75]}}],)"
          R"("meshes":[{"name":"copies","primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":2},"indices":3,"material":0}]}],)"
          R"("materials":[{"name":"atlas","doubleSided":true,"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0,"roughnessFactor":1},)"
          R"("extensions":{"KHR_materials_unlit":{}}}],"textures":[{"sampler":0,"source":0}],)"
          R"("samplers":[{"magFilter":9728,"minFilter":9728,"wrapS":33071,"wrapT":33071}],"images":[{"name":"atlas","bufferView":4,"mimeType":"image/png"}],)"
          R"("accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[2,0,-1],"max":[3,1.5,1]},)"
          R"({"bufferView":1,"componentType":5126,"count":8,"type":"VEC2"},{"bufferView":2,"componentType":5123,"count":8,"type":"VEC4","normalized":true},)"
          R"({"bufferView":3,"componentType":5123,"count":12,"type":"SCALAR"}],)"
          R"("bufferViews":[{"buffer":0,"byteLength":96,"byteStride":12,"target":34962},{"buffer":0,"byteOffset":96,"byteLength":64,"byteStride":8,"target":34962},)"
          R"({"buffer":0,"byteOffset":160,"byteLength":64,"byteStride":8,"target":34962},{"buffer":0,"byteOffset":224,"byteLength":24,"target":34963},)"
          R"({"buffer":0,"byteOffset":248,"byteLength":)" +
          std::to_string(png.size()) + R"(}],"buffers":[{"byteLength":)" + total +
          R"(}],)"
          R"("extras":{"orbc_copies":[)"
          R"({"word":"","bounces":0,"sheet":0,"reversing":false,"weight":[1,1,1],"distance":0,"level":0,"primitive":0,"first_index":0,"index_count":6},)"
          R"({"word":"2 1","bounces":2,"sheet":0,"reversing":false,"weight":[0.81,0.6561,0.5],"distance":1.5,"level":0,"primitive":0,"first_index":6,"index_count":6}]}})");
  CHECK(at<float>(glb.bin, 0) == 2.0f);  // (2, −0.25, 0) → (2, 0, 0.25)
  CHECK(at<float>(glb.bin, 4) == 0.0f);
  CHECK(at<float>(glb.bin, 8) == 0.25f);
  CHECK(at<float>(glb.bin, 96 + 4 * 8) == 0.75f);
  CHECK(at<std::uint16_t>(glb.bin, 160) == 65535);
  CHECK(at<std::uint16_t>(glb.bin, 160 + 4 * 8) == 53083);      // 0.81
  CHECK(at<std::uint16_t>(glb.bin, 160 + 4 * 8 + 2) == 42998);  // 0.6561
  CHECK(at<std::uint16_t>(glb.bin, 160 + 4 * 8 + 6) == 65535);
  CHECK(at<std::uint16_t>(glb.bin, 224 + 2 * 6) == 4);
  CHECK(at<std::uint16_t>(glb.bin, 224 + 2 * 7) == 6);
  CHECK(glb.bin.substr(248, png.size()) == png);
}

TEST_CASE("copies that lamps light are matte and white, what glows keeps its weight, and every lamp is a node", "[gltf]") {
  driver::Product product = test::two_squares();
  product.normals.assign(product.positions.size(), {-1, 0, 0});
  product.copies[0].weight = {0.5, 0.5, 0.5};
  product.copies[1].shading = native_lights::Shading::emissive;
  product.native.emplace();
  native_lights::NativeLamp lamp;
  lamp.at = {1, 2, 3}, lamp.intensity = {0.5, 1, 0.25};
  product.native->lamps.push_back(lamp);
  lamp.direct = false;
  product.native->lamps.push_back(lamp);
  const Glb glb = split(gltf::write_gltf(product)[0].bytes);
  CHECK(contains(glb.json, R"("extensionsUsed":["KHR_materials_unlit","KHR_materials_specular","KHR_lights_punctual"])"));
  CHECK(contains(glb.json, R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","color":[0.5,1,0.25],"intensity":2145.7)"));
  CHECK(contains(glb.json, R"("nodes":[0,1,2]})"));
  CHECK(contains(glb.json, R"(1,3,-2,1],"extensions":{"KHR_lights_punctual":{"light":0}}})"));
  CHECK(contains(glb.json, R"({"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"COLOR_0":3},"indices":4,"material":1},)"));
  CHECK(contains(glb.json, R"("indices":9,"material":0})"));
  const std::size_t colors = 8 * (12 + 12 + 8);
  CHECK(at<float>(glb.bin, 8 * 12) == -1.0f);
  CHECK(at<std::uint16_t>(glb.bin, colors) == 65535);          // lit: its lamp brings the weight
  CHECK(at<std::uint16_t>(glb.bin, colors + 4 * 8) == 53083);  // glowing: 0.81
}

TEST_CASE("by object each has a node, a mesh and a material under its name, of all its copies", "[gltf]") {
  driver::Product product = test::two_squares();
  const driver::Product once = product;
  for (const driver::ProductCopy& copy : once.copies) {  // the same again, as copies of another object
    const auto first = static_cast<std::ptrdiff_t>(copy.first_vertex);
    const auto cut = [first](const auto& all) { return std::vector(all.begin() + first, all.begin() + first + 4); };
    test::add_copy(product, cut(once.positions), cut(once.uv), {0, 1, 2, 0, 2, 3});
  }
  product.objects = {"floor", "unseen", "\"statue\" 2"};
  for (std::size_t i = 0; i < 4; ++i) product.copies[i].object = i < 2 ? 0 : 2;
  product.copies[2].duplicate_of = 0, product.copies[3].duplicate_of = 1;
  const std::string json = split(gltf::write_gltf(product, {.nodes_per_object = true})[0].bytes).json;
  CHECK(contains(json, R"("nodes":[0,1,2]}])"));
  CHECK(contains(json, R"({"name":"floor","mesh":0,"extras":{"orbc_object":"floor","orbc_copies":2}},)"));
  CHECK(contains(json, R"({"name":"\"statue\" 2","mesh":1,"extras":{"orbc_object":"\"statue\" 2","orbc_copies":2}})"));
  CHECK(contains(
      json,
      R"("meshes":[{"name":"floor","primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":2},"indices":3,"material":0}]},)"));
  CHECK(contains(
      json,
      R"({"name":"\"statue\" 2","primitives":[{"attributes":{"POSITION":4,"TEXCOORD_0":5,"COLOR_0":6},"indices":7,"material":1}]}])"));
  CHECK(contains(json, R"("materials":[{"name":"floor",)"));
  CHECK(contains(json, R"({"name":"\"statue\" 2","doubleSided":true,)"));
  CHECK(contains(json, R"("object":"floor","primitive":0,"first_index":6,"index_count":6})"));
  CHECK(!contains(json, "unseen"));
}

TEST_CASE("an atlas with holes is a mask at one half, and one of sixteen bits is a PNG of sixteen bits", "[gltf]") {
  driver::Product product = test::two_squares();
  product.masked = true;
  product.atlas.rgba[3] = 0;
  const Glb glb = split(gltf::write_gltf(product)[0].bytes);
  CHECK(contains(glb.json, R"("alphaMode":"MASK","alphaCutoff":0.5)"));
  CHECK(image_io::decode_png(glb.bin.substr(248), "PNG").value().rgba[3] == 0);
  product.depth = scene::AtlasFormat::srgb16;
  product.atlas16 = {2, 1, {65535, 32896, 0, 2570, 5140, 7710}};
  const std::string png = split(gltf::write_gltf(product)[0].bytes).bin.substr(248);
  CHECK(png[24] == 16);
  CHECK(image_io::decode_png(png, "PNG").value().rgba == std::vector<std::uint8_t>{255, 128, 0, 0, 10, 20, 30, 255});
}

TEST_CASE("indices need four bytes from 65536 vertices on", "[gltf]") {
  for (const std::size_t vertices : {std::size_t{65535}, std::size_t{65536}}) {
    driver::Product product = test::empty_product();
    std::vector<std::array<float, 3>> positions(vertices);
    for (std::size_t i = 0; i < vertices; ++i) positions[i] = {static_cast<float>(i), static_cast<float>(i % 7), 1};
    test::add_copy(product, positions, std::vector<std::array<float, 2>>(vertices), {0, 1, static_cast<std::uint32_t>(vertices - 1)});
    const Glb glb = split(gltf::write_gltf(product)[0].bytes);
    CHECK(contains(glb.json, vertices > 65535 ? R"("componentType":5125,"count":3)" : R"("componentType":5123,"count":3)"));
    if (vertices > 65535) CHECK(at<std::uint32_t>(glb.bin, 28 * vertices + 8) == 65535);
  }
}

TEST_CASE("copies that do not follow one another become primitives of their own", "[gltf]") {
  driver::Product product = test::two_squares();
  std::swap(product.copies[0], product.copies[1]);
  const Glb glb = split(gltf::write_gltf(product)[0].bytes);
  CHECK(contains(glb.json,
                 R"({"attributes":{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":2},"indices":3,"material":0},{"attributes":{"POSITION":4,)"));
  CHECK(contains(glb.json, R"("primitive":1,"first_index":0,"index_count":6)"));
  CHECK(at<float>(glb.bin, 0) == 3.0f);  // the parts are written in the order of the copies
  CHECK(at<std::uint16_t>(glb.bin, 160) == 53083);
}

TEST_CASE("with a node per copy each copy has its name, facts and factor", "[gltf]") {
  const Glb glb = split(gltf::write_gltf(test::two_squares(), {.nodes_per_copy = true})[0].bytes);
  CHECK(contains(glb.json, R"({"name":"copies","children":[2,3]},{"name":"room","mesh":0,"extras":{"word":"",)"));
  CHECK(contains(glb.json, R"({"name":"copy 2 1","mesh":1,"extras":{"word":"2 1","bounces":2,)"));
  CHECK(contains(glb.json, R"("baseColorFactor":[0.81,0.6561,0.5,1])"));
  CHECK_FALSE(contains(glb.json, "COLOR_0"));
}

TEST_CASE("the text form has its buffer and atlas beside it", "[gltf]") {
  const std::vector<driver::File> files = gltf::write_gltf(test::two_squares(), {.name = "squares", .binary = false});
  REQUIRE(files.size() == 3);
  CHECK(files[1].name == exporters::side_file_name({"squares", "gltf", "", ".bin"}, files[1].bytes));
  CHECK(files[1].bytes.size() == 248);
  CHECK(files[2].name == exporters::side_file_name({"squares", "gltf", "-atlas", ".png"}, files[2].bytes));
  CHECK(contains(files[0].bytes, R"("buffers":[{"byteLength":248,"uri":")" + files[1].name + R"("}])"));
  CHECK(contains(files[0].bytes, R"("images":[{"name":"atlas","uri":")" + files[2].name + R"("}])"));
}

TEST_CASE("a product without triangles is a scene with a camera", "[gltf]") {
  for (const bool binary : {true, false}) {
    const std::vector<driver::File> files = gltf::write_gltf(test::empty_product(), {.binary = binary});
    REQUIRE(files.size() == 1);
    const std::string json = binary ? split(files[0].bytes).json : files[0].bytes;
    CHECK(contains(json, R"("nodes":[0]})"));
    for (const char* key : {"meshes", "materials", "buffers", "accessors", "images", "extensionsUsed"}) CHECK_FALSE(contains(json, key));
  }
  driver::Product hollow = test::two_squares();
  for (driver::ProductCopy& copy : hollow.copies) copy.index_count = 0;
  CHECK_FALSE(contains(split(gltf::write_gltf(hollow)[0].bytes).json, "meshes"));
}

TEST_CASE("a panorama's camera says so in its extras", "[gltf]") {
  driver::Product product = test::two_squares();
  product.eye.projection = scene::Projection::panorama;
  CHECK(contains(split(gltf::write_gltf(product)[0].bytes).json, R"("extras":{"orbc_projection":"panorama","orbc_width":80,)"));
}

TEST_CASE("an atlas of baked light is looked up bilinearly", "[gltf]") {
  driver::Product product = test::two_squares();
  product.bilinear_atlas = true;
  CHECK(contains(split(gltf::write_gltf(product)[0].bytes).json, R"("samplers":[{"magFilter":9729,"minFilter":9729,)"));
}

TEST_CASE("weights outside [0, 1] are clamped, as the format demands", "[gltf]") {
  driver::Product product = test::two_squares();
  product.copies[1].weight = {1.5, -0.25, 1};
  const Glb glb = split(gltf::write_gltf(product)[0].bytes);
  CHECK(at<std::uint16_t>(glb.bin, 160 + 32) == 65535);
  CHECK(at<std::uint16_t>(glb.bin, 160 + 34) == 0);
  CHECK(contains(split(gltf::write_gltf(product, {.nodes_per_copy = true})[0].bytes).json, R"("baseColorFactor":[1,0,1,1])"));
}

TEST_CASE("strings become JSON whatever bytes they hold", "[gltf]") {
  const auto json = [](std::string_view text) {
    std::string out;
    exporters::Pen pen(out);
    gltf::Json(pen).string(text);
    pen.flush();
    return out;
  };
  CHECK(json("a\"b\\c\n\x01") == R"("a\"b\\c\u000a\u0001")");
  CHECK(json("∗237 ü 🎈") == "\"∗237 ü 🎈\"");
  CHECK(json("x\xff\xc0\x80y") == R"("x\ufffd\ufffd\ufffdy")");
  CHECK(json("\xed\xa0\x80") == R"("\ufffd\ufffd\ufffd")");  // a surrogate
  CHECK(json("\xe2\x82") == R"("\ufffd\ufffd")");            // cut off
  CHECK(json(std::string(2000, 'x')).size() == 2002);
}

TEST_CASE("the same product gives the same bytes", "[gltf]") {
  CHECK(gltf::write_gltf(test::two_squares())[0].bytes == gltf::write_gltf(test::two_squares())[0].bytes);
}
