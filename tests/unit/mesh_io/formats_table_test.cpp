// docs/files.md, row by row: its table says what this one says, and each cell holds for small files that are really read.
#include <catch2/catch.hpp>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include "compiler/image_io/png.h"
#include "compiler/mesh/analyse.h"
#include "compiler/mesh_io/load.h"
#include "tests/unit/mesh_io/files.h"
#include "tests/unit/mesh_io/panel.h"

namespace {

using namespace orbc;
using namespace orbc::mesh_io;
using namespace orbc::mesh_io::test;
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

const Cell kNone{"—", {}};

/// What is read of a file, beside a red picture and a mask; nothing when it is refused.
Result<mesh::LoadedMesh> read_beside_pictures(const std::string& name, const std::string& bytes, const std::string& mtl = "") {
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

mesh::LoadedMesh must(Result<mesh::LoadedMesh> loaded) {
  if (!loaded) FAIL(to_text(loaded.error()));
  return *std::move(loaded);
}

mesh::LoadedMesh must_read(const std::string& name, const std::string& bytes, const std::string& mtl = "") {
  return must(read_beside_pictures(name, bytes, mtl));
}

mesh::LoadedMesh must_read(const Panel& panel) {
  std::string data;
  const std::string json = json_of(panel, data);
  return must(load_mesh_bytes(glb(json, data), Format::glb, "file", ""));
}

Panel panel_of(const std::string& material, const std::string& top = "") {
  Panel panel;
  panel.material = material;
  panel.top = top;
  return panel;
}

Panel textured(const std::string& members = "", const std::string& uri = data_uri("image/png", four_colors())) {
  return panel_of("{" + members + "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorTexture\":{\"index\":0}}}", with_picture(uri));
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

/// A square with a material of an MTL.
mesh::LoadedMesh with_mtl(const std::string& mtl) {
  return must_read("p.obj", "mtllib m.mtl\n" + kSquare + "usemtl m\nf 1/1 2/2 3/3 4/4\nusemtl n\nf 1/1 2/2 3/3\n",
                   "newmtl m\n" + mtl + "newmtl n\n");
}

/// A PLY of a square: more properties of vertices, more elements, and what each vertex and the face have behind.
std::string ply_square(const std::string& vertex_properties, const std::string& vertex, const std::string& face_properties = "",
                       const std::string& face = "", const std::string& comments = "") {
  std::string text = "ply\nformat ascii 1.0\n" + comments + "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n" +
                     vertex_properties + "element face 1\nproperty list uchar int vertex_indices\n" + face_properties + "end_header\n";
  for (const char* at : {"0 0 0", "1 0 0", "1 1 0", "0 1 0"}) text += at + vertex + "\n";
  return text + "4 0 1 2 3" + face + "\n";
}

std::string off_square(const std::string& keyword, const std::string& vertex, const std::string& face = "") {
  std::string text = keyword + "\n4 1 0\n";
  for (const char* at : {"0 0 0", "1 0 0", "1 1 0", "0 1 0"}) text += at + vertex + "\n";
  return text + "4 0 1 2 3" + face + "\n";
}

std::string stl_with_color(unsigned color) {
  std::string bytes = tetra_binary_stl();
  for (std::size_t t = 0; t < 4; ++t) {
    bytes[84 + 50 * t + 48] = static_cast<char>(color & 255);
    bytes[84 + 50 * t + 49] = static_cast<char>(color >> 8);
  }
  return bytes;
}

bool is_color(const std::array<double, 3>& color, double r, double g, double b) {
  return std::fabs(color[0] - r) < 1e-3 && std::fabs(color[1] - g) < 1e-3 && std::fabs(color[2] - b) < 1e-3;
}

bool is_first_color(const mesh::LoadedMesh& loaded, double r, double g, double b) {
  return is_color(loaded.mesh.materials.at(loaded.mesh.triangle_material.empty() ? 0 : loaded.mesh.triangle_material[0]).color, r, g, b);
}

MaterialKind first_kind(const mesh::LoadedMesh& loaded) { return loaded.mesh.materials.at(0).kind; }
std::size_t triangles_of(const mesh::LoadedMesh& loaded) { return loaded.mesh.triangles.size(); }
bool has_picture(const mesh::LoadedMesh& loaded) { return !loaded.mesh.textures.empty() && loaded.mesh.materials.at(0).texture >= 0; }

/// The same mesh with and without what is left out.
bool same_mesh(const mesh::LoadedMesh& a, const mesh::LoadedMesh& b) {
  return a.mesh.triangles == b.mesh.triangles && a.mesh.positions.size() == b.mesh.positions.size() && a.warnings.empty() &&
         b.warnings.empty();
}

std::string as_utf16(const std::string& text) {
  std::string wide("\xff\xfe");
  for (const char c : text) {
    wide.push_back(c);
    wide.push_back('\0');
  }
  return wide;
}

std::string with_carriage_returns(std::string text) {
  for (char& c : text) c = c == '\n' ? '\r' : c;
  return text;
}

constexpr double kGrey = 0.21404;  // of the sRGB code one half

Row positions() {
  const std::string far = "4500000.01";
  return {"positions",
          {{"read in double precision",
            [=] { return must_read("p.obj", "v " + far + " 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n").mesh.positions[0].x == 4500000.01; }},
           {"read",
            [] {
              std::string text = ply_square("", "");
              text.replace(text.find("1 1 0\n"), 6, "4500000.01 1 0\n");
              return mesh::analyse(must_read("p.ply", text).mesh).highest.x == 4500000.01;
            }},
           {"read", [] { return mesh::analyse(must_read("p.off", tetra_off()).mesh).highest.y == 1; }},
           {"read", [] { return mesh::analyse(must_read("p.stl", tetra_binary_stl()).mesh).highest.x == 1; }},
           {"read", [] { return mesh::analyse(must_read("p.glb", tetra_glb()).mesh).highest.x == 1; }}}};
}

Row polygons() {
  const std::string frame = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\nf 1 2 3 4 1 5 6 7 8 5\n";
  return {
      "polygons",
      {{"read, of any size, with bridged holes", [=] { return std::fabs(mesh::analyse(must_read("p.obj", frame).mesh).area - 12) < 1e-9; }},
       {"read", [] { return triangles_of(must_read("p.ply", ply_square("", ""))) == 2; }},
       {"read", [] { return triangles_of(must_read("p.off", off_square("OFF", ""))) == 2; }},
       {"triangles only",
        [] {
          std::string text = tetra_stl();
          text.insert(text.find("  endloop"), "   vertex 0 0 0\n");
          return triangles_of(must_read("p.stl", tetra_stl())) == 4 && code_of(read_beside_pictures("q.stl", text)) == "mesh.bad-header";
        }},
       {"triangles, strips, fans", [] {
          for (const char* mode : {"5", "6"}) {
            Panel panel;
            panel.primitive = ",\"mode\":" + std::string(mode);
            if (triangles_of(must_read(panel)) < 2) return false;
          }
          return triangles_of(must_read(Panel{})) == 2;
        }}}};
}

Row points_and_lines() {
  return {"points and lines",
          {{"not shown",
            [] { return same_mesh(must_read("p.obj", kSquare + "p 1\nl 1 2 3\nf 1 2 3\n"), must_read("q.obj", kSquare + "f 1 2 3\n")); }},
           {"not shown",
            [] {
              std::string text = ply_square("", "");
              text.replace(text.find("end_header"), 10, "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header");
              return same_mesh(must_read("p.ply", text + "0 1\n"), must_read("q.ply", ply_square("", "")));
            }},
           {"not shown", [] { return triangles_of(must_read("p.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n")) == 1; }},
           kNone,
           {"not shown", [] {
              Panel panel;
              panel.primitive = ",\"mode\":0},{\"attributes\":{\"POSITION\":0},\"indices\":2";
              return triangles_of(must_read(panel)) == 2;
            }}}};
}

Row texture_coordinates() {
  const auto has_uv = [](const mesh::LoadedMesh& loaded, float u, float v) {
    for (const auto& uv : loaded.mesh.uv)
      if (uv == std::array<float, 2>{u, v}) return true;
    return false;
  };
  return {"uv",
          {{"read for each corner",
            [=] { return has_uv(must_read("p.obj", kSquare + "vt 0.5 0.25\nf 1/1 2/2 3/3\nf 1/5 3/3 4/4\n"), 0.5f, 0.75f); }},
           {"read for each vertex or corner",
            [=] {
              return has_uv(must_read("p.ply", ply_square("property float s\nproperty float t\n", " 0.5 0.25")), 0.5f, 0.75f) &&
                     has_uv(must_read("q.ply", ply_square("", "", "property list uchar float texcoord\n", " 8 0.5 0.25 1 0 1 1 0 1")), 0.5f,
                            0.75f);
            }},
           {"read (ST)", [=] { return has_uv(must_read("p.off", off_square("STOFF", " 0.5 0.25")), 0.5f, 0.75f); }},
           kNone,
           {"read, with KHR_texture_transform", [=] {
              Panel panel = textured();
              panel.material =
                  "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_transform\":{\"scale\":[2,3]}"
                  "}}}}";
              return has_uv(must_read(textured()), 1, 1) && has_uv(must_read(panel), 2, 3);
            }}}};
}

Row vertex_colors() {
  const auto has_color = [](const mesh::LoadedMesh& loaded, double r, double g, double b) {
    for (const LinearColor& c : loaded.mesh.colors)
      if (is_color({static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])}, r, g, b)) return true;
    return false;
  };
  return {"colours of vertices",
          {{"read (`v x y z r g b`, ZBrush's `#MRGB`), sRGB",
            [=] {
              return has_color(must_read("p.obj", "v 0 0 0 0.5 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nf 1 2 3\n"), kGrey, 0, 0) &&
                     has_color(must_read("q.obj", kSquare + "#MRGB ffff0000ff00ff00ff0000ffffffff00\nf 1 2 3 4\n"), 1, 0, 0);
            }},
           {"read, sRGB",
            [=] {
              std::string text = ply_square("property float red\nproperty float green\nproperty float blue\n", " 0.5 0 0");
              text.replace(text.find("1 1 0 0.5"), 9, "1 1 0 1.0");
              return has_color(must_read("p.ply", text), kGrey, 0, 0);
            }},
           {"read (C), sRGB",
            [=] {
              std::string text = off_square("COFF", " 0.5 0 0 1");
              text.replace(text.find("1 1 0 0.5"), 9, "1 1 0 1.0");
              return has_color(must_read("p.off", text), kGrey, 0, 0);
            }},
           kNone,
           {"read (COLOR_0), linear", [=] {
              Panel panel;
              panel.attributes = ",\"COLOR_0\":3";
              panel.accessors = ",{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}";
              panel.more = {0.5f, 0, 0, 0, 1, 0, 0, 0, 1, 0.25f, 0.5f, 0};
              return has_color(must_read(panel), 0.5, 0, 0);
            }}}};
}

Row face_colors() {
  return {"colours of faces",
          {{"by materials", [] { return is_first_color(with_mtl("Kd 1 0 0\n"), 1, 0, 0); }},
           {"read, sRGB",
            [] {
              const std::string properties = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
              return is_first_color(must_read("p.ply", ply_square("", "", properties, " 255 0 0")), 1, 0, 0);
            }},
           {"read; by index: left out",
            [] {
              return is_first_color(must_read("p.off", off_square("OFF", "", " 255 0 0")), 1, 0, 0) &&
                     warns(must_read("q.off", off_square("OFF", "", " 7")), "mesh.ignored", "by index");
            }},
           {"read (Magics, VisCAM), sRGB",
            [] {
              // VisCAM: bit 15 says that there is a colour, blue in the lowest bits. Magics: a colour of the whole in the header, bit 15
              // says that it holds, red in the lowest bits.
              std::string magics = stl_with_color(31);
              magics.replace(0, 10, "COLOR=\xff\xff\xff\xff");
              return is_first_color(must_read("p.stl", stl_with_color(0x8000 | 31u << 10)), 1, 0, 0) &&
                     is_first_color(must_read("q.stl", magics), 1, 0, 0);
            }},
           {"by materials", [] {
              return is_first_color(must_read(panel_of("{\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.5,0,1]}}")), 1, 0.5, 0);
            }}}};
}

Row normals() {
  return {
      "normals",
      {{"not used: surfaces are smooth where their edges are blunt",
        [] { return same_mesh(must_read("p.obj", kSquare + "vn 0 1 0\nf 1//1 2//1 3//1\n"), must_read("q.obj", kSquare + "f 1 2 3\n")); }},
       {"as OBJ",
        [] {
          return same_mesh(must_read("p.ply", ply_square("property float nx\nproperty float ny\nproperty float nz\n", " 0 1 0")),
                           must_read("q.ply", ply_square("", "")));
        }},
       {"as OBJ", [] { return same_mesh(must_read("p.off", off_square("NOFF", " 0 1 0")), must_read("q.off", off_square("OFF", ""))); }},
       {"as OBJ",
        [] {
          std::string text = tetra_stl();
          text.replace(text.find("normal 0 0 0"), 12, "normal 0 1 0");
          return same_mesh(must_read("p.stl", text), must_read("q.stl", tetra_stl()));
        }},
       {"as OBJ", [] {
          Panel panel;
          panel.attributes = ",\"NORMAL\":0";
          return same_mesh(must_read(panel), must_read(Panel{}));
        }}}};
}

Row pictures() {
  const auto has_u = [](const mesh::LoadedMesh& loaded, float u) {
    for (const auto& uv : loaded.mesh.uv)
      if (uv[0] == u) return true;
    return false;
  };
  return {"pictures",
          {{"`map_Kd` with -s, -o, -clamp; beside the mesh, in any case, whatever the path",
            [=] {
              const auto far = with_mtl("map_Kd -s 2 2 1 -o 0.5 0 C:\\art\\RED.png\n");
              return has_picture(far) && has_u(far, 2.5f) && has_picture(with_mtl("map_Kd -clamp on red.png\n"));
            }},
           {"`TextureFile`, several with `texnumber`",
            [] {
              const auto loaded =
                  must_read("p.ply", ply_square("", "", "property list uchar float texcoord\nproperty int texnumber\n",
                                                " 8 0 0 1 0 1 1 0 1 1", "comment TextureFile mask.png\ncomment TextureFile red.png\n"));
              const auto material = loaded.mesh.triangle_material.empty() ? 0 : loaded.mesh.triangle_material[0];
              return loaded.mesh.textures.at(static_cast<std::size_t>(loaded.mesh.materials.at(material).texture)).width == 1;
            }},
           kNone,
           kNone,
           {"base colour, diffuse (specular-glossiness), emissive; wrap modes", [] {
              const std::string top = with_picture(data_uri("image/png", four_colors()));
              Panel clamped = textured();
              clamped.uv_from = -1;
              clamped.uv_to = 2;
              const std::size_t tiles = triangles_of(must_read(clamped));
              clamped.top = with_picture(data_uri("image/png", four_colors()), "{\"wrapS\":33071,\"wrapT\":33071}");
              return has_picture(must_read(textured())) && tiles == 2 && triangles_of(must_read(clamped)) > 2 &&
                     has_picture(must_read(
                         panel_of("{\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseTexture\":{\"index\":0}}}}", top))) &&
                     has_picture(must_read(panel_of("{\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0},"
                                                    "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1]}}",
                                                    top)));
            }}}};
}

Row holes() {
  const std::string translucent = data_uri("image/png", image_io::encode_png(image::Image{2, 1, {255, 0, 0, 255, 0, 0, 0, 90}}));
  return {
      "holes",
      {{"`map_d`: changed, by a threshold of one half", [] { return with_mtl("map_d mask.png\n").mesh.materials[0].alpha_cutoff == 0.5; }},
       kNone,
       kNone,
       kNone,
       {"alphaMode MASK: read; BLEND: changed, with a warning", [=] {
          const auto masked = must_read(textured("\"alphaMode\":\"MASK\",\"alphaCutoff\":0.3,", translucent));
          const auto blended = must_read(textured("\"alphaMode\":\"BLEND\",", translucent));
          return std::fabs(masked.mesh.materials[0].alpha_cutoff - 0.3) < 1e-9 && masked.warnings.empty() &&
                 blended.mesh.materials[0].alpha_cutoff == 0.5 && warns(blended, "mesh.blended");
        }}}};
}

Row transparency() {
  const auto transmission = [](const char* factor) {
    return must_read(panel_of("{\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":" + std::string(factor) +
                              "},\"KHR_materials_ior\":{\"ior\":1.33}}}"));
  };
  return {"transparency",
          {{"`d`, `Tr`: glass with illum 4, 6, 7, 9; else changed, with a warning",
            [] {
              for (const char* illum : {"4", "6", "7", "9"})
                if (first_kind(with_mtl("d 0.1\nillum " + std::string(illum) + "\n")) != MaterialKind::glass) return false;
              return first_kind(with_mtl("Tr 0.9\nillum 7\n")) == MaterialKind::glass && warns(with_mtl("d 0.7\n"), "mesh.blended");
            }},
           kNone,
           kNone,
           kNone,
           {"transmission and ior: glass, from one half on", [=] {
              const auto glass = transmission("0.5");
              return first_kind(glass) == MaterialKind::glass && glass.mesh.materials[0].index == 1.33 &&
                     first_kind(transmission("0.4")) != MaterialKind::glass;
            }}}};
}

Row light_of_its_own() {
  return {"light",
          {{"`Ke`: emissive", [] { return first_kind(with_mtl("Ke 0 4 2\n")) == MaterialKind::emissive; }},
           kNone,
           kNone,
           kNone,
           {"emissive where it is brighter than the colour; else left out", [] {
              const auto bright =
                  must_read(panel_of("{\"emissiveFactor\":[0,1,0],\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1]}}"));
              const auto dim = must_read(panel_of("{\"emissiveFactor\":[0.1,0,0]}"));
              return first_kind(bright) == MaterialKind::emissive && first_kind(dim) != MaterialKind::emissive &&
                     warns(dim, "mesh.ignored", "emissive");
            }}}};
}

Row metal_and_gloss() {
  const auto kind_of = [](const char* metallic, const char* roughness) {
    return first_kind(must_read(
        panel_of("{\"pbrMetallicRoughness\":{\"metallicFactor\":" + std::string(metallic) + ",\"roughnessFactor\":" + roughness + "}}")));
  };
  return {"metal and gloss",
          {{"`Pm`, `Pr`: metal; `Ks`, `Ns` are not shown",
            [] {
              return first_kind(with_mtl("Pm 1\nPr 0.2\n")) == MaterialKind::metal &&
                     with_mtl("Pm 1\nPr 0.2\n").mesh.materials[0].roughness == 0.2 &&
                     first_kind(with_mtl("Ks 1 1 1\nNs 500\n")) == MaterialKind::matte;
            }},
           kNone,
           kNone,
           kNone,
           {"metal from one half on, glossy below a roughness of one half, of pictures their mean", [=] {
              // Blue is metal, green roughness: one texel of two is metal.
              const std::string halves = data_uri("image/png", image_io::encode_png(image::Image{2, 1, {0, 51, 255, 255, 0, 51, 0, 255}}));
              const auto mixed =
                  must_read(panel_of("{\"pbrMetallicRoughness\":{\"metallicRoughnessTexture\":{\"index\":0}}}", with_picture(halves)));
              return kind_of("0.5", "0.9") == MaterialKind::metal && kind_of("0.4", "0.9") == MaterialKind::matte &&
                     kind_of("0", "0.4") == MaterialKind::glossy && kind_of("0", "0.5") == MaterialKind::matte &&
                     first_kind(mixed) == MaterialKind::metal && std::fabs(mixed.mesh.materials[0].roughness - 0.2) < 1e-3;
            }}}};
}

Row bumps() {
  return {"bumps, reflections",
          {{"left out", [] { return warns(with_mtl("bump b.png\nrefl r.png\n"), "mesh.ignored", "bump, refl"); }},
           kNone,
           kNone,
           kNone,
           {"left out", [] { return warns(must_read(panel_of("{\"normalTexture\":{\"index\":0}}")), "mesh.ignored", "normalTexture"); }}}};
}

Row skeletons() {
  return {"skeletons, morphs",
          {kNone, kNone, kNone, kNone, {"read in the default pose; animation: a note", [] {
                                          Panel morph;
                                          morph.primitive = ",\"targets\":[{\"POSITION\":3}]";
                                          morph.accessors = ",{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}";
                                          morph.more = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0};
                                          morph.mesh = ",\"weights\":[1]";
                                          Panel skin;
                                          skin.node = ",\"skin\":0,\"translation\":[9,9,9]";
                                          skin.nodes = ",{\"translation\":[5,0,0]}";
                                          skin.top = "\"skins\":[{\"joints\":[1]}],";
                                          skin.attributes = ",\"JOINTS_0\":3,\"WEIGHTS_0\":4";
                                          skin.accessors =
                                              ",{\"bufferView\":3,\"componentType\":5121,\"count\":4,\"type\":\"VEC4\"}"
                                              ",{\"bufferView\":3,\"byteOffset\":16,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"}";
                                          skin.more = {0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
                                          return mesh::analyse(must_read(morph).mesh).highest.y == 2 &&
                                                 mesh::analyse(must_read(skin).mesh).highest.x == 6 &&
                                                 warns(must_read(panel_of("{}", "\"animations\":[{\"channels\":[],\"samplers\":[]}],")),
                                                       "mesh.ignored", "animated");
                                        }}}};
}

