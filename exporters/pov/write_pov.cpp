// One mesh2 per copy costs nothing in POV-Ray (100,000 objects parse as fast as one), shared vertices halve the time, one declared atlas
// serves all (an image_map per object would be loaded anew each time: 15 s instead of 0.1 s). Colours: pigment from the atlas (sRGB,
// decoded by POV-Ray) times `emission`, in linear light, encoded again on output; nothing else may shine.
#include "exporters/pov/write_pov.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/check.h"
#include "compiler/base/elementary.h"
#include "compiler/image/image.h"
#include "compiler/image_io/exr.h"
#include "compiler/image_io/png.h"
#include "exporters/pov/base64.h"
#include "exporters/side_file.h"
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
  for (const driver::ProductCopy& copy : product.copies) triangles += copy.index_count / 3;
  pen << "// orbc: " << exporters::one_line(product.title) << ", " << product.copies.size() << " copies, " << triangles << " triangles\n";
  pen << "// size: +W" << product.eye.width << " +H" << product.eye.height << "\n";
  if (options.inline_atlas) {
    pen << "// The atlas is in the comment at the end; draw with: scripts/povray-pipe -o picture.png < this-file\n";
  } else {
    pen << "// Draw from this folder: povray +I" << exporters::one_line(options.name) << ".pov +W" << product.eye.width << " +H"
        << product.eye.height << " -D -A +FN8\n";
  }
  pen << "#version 3.7;\nglobal_settings { assumed_gamma 1.0 adc_bailout 0 max_trace_level " << (product.masked ? 256 : 5) << " }\n";
  pen << "background { rgb " << product.background << " }\n";
}

