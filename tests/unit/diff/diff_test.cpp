#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "compiler/diff/compare.h"
#include "compiler/diff/json.h"
#include "compiler/diff/tokens.h"
#include "compiler/image/image.h"
#include "compiler/image_io/exr.h"
#include "compiler/image_io/png.h"

using namespace orbc;
using namespace orbc::diff;

namespace {

Source source(const std::string& name, std::string bytes, const std::string& folder = "/nowhere") {
  return {name, folder, std::filesystem::path(name).stem().string(), std::move(bytes)};
}

Finding compared(Form form, const std::string& a, const std::string& b, double within = 0) {
  const std::string ending = form == Form::pov ? ".pov" : form == Form::svg ? ".svg" : form == Form::json ? ".json" : ".glb";
  return compare(form, source("a" + ending, a), source("b" + ending, b), {within, 0}).value();
}

std::string error_of(Form form, const std::string& a) {
  const auto result = compare(form, source("a", a), source("b", a), {});
  return result ? "" : result.error().front().message;
}

std::string word(std::uint32_t value) { return std::string(reinterpret_cast<const char*>(&value), 4); }

/// A GLB of a JSON text and a binary chunk.
std::string glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto total = static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size());
  return "glTF" + word(2) + word(total) + word(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
         word(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
}

/// Three floats behind each other, `pad` bytes before them.
std::string floats(float x, float y, float z, std::size_t pad = 0) {
  std::string bytes(pad + 12, '\0');
  for (const float v : {x, y, z}) std::memcpy(bytes.data() + pad, &v, 4), pad += 4;
  return bytes;
}

std::string column_of(std::size_t offset, const std::string& accessor) {
  return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(offset + 12) +
         R"(}],"bufferViews":[{"buffer":0,"byteOffset":)" + std::to_string(offset) + R"(,"byteLength":12}],"accessors":[)" + accessor +
         "]}";
}

const std::string kScalars = R"({"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"})";

}  // namespace

TEST_CASE("differences of numbers are absolute up to 1 and relative beyond", "[diff]") {
  CHECK(distance(0.25, 0.5) == 0.25);
  CHECK(distance(1e-9, -1e-9) == 2e-9);
  CHECK(distance(1000, 1001) == Approx(1.0 / 1001));
  CHECK(distance(1e308, -1e308) == 2);
  const double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
  CHECK(distance(infinite, infinite) == 0);
  CHECK(distance(none, none) == 0);
  CHECK(distance(infinite, -infinite) == infinite);
  CHECK(distance(none, 0) == infinite);
}

TEST_CASE("texts agree when their tokens do, however they are broken into lines", "[diff]") {
  CHECK_FALSE(compared(Form::pov, "box { <0,1.5, -2>, 1 }\n", "box{<0, 1.50,\n-2.0>,+1}").differs);
  CHECK(compared(Form::pov, "box { <0, 1> }", "sphere { <0, 1> }").differs);
  CHECK(compared(Form::pov, "box { <0, 1> }", "box { <0, 1> ").first.what == "} against the end of the file");
  CHECK_FALSE(compared(Form::svg, "<path d=\"M1.5-2L3 4\"/>", "<path d=\"M 1.5 -2 L 3,4\"/>").same_structure);  // a comma is a token
  CHECK_FALSE(compared(Form::svg, "<path d=\"M1.5-2L3 4\"/>", "<path d=\"M 1.5 -2 L 3.0 4\"/>").differs);
  CHECK(compared(Form::svg, "<g fill=\"#a0b0c0\"/>", "<g fill=\"#a0b0c1\"/>").differs);
}

TEST_CASE("numbers within the bound agree, and the largest difference is told with its place", "[diff]") {
  const std::string a = "mesh2 {\n  <0.5, 0.25>\n  <1.5, 7>\n}", b = "mesh2 {\n  <0.5000001, 0.25>\n  <1.5000006, 7>\n}";
  const Finding near = compared(Form::pov, a, b, 1e-6);
  CHECK_FALSE(near.differs);
  CHECK(near.numbers == 4);
  CHECK(near.numbers_differing == 2);
  CHECK(near.largest == Approx(4e-7).epsilon(1e-6));
  CHECK(near.largest_at == "3:4");
  const Finding far = compared(Form::pov, a, b, 1e-8);
  CHECK(far.differs);
  CHECK(far.same_structure);
  CHECK(far.first.at == "2:4");
  CHECK(far.first.at_in_other == "2:4");
  CHECK(far.first.what == "0.5 against 0.5000001");
  CHECK(far.numbers_beyond == 2);
}