Row instances() {
  return {"instances, visibility",
          {{"groups are one mesh", [] { return triangles_of(must_read("p.obj", kSquare + "g a\nf 1 2 3\no b\nf 1 3 4\n")) == 2; }},
           kNone,
           kNone,
           kNone,
           {"EXT_mesh_gpu_instancing, KHR_node_visibility", [] {
              Panel panel;
              panel.node = ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":3}}}";
              panel.accessors = ",{\"bufferView\":3,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}";
              panel.more = {0, 0, 0, 2, 0, 0, 4, 0, 0};
              const std::size_t three = triangles_of(must_read(panel));
              Panel hidden;
              hidden.node = ",\"extensions\":{\"KHR_node_visibility\":{\"visible\":false}}";
              std::string data;
              const std::string json = json_of(hidden, data);
              return three == 6 && code_of(load_mesh_bytes(glb(json, data), Format::glb, "file", "")) == "mesh.no-triangles";
            }}}};
}

Row compression() {
  return {"compression",
          {kNone, kNone, kNone, kNone, {"Draco, meshopt: refused", [] {
                                          for (const std::string name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
                                            std::string data;
                                            const std::string json =
                                                json_of(panel_of("{}", "\"extensionsUsed\":[\"" + name + "\"],\"extensionsRequired\":[\"" +
                                                                           name + "\"],"),
                                                        data);
                                            const auto loaded = load_mesh_bytes(glb(json, data), Format::glb, "file", "");
                                            if (code_of(loaded) != "mesh.unsupported" ||
                                                loaded.error().front().message.find(name) == std::string::npos)
                                              return false;
                                          }
                                          return true;
                                        }}}};
}

