// The boundary that the page calls, here in the program: what it says of scenes is what the compiler says.
#include "exporters/html/core/core.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compiler/geometry/isometry.h"
#include "exporters/html/core/page_assets.h"

using namespace orbc;
using Json = nlohmann::json;

namespace {

const std::string kPentagon = R"(orbc: 1
orbifold: "*22222"
room: {height: 0.9, floor: {checker: [ivory, slategray], cell: 0.2}, walls: {all: {mirror: {reflectance: 0.9}}}}
objects:
  - {sphere: {radius: 0.1}, at: {polar: [0.2, 40deg]}, material: coral}
lights:
  - {kind: point, at: {polar: [0.1, 200deg], z: 0.7}, power: 4}
cover: {max_bounces: 3}
)";

Json json_of(const OrbcReply* reply) { return Json::parse(std::string(reply->json, reply->json_size)); }

template <class T>
std::vector<T> block(const OrbcReply* reply, const Json& array) {
  std::vector<T> list(array.at("count").get<std::size_t>());
  std::memcpy(list.data(), reply->block + array.at("at").get<std::size_t>(), list.size() * sizeof(T));
  return list;
}

}  // namespace

TEST_CASE("an open scene tells its room", "[html]") {
  const Json scene = json_of(orbc_open(kPentagon.data(), kPentagon.size()));
  REQUIRE(scene.at("ok") == true);
  CHECK(scene.at("orbifold").at("notation") == "*22222");
  CHECK(scene.at("orbifold").at("chi") == "-1/4");
  CHECK(scene.at("room").at("curvature") == -1);
  CHECK(scene.at("room").at("walls").size() == 5);
  CHECK(scene.at("shell").at("walls").at(0).at("mirrors").at(0).at("throughput").at(0).get<double>() == Approx(0.9));
  CHECK(scene.at("objects").at(0).at("name") == "sphere");
}

TEST_CASE("drawn vertices lie on the hyperboloid, and indices among them", "[html]") {
  const OrbcReply* reply = orbc_open(kPentagon.data(), kPentagon.size());
  const Json meshes = json_of(reply).at("meshes");
  const auto positions = block<float>(reply, meshes.at("positions"));
  REQUIRE(positions.size() > 400);
  for (std::size_t i = 0; i < positions.size(); i += 4)
    REQUIRE(positions[i] * positions[i] - positions[i + 1] * positions[i + 1] - positions[i + 2] * positions[i + 2] ==
            Approx(1).margin(1e-5));
  for (const std::uint32_t index : block<std::uint32_t>(reply, meshes.at("parts").at(0).at("indices")))
    REQUIRE(index < positions.size() / 4);
}

TEST_CASE("errors keep the open scene and say where they are", "[html]") {
  REQUIRE(json_of(orbc_open(kPentagon.data(), kPentagon.size())).at("ok") == true);
  std::string wrong = kPentagon;
  wrong.replace(wrong.find("radius: 0.1"), 11, "radius: -.1");
  const Json reply = json_of(orbc_open(wrong.data(), wrong.size()));
  CHECK(reply.at("ok") == false);
  CHECK(reply.at("diagnostics").at(0).at("severity") == "error");
  CHECK(reply.at("diagnostics").at(0).at("line") == 5);
  CHECK(json_of(orbc_copies(1, 100)).at("lengths").at("count") == 6);  // of the pentagon, which is still open
}

TEST_CASE("copies of a pentagon are those of its group", "[html]") {
  REQUIRE(json_of(orbc_open(kPentagon.data(), kPentagon.size())).at("ok") == true);
  const OrbcReply* reply = orbc_copies(2, 1000);
  const Json copies = json_of(reply);
  CHECK(copies.at("lengths").at("count") == 1 + 5 + 15);  // 5·4 words of two letters, of which neighbours commute
  CHECK(copies.at("whole") == true);
  const auto matrices = block<double>(reply, copies.at("matrices"));
  CHECK(matrices[0] == 1);
  CHECK(json_of(orbc_copies(9, 10)).at("whole") == false);
}

TEST_CASE("all points of the light job are lit, and those by the lamp brightest", "[html]") {
  REQUIRE(json_of(orbc_open(kPentagon.data(), kPentagon.size())).at("ok") == true);
  std::size_t points = 0;
  float most = 0;
  for (;;) {
    const OrbcReply* reply = orbc_light(4000);
    const Json light = json_of(reply);
    for (const float x : block<float>(reply, light.at("irradiance"))) most = std::max(most, x);
    points += light.at("irradiance").at("count").get<std::size_t>() / 3;
    if (light.at("done") == light.at("all")) break;
  }
  CHECK(points > 9000);
  CHECK(most > 0.05f);
}

TEST_CASE("a traced tile shows the floor below the eye", "[html]") {
  const std::string plain = "orbc: 1\norbifold: \"*22222\"\nroom: {floor: {color: \"#ff0000\"}}\n";
  REQUIRE(json_of(orbc_open(plain.data(), plain.size())).at("ok") == true);
  // The eye in the middle, looking straight down.
  const double eye[19] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, 0, 0, -1, 0, -1, 0, 1, 0, 0}, shift[2] = {0, 0};
  orbc_trace_begin(eye, 0.5, 8, 8, shift);
  const int tile[4] = {0, 0, 8, 8};
  const OrbcReply* reply = orbc_trace_tile(tile, 0, 1);
  const auto pixels = block<std::uint8_t>(reply, json_of(reply).at("pixels"));
  REQUIRE(pixels.size() == 256);
  CHECK(pixels[0] == 255);
  CHECK(pixels[1] == 0);
}

