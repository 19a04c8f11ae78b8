// What glTF files of others have: kinds of materials, colours, wrap modes, poses, instances, data URIs. Each case was met in public files.
#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/image_io/png.h"
#include "compiler/mesh/analyse.h"
#include "compiler/mesh_io/load.h"
#include "tests/unit/mesh_io/files.h"
#include "tests/unit/mesh_io/panel.h"

using namespace orbc;
using namespace orbc::mesh_io;
using namespace orbc::mesh_io::test;
using mesh::MaterialKind;

namespace {

Result<mesh::LoadedMesh> try_load(const Panel& panel, const std::string& folder = "") {
  std::string data;
  const std::string json = json_of(panel, data);
  return load_mesh_bytes(glb(json, data), Format::glb, "file", folder);
}

mesh::LoadedMesh load(const Panel& panel, const std::string& folder = "") {
  auto loaded = try_load(panel, folder);
  if (!loaded) FAIL(to_text(loaded.error()));
  return *std::move(loaded);
}

mesh::Material material(const std::string& json) {
  Panel panel;
  panel.material = json;
  return load(panel).mesh.materials.at(0);
}

const char kTextured[] = "{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorTexture\":{\"index\":0}}}";

}  // namespace

TEST_CASE("materials of glTF are metal, glass, light, glossy or matte", "[mesh_io]") {
  const auto metal =
      material("{\"pbrMetallicRoughness\":{\"metallicFactor\":1,\"roughnessFactor\":0.1,\"baseColorFactor\":[1,0.77,0.34,1]}}");
  CHECK(metal.kind == MaterialKind::metal);
  CHECK(metal.roughness == 0.1);
  CHECK(metal.color == std::array<double, 3>{1, 0.77, 0.34});
  CHECK(material("{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0.2}}").kind == MaterialKind::glossy);
  CHECK(material("{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0.8}}").kind == MaterialKind::matte);
  CHECK(material("{}").kind == MaterialKind::matte);
  const auto light = material(
      "{\"emissiveFactor\":[0,1,0.5],\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":3}},"
      "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":[0,0,0,1]}}");
  CHECK(light.kind == MaterialKind::emissive);
  CHECK(light.emission == 3);
  CHECK(light.color == std::array<double, 3>{0, 1, 0.5});
  const auto glass =
      material("{\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},\"KHR_materials_ior\":{\"ior\":1.33}}}");
  CHECK(glass.kind == MaterialKind::glass);
  CHECK(glass.index == 1.33);
  const auto old = material("{\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseFactor\":[0.1,0.7,0.2,1]}}}");
  CHECK(old.color == std::array<double, 3>{0.1, 0.7, 0.2});
  Panel bumpy;
  bumpy.material = "{\"normalTexture\":{\"index\":0},\"emissiveFactor\":[0.1,0,0]}";
  CHECK(warns(load(bumpy), "mesh.ignored", "normalTexture"));
  CHECK(warns(load(bumpy), "mesh.ignored", "emissive"));
}

TEST_CASE("the picture of a specular-glossiness material is shown", "[mesh_io]") {
  Panel panel;
  panel.material = "{\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseTexture\":{\"index\":0}}}}";
  panel.top = "\"extensionsRequired\":[\"KHR_materials_pbrSpecularGlossiness\"]," + with_picture(data_uri("image/png", four_colors()));
  const auto loaded = load(panel);
  CHECK(loaded.mesh.materials[0].texture == 0);
  CHECK(loaded.mesh.textures.size() == 1);
}

TEST_CASE("surfaces that are blended are there or not, with a warning", "[mesh_io]") {
  Panel panel;
  panel.material = "{\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":[1,0.2,0.2,0.15]}}";
  CHECK(warns(load(panel), "mesh.blended"));
  panel.material = "{\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorTexture\":{\"index\":0}}}";
  panel.top = with_picture(data_uri("image/png", image_io::encode_png(image::Image{2, 1, {255, 0, 0, 255, 0, 0, 0, 90}})));
  const auto veil = load(panel);
  CHECK(warns(veil, "mesh.blended"));
  CHECK(veil.mesh.materials[0].alpha_cutoff == 0.5);
  panel.top = with_picture(data_uri("image/png", four_colors()));
  CHECK(load(panel).warnings.empty());
}

