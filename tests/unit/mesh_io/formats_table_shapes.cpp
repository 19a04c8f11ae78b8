// Rows of docs/files.md on shapes: positions, faces, coordinates on surfaces, and how files are written.
#include "tests/unit/mesh_io/formats_table.h"

namespace orbc::mesh_io::test {

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
              for (std::size_t at = 0; (at = windows.find('\n', at)) != windows.npos; at += 2) windows.insert(at, 1, '\r');
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

}  // namespace orbc::mesh_io::test