/// The camera's three vectors say everything; look_at and angle would make the picture depend on the handedness of `right`.
void write_camera(Pen& pen, const driver::Product& product) {
  const exporters::Standpoint at = exporters::standpoint(product);
  const place::Camera& eye = product.eye;
  const double aspect = static_cast<double>(eye.height) / eye.width;
  pen << "camera {\n  ";
  switch (eye.projection) {
    case scene::Projection::perspective: {
      const double half = math::tan(eye.fov.radians / 2);
      pen << "perspective\n  location " << at.location << "\n  direction " << at.forward << "\n  right " << (2 * half) * at.right
          << "\n  up " << (2 * half * aspect) * at.up << "\n";
      break;
    }
    case scene::Projection::panorama:
    case scene::Projection::stereo:  // refused before (driver.stereo-export)
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

/// The files beside the scene: the atlas, and of one with holes a mask. What is in a hole is decided after blending, at one half: so edges
/// stay sharp, and no colour of a hole shows at them.
struct AtlasFiles {
  driver::File atlas, mask;
};

// In the scene itself they need no name that nobody else has.
std::string name_beside(const PovOptions& options, const char* kind, const char* ending, const std::string& bytes) {
  if (options.inline_atlas) return exporters::plain_name(options.name) + kind + ending;
  return exporters::side_file_name({options.name, "pov", kind, ending}, bytes);
}

AtlasFiles atlas_files(const driver::Product& product, const PovOptions& options) {
  AtlasFiles files;
  if (product.atlas.rgba.empty()) return files;
  const bool exr = product.depth == scene::AtlasFormat::exr;
  if (product.atlas16.rgb.empty()) {
    image::Image opaque = product.atlas;
    for (std::size_t i = 3; i < opaque.rgba.size(); i += 4) opaque.rgba[i] = 255;
    files.atlas.bytes = image_io::encode_png(opaque);
  } else {
    files.atlas.bytes = exr ? image_io::encode_exr(product.atlas16) : image_io::encode_png(product.atlas16);
  }
  files.atlas.name = name_beside(options, "-atlas", exr ? ".exr" : ".png", files.atlas.bytes);
  if (product.masked) {
    files.mask.bytes = image_io::encode_alpha(product.atlas);
    files.mask.name = name_beside(options, "-mask", ".png", files.mask.bytes);
  }
  return files;
}

void write_atlas_pigment(Pen& pen, const driver::Product& product, const AtlasFiles& files, const PovOptions& options) {
  const char* lookup = options.interpolate || product.bilinear_atlas ? " interpolate 2" : "";
  const char* kind = product.depth == scene::AtlasFormat::exr ? "exr" : "png";
  pen << "#declare OrbcAtlas = pigment { ";
  if (files.atlas.name.empty()) {
    pen << "rgb 1";
  } else if (files.mask.name.empty()) {
    pen << "uv_mapping image_map { " << kind << " \"" << files.atlas.name << "\"" << lookup << " }";
  } else {
    pen << "uv_mapping image_pattern { png \"" << files.mask.name << "\"" << lookup << " } pigment_map { [0.5 rgbt 1] [0.5 image_map { "
        << kind << " \"" << files.atlas.name << "\"" << lookup << " }] }";
  }
  pen << " }\n";
}

constexpr double kFadeDistance = 1e-3;  // 2/(1 + (r/D)²) is 2D²/r² to 1/10,000 from r = 100 D on
constexpr int kGrid = 7;                // points of an area light in each direction

double degrees_of(double cosine) { return math::acos(std::clamp(cosine, 0.0, 1.0)) * 180 / std::numbers::pi; }

/// A white surface, face on at distance r, is to show intensity/r²; POV-Ray shows colour × 2/(1 + (r/D)²).
void write_lamp(Pen& pen, const native_lights::NativeLamp& lamp) {
  using scene::LampKind;
  const double gain = lamp.inverse_square ? 1 / (2 * kFadeDistance * kFadeDistance) : 1;
  pen << "light_source { " << lamp.at << " rgb " << gain * lamp.intensity;
  const bool one_sided = lamp.kind == LampKind::rectangle || lamp.kind == LampKind::disk;
  if (lamp.kind == LampKind::spot) {
    pen << " spotlight point_at " << lamp.at + lamp.axis << " radius " << degrees_of(lamp.cone_inner) << " falloff "
        << degrees_of(lamp.cone_outer) << " tightness 0";
  } else if (one_sided) {  // the cosine of a Lambertian plate
    pen << " spotlight point_at " << lamp.at + lamp.axis << " radius 90 falloff 90 tightness 1";
  }
  if (lamp.kind == LampKind::tube) {
    pen << " area_light " << 2.0 * lamp.half_u << ", <0,0,0.001>, " << kGrid * 2 << ", 1 area_illumination on";
  } else if (one_sided || lamp.kind == LampKind::sphere) {
    pen << " area_light " << 2.0 * lamp.half_u << ", " << 2.0 * lamp.half_v << ", " << kGrid << ", " << kGrid;
    if (lamp.kind != LampKind::rectangle) pen << " circular";
    if (lamp.kind == LampKind::sphere) pen << " orient";
    pen << " area_illumination on";
  }
  if (lamp.inverse_square) pen << " fade_power 2 fade_distance " << kFadeDistance;
  pen << " }\n";
}

/// The finish by which the pigment becomes light.
void write_finish(Pen& pen, const driver::Product& product, const driver::ProductCopy& copy) {
  if (product.native && copy.shading == native_lights::Shading::lit)
    pen << "finish { emission rgb " << copy.weight * product.native->ambient << " ambient 0 diffuse 1 }";
  else pen << "finish { emission rgb " << copy.weight << " ambient 0 diffuse 0 }";
}

void write_copy(Pen& pen, const driver::Product& product, const driver::ProductCopy& copy, std::size_t number) {
  pen << "// copy " << number << ": word \"" << cover::to_string(copy.word) << "\", " << copy.bounces << " bounces, sheet " << copy.sheet
      << ", weight " << copy.weight << ", distance " << static_cast<float>(copy.distance) << (copy.reversing ? ", reversed" : "");
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
  if (!product.normals.empty()) {
    pen << " }\nnormal_vectors { " << copy.vertex_count;
    for (std::size_t i = 0; i < copy.vertex_count; ++i) {
      const auto& n = product.normals[copy.first_vertex + i];
      pen << ",\n<" << n[0] << ',' << n[1] << ',' << n[2] << '>';
    }
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
  pen << " }\nuv_mapping\ntexture { pigment { OrbcAtlas } ";
  write_finish(pen, product, copy);
  pen << " }" << (copy.shading == native_lights::Shading::lamp_body ? " no_shadow" : "") << "\n}\n";
}

/// A copy that is lit by lamps of its own alone: in a light group, where everything casts shadows, but only what is in it is lit.
void write_lit_copy(Pen& pen, const driver::Product& product, std::size_t number, std::size_t& next_lamp) {
  const auto& lamps = product.native->lamps;
  const driver::ProductCopy& copy = product.copies[number];
  const bool drawn = copy.vertex_count > 0 && copy.index_count > 0 && next_lamp < lamps.size() && lamps[next_lamp].copy == number;
  if (drawn) pen << "light_group {\n";
  for (; next_lamp < lamps.size() && lamps[next_lamp].copy == number; ++next_lamp)
    if (drawn) write_lamp(pen, lamps[next_lamp]);
  write_copy(pen, product, copy, number);
  if (drawn) pen << "global_lights off\n}\n";
}

}  // namespace

std::vector<driver::File> write_pov(const driver::Product& product, const PovOptions& options) {
  ORBC_CHECK(product.uv.size(), ==, product.positions.size());
  AtlasFiles beside = atlas_files(product, options);

  std::string scene;
  // Measured: 31 bytes a position, 19 a uv, 22 a triangle; a little more is cheap, a second growth of the string is not.
  scene.reserve(4096 + 256 * product.copies.size() + 54 * product.positions.size() + 9 * product.indices.size() +
                (options.inline_atlas ? beside.atlas.bytes.size() / 3 * 4 + beside.atlas.bytes.size() / 64 : 0));
  {
    Pen pen(scene);
    write_head(pen, product, options);
    write_camera(pen, product);
    write_atlas_pigment(pen, product, beside, options);
    std::size_t next_lamp = 0;
    for (std::size_t i = 0; i < product.copies.size(); ++i) {
      if (product.native) write_lit_copy(pen, product, i, next_lamp);
      else write_copy(pen, product, product.copies[i], i);
    }
    for (const driver::File* file : {&beside.mask, &beside.atlas}) {
      if (!options.inline_atlas || file->name.empty()) continue;
      pen << "/* orbc-file " << file->name << " base64\n";
      write_base64(pen, file->bytes);
      pen << "*/\n";
    }
  }
  std::vector<driver::File> files;
  files.push_back({"", std::move(scene)});
  for (driver::File* file : {&beside.mask, &beside.atlas})
    if (!options.inline_atlas && !file->name.empty()) files.push_back(std::move(*file));
  return files;
}

std::uint64_t bytes_of(const driver::Amount& amount) {
  // Measured over all examples; indices count from 0 in each copy, so they are as long as a copy is large.
  constexpr double kHead = 900, kCopy = 330, kVertex = 52, kNormal = 33, kTriangle = 6;
  const auto copies = static_cast<double>(std::max<std::uint64_t>(1, amount.copies)), vertices = static_cast<double>(amount.vertices);
  const double digits = std::floor(math::log10(std::max(1.0, vertices / copies))) + 1;
  return static_cast<std::uint64_t>(kHead + kCopy * copies + (kVertex + (amount.normals ? kNormal : 0)) * vertices +
                                    (kTriangle + 3 * digits) * static_cast<double>(amount.triangles));
}

}  // namespace orbc::pov