TEST_CASE("colours of vertices are read from glTF, linear, as floats or integers", "[mesh_io]") {
  Panel panel;
  panel.material = "{\"pbrMetallicRoughness\":{\"metallicFactor\":0}}";
  panel.attributes = ",\"COLOR_0\":3";
  panel.accessors = ",{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}";
  panel.more = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.25f, 0.5f, 0};
  const auto loaded = load(panel);
  REQUIRE(loaded.mesh.colors.size() == 4);
  CHECK(loaded.mesh.colors[0] == mesh::LinearColor{1, 0, 0});
  CHECK(loaded.mesh.colors[3] == mesh::LinearColor{0.25f, 0.5f, 0});
  panel.more = {1, 1, 0.5f, 1, 1, 0.5f, 1, 1, 0.5f, 1, 1, 0.5f};
  const auto uniform = load(panel);
  CHECK(uniform.mesh.colors.empty());
  CHECK(uniform.mesh.materials[0].color == std::array<double, 3>{1, 1, 0.5});
}

TEST_CASE("a clamped picture is shown once, a mirrored one turns at its borders", "[mesh_io]") {
  Panel panel;
  panel.material = kTextured;
  panel.uv_from = -1;
  panel.uv_to = 2;
  panel.top = with_picture(data_uri("image/png", four_colors()), "{\"wrapS\":33071,\"wrapT\":33071}");
  const auto clamped = load(panel);
  CHECK(mesh::analyse(clamped.mesh).area == Approx(1));
  CHECK(clamped.mesh.triangles.size() > 2);
  for (std::size_t v = 0; v < clamped.mesh.uv.size(); ++v) {
    const auto& p = clamped.mesh.positions[v];
    const auto expected = [](double at) { return std::clamp(3 * at - 1, 0.25, 0.75); };
    CHECK(static_cast<double>(clamped.mesh.uv[v][0]) == Approx(expected(p.x)).margin(1e-6));
    CHECK(static_cast<double>(clamped.mesh.uv[v][1]) == Approx(expected(1 - p.y)).margin(1e-6));
  }
  panel.top = with_picture(data_uri("image/png", four_colors()), "{\"wrapS\":33648,\"wrapT\":33648}");
  const auto mirrored = load(panel);
  CHECK(mesh::analyse(mirrored.mesh).area == Approx(1));
  for (std::size_t v = 0; v < mirrored.mesh.uv.size(); ++v) {
    const auto expected = [](double at) { return at < 1.0 / 3 ? 1 - 3 * at : at < 2.0 / 3 ? 3 * at - 1 : 3 - 3 * at; };
    CHECK(static_cast<double>(mirrored.mesh.uv[v][0]) == Approx(expected(mirrored.mesh.positions[v].x)).margin(1e-6));
  }
}

TEST_CASE("morph targets are added with the weights of the mesh or the node", "[mesh_io]") {
  Panel panel;
  panel.primitive = ",\"targets\":[{\"POSITION\":3}]";
  panel.accessors = ",{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}";
  panel.more = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0};
  panel.mesh = ",\"weights\":[1]";
  CHECK(mesh::analyse(load(panel).mesh).highest.y == 2);
  panel.node = ",\"weights\":[0.5]";
  CHECK(mesh::analyse(load(panel).mesh).highest.y == 1.5);
}

