#pragma once
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "compiler/image_io/png.h"
#include "compiler/mesh/analyse.h"
#include "compiler/mesh_io/load.h"
#include "tests/unit/mesh_io/files.h"
#include "tests/unit/mesh_io/panel.h"

/// The rows of docs/files.md as tests, and the small files that they read.
namespace orbc::mesh_io::test {

using mesh::LinearColor;
using mesh::MaterialKind;

/// A cell of the table, and whether it holds; cells "—" have nothing to hold.
struct Cell {
  std::string text;
  std::function<bool()> holds;
};
struct Row {
  std::string name;
  std::vector<Cell> cells;  ///< OBJ, PLY, OFF, STL, glTF
};

// Rows on shapes: formats_table_shapes.cpp.
Row positions();
Row polygons();
Row points_and_lines();
Row texture_coordinates();
Row normals();
Row skeletons();
Row instances();
Row compression();
Row text();

// Rows on looks: formats_table_looks.cpp.
Row vertex_colors();
Row face_colors();
Row pictures();
Row holes();
Row transparency();
Row light_of_its_own();
Row metal_and_gloss();
Row bumps();

inline const Cell kNone{"—", {}};

/// What is read of a file, beside a red picture and a mask; nothing when it is refused.
inline Result<mesh::LoadedMesh> read_beside_pictures(const std::string& name, const std::string& bytes, const std::string& mtl = "") {
  static const Folder folder("formats_table");
  static const bool written = [] {
    folder.write("red.png", image_io::encode_png(image::Image{1, 1, {255, 0, 0, 255}}));
    folder.write("mask.png", image_io::encode_png(image::Image{2, 1, {255, 255, 255, 255, 0, 0, 0, 255}}));
    return true;
  }();
  (void)written;
  folder.write("m.mtl", mtl);
  return load_mesh(folder.write(name, bytes));
}

inline mesh::LoadedMesh must(Result<mesh::LoadedMesh> loaded) {
  if (!loaded) FAIL(to_text(loaded.error()));
  return *std::move(loaded);
}

inline mesh::LoadedMesh must_read(const std::string& name, const std::string& bytes, const std::string& mtl = "") {
  return must(read_beside_pictures(name, bytes, mtl));
}

inline mesh::LoadedMesh must_read(const Panel& panel) {
  std::string data;
  const std::string json = json_of(panel, data);
  return must(load_mesh_bytes(glb(json, data), Format::glb, "file", ""));
}

inline Panel panel_of(const std::string& material, const std::string& top = "") {
  Panel panel;
  panel.material = material;
  panel.top = top;
  return panel;
}

inline Panel textured(const std::string& members = "", const std::string& uri = data_uri("image/png", four_colors())) {
  return panel_of("{" + members + "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorTexture\":{\"index\":0}}}", with_picture(uri));
}

inline const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

/// A square with a material of an MTL.
inline mesh::LoadedMesh with_mtl(const std::string& mtl) {
  return must_read("p.obj", "mtllib m.mtl\n" + kSquare + "usemtl m\nf 1/1 2/2 3/3 4/4\nusemtl n\nf 1/1 2/2 3/3\n",
                   "newmtl m\n" + mtl + "newmtl n\n");
}

/// A PLY of a square: more properties of vertices, more elements, and what each vertex and the face have behind.
inline std::string ply_square(const std::string& vertex_properties, const std::string& vertex, const std::string& face_properties = "",
                       const std::string& face = "", const std::string& comments = "") {
  std::string text = "ply\nformat ascii 1.0\n" + comments + "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n" +
                     vertex_properties + "element face 1\nproperty list uchar int vertex_indices\n" + face_properties + "end_header\n";
  for (const char* at : {"0 0 0", "1 0 0", "1 1 0", "0 1 0"}) text += at + vertex + "\n";
  return text + "4 0 1 2 3" + face + "\n";
}

inline std::string off_square(const std::string& keyword, const std::string& vertex, const std::string& face = "") {
  std::string text = keyword + "\n4 1 0\n";
  for (const char* at : {"0 0 0", "1 0 0", "1 1 0", "0 1 0"}) text += at + vertex + "\n";
  return text + "4 0 1 2 3" + face + "\n";
}

inline std::string stl_with_color(unsigned color) {
  std::string bytes = tetra_binary_stl();
  for (std::size_t t = 0; t < 4; ++t) {
    bytes[84 + 50 * t + 48] = static_cast<char>(color & 255);
    bytes[84 + 50 * t + 49] = static_cast<char>(color >> 8);
  }
  return bytes;
}

inline bool is_color(const std::array<double, 3>& color, double r, double g, double b) {
  return std::fabs(color[0] - r) < 1e-3 && std::fabs(color[1] - g) < 1e-3 && std::fabs(color[2] - b) < 1e-3;
}

inline bool is_first_color(const mesh::LoadedMesh& loaded, double r, double g, double b) {
  return is_color(loaded.mesh.materials.at(loaded.mesh.triangle_material.empty() ? 0 : loaded.mesh.triangle_material[0]).color, r, g, b);
}

inline MaterialKind first_kind(const mesh::LoadedMesh& loaded) { return loaded.mesh.materials.at(0).kind; }
inline std::size_t triangles_of(const mesh::LoadedMesh& loaded) { return loaded.mesh.triangles.size(); }
inline bool has_picture(const mesh::LoadedMesh& loaded) {
  return !loaded.mesh.textures.empty() && loaded.mesh.materials.at(0).texture >= 0;
}

/// The same mesh with and without what is left out.
inline bool same_mesh(const mesh::LoadedMesh& a, const mesh::LoadedMesh& b) {
  return a.mesh.triangles == b.mesh.triangles && a.mesh.positions.size() == b.mesh.positions.size() && a.warnings.empty() &&
         b.warnings.empty();
}

inline std::string as_utf16(const std::string& text) {
  std::string wide("\xff\xfe");
  for (const char c : text) {
    wide.push_back(c);
    wide.push_back('\0');
  }
  return wide;
}

inline std::string with_carriage_returns(std::string text) {
  for (char& c : text) c = c == '\n' ? '\r' : c;
  return text;
}

inline constexpr double kGrey = 0.21404;  // of the sRGB code one half

}  // namespace orbc::mesh_io::test