Row text() {
  return {"text",
          {{"UTF-8, UTF-16 with a mark; lines of Unix, Windows and old Macs",
            [] {
              std::string windows = tetra_obj();
              for (std::size_t at = 0; (at = windows.find('\n', at)) != windows.npos; at += 2) windows.insert(at, "\r");
              for (const std::string& same :
                   {as_utf16(tetra_obj()), std::string("\xef\xbb\xbf").append(tetra_obj()), with_carriage_returns(tetra_obj()), windows})
                if (triangles_of(must_read("p.obj", same)) != 4) return false;
              return true;
            }},
           {"as OBJ, without UTF-16",
            [] {
              return triangles_of(must_read("p.ply", with_carriage_returns(tetra_ply()))) == 4 &&
                     triangles_of(must_read("q.ply", std::string("\xef\xbb\xbf").append(tetra_ply()))) == 4 &&
                     code_of(read_beside_pictures("r.ply", as_utf16(tetra_ply()))) == "mesh.bad-header";
            }},
           {"as OBJ; the keyword may be missing or glued to the counts",
            [] {
              const std::string body = off_square("", "").substr(1);
              return triangles_of(must_read("p.off", body)) == 2 && triangles_of(must_read("q.off", "OFF" + body)) == 2 &&
                     triangles_of(must_read("r.off", as_utf16(tetra_off()))) == 4;
            }},
           {"as OBJ; without its end: a warning",
            [] {
              return warns(must_read("p.stl", tetra_stl().substr(0, tetra_stl().find("endsolid"))), "mesh.repaired", "endsolid") &&
                     triangles_of(must_read("q.stl", as_utf16(tetra_stl()))) == 4;
            }},
           kNone}};
}