TEST_CASE("a skinned mesh stands where its joints put it, whatever its node says", "[mesh_io]") {
  Panel panel;
  panel.node = ",\"skin\":0,\"rotation\":[0.7071068,0,0,0.7071068],\"translation\":[9,9,9]";
  panel.nodes = ",{\"translation\":[5,0,0]}";
  panel.top = "\"skins\":[{\"joints\":[1]}],";
  panel.attributes = ",\"JOINTS_0\":3,\"WEIGHTS_0\":4";
  panel.accessors =
      ",{\"bufferView\":3,\"componentType\":5121,\"count\":4,\"type\":\"VEC4\"}"
      ",{\"bufferView\":3,\"byteOffset\":16,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"}";
  panel.more = {0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  const auto found = mesh::analyse(load(panel).mesh);
  CHECK(found.lowest.x == 5);
  CHECK(found.highest.x == 6);
  CHECK(found.highest.y == 1);
  CHECK(found.highest.z == 0);
}

TEST_CASE("instances are drawn, hidden nodes are not", "[mesh_io]") {
  Panel panel;
  panel.node = ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":3}}}";
  panel.accessors = ",{\"bufferView\":3,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}";
  panel.more = {0, 0, 0, 2, 0, 0, 4, 0, 0};
  const auto three = load(panel);
  CHECK(three.mesh.triangles.size() == 6);
  CHECK(mesh::analyse(three.mesh).highest.x == 5);
  panel.node = ",\"extensions\":{\"KHR_node_visibility\":{\"visible\":false}}";
  const auto hidden = try_load(panel);
  CHECK(code_of(hidden) == "mesh.no-triangles");
}

TEST_CASE("data URIs of any type are read, and messages stay short", "[mesh_io]") {
  std::string data;
  std::string json = json_of({}, data);
  const auto at = json.find("\"buffers\":[{") + 12;
  for (const std::string type : {"", "application/octet-stream", "application/gltf-buffer", "text/x"}) {
    auto with_uri = json;
    with_uri.insert(at, "\"uri\":\"" + data_uri(type, data) + "\",");
    const auto loaded = load_mesh_bytes(with_uri, Format::gltf, "file", "");
    if (!loaded) FAIL(to_text(loaded.error()));
    CHECK(loaded->mesh.triangles.size() == 2);
  }
  Panel panel;
  panel.material = kTextured;
  panel.top = with_picture("data:image/x-strange;base64," + base64(std::string(60'000, 'x')));
  const auto strange = load(panel);
  REQUIRE(strange.warnings.size() == 1);
  CHECK(to_text(strange.warnings).size() < 500);
  panel.top = with_picture(data_uri("image/x-strange", four_colors()));
  CHECK(load(panel).mesh.textures.size() == 1);
}

TEST_CASE("extensions that are not read are named, with what helps", "[mesh_io]") {
  const auto refused = [](const std::string& name, const std::string& hint) {
    Panel panel;
    panel.top = "\"extensionsUsed\":[\"" + name + "\"],\"extensionsRequired\":[\"" + name + "\"],";
    const auto loaded = try_load(panel);
    REQUIRE_FALSE(loaded);
    CHECK(loaded.error().front().code == "mesh.unsupported");
    CHECK(loaded.error().front().message.find(name) != std::string::npos);
    CHECK(loaded.error().front().hint.find(hint) != std::string::npos);
  };
  refused("KHR_draco_mesh_compression", "without compression");
  refused("EXT_meshopt_compression", "without compression");
  refused("KHR_texture_basisu", "PNG or JPEG");
  refused("VENDOR_strange", "without this extension");
  Panel panel;
  panel.material = kTextured;
  panel.top = "\"images\":[{\"uri\":\"" + data_uri("image/ktx2", "xxxx") +
              "\"}],\"textures\":[{\"extensions\":{\"KHR_texture_basisu\":{\"source\":0}}}],";
  CHECK(warns(load(panel), "mesh.bad-texture", "KHR_texture_basisu"));
}

TEST_CASE("an animated glTF is shown as it is stored, with a note", "[mesh_io]") {
  Panel panel;
  panel.top = "\"animations\":[{\"channels\":[],\"samplers\":[]}],";
  CHECK(warns(load(panel), "mesh.ignored", "animated"));
}
