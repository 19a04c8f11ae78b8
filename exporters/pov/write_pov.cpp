// One mesh2 per copy costs nothing in POV-Ray (100,000 objects parse as fast as one), shared vertices halve the time, one declared atlas
// serves all (an image_map per object would be loaded anew each time: 15 s instead of 0.1 s). Colours: pigment from the atlas (sRGB, decoded
// by POV-Ray) times `emission`, in linear light, encoded again on output; nothing else may shine.
#include "exporters/pov/write_pov.h"

#include <cmath>

#include "compiler/base/check.h"
#include "compiler/mesh/image.h"
#include "exporters/pov/base64.h"
#include "exporters/standpoint.h"
#include "exporters/text.h"

namespace orbc::pov {
namespace {

using exporters::Pen;
using geometry::Vector3;

Pen& operator<<(Pen& pen, const Vector3& v) { return pen << '<' << v.x << ',' << v.y << ',' << v.z << '>'; }

/// Weights leave as float32: what a renderer keeps anyway, and half as long as the digits of a double.
Pen& operator<<(Pen& pen, const scene::Color& c) {
  return pen << '<' << static_cast<float>(c.r) << ',' << static_cast<float>(c.g) << ',' << static_cast<float>(c.b) << '>';
}

void write_head(Pen& pen, const driver::Product& product, const PovOptions& options) {
  std::size_t triangles = 0;
  for (const driver::DrawnCopy& copy : product.copies) triangles += copy.index_count / 3;
  pen << "// orbc: " << exporters::one_line(product.title) << ", " << product.copies.size() << " copies, " << triangles << " triangles\n";
  pen << "// size: +W" << product.eye.width << " +H" << product.eye.height << "\n";
  if (options.inline_atlas) {
    pen << "// The atlas is in the comment at the end; draw with: scripts/povray-pipe -o picture.png < this-file\n";
  } else {
    pen << "// Draw from this folder: povray +I" << exporters::one_line(options.name) << ".pov +W" << product.eye.width << " +H"
        << product.eye.height << " -D -A +FN8\n";
  }
  pen << "#version 3.7;\nglobal_settings { assumed_gamma 1.0 adc_bailout 0 max_trace_level 5 }\n";
  pen << "background { rgb " << product.background << " }\n";
}

/// The camera's three vectors say everything; look_at and angle would make the picture depend on the handedness of `right`.
void write_camera(Pen& pen, const driver::Product& product) {
  const exporters::Standpoint at = exporters::standpoint(product);
  const place::Eye& eye = product.eye;
  const double aspect = static_cast<double>(eye.height) / eye.width;
  pen << "camera {\n  ";
  switch (eye.projection) {
    case scene::Projection::perspective: {
      const double half = std::tan(eye.fov.radians / 2);
      pen << "perspective\n  location " << at.location << "\n  direction " << at.forward << "\n  right " << (2 * half) * at.right << "\n  up "
          << (2 * half * aspect) * at.up << "\n";
      break;
    }
    case scene::Projection::panorama:
      pen << "spherical\n  location " << at.location << "\n  direction " << at.forward << "\n  right " << -1.0 * at.right << "\n  up "
          << -1.0 * at.up << "\n  angle 360 180\n";
      break;
    case scene::Projection::cylinder:
      pen << "cylinder 1\n  location " << at.location << "\n  direction " << at.forward << "\n  right " << at.right << "\n  up "
          << (eye.fov.radians * aspect) * at.up << "\n  angle " << eye.fov.degrees() << "\n";
      break;
  }
  pen << "}\n";
}

void write_atlas_pigment(Pen& pen, const driver::Product& product, const std::string& atlas_name, const PovOptions& options) {
  pen << "#declare OrbcAtlas = pigment { ";
  if (product.atlas.rgba.empty()) {
    pen << "rgb 1";
  } else {
    pen << "uv_mapping image_map { png \"" << atlas_name << "\"" << (options.interpolate || product.blended_atlas ? " interpolate 2" : "") << " }";
  }
  pen << " }\n";
}

void write_copy(Pen& pen, const driver::Product& product, const driver::DrawnCopy& copy, std::size_t number) {
  pen << "// copy " << number << ": word \"" << cover::to_string(copy.word) << "\", " << copy.bounces << " bounces, sheet " << copy.sheet
      << ", weight " << copy.tint << ", distance " << static_cast<float>(copy.distance) << (copy.reversing ? ", reversed" : "");
  if (copy.vertex_count == 0 || copy.index_count == 0) {
    pen << ", nothing to draw\n";  // an empty mesh2 would be a parse error
    return;
  }
  pen << "\nmesh2 {\nvertex_vectors { " << copy.vertex_count;
  for (std::size_t i = 0; i < copy.vertex_count; ++i) {
    const auto& p = product.positions[copy.first_vertex + i];
    ORBC_CHECK(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]), ==, true);
    pen << ",\n<" << p[0] << ',' << p[1] << ',' << p[2] << '>';
  }
  pen << " }\nuv_vectors { " << copy.vertex_count;
  for (std::size_t i = 0; i < copy.vertex_count; ++i) {
    const auto& t = product.uv[copy.first_vertex + i];
    pen << ",\n<" << t[0] << ',' << 1 - t[1] << '>';  // POV-Ray counts v from the bottom row
  }
  pen << " }\nface_indices { " << copy.index_count / 3;
  for (std::size_t i = copy.first_index; i < copy.first_index + copy.index_count; i += 3) {
    std::size_t corner[3];
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = product.indices[i + k] - copy.first_vertex;  // wraps below first_vertex, and is caught too
      ORBC_CHECK(corner[k], <, copy.vertex_count);
    }
    pen << ",\n<" << corner[0] << ',' << corner[1] << ',' << corner[2] << '>';
  }
  pen << " }\nuv_mapping\ntexture { pigment { OrbcAtlas } finish { emission rgb " << copy.tint << " ambient 0 diffuse 0 } }\n}\n";
}

}  // namespace

std::vector<driver::File> write_pov(const driver::Product& product, const PovOptions& options) {
  ORBC_CHECK(product.uv.size(), ==, product.positions.size());
  const std::string atlas_name = exporters::plain_name(options.name) + "-atlas.png";
  std::string png;
  if (!product.atlas.rgba.empty()) png = mesh::encode_png(product.atlas);

  std::string scene;
  // Measured: 31 bytes a position, 19 a uv, 22 a triangle; a little more is cheap, a second growth of the string is not.
  scene.reserve(4096 + 256 * product.copies.size() + 54 * product.positions.size() + 9 * product.indices.size() +
                (options.inline_atlas ? png.size() / 3 * 4 + png.size() / 64 : 0));
  {
    Pen pen(scene);
    write_head(pen, product, options);
    write_camera(pen, product);
    write_atlas_pigment(pen, product, atlas_name, options);
    for (std::size_t i = 0; i < product.copies.size(); ++i) write_copy(pen, product, product.copies[i], i);
    if (options.inline_atlas && !png.empty()) {
      pen << "/* orbc-file " << atlas_name << " base64\n";
      write_base64(pen, png);
      pen << "*/\n";
    }
  }
  std::vector<driver::File> files;
  files.push_back({"", std::move(scene)});
  if (!options.inline_atlas && !png.empty()) files.push_back({atlas_name, std::move(png)});
  return files;
}

}  // namespace orbc::pov