TEST_CASE("what is wrong with a notation is said of the notation alone", "[html]") {
  const Json good = json_of(orbc_notation("*237", 4, 0)), bad = json_of(orbc_notation("*23", 3, 0));
  CHECK(good.at("orbifold").at("chi") == "-1/84");
  CHECK(bad.at("diagnostics").at(0).at("code") == "notation.bad-orbifold");
  CHECK_FALSE(bad.contains("orbifold"));
}

TEST_CASE("a mesh comes back from the page as it went", "[html]") {
  mesh::Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}};
  mesh.triangles = {{0, 1, 2}};
  mesh.triangle_material = {0};
  mesh.materials.resize(1);
  mesh.materials[0].color = {0.1, 0.2, 0.3};
  const html::PageFiles files{{"m.obj", html::page_file(mesh)}};
  const auto back = html::assets_of_page(files).load_mesh("m.obj");
  REQUIRE(back);
  CHECK(back->mesh.positions[2].z == 0.5);
  CHECK(back->mesh.materials[0].color[2] == 0.3);
  CHECK(html::assets_of_page(files).load_mesh("n.obj").error().front().code == "mesh.missing-file");
}

TEST_CASE("a damaged file of the page is refused", "[html]") {
  mesh::Mesh mesh;
  mesh.positions = {{0, 0, 0}};
  mesh.triangles = {{0, 0, 9}};
  html::PageFiles files{{"far.obj", html::page_file(mesh)}, {"short.obj", html::page_file(mesh)}};
  files["short.obj"].resize(30);
  for (const char* name : {"far.obj", "short.obj"})
    CHECK(html::assets_of_page(files).load_mesh(name).error().front().code == "page.bad-asset");
}

TEST_CASE("an export of the core has files and no errors", "[html]") {
  for (const char* format : {"glb", "pov", "svg"}) {
    const Json made = json_of(orbc_export(kPentagon.data(), kPentagon.size(), format, nullptr));
    REQUIRE(made.at("files").size() >= 1);
    CHECK(made.at("files").at(0).at("name") == "");
    CHECK(made.at("files").at(0).at("bytes").at("count").get<int>() > 1000);
    CHECK(made.at("copies").get<int>() > 1);
  }
}

TEST_CASE("an export from another eye differs, and from the scene's own is the same", "[html]") {
  const std::string flat = "orbc: 1\norbifold: \"*2222\"\nroom: {height: 3}\ncamera: {at: {xy: [0.3, 0.2], z: 1}}\n";
  const auto bytes = [&](const double* eye) {
    const OrbcReply* reply = orbc_export(flat.data(), flat.size(), "pov", eye);
    const auto list = block<std::uint8_t>(reply, json_of(reply).at("files").at(0).at("bytes"));
    return std::string(list.begin(), list.end());
  };
  const Json eye = json_of(orbc_open(flat.data(), flat.size())).at("eye");
  std::vector<double> numbers = eye.at("room_from_eye").get<std::vector<double>>();
  numbers.push_back(eye.at("z").get<double>());
  for (const char* axis : {"forward", "right", "up"})
    for (const double c : eye.at(axis).get<std::vector<double>>()) numbers.push_back(c);
  const std::string own = bytes(nullptr);
  const std::string same = bytes(numbers.data());
  CHECK(own.substr(0, own.find("camera")) == same.substr(0, same.find("camera")));
  CHECK(std::abs(static_cast<double>(own.size()) / static_cast<double>(same.size()) - 1) < 1e-4);  // last digits
  numbers[9] += 0.2;
  CHECK(bytes(numbers.data()) != own);
}

TEST_CASE("what makes no export says why", "[html]") {
  const std::string broken = "orbc: 1\norbifold: \"*23\"\n";
  const Json made = json_of(orbc_export(broken.data(), broken.size(), "glb", nullptr));
  CHECK(made.at("files").empty());
  CHECK(made.at("diagnostics").size() >= 1);
}

TEST_CASE("an atlas as EXR is refused: the page writes none", "[html]") {
  const std::string scene = "orbc: 1\norbifold: \"*22222\"\nbake: {atlas: exr}\n";
  const Json made = json_of(orbc_export(scene.data(), scene.size(), "pov", nullptr));
  CHECK(made.at("files").empty());
  CHECK(made.at("diagnostics").at(0).at("code") == "page.no-exr");
}

TEST_CASE("a mesh as it is on a disk serves the scene, and a broken one is refused", "[html]") {
  const std::string name = "tetrahedron.off", off = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const auto take = [&](const std::string& text) {
    return json_of(orbc_take_mesh(name.data(), name.size(), reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  };
  CHECK(take(off).at("triangles") == 4);
  const Json refused = take("OFF\n4 4 0\n0 0");
  CHECK_FALSE(refused.contains("triangles"));
  CHECK(refused.at("diagnostics").size() == 1);
  const std::string scene = "orbc: 1\norbifold: \"*22222\"\nobjects: [{mesh: a/tetrahedron.off, size: 0.1, at: centre}]\n";
  CHECK(json_of(orbc_open(scene.data(), scene.size())).at("ok") == true);  // found without its folder, and the good one is kept
}
