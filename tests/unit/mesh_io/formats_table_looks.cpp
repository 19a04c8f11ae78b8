// Rows of docs/files.md on looks: colours, pictures, holes, transparency, light, metal.
#include "tests/unit/mesh_io/formats_table.h"

namespace orbc::mesh_io::test {

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

}  // namespace orbc::mesh_io::test
