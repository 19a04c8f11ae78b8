// What files beside an export are called: exporters/side_file.h.
#include "exporters/side_file.h"

#include <catch2/catch.hpp>
#include <set>

using namespace orbc::exporters;

TEST_CASE("the name of a side file tells its content, its main output's stem and its format", "[pov]") {
  const SideFileName name{"room", "pov", "-atlas", ".png"};
  const std::string first = side_file_name(name, "some bytes");
  CHECK(first.substr(0, 11) == "room-atlas-");
  CHECK(first.size() == std::string("room-atlas-0a1b2c3d4e5f.png").size());
  CHECK(first == side_file_name(name, "some bytes"));
  const std::set<std::string> different = {first,
                                           side_file_name(name, "some byte"),
                                           side_file_name(name, "some bytes "),
                                           side_file_name(name, "Some bytes"),
                                           side_file_name(name, ""),
                                           side_file_name(name, std::string(1, '\0')),
                                           side_file_name(name, std::string(8, '\0')),
                                           side_file_name({"room", "gltf", "-atlas", ".png"}, "some bytes"),
                                           side_file_name({"rooms", "pov", "-atlas", ".png"}, "some bytes")};
  CHECK(different.size() == 9);
  // An output of 200 bytes of which each bit in turn is another.
  std::set<std::string> names;
  for (std::size_t bit = 0; bit < 1600; ++bit) {
    std::string bytes(200, 'x');
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    names.insert(side_file_name(name, bytes));
  }
  CHECK(names.size() == 1600);
}

TEST_CASE("a side file is recognised by its name and content together", "[pov]") {
  const std::string name = side_file_name({"room", "pov", "-mask", ".png"}, "mask");
  CHECK(is_side_file(name, "mask", "room", "pov"));
  CHECK_FALSE(is_side_file(name, "musk", "room", "pov"));
  CHECK_FALSE(is_side_file(name, "mask", "room", "gltf"));
  CHECK_FALSE(is_side_file(name, "mask", "roo", "pov"));
  CHECK_FALSE(is_side_file("room-mask-0123456789ab.png", "mask", "room", "pov"));
  for (const char* other : {"room.png", "room-0123456789a.png", "room-0123456789aX.png", "0123456789ab.png", "-0123456789ab", ""})
    CHECK_FALSE(is_side_file(other, "mask", "room", "pov"));
}

TEST_CASE("names of side files fit into 255 bytes of plain ASCII, and long stems stay apart", "[pov]") {
  const std::string stem(251, 'n');
  const std::string name = side_file_name({stem, "pov", "-atlas", ".png"}, "x");
  CHECK(name.size() <= 255);
  CHECK(is_side_file(name, "x", stem, "pov"));
  CHECK(name != side_file_name({stem.substr(1), "pov", "-atlas", ".png"}, "x"));
  for (const char c : side_file_name({"r\xC3\xA4um \"1\"", "gltf", "", ".bin"}, "x")) CHECK((c > ' ' && c < 127 && c != '"'));
}
