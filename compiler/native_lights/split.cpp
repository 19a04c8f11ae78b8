#include "compiler/native_lights/split.h"

#include <algorithm>
#include <utility>

#include "compiler/light/lamp.h"

namespace orbc::native_lights {
namespace {

using scene::MaterialKind;

bool is_emissive(const place::Interior& room, std::uint16_t style) { return room.styles[style].material.kind == MaterialKind::emissive; }

/// The triangles of a part that are emissive, or the others.
place::PlacedMesh emissive_subset(const place::Interior& room, const place::PlacedMesh& part, bool emissive) {
  place::PlacedMesh subset = part;
  subset.triangles.clear();
  subset.style.clear();
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    if (is_emissive(room, part.style[t]) != emissive) continue;
    subset.triangles.push_back(part.triangles[t]);
    subset.style.push_back(part.style[t]);
  }
  return subset;
}

/// The parts, with those that mix emissive and other triangles split in two.
std::vector<place::PlacedMesh> split_parts(const place::Interior& room, std::vector<place::PlacedMesh> parts) {
  std::vector<place::PlacedMesh> split;
  for (place::PlacedMesh& part : parts) {
    const auto count = std::count_if(part.style.begin(), part.style.end(), [&](std::uint16_t style) { return is_emissive(room, style); });
    if (count == 0 || count == static_cast<std::ptrdiff_t>(part.style.size())) {
      split.push_back(std::move(part));
    } else {
      split.push_back(emissive_subset(room, part, false));
      split.push_back(emissive_subset(room, part, true));
    }
  }
  return split;
}

}  // namespace

bool uses_native_lights(const scene::Scene& scene) { return scene.bake.lights == scene::LightMode::native && !scene.lamps.empty(); }

UnlitCopy unlit_copy(const scene::Scene& scene, const place::Interior& interior) {
  UnlitCopy copy{scene, interior};
  copy.scene.lamps.clear();
  copy.scene.integrator = scene::Integrator::direct;
  copy.scene.exposure = 1;
  for (place::SurfaceStyle& look : copy.interior.styles) {
    // The intensity of native lamps includes the exposure: emission must, too.
    if (look.material.kind == MaterialKind::emissive) look.material.emission *= scene.exposure;
    else look.material.kind = MaterialKind::matte;
  }
  copy.interior.parts = split_parts(copy.interior, std::move(copy.interior.parts));
  return copy;
}

Shading shading_of(const place::Interior& interior, const place::PlacedMesh& part) {
  if (part.style.empty()) return Shading::lit;
  const bool is_impostor = part.style[0] >= interior.styles.size();
  if (is_impostor) return Shading::lamp_body;
  if (!is_emissive(interior, part.style[0])) return Shading::lit;
  return light::lamp_of_part(part) >= 0 || part.kind != place::PartKind::object ? Shading::lamp_body : Shading::emissive;
}

}  // namespace orbc::native_lights
