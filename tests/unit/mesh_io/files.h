#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "compiler/mesh_io/load.h"
#include "tests/support/folder.h"

namespace orbc::mesh_io::test {

using orbc::test::Folder;

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

inline std::string code_of(const Result<mesh::LoadedMesh>& result) { return result ? "fine" : result.error().front().code; }

inline bool warns(const mesh::LoadedMesh& loaded, const std::string& code, const std::string& part = "") {
  for (const auto& d : loaded.warnings)
    if (d.code == code && d.message.find(part) != std::string::npos) return true;
  return false;
}

// A tetrahedron in every format: corners (0,0,0), (1,0,0), (0,1,0), (0,0,1), turned outwards.

inline std::string tetra_obj() {
  return "# tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0.5 1\n"
         "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nf -4/1 -1/2 -2/3\n";
}
inline std::string tetra_off() { return "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"; }
inline std::string tetra_ply() {
  return "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nelement face 4\nproperty list uchar int vertex_indices\nproperty uchar flags\nend_header\n"
         "0 0 0 255\n1 0 0 255\n0 1 0 255\n0 0 1 255\n3 0 2 1 9\n3 0 1 3 9\n3 1 2 3 9\n3 0 3 2 9\n";
}
inline std::string tetra_binary_ply(bool big) {
  std::string out =
      std::string("ply\nformat binary_") + (big ? "big" : "little") +
      "_endian 1.0\nelement camera 1\nproperty list uchar short matrix\nelement vertex 4\nproperty double x\nproperty float y\n"
      "property short z\nproperty float s\nproperty float t\nelement face 4\nproperty list ushort uint vertex_index\nend_header\n";
  const auto add = [&](auto value) {
    std::string bytes;
    put(bytes, value);
    if (big) bytes.assign(bytes.rbegin(), bytes.rend());
    out += bytes;
  };
  add(std::uint8_t{2}), add(std::int16_t{7}), add(std::int16_t{8});
  const int p[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& v : p) add(double(v[0])), add(float(v[1])), add(std::int16_t(v[2])), add(0.25f), add(0.75f);
  const std::uint32_t f[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  for (const auto& t : f) add(std::uint16_t{3}), add(t[0]), add(t[1]), add(t[2]);
  return out;
}
inline const float (&tetra_points())[4][3] {
  static const float points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return points;
}
inline const int (&tetra_faces())[4][3] {
  static const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return faces;
}
inline std::string tetra_binary_stl() {
  std::string out(80, ' ');
  put(out, std::uint32_t{4});
  for (const auto& t : tetra_faces()) {
    for (int k = 0; k < 3; ++k) put(out, 0.0f);
    for (const int v : t) {
      for (const float x : tetra_points()[v]) put(out, x);
    }
    put(out, std::uint16_t{0});
  }
  return out;
}
inline std::string tetra_stl() {
  std::string out = "solid tetra\n";
  for (const auto& t : tetra_faces()) {
    out += " facet normal 0 0 0\n  outer loop\n";
    for (const int v : t) {
      out += "   vertex";
      for (const float x : tetra_points()[v]) out += x != 0 ? " 1.0e0" : " 0";
      out += "\n";
    }
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid tetra\n";
}

/// The data of a glTF tetrahedron: 48 bytes of positions, 24 bytes of 16-bit indices.
inline std::string tetra_data() {
  std::string data;
  for (const auto& p : tetra_points()) {
    for (const float x : p) put(data, x);
  }
  for (const auto& t : tetra_faces()) {
    for (const int v : t) put(data, static_cast<std::uint16_t>(v));
  }
  return data;
}
inline std::string tetra_json(const std::string& uri) {
  return "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
         "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
         "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,1]},"
         "{\"bufferView\":1,\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"}],"
         "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":24}],"
         "\"buffers\":[{" +
         (uri.empty() ? "" : "\"uri\":\"" + uri + "\",") + "\"byteLength\":72}]}";
}
inline std::string glb(std::string json, std::string data) {
  while (json.size() % 4) json += ' ';
  while (data.size() % 4) data += '\0';
  std::string out = "glTF";
  put(out, std::uint32_t{2});
  put(out, static_cast<std::uint32_t>(12 + 8 + json.size() + (data.empty() ? 0 : 8 + data.size())));
  put(out, static_cast<std::uint32_t>(json.size()));
  out += "JSON" + json;
  if (data.empty()) return out;
  put(out, static_cast<std::uint32_t>(data.size()));
  out += std::string("BIN\0", 4) + data;
  return out;
}
inline std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k < bytes.size() + 1 ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}
inline std::string tetra_glb() { return glb(tetra_json(""), tetra_data()); }
inline std::string tetra_gltf() { return tetra_json("data:application/octet-stream;base64," + base64(tetra_data())); }

/// The good files by name: what every format has to survive when they are cut off or bent.
inline std::vector<std::pair<std::string, std::pair<Format, std::string>>> good_files() {
  return {{"tetra.obj", {Format::obj, tetra_obj()}},          {"tetra.off", {Format::off, tetra_off()}},
          {"ascii.ply", {Format::ply, tetra_ply()}},          {"little.ply", {Format::ply, tetra_binary_ply(false)}},
          {"big.ply", {Format::ply, tetra_binary_ply(true)}}, {"binary.stl", {Format::stl, tetra_binary_stl()}},
          {"text.stl", {Format::stl, tetra_stl()}},           {"tetra.glb", {Format::glb, tetra_glb()}},
          {"tetra.gltf", {Format::gltf, tetra_gltf()}}};
}

}  // namespace orbc::mesh_io::test