TEST_CASE("whole numbers are structure: an index may not differ however wide the bound", "[diff]") {
  CHECK(compared(Form::pov, "<1000000, 2>", "<1000001, 2>", 0.1).differs);
  CHECK_FALSE(compared(Form::pov, "<1, 2>", "<1.0000001, 2>", 1e-6).differs);
  CHECK(compared(Form::json, R"({"copies": 1000000})", R"({"copies": 1000001})", 0.1).first.at == "$.copies");
  CHECK_FALSE(compared(Form::json, R"({"error": 1})", R"({"error": 1.0000001})", 1e-6).differs);
}

TEST_CASE("comments count, but for the names of the files themselves", "[diff]") {
  CHECK_FALSE(compared(Form::pov, "// Draw: povray +Ia.pov +W8\n#declare A = \"a-atlas\";",
                       "// Draw: povray +Ib.pov +W8\n#declare A = \"b-atlas\";")
                  .differs);
  // What is in a file is compared by itself; the digits in its name say no more than that it differs.
  const std::string one = R"({"uri": "a-0123456789ab.bin"})", same = R"({"uri": "b-ba9876543210.bin"})";
  CHECK_FALSE(compared(Form::json, one, same).differs);
  CHECK(compared(Form::json, one, R"({"uri": "b-ba987654321.bin"})").differs);
  CHECK(compared(Form::json, one, R"({"uri": "c-ba9876543210.bin"})").differs);
  CHECK(compared(Form::pov, "// size: +W800\n", "// size: +W801\n").differs);
  CHECK_FALSE(compared(Form::pov, "// weight 0.5\n", "// weight 0.5000000001\n", 1e-6).differs);
  CHECK(compared(Form::pov, "/* open", "/* opened").differs);
}

TEST_CASE("trees of JSON are compared by path", "[diff]") {
  CHECK_FALSE(compared(Form::json, R"({"a": 1, "b": [1, {"c": 0.5}]})", R"({ "b": [1, {"c": 5e-1}], "a": 1 })").differs);
  const Finding number = compared(Form::json, R"({"b": [1, {"c": 0.5}]})", R"({"b": [1, {"c": 0.75}]})", 0.1);
  CHECK(number.first.at == "$.b[1].c");
  CHECK(number.first.what == "0.5 against 0.75");
  CHECK(number.largest == 0.25);
  CHECK(compared(Form::json, R"({"b": 1})", R"({"b": 1, "c": 2})").first.at == "$.c");
  CHECK(compared(Form::json, R"([1, 2])", R"([1])").first.what == "a list of 2 against a list of 1");
  CHECK(compared(Form::json, R"({"x": null})", R"({"x": 0})").differs);
  CHECK(compared(Form::json, R"({"x": "1"})", R"({"x": 1})").differs);
}

TEST_CASE("accessors of glTF are decoded, wherever they lie", "[diff]") {
  const std::string a = glb(column_of(0, kScalars), floats(1, 2, 3));
  CHECK_FALSE(compared(Form::glb, a, glb(column_of(16, kScalars), floats(1, 2, 3, 16))).differs);
  const std::string near = glb(column_of(0, kScalars), floats(1, 2.000001F, 3));
  CHECK_FALSE(compared(Form::glb, a, near, 1e-6).differs);
  const Finding far = compared(Form::glb, a, near, 1e-9);
  CHECK(far.first.at == "accessor 0, element 1, component 0");
  CHECK(far.numbers_beyond == 1);
  CHECK(far.largest == Approx(1e-6 / 2).epsilon(0.1));
  const std::string index = R"({"bufferView":0,"componentType":5125,"count":3,"type":"SCALAR"})";
  CHECK(compared(Form::glb, glb(column_of(0, index), word(1) + word(2) + word(3000000)),
                 glb(column_of(0, index), word(1) + word(2) + word(3000001)), 0.5)
            .differs);
}

