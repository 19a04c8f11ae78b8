#include "exporters/gltf/lamps.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "compiler/base/elementary.h"
#include "exporters/gltf/pose.h"

namespace orbc::gltf {
namespace {

bool is_cone(const native_lights::NativeLamp& lamp) {
  return lamp.kind == scene::LampKind::spot || lamp.kind == scene::LampKind::disk || lamp.kind == scene::LampKind::rectangle;
}

}  // namespace

std::vector<native_lights::NativeLamp> own_lamps(const driver::Product& product) {
  std::vector<native_lights::NativeLamp> own;
  if (product.native)
    std::copy_if(product.native->lamps.begin(), product.native->lamps.end(), std::back_inserter(own),
                 [](const native_lights::NativeLamp& l) { return l.direct; });
  return own;
}

void write_lights(Json& json, const std::vector<native_lights::NativeLamp>& lamps) {
  constexpr double kLumensPerWatt = 683;
  json.key("extensions").object().key("KHR_lights_punctual").object().key("lights").array();
  for (const native_lights::NativeLamp& lamp : lamps) {
    const double most = scene::max_channel(lamp.intensity), whole = most > 0 ? most : 1;
    json.object().key("type").string(is_cone(lamp) ? "spot" : "point");
    json.key("color").numbers(floats((1 / whole) * lamp.intensity));
    json.key("intensity").number(kLumensPerWatt * std::numbers::pi * most);
    if (lamp.kind != scene::LampKind::tube && geometry::length(lamp.half_u) > 0)  // glTF knows no size; scripts/render_blender.py does
      json.key("extras")
          .object()
          .key("orbc_radius")
          .number(static_cast<float>(std::sqrt(geometry::length(lamp.half_u) * geometry::length(lamp.half_v))))
          .end_object();
    if (is_cone(lamp)) {
      const bool spot = lamp.kind == scene::LampKind::spot;
      const double outer = spot ? std::min(math::acos(lamp.cone_outer), std::numbers::pi / 2) : std::numbers::pi / 2;
      json.key("spot").object().key("innerConeAngle").number(spot ? std::min(math::acos(lamp.cone_inner), 0.999 * outer) : 0.0);
      json.key("outerConeAngle").number(outer).end_object();
    }
    json.end_object();
  }
  json.end_array().end_object().end_object();
}

void write_lamp_node(Json& json, const native_lights::NativeLamp& lamp, std::size_t number) {
  // Any frame whose third axis is against that of the lamp.
  const geometry::Vector3 back = -1.0 * lamp.axis;
  const geometry::Vector3 aside = std::fabs(back.z) < 0.9 ? geometry::Vector3{0, 0, 1} : geometry::Vector3{1, 0, 0};
  const geometry::Vector3 right = geometry::normalised(geometry::cross(aside, back));
  json.object().key("name").string("lamp");
  write_matrix(json, {right, geometry::cross(back, right), back, lamp.at});
  json.key("extensions").object().key("KHR_lights_punctual").object().key("light").number(number).end_object().end_object();
  json.end_object();
}

}  // namespace orbc::gltf
