#include "exporters/gltf/camera.h"

#include "compiler/base/elementary.h"
#include "exporters/gltf/pose.h"
#include "exporters/standpoint.h"

namespace orbc::gltf {
namespace {

const char* projection_name(scene::Projection projection) {
  switch (projection) {
    case scene::Projection::perspective:
      return "perspective";
    case scene::Projection::cylinder:
      return "cylinder";
    default:
      return "panorama";
  }
}

}  // namespace

void write_camera(Json& json, const driver::Product& product) {
  const place::Camera& eye = product.eye;
  const double aspect = static_cast<double>(eye.width) / eye.height;
  double half = 1;
  if (eye.projection == scene::Projection::perspective) half = math::tan(eye.fov.radians / 2) / aspect;
  if (eye.projection == scene::Projection::cylinder) half = eye.fov.radians / 2 / aspect;
  json.key("cameras").array().object();
  json.key("type").string("perspective").key("perspective").object();
  json.key("yfov").number(2 * math::atan(half)).key("aspectRatio").number(aspect).key("znear").number(0.01);
  json.end_object();
  json.key("extras").object();
  json.key("orbc_projection").string(projection_name(eye.projection));
  json.key("orbc_width").number(eye.width).key("orbc_height").number(eye.height);
  json.key("orbc_fov_deg").number(static_cast<float>(eye.fov.degrees()));
  json.key("orbc_background").numbers(floats(product.background));
  if (product.scale != 1) json.key("orbc_scale").number(product.scale);
  json.end_object().end_object().end_array();
}

void write_camera_node(Json& json, const driver::Product& product) {
  const exporters::Standpoint at = exporters::standpoint(product);
  json.object().key("name").string("camera").key("camera").number(0);
  write_matrix(json, {at.right, at.up, -1.0 * at.forward, at.location});
  json.end_object();
}

}  // namespace orbc::gltf