TEST_CASE("pictures are compared in steps, and the pixel that differs most is named", "[diff]") {
  image::Image one{3, 2, std::vector<std::uint8_t>(24, 100)}, other = one;
  for (std::size_t i = 3; i < 24; i += 4) one.rgba[i] = other.rgba[i] = 255;
  other.rgba[4 * 4 + 1] = 103;
  const std::string a = image_io::encode_png(one), b = image_io::encode_png(other);
  const Finding beyond = compare(Form::picture, source("a.png", a), source("b.png", b), {0, 2}).value();
  CHECK(beyond.differs);
  CHECK(beyond.first.at == "a.png, pixel (1, 1)");
  CHECK(beyond.largest_step == 3);
  CHECK(beyond.pixels == 6);
  CHECK_FALSE(compare(Form::picture, source("a.png", a), source("b.png", b), {0, 3}).value().differs);
  image::Image16 deep{2, 1, {0, 1000, 65535, 3, 4, 5}}, moved = deep;
  moved.rgb[1] = 2000;
  const Finding exr =
      compare(Form::picture, source("a.exr", image_io::encode_exr(deep)), source("b.exr", image_io::encode_exr(moved)), {0, 3}).value();
  CHECK(exr.differs);
  CHECK(exr.largest_step == Approx(1000 / 257.0).epsilon(0.01));
  CHECK_FALSE(compare(Form::picture, source("a.exr", image_io::encode_exr(deep)), source("b.exr", image_io::encode_exr(moved)), {0, 4})
                  .value()
                  .differs);
  CHECK(compare(Form::picture, source("a.png", a), source("b.exr", image_io::encode_exr(deep)), {}).value().differs);
}

TEST_CASE("PNG pictures of 16 bits are compared in all of their bits", "[diff]") {
  image::Image16 deep{2, 1, {0, 1000, 65535, 3, 4, 5}}, moved = deep;
  moved.rgb[1] = 1064;  // a quarter of a step: the same in 8 bits
  const std::string a = image_io::encode_png(deep), b = image_io::encode_png(moved);
  const Finding exact = compare(Form::picture, source("a.png", a), source("b.png", b), {}).value();
  CHECK(exact.differs);
  CHECK(exact.first.at == "a.png, pixel (0, 0)");
  CHECK(exact.largest_step == Approx(64 / 257.0));
  CHECK_FALSE(compare(Form::picture, source("a.png", a), source("b.png", b), {0, 1}).value().differs);
  CHECK_FALSE(compare(Form::picture, source("a.png", a), source("b.png", a), {}).value().differs);
  // Against a picture of 8 bits, whose code 128 is 128 * 257 of 65535.
  const image::Image flat{1, 1, {128, 128, 128, 255}};
  const image::Image16 same{1, 1, {128 * 257, 128 * 257, 128 * 257}};
  CHECK_FALSE(
      compare(Form::picture, source("a.png", image_io::encode_png(flat)), source("b.png", image_io::encode_png(same)), {}).value().differs);
  for (std::size_t length = 30; length < a.size(); length += 5)
    CHECK_FALSE(compare(Form::picture, source("a.png", a.substr(0, length)), source("b.png", b), {}).has_value());
}

