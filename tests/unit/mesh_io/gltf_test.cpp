#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/image_io/png.h"
#include "compiler/mesh/analyse.h"
#include "compiler/mesh_io/load.h"
#include "tests/unit/mesh_io/files.h"

using namespace orbc;
using namespace orbc::mesh;
using namespace orbc::mesh_io;
using namespace orbc::mesh_io::test;

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}
Result<LoadedMesh> load(const std::string& json, const std::string& data = tetra_data()) {
  return load_mesh_bytes(glb(json, data), Format::glb, "file", "");
}
std::string changed(const std::string& from, const std::string& to) { return replaced(tetra_json(""), from, to); }

}  // namespace

TEST_CASE("nodes of a glTF move, turn, scale and mirror their meshes", "[mesh_io]") {
  const auto turned =
      load(changed("{\"mesh\":0}",
                   "{\"mesh\":0,\"translation\":[10,0,0],\"rotation\":[0,0,0.70710678118654752,0.70710678118654752],\"scale\":[2,3,4]}"));
  REQUIRE(turned);
  auto found = analyse(turned->mesh);
  CHECK(found.volume == Approx(4));
  CHECK(found.lowest.x == Approx(7));
  CHECK(found.highest.x == Approx(10));
  CHECK(found.highest.y == Approx(2));
  CHECK(found.highest.z == Approx(4));
  const auto mirrored = load(
      changed("{\"mesh\":0}", "{\"children\":[1],\"matrix\":[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,5,1]},{\"mesh\":0,\"translation\":[1,0,0]}"));
  REQUIRE(mirrored);
  found = analyse(mirrored->mesh);
  CHECK(found.volume == Approx(1.0 / 6));
  CHECK_FALSE(found.inside_out);
  CHECK(found.lowest.x == Approx(-2));
  CHECK(found.lowest.z == Approx(5));
}

TEST_CASE("without scenes all roots of a glTF are read; with scenes only the chosen one", "[mesh_io]") {
  CHECK(load(changed("\"scene\":0,\"scenes\":[{\"nodes\":[0]}],", ""))->mesh.triangles.size() == 4);
  const auto two =
      changed("\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]",
              "\"scene\":1,\"scenes\":[{\"nodes\":[0,1]},{\"nodes\":[1]}],\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"translation\":[5,0,0]}]");
  const auto loaded = load(two);
  REQUIRE(loaded);
  CHECK(loaded->mesh.triangles.size() == 4);
  CHECK(analyse(loaded->mesh).lowest.x == Approx(5));
}