std::vector<Row> table() {
  return {
      positions(), polygons(),     points_and_lines(), texture_coordinates(), vertex_colors(), face_colors(), normals(),   pictures(),
      holes(),     transparency(), light_of_its_own(), metal_and_gloss(),     bumps(),         skeletons(),   instances(), compression(),
      text()};
}

/// The cells of the table's rows as the page has them, without its head.
std::vector<std::vector<std::string>> rows_of_page() {
  std::ifstream page(ORBC_SOURCE_DIR "/docs/files.md");
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) == 0) break;  // the table of bounds
    if (line.rfind("| ", 0) != 0 || line.rfind("| | OBJ", 0) == 0) continue;
    std::vector<std::string> cells;
    std::istringstream parts(line.substr(2));
    for (std::string cell; std::getline(parts, cell, '|');)
      cells.push_back(cell.substr(cell.find_first_not_of(' '), cell.find_last_not_of(' ') + 1 - cell.find_first_not_of(' ')));
    rows.push_back(std::move(cells));
  }
  return rows;
}

}  // namespace

TEST_CASE("the page on mesh files says of each format what is tested here", "[mesh_io]") {
  const auto page = rows_of_page();
  const auto tested = table();
  REQUIRE(page.size() == tested.size());
  for (std::size_t r = 0; r < page.size(); ++r) {
    std::vector<std::string> cells{tested[r].name};
    for (const Cell& cell : tested[r].cells) cells.push_back(cell.text);
    CHECK(page[r] == cells);
  }
}

TEST_CASE("each cell of the page on mesh files holds for small files", "[mesh_io]") {
  const char* const formats[] = {"OBJ", "PLY", "OFF", "STL", "glTF"};
  for (const Row& row : table()) {
    REQUIRE(row.cells.size() == 5);
    for (std::size_t c = 0; c < 5; ++c) {
      INFO(row.name << " of " << formats[c] << ": " << row.cells[c].text);
      if (row.cells[c].text == "—") CHECK_FALSE(row.cells[c].holds);
      else CHECK(row.cells[c].holds());
    }
  }
}
