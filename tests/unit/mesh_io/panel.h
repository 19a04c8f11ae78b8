#pragma once
#include <string>
#include <vector>

#include "compiler/image_io/png.h"
#include "tests/unit/mesh_io/files.h"

namespace orbc::mesh_io::test {

/// A panel of two triangles in [0, 1]², with uv as given and further floats behind: views 0 positions, 1 uv, 2 indices, 3 more.
struct Panel {
  std::string material = "{}";
  std::string top;         ///< more members of the outermost object
  std::string node;        ///< more members of the node
  std::string nodes;       ///< more nodes
  std::string primitive;   ///< more members of the primitive
  std::string attributes;  ///< more attributes
  std::string mesh;        ///< more members of the mesh
  std::string accessors;   ///< more accessors, on view 3
  std::vector<float> more;
  float uv_from = 0, uv_to = 1;
};

inline std::string json_of(const Panel& p, std::string& data) {
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) put(data, x);
  for (const float x : {p.uv_from, p.uv_to, p.uv_to, p.uv_to, p.uv_to, p.uv_from, p.uv_from, p.uv_from}) put(data, x);
  for (const int i : {0, 1, 2, 0, 2, 3}) put(data, static_cast<std::uint16_t>(i));
  const auto more_at = data.size();
  for (const float x : p.more) put(data, x);
  const auto number = [](std::size_t n) { return std::to_string(n); };
  return "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0" + p.node + "}" + p.nodes +
         "],\"materials\":[" + p.material + "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1" +
         p.attributes + "},\"indices\":2,\"material\":0" + p.primitive + "}]" + p.mesh + "}]," + p.top +
         "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]},"
         "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
         "{\"bufferView\":2,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}" +
         p.accessors +
         "],\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":32},"
         "{\"buffer\":0,\"byteOffset\":80,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":" +
         number(more_at) + ",\"byteLength\":" + number(std::max<std::size_t>(data.size() - more_at, 1)) +
         "}],\"buffers\":[{\"byteLength\":" + number(data.size()) + "}]}";
}

inline std::string data_uri(const std::string& type, const std::string& bytes) { return "data:" + type + ";base64," + base64(bytes); }

inline std::string with_picture(const std::string& uri, const std::string& sampler = "") {
  return "\"images\":[{\"uri\":\"" + uri + "\"}],\"textures\":[{\"source\":0" + std::string(sampler.empty() ? "" : ",\"sampler\":0") +
         "}]," + (sampler.empty() ? "" : "\"samplers\":[" + sampler + "],");
}

inline std::string four_colors() {
  return image_io::encode_png(image::Image{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0, 255}});
}

}  // namespace orbc::mesh_io::test