TEST_CASE("strips, fans and plain lists of a glTF are triangles; points and lines are read over", "[mesh_io]") {
  // Four positions in the order of a strip: (0,0,0), (1,0,0), (0,1,0), (0,0,1).
  const auto mode = [](int number) { return load(changed("\"indices\":1", "\"mode\":" + std::to_string(number))); };
  CHECK(mode(5)->mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
  CHECK(mode(6)->mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(mode(4)->mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(mode(4)->mesh.positions.size() == 3);
  for (const int number : {0, 1, 2, 3, 7}) CHECK(code_of(mode(number)) == "mesh.no-triangles");
}

TEST_CASE("indices of a glTF may have 8, 16 or 32 bits, positions may be quantised", "[mesh_io]") {
  std::string data = tetra_data().substr(0, 48);
  for (const auto& t : tetra_faces()) {
    for (const int v : t) put(data, static_cast<std::uint8_t>(v));
  }
  auto json = replaced(changed("5123", "5121"), "\"byteLength\":24", "\"byteLength\":12");
  CHECK(load(replaced(json, "\"byteLength\":72", "\"byteLength\":60"), data)->mesh.triangles.size() == 4);
  data = tetra_data().substr(0, 48);
  for (const auto& t : tetra_faces()) {
    for (const int v : t) put(data, static_cast<std::uint32_t>(v));
  }
  json = replaced(changed("5123", "5125"), "\"byteLength\":24", "\"byteLength\":48");
  CHECK(load(replaced(json, "\"byteLength\":72", "\"byteLength\":96"), data)->mesh.triangles.size() == 4);
  data.clear();
  for (const auto& p : tetra_points()) {
    for (const float x : p) put(data, static_cast<std::int8_t>(x * 127));
    put(data, std::int8_t{0});
  }
  for (const auto& t : tetra_faces()) {
    for (const int v : t) put(data, static_cast<std::uint16_t>(v));
  }
  json = replaced(changed("5126", "5120,\"normalized\":true"), "{\"buffer\":0,\"byteLength\":48}",
                  "{\"buffer\":0,\"byteLength\":16,\"byteStride\":4}");
  json = replaced(replaced(json, "\"byteOffset\":48", "\"byteOffset\":16"), "\"byteLength\":72", "\"byteLength\":40");
  const auto quantised = load(json, data);
  REQUIRE(quantised);
  CHECK(analyse(quantised->mesh).volume == Approx(1.0 / 6));
}

TEST_CASE("sparse accessors of a glTF are applied and checked", "[mesh_io]") {
  std::string data = tetra_data();
  put(data, std::uint16_t{3}), put(data, std::uint16_t{0});
  for (const float x : {0.0f, 0.0f, 6.0f}) put(data, x);
  const auto sparse = [&](const std::string& text) {
    auto json = changed("\"count\":4,", "\"count\":4,\"sparse\":" + text + ",");
    json =
        replaced(json, "\"byteLength\":24}",
                 "\"byteLength\":24},{\"buffer\":0,\"byteOffset\":72,\"byteLength\":2},{\"buffer\":0,\"byteOffset\":76,\"byteLength\":12}");
    return load(replaced(json, "\"byteLength\":72}", "\"byteLength\":88}"), data);
  };
  const auto fine = sparse("{\"count\":1,\"indices\":{\"bufferView\":2,\"componentType\":5123},\"values\":{\"bufferView\":3}}");
  REQUIRE(fine);
  CHECK(analyse(fine->mesh).volume == Approx(1));
  CHECK(code_of(sparse("{\"count\":2,\"indices\":{\"bufferView\":2,\"componentType\":5123},\"values\":{\"bufferView\":3}}")) ==
        "mesh.bad-gltf");
  CHECK(code_of(sparse("{\"count\":1,\"indices\":{\"bufferView\":9,\"componentType\":5123},\"values\":{\"bufferView\":3}}")) ==
        "mesh.bad-gltf");
  CHECK(code_of(sparse("{\"count\":-1,\"indices\":{\"bufferView\":2,\"componentType\":5123},\"values\":{\"bufferView\":3}}")) ==
        "mesh.bad-gltf");
  CHECK(code_of(sparse(
            "{\"count\":1,\"indices\":{\"bufferView\":2,\"componentType\":5123,\"byteOffset\":-2},\"values\":{\"bufferView\":3}}")) ==
        "mesh.bad-gltf");
  CHECK(code_of(sparse("{\"count\":1,\"indices\":{\"bufferView\":1,\"componentType\":5125},\"values\":{\"bufferView\":3}}")) ==
        "mesh.bad-index");
}

TEST_CASE("a textured glTF gives uv, colour and picture, embedded, by data URI and beside it", "[mesh_io]") {
  const Folder folder("textured");
  const image::Image picture{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 128}};
  const auto png = image_io::encode_png(picture);
  std::string data = tetra_data();
  for (int i = 0; i < 4; ++i) put(data, static_cast<float>(i) / 4), put(data, 0.5f);
  const auto size = data.size();
  data += png;
  auto json = replaced(tetra_json(""), "\"POSITION\":0}", "\"POSITION\":0,\"TEXCOORD_0\":2},\"material\":0");
  json = replaced(json, "\"type\":\"SCALAR\"}",
                  "\"type\":\"SCALAR\"},{\"bufferView\":2,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"}");
  json = replaced(json, "\"byteLength\":24}",
                  "\"byteLength\":24},{\"buffer\":0,\"byteOffset\":72,\"byteLength\":32},{\"buffer\":0,\"byteOffset\":" +
                      std::to_string(size) + ",\"byteLength\":" + std::to_string(png.size()) + "}");
  json = replaced(json, "\"byteLength\":72}", "\"byteLength\":" + std::to_string(data.size()) + "}");
  const auto with = [&](const std::string& image, const std::string& extra = "") {
    return json.substr(0, json.size() - 1) +
           ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.5,0.25,1],\"baseColorTexture\":{\"index\":0" + extra +
           "}}}],\"textures\":[{\"source\":0}],\"images\":[{" + image + "}]}";
  };
  folder.write("pics/my pic.png", png);
  folder.write("../orbc_mesh_secret.png", png);
  const auto check = [&](const std::string& text) {
    const auto loaded = load_mesh(folder.write("a.glb", glb(text, data)));
    REQUIRE(loaded);
    CHECK(loaded->warnings.empty());
    const auto& mesh = loaded->mesh;
    REQUIRE(mesh.materials.size() == 1);
    CHECK(mesh.triangle_material.empty());
    CHECK(mesh.materials[0].color == std::array<double, 3>{1, 0.5, 0.25});
    CHECK(mesh.materials[0].texture == 0);
    REQUIRE(mesh.textures.size() == 1);
    CHECK(mesh.textures[0].rgba == picture.rgba);
    CHECK(mesh.uv[3] == std::array<float, 2>{0.75f, 0.5f});
  };
  check(with("\"bufferView\":3,\"mimeType\":\"image/png\""));
  check(with("\"uri\":\"data:image/png;base64," + base64(png) + "\""));
  check(with("\"uri\":\"pics/my%20pic.png\""));
  const auto moved = load_mesh(
      folder.write("b.glb", glb(with("\"bufferView\":3,\"mimeType\":\"image/png\"",
                                     ",\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.5,0.25],\"scale\":[2,1],\"rotation\":0}}"),
                                data)));
  REQUIRE(moved);
  CHECK(moved->mesh.uv[3] == std::array<float, 2>{2.0f, 0.75f});

  const auto left_out = [&](const std::string& image) {
    const auto loaded = load_mesh(folder.write("c.glb", glb(with(image), data)));
    REQUIRE(loaded);
    CHECK(loaded->mesh.materials[0].texture == -1);
    REQUIRE(loaded->warnings.size() == 1);
    INFO(to_text(loaded->warnings));
    CHECK(loaded->warnings[0].code == "mesh.bad-texture");
    return loaded->warnings[0].message;
  };
  CHECK(left_out("\"uri\":\"../orbc_mesh_secret.png\"").find("leads out") != std::string::npos);
  CHECK(left_out("\"uri\":\"%2e%2e/orbc_mesh_secret.png\"").find("leads out") != std::string::npos);
  CHECK(left_out("\"uri\":\"/etc/passwd\"").find("absolute") != std::string::npos);
  CHECK(left_out("\"uri\":\"https://example.org/a.png\"").find("not a local file") != std::string::npos);
  CHECK(left_out("\"uri\":\"gone.png\"").find("no such file") != std::string::npos);
  CHECK(left_out("\"bufferView\":0,\"mimeType\":\"image/png\"").find("neither") != std::string::npos);
  std::filesystem::remove(folder("../orbc_mesh_secret.png"));
}

TEST_CASE("buffers of a glTF may lie beside it, but not elsewhere", "[mesh_io]") {
  const Folder folder("buffers");
  folder.write("data/t.bin", tetra_data());
  folder.write("../orbc_mesh_secret.bin", tetra_data());
  CHECK(load_mesh(folder.write("a.gltf", tetra_json("data/t.bin"))));
  const auto refused = [&](const std::string& uri, const std::string& code) {
    const auto loaded = load_mesh(folder.write("a.gltf", tetra_json(uri)));
    REQUIRE_FALSE(loaded);
    INFO(to_text(loaded.error()));
    CHECK(loaded.error().front().code == code);
  };
  refused("../orbc_mesh_secret.bin", "mesh.bad-reference");
  refused("data/../../orbc_mesh_secret.bin", "mesh.bad-reference");
  refused("/etc/passwd", "mesh.bad-reference");
  refused("file:///etc/passwd", "mesh.bad-reference");
  refused("data/u.bin", "mesh.missing-file");
  folder.write("data/short.bin", tetra_data().substr(0, 70));
  refused("data/short.bin", "mesh.bad-gltf");
  std::filesystem::create_symlink("/dev/zero", folder("zero.bin"));
  refused("zero.bin", "mesh.not-a-file");
  std::filesystem::remove(folder("../orbc_mesh_secret.bin"));
}

TEST_CASE("what a glTF promises is checked before it is believed", "[mesh_io]") {
  const auto refused = [](const std::string& json, const std::string& code) {
    const auto loaded = load(json);
    REQUIRE_FALSE(loaded);
    INFO(to_text(loaded.error()));
    CHECK(loaded.error().front().code == code);
  };
  refused(changed("\"count\":4,", "\"count\":5,"), "mesh.bad-gltf");
  refused(changed("\"count\":4,", "\"count\":4000000000,"), "mesh.too-big");
  refused(changed("\"count\":4,", "\"count\":-4,"), "mesh.bad-gltf");
  refused(changed("\"count\":12,", "\"count\":13,"), "mesh.bad-gltf");
  refused(changed("\"bufferView\":0,", "\"bufferView\":7,"), "mesh.bad-gltf");
  refused(changed("\"bufferView\":1,", "\"bufferView\":7,"), "mesh.bad-gltf");
  refused(changed("\"byteOffset\":48", "\"byteOffset\":18446744073709551615"), "mesh.bad-gltf");
  refused(changed("\"byteOffset\":48", "\"byteOffset\":60"), "mesh.bad-gltf");
  refused(changed("\"byteLength\":72}", "\"byteLength\":73}"), "mesh.bad-gltf");
  refused(changed("\"byteLength\":72}", "\"byteLength\":0}"), "mesh.bad-gltf");
  refused(changed("{\"buffer\":0,\"byteLength\":48}", "{\"buffer\":3,\"byteLength\":48}"), "mesh.bad-gltf");
  refused(changed("{\"buffer\":0,\"byteLength\":48}", "{\"buffer\":0,\"byteLength\":48,\"byteStride\":252}"), "mesh.bad-gltf");
  refused(changed("\"POSITION\":0", "\"POSITION\":5"), "mesh.bad-gltf");
  refused(changed("\"POSITION\":0", "\"POSITION\":1"), "mesh.bad-gltf");
  refused(changed("\"indices\":1", "\"indices\":0"), "mesh.bad-gltf");
  refused(changed("\"indices\":1", "\"indices\":1,\"material\":3"), "mesh.bad-gltf");
  refused(changed("\"nodes\":[0]", "\"nodes\":[4]"), "mesh.bad-gltf");
  refused(changed("{\"mesh\":0}", "{\"mesh\":4}"), "mesh.bad-gltf");
  refused(changed("{\"mesh\":0}", "{\"mesh\":0,\"children\":[0]}"), "mesh.bad-gltf");
  refused(changed("{\"mesh\":0}", "{\"mesh\":0,\"children\":[1,1]},{\"mesh\":0}"), "mesh.bad-gltf");
  refused(changed("{\"mesh\":0}", "{\"mesh\":0,\"scale\":[1e300,1,1]}"), "mesh.not-finite");
  refused(changed("{\"mesh\":0}", "{\"mesh\":0,\"translation\":[1e999,1,1]}"), "mesh.bad-gltf");
  refused(changed("{\"version\":\"2.0\"}", "{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]"),
          "mesh.unsupported");
  refused("{}", "mesh.bad-gltf");
  refused("[1,2,3]", "mesh.bad-gltf");
  refused("{\"asset\":{\"version\":\"2.0\"}}", "mesh.no-triangles");
  auto data = tetra_data();
  data[49] = 1;
  CHECK(code_of(load(tetra_json(""), data)) == "mesh.bad-index");
}
