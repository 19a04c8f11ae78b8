// Makes the meshes of examples/meshes: make_meshes <folder> [name…]. Same program, same bytes.
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <set>
#include <string>

#include "compiler/image_io/png.h"
#include "compiler/mesh/primitives.h"
#include "compiler/mesh/weld.h"
#include "scripts/make_meshes/sdf.h"
#include "scripts/make_meshes/vase.h"

namespace make_meshes {
namespace {

using orbc::mesh::Mesh;

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  std::printf("%s: %zu bytes\n", path.c_str(), bytes.size());
}

std::string ply(Mesh mesh) {
  // Without uv no vertex has to be double.
  mesh.uv.clear();
  const auto weld = orbc::mesh::weld_positions(mesh.positions);
  for (auto& t : mesh.triangles) t = {weld[t[0]], weld[t[1]], weld[t[2]]};
  mesh = orbc::mesh::remove_unused_vertices(std::move(mesh)).mesh;
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment made by scripts/make_meshes; z up, front along +x\nelement vertex " +
                    std::to_string(mesh.positions.size()) + "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                    std::to_string(mesh.triangles.size()) + "\nproperty list uchar uint vertex_indices\nend_header\n";
  for (const auto& p : mesh.positions)
    put(out, static_cast<float>(p.x)), put(out, static_cast<float>(p.y)), put(out, static_cast<float>(p.z));
  for (const auto& t : mesh.triangles) put(out, std::uint8_t{3}), put(out, t[0]), put(out, t[1]), put(out, t[2]);
  return out;
}

/// A textured mesh as GLB: y up, as glTF wants it.
std::string glb(const Mesh& mesh, const std::string& png) {
  std::string data;
  float low[3] = {1e9f, 1e9f, 1e9f}, high[3] = {-1e9f, -1e9f, -1e9f};
  for (const auto& p : mesh.positions) {
    const float xyz[3] = {static_cast<float>(p.x), static_cast<float>(p.z), static_cast<float>(-p.y)};
    for (int k = 0; k < 3; ++k) put(data, xyz[k]), low[k] = std::min(low[k], xyz[k]), high[k] = std::max(high[k], xyz[k]);
  }
  const auto positions = data.size();
  for (const auto& uv : mesh.uv) put(data, uv[0]), put(data, uv[1]);
  const auto uvs = data.size() - positions;
  for (const auto& t : mesh.triangles) {
    for (const auto v : t) put(data, static_cast<std::uint16_t>(v));
  }
  const auto indices = data.size() - positions - uvs;
  while (data.size() % 4) data += '\0';
  const auto picture = data.size();
  data += png;
  while (data.size() % 4) data += '\0';
  std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0","generator":"orbc scripts/make_meshes"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,"name":"vase"}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2,"material":0}}]}}],)"
      R"("materials":[{{"name":"clay","pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}},"metallicFactor":0,"roughnessFactor":0.7}}}}],)"
      R"("textures":[{{"source":0,"sampler":0}}],"samplers":[{{"wrapS":10497,"wrapT":33071}}],"images":[{{"bufferView":3,"mimeType":"image/png"}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":[{},{},{}],"max":[{},{},{}]}},)"
      R"({{"bufferView":1,"componentType":5126,"count":{},"type":"VEC2"}},{{"bufferView":2,"componentType":5123,"count":{},"type":"SCALAR"}}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":{},"target":34962}},{{"buffer":0,"byteOffset":{},"byteLength":{},"target":34962}},)"
      R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":34963}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],"buffers":[{{"byteLength":{}}}]}})",
      mesh.positions.size(), low[0], low[1], low[2], high[0], high[1], high[2], mesh.uv.size(), 3 * mesh.triangles.size(), positions,
      positions, uvs, positions + uvs, indices, picture, png.size(), data.size());
  while (json.size() % 4) json += ' ';
  std::string out = "glTF";
  put(out, std::uint32_t{2});
  put(out, static_cast<std::uint32_t>(28 + json.size() + data.size()));
  put(out, static_cast<std::uint32_t>(json.size()));
  out += "JSON" + json;
  put(out, static_cast<std::uint32_t>(data.size()));
  return out + std::string("BIN\0", 4) + data;
}

/// A torus knot of 26,022 triangles, the number of the paper's speed scene: 2 · 542 · 24, and three diagonals split.
Mesh knot() {
  Mesh mesh = orbc::mesh::make_torus_knot(2, 3, 0.5, 0.13, 542, 24);
  for (const std::size_t quad : {1000, 5000, 9000}) {
    // The two triangles of a quad are neighbours in the list; the edge they share is the diagonal.
    auto &s = mesh.triangles[2 * quad], &t = mesh.triangles[2 * quad + 1];
    const auto in = [](const orbc::mesh::Triangle& triangle, std::uint32_t v) {
      return std::find(triangle.begin(), triangle.end(), v) != triangle.end();
    };
    while (in(t, s[0])) std::rotate(s.begin(), s.begin() + 1, s.end());
    while (in(s, t[0])) std::rotate(t.begin(), t.begin() + 1, t.end());
    const auto m = static_cast<std::uint32_t>(mesh.positions.size()), a = s[0], b = s[1], c = s[2], d = t[0];
    mesh.positions.push_back(0.5 * (mesh.positions[b] + mesh.positions[c]));
    mesh.uv.push_back({(mesh.uv[b][0] + mesh.uv[c][0]) / 2, (mesh.uv[b][1] + mesh.uv[c][1]) / 2});
    s = {a, b, m}, t = {d, c, m};
    mesh.triangles.push_back({a, m, c});
    mesh.triangles.push_back({d, m, b});
  }
  return mesh;
}

}  // namespace
}  // namespace make_meshes

int main(int argc, char** argv) {
  using namespace make_meshes;
  if (argc < 2) return std::fprintf(stderr, "usage: make_meshes <folder> [statue|dragon|vase|knot]…\n"), 2;
  const std::string folder = argv[1];
  const std::set<std::string> wanted(argv + 2, argv + argc);
  const auto wants = [&](const char* name) { return wanted.empty() || wanted.count(name); };
  if (wants("statue")) {
    const auto fine = surface_of(statue(), {-0.55, -0.65, -0.04}, {0.55, 0.75, 2.6}, 0.0055);
    write(folder + "/statue.ply", ply(simplified(fine, 26000, "statue")));
    write(folder + "/statue_small.ply", ply(simplified(fine, 5000, "statue_small")));
  }
  if (wants("dragon")) {
    const auto fine = surface_of(dragon(), {-1.36, -1.6, -0.04}, {1.12, 1.6, 2.2}, 0.0105);
    write(folder + "/dragon.ply", ply(simplified(fine, 28000, "dragon")));
  }
  if (wants("vase")) write(folder + "/vase.glb", glb(vase(), orbc::image_io::encode_png(vase_paint())));
  if (wants("knot")) write(folder + "/knot.ply", ply(knot()));
}
