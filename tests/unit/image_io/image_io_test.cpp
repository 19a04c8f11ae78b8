#include <cstdio>  // jpeglib.h needs it
#include <jpeglib.h>

#include <catch2/catch.hpp>
#include <random>

#include "compiler/image_io/decode.h"
#include "compiler/image_io/exr.h"
#include "compiler/image_io/jpeg.h"
#include "compiler/image_io/png.h"
#include "tests/support/folder.h"

using namespace orbc;
using namespace orbc::image_io;
using orbc::image::Image;
using orbc::image::Image16;
using orbc::test::Folder;

namespace {

Image noise(int width, int height, bool opaque) {
  std::mt19937 random(7);
  Image image{width, height, {}};
  for (int i = 0; i < 4 * width * height; ++i) image.rgba.push_back(opaque && i % 4 == 3 ? 255 : static_cast<std::uint8_t>(random()));
  return image;
}

std::string jpeg(int width, int height) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &bytes, &size);
  info.image_width = static_cast<JDIMENSION>(width), info.image_height = static_cast<JDIMENSION>(height);
  info.input_components = 3, info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 95, TRUE);
  jpeg_start_compress(&info, TRUE);
  std::vector<unsigned char> row;
  for (int x = 0; x < width; ++x) row.insert(row.end(), {200, 100, 50});
  JSAMPROW rows[] = {row.data()};
  for (int y = 0; y < height; ++y) jpeg_write_scanlines(&info, rows, 1);
  jpeg_finish_compress(&info);
  std::string out(reinterpret_cast<char*>(bytes), size);
  jpeg_destroy_compress(&info);
  free(bytes);
  return out;
}

std::string code(const Result<Image>& result) { return result ? "fine" : result.error().front().code; }

}  // namespace

TEST_CASE("a picture comes back from PNG as it was, and gives the same bytes every time", "[image_io]") {
  for (const auto& image : {noise(17, 5, true), noise(17, 5, false), noise(1, 1, true), noise(300, 200, false)}) {
    const auto bytes = encode_png(image);
    CHECK(bytes == encode_png(image));
    CHECK(bytes.find("tIME") == bytes.npos);
    const auto back = decode_png(bytes, "PNG");
    REQUIRE(back);
    CHECK(back->width == image.width);
    CHECK(back->height == image.height);
    CHECK(back->rgba == image.rgba);
  }
}

TEST_CASE("a JPEG is read as RGB, whatever its name", "[image_io]") {
  const Folder folder("jpeg");
  const auto image = load_image(folder.write("a.png", jpeg(20, 10)));
  REQUIRE(image);
  CHECK(image->width == 20);
  CHECK(image->height == 10);
  CHECK(std::abs(image->rgba[0] - 200) <= 2);
  CHECK(std::abs(image->rgba[1] - 100) <= 2);
  CHECK(std::abs(image->rgba[2] - 50) <= 2);
  CHECK(image->rgba[3] == 255);
}

TEST_CASE("a JPEG that is written shows the picture, without its alpha, and has the same bytes every time", "[image_io]") {
  Image picture{65, 40, {}};
  for (int i = 0; i < picture.width * picture.height; ++i)
    picture.rgba.insert(picture.rgba.end(), {static_cast<std::uint8_t>(i % 65 * 3), static_cast<std::uint8_t>(i / 65 * 6), 90, 0});
  const std::string bytes = encode_jpeg(picture);
  CHECK(bytes == encode_jpeg(picture));
  CHECK(bytes.size() < picture.rgba.size());
  CHECK(encode_jpeg(picture, 30).size() < bytes.size());
  const auto back = decode_image(bytes, "a JPEG");
  REQUIRE(back);
  REQUIRE(back->width == 65);
  REQUIRE(back->height == 40);
  int worst = 0;
  for (std::size_t i = 0; i < back->rgba.size(); ++i)
    worst = std::max(worst, std::abs(i % 4 == 3 ? back->rgba[i] - 255 : back->rgba[i] - picture.rgba[i]));
  CHECK(worst <= 6);
}

TEST_CASE("pictures that are too large, broken or none are refused", "[image_io]") {
  const Folder folder("pictures");
  CHECK(code(load_image(folder("gone.png"))) == "mesh.missing-file");
  CHECK(code(load_image(folder.path())) == "mesh.not-a-file");
  CHECK(code(load_image(folder.write("a.png", "hello"))) == "mesh.bad-image");
  CHECK(code(decode_image("", "x")) == "mesh.bad-image");
  auto png = encode_png(noise(40, 40, true));
  CHECK(code(decode_image(png, "x", {.max_side = 39})) == "mesh.image-too-big");
  CHECK(code(decode_image(png, "x", {.max_bytes = 6000})) == "mesh.image-too-big");
  CHECK(code(decode_image(jpeg(40, 40), "x", {.max_side = 39})) == "mesh.image-too-big");
}

TEST_CASE("cut off and bent pictures are a picture or a diagnostic", "[image_io]") {
  std::mt19937 random(1);
  for (const auto& whole : {encode_png(noise(20, 20, false)), jpeg(40, 30)}) {
    for (std::size_t length = 0; length < whole.size(); ++length) CHECK(code(decode_image(whole.substr(0, length), "x")) != "");
    for (int round = 0; round < 3000; ++round) {
      auto bytes = whole;
      for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
      const auto image = decode_image(bytes, "x");
      if (image)
        REQUIRE(image->rgba.size() == std::size_t{4} * static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height));
    }
  }
}

TEST_CASE("a picture of 16 bits is written with all of them, and comes back from EXR as linear light", "[image_io]") {
  const Image16 picture{2, 1, {0, 1000, 65535, 3, 4, 5}};
  const std::string png = encode_png(picture);
  CHECK(png[24] == 16);  // bit depth in IHDR
  CHECK(decode_image(png, "a PNG")->rgba == std::vector<std::uint8_t>{0, 4, 255, 255, 0, 0, 0, 255});
  const auto exr = decode_exr(encode_exr(picture));
  REQUIRE(exr);
  CHECK(exr->channels.at("R")[0] == 0);
  CHECK(exr->channels.at("B")[0] == 1);
  CHECK(exr->channels.at("G")[0] == Approx(1000 / 65535.0 / 12.92).epsilon(1e-3));
}

TEST_CASE("channels of floats come back from EXR as they were, and damaged files are refused", "[image_io]") {
  const orbc::image::FloatImage picture{2, 2, {{"Z", {1, 2.5f, -3, 1e30f}}, {"object.id", {-2, 0, 1, 7}}}};
  const std::string bytes = encode_exr(picture);
  CHECK(is_exr(bytes));
  CHECK(bytes == encode_exr(picture));
  const auto back = decode_exr(bytes);
  REQUIRE(back);
  CHECK(back->width == 2);
  CHECK(back->channels == picture.channels);
  CHECK_FALSE(decode_exr(bytes.substr(0, bytes.size() / 2)));
  CHECK_FALSE(decode_exr("hello"));
}