TEST_CASE("pictures that a scene names are looked into, beside it and inlined", "[diff]") {
  image::Image one{1, 1, {1, 2, 3, 255}}, other{1, 1, {1, 2, 5, 255}};
  const auto folder = std::filesystem::path(ORBC_BINARY_DIR) / "diff_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a-atlas.png", std::ios::binary) << image_io::encode_png(one);
  std::ofstream(folder / "b-atlas.png", std::ios::binary) << image_io::encode_png(other);
  const Source a = source("a.pov", "image_map { png \"a-atlas.png\" }", folder),
               b = source("b.pov", "image_map { png \"b-atlas.png\" }", folder);
  CHECK(compare(Form::pov, a, b, {0, 1}).value().first.at == "a-atlas.png, pixel (0, 0)");
  CHECK_FALSE(compare(Form::pov, a, b, {0, 2}).value().differs);
  const auto missing = compare(Form::pov, source("c.pov", "\"c-atlas.png\"", folder), source("b.pov", "\"b-atlas.png\"", folder), {});
  CHECK(missing.error().front().code == "diff.cannot-read");
  CHECK(compare(Form::pov, source("c.pov", "\"../c.png\"", folder), source("b.pov", "\"../c.png\"", folder), {}).error().front().code ==
        "diff.cannot-read");
  const std::string inlined = "/* orbc-file scene-atlas.png base64\nAAAA\n*/";
  CHECK(error_of(Form::pov, inlined).find("cannot be read") != std::string::npos);
  // The picture of one white pixel, named before it is carried along: there is no such file.
  const std::string white = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4//8/AAX+Av4N70a4AAAAAElFTkSuQmCC";
  const std::string piped = "image_map { png \"scene-atlas.png\" }\n/* orbc-file scene-atlas.png base64\n" + white + "\n*/";
  CHECK(compare(Form::pov, source("x.pov", piped), source("y.pov", piped), {}).value().pixels == 1);
  CHECK(decode_base64("b3J\niYw==").value() == "orbc");
  CHECK_FALSE(decode_base64("b3J!").has_value());
}

TEST_CASE("damaged files are refused with the reason, not read", "[diff]") {
  CHECK(error_of(Form::json, "{\"a\": ").find("line 1") != std::string::npos);
  CHECK(error_of(Form::json, std::string(100000, '[')).find("inside each other") != std::string::npos);
  CHECK(error_of(Form::glb, "glTF").find("no GLB") != std::string::npos);
  const std::string whole = glb(column_of(0, kScalars), floats(1, 2, 3));
  for (std::size_t length = 0; length < whole.size(); ++length) CHECK_FALSE(error_of(Form::glb, whole.substr(0, length)).empty());
  const auto with = [](const std::string& accessor) { return error_of(Form::glb, glb(column_of(0, accessor), floats(1, 2, 3))); };
  CHECK(with(kScalars).empty());
  CHECK(with(R"({"bufferView":0,"componentType":5126,"count":4,"type":"SCALAR"})").find("leaves its buffer view") != std::string::npos);
  CHECK(with(R"({"bufferView":0,"componentType":5126,"count":18446744073709551615,"type":"SCALAR"})").find("leaves") != std::string::npos);
  CHECK(with(R"({"bufferView":0,"byteOffset":18446744073709551613,"componentType":5126,"count":1,"type":"SCALAR"})").find("leaves") !=
        std::string::npos);
  CHECK(with(R"({"bufferView":7,"componentType":5126,"count":1,"type":"SCALAR"})").find("bufferViews[7]") != std::string::npos);
  CHECK(with(R"({"bufferView":-1,"componentType":5126,"count":1,"type":"SCALAR"})").find("no whole number") != std::string::npos);
  CHECK(with(R"({"bufferView":0,"componentType":9,"count":1,"type":"SCALAR"})").find("componentType") != std::string::npos);
  CHECK(with(R"({"bufferView":0,"componentType":5126,"count":1,"type":5})").find("type") != std::string::npos);
  CHECK(with(R"({"bufferView":0,"componentType":5126,"count":1,"type":"SCALAR","sparse":{}})").find("sparse") != std::string::npos);
  CHECK(error_of(Form::picture, "nothing").find("cannot be read") != std::string::npos);
  const std::string exr = image_io::encode_exr({2, 1, {0, 1000, 65535, 3, 4, 5}});
  for (std::size_t length = 4; length < exr.size(); length += 7) CHECK_FALSE(error_of(Form::picture, exr.substr(0, length)).empty());
}

TEST_CASE("any bytes can be compared as text", "[diff]") {
  std::uint32_t state = 1;
  for (int round = 0; round < 300; ++round) {
    std::string text;
    for (int i = 0; i < 200; ++i) {
      state = state * 1664525 + 1013904223;
      text += round % 2 ? static_cast<char>(state >> 24) : "0123456789.eE+-\"/*<>#aM \n"[(state >> 24) % 25];
    }
    CHECK_FALSE(compared(Form::svg, text, text).differs);
    const auto pov = compare(Form::pov, source("a.pov", text), source("b.pov", text), {});
    CHECK((!pov || !pov->differs));
  }
}
