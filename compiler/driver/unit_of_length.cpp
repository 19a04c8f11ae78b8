// Similarities of E². Angles, directions, colours and everything that counts pixels stay as they are.
#include "compiler/driver/unit_of_length.h"

#include <memory>
#include <utility>
#include <variant>

#include "compiler/notation/classify.h"
#include "compiler/room/realise.h"

namespace orbc::driver {
namespace {

template <class... Cases>
struct Overload : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overload(Cases...) -> Overload<Cases...>;  // clang 14 needs it

geometry::Point scaled(const geometry::Point& p, double factor) { return {p.w, factor * p.x, factor * p.y}; }

geometry::Isometry scaled(geometry::Isometry map, double factor) {
  map.b *= factor;
  return map;
}

// ---- the scene -----------------------------------------------------------------------------------------------------------------

/// A number to 40 binary digits, so that scenes which differ only by their unit have the same lengths to the last bit. A tie, such as two
/// edges of equal length, is then broken in the same way in every unit.
/// Source: Veltkamp's splitting; Dekker 1971, A floating-point technique for extending the available precision, §5.
double to_40_digits(double x) {
  constexpr double kSplit = (1 << 13) + 1;
  const double large = kSplit * x;
  return large - (large - x);
}

/// What lengths of a scene are multiplied by. The products are rounded.
struct Factor {
  double value = 1;
};
double operator*(Factor factor, double length) { return to_40_digits(factor.value * length); }
double& operator*=(double& length, Factor factor) { return length = factor * length; }

scene::Place scaled(scene::Place place, Factor factor) {
  std::visit(Overload{[](scene::AtCentre&) {},
                      [&](scene::AtDisk& at) {
                        at.z = {factor * at.z.real(), factor * at.z.imag()};
                      },
                      [&](scene::AtPolar& at) { at.r *= factor; },
                      [&](scene::AtXy& at) {
                        at = {factor * at.x, factor * at.y};
                      },
                      [&](scene::AtToward& at) { at.distance *= factor; },
                      [&](scene::AtWalls& at) {
                        for (double& distance : at.distances) distance *= factor;
                      }},
             place.floor);
  if (place.z) *place.z *= factor;
  return place;
}

scene::Material scaled(scene::Material material, Factor factor) {
  material.cell *= factor;
  return material;
}

scene::Mirror scaled(scene::Mirror mirror, Factor factor) {
  for (auto* range : {&mirror.arc, &mirror.height})
    if (*range) *range = {factor * (**range)[0], factor * (**range)[1]};
  if (mirror.frame) mirror.frame = scene::Frame{factor * mirror.frame->width, scaled(mirror.frame->material, factor)};
  return mirror;
}

scene::Surface scaled(scene::Surface surface, Factor factor) {
  surface.material = scaled(std::move(surface.material), factor);
  if (surface.mirror) surface.mirror = scaled(std::move(*surface.mirror), factor);
  return surface;
}

scene::RoomSpec scaled(scene::RoomSpec room, Factor factor) {
  room.height *= factor;
  room.floor = scaled(std::move(room.floor), factor);
  room.ceiling = scaled(std::move(room.ceiling), factor);
  for (scene::Wall& wall : room.walls) {
    wall.material = scaled(std::move(wall.material), factor);
    for (scene::Mirror& mirror : wall.mirrors) mirror = scaled(std::move(mirror), factor);
  }
  return room;
}

/// Meshes without a size have the author's unit: their factors grow instead.
scene::Object scaled(scene::Object object, Factor factor) {
  const auto grow = [&](auto&... lengths) { ((lengths *= factor), ...); };
  std::visit(Overload{[&](scene::MeshFile&) {
                        if (!object.size) grow(object.scale[0], object.scale[1], object.scale[2]);
                      },
                      [&](scene::SphereSpec& s) { grow(s.radius); }, [&](scene::CylinderSpec& s) { grow(s.radius, s.height); },
                      [&](scene::BoxSpec& s) { grow(s.size[0], s.size[1], s.size[2]); },
                      [&](scene::TorusSpec& s) { grow(s.radius, s.tube); }, [&](scene::TorusKnotSpec& s) { grow(s.radius, s.tube); },
                      [&](scene::BarSpec& s) {
                        s.from = scaled(s.from, factor);
                        s.to = scaled(s.to, factor);
                        grow(s.width);
                      }},
             object.shape);
  if (object.size) grow(*object.size);
  object.place = scaled(std::move(object.place), factor);
  if (object.material) object.material = scaled(std::move(*object.material), factor);
  return object;
}

scene::Lamp scaled(scene::Lamp lamp, Factor factor) {
  lamp.place = scaled(std::move(lamp.place), factor);
  if (lamp.to) lamp.to = scaled(std::move(*lamp.to), factor);
  lamp.radius *= factor;
  lamp.size = {factor * lamp.size[0], factor * lamp.size[1]};
  if (lamp.falloff != scene::Falloff::none) lamp.power = to_40_digits(factor.value * factor.value * lamp.power);
  return lamp;
}

scene::Camera scaled(scene::Camera camera, Factor factor) {
  camera.place = scaled(std::move(camera.place), factor);
  if (auto* at = std::get_if<scene::Place>(&camera.look_at.value)) *at = scaled(std::move(*at), factor);
  if (camera.eye_separation) *camera.eye_separation *= factor;
  if (!camera.lens) return camera;
  camera.lens->radius *= factor;
  std::visit(Overload{[&](double& distance) { distance *= factor; }, [](scene::LookAtObject&) {},
                      [&](scene::Place& at) { at = scaled(std::move(at), factor); }},
             camera.lens->focus.value);
  return camera;
}

// ---- the room and its eye ----------------------------------------------------------------------------------------------------

room::Room scaled(room::Room room, double factor) {
  for (room::Corner& corner : room.corners) corner.at = scaled(corner.at, factor);
  for (room::Wall& wall : room.walls) {
    wall.line.w *= factor;
    wall.start = scaled(wall.start, factor);
    wall.length *= factor;
  }
  for (geometry::Point& p : room.outline) p = scaled(p, factor);
  for (double* length : {&room.inradius, &room.circumradius, &room.certificate.closure_residual, &room.certificate.side_residual})
    *length *= factor;
  for (double* area : {&room.area, &room.certificate.area_residual}) *area *= factor * factor;
  return room;
}

place::Camera scaled(place::Camera eye, double factor) {
  eye.room_from_eye = scaled(eye.room_from_eye, factor);
  eye.z *= factor;
  eye.eye_separation *= factor;
  if (eye.lens) eye.lens = place::ThinLens{factor * eye.lens->radius, factor * eye.lens->focus_distance};
  return eye;
}

}  // namespace

double unit_of_length(const scene::Scene& scene) {
  const auto space = notation::classify(scene.orbifold);
  const double scale = scene.room.shape.scale;
  const bool refused = !(scale >= room::kMinScale && scale <= room::kMaxScale);  // `realise` says so
  return space && *space == geometry::Space::euclidean && !refused ? kCompiledScale / scale : 1;
}

scene::Scene in_compiled_unit(scene::Scene scene, double unit) {
  if (unit == 1) return scene;
  const Factor factor{unit};
  scene.room = scaled(std::move(scene.room), factor);
  scene.room.shape.scale = kCompiledScale;
  for (scene::Object& object : scene.objects) object = scaled(std::move(object), factor);
  for (scene::Lamp& lamp : scene.lamps) lamp = scaled(std::move(lamp), factor);
  scene.camera = scaled(std::move(scene.camera), factor);
  return scene;
}

Product in_author_unit(Product product, double unit) {
  if (unit == 1) return product;
  const double factor = 1 / unit;
  product.eye = scaled(product.eye, factor);
  const auto small = static_cast<float>(factor);
  for (auto& p : product.positions) p = {small * p[0], small * p[1], small * p[2]};
  for (ProductCopy& copy : product.copies) copy.distance *= factor;
  if (!product.native) return product;
  for (native_lights::NativeLamp& lamp : product.native->lamps) {
    for (geometry::Vector3* v : {&lamp.at, &lamp.half_u, &lamp.half_v}) *v = factor * *v;
    if (lamp.inverse_square) lamp.intensity = factor * factor * lamp.intensity;
  }
  return product;
}

Tiling in_author_unit(Tiling tiling, double unit) {
  if (unit == 1) return tiling;
  const double factor = 1 / unit;
  tiling.room = scaled(std::move(tiling.room), factor);
  for (cover::Copy& copy : tiling.copies) {
    copy.cover_from_room = scaled(copy.cover_from_room, factor);
    copy.storey.offset *= factor;
    for (cover::HeightBound& bound : copy.height_bounds) {
      bound.line.w *= factor;
      bound.z *= factor;
    }
  }
  tiling.room_from_eye = scaled(tiling.room_from_eye, factor);
  return tiling;
}

render::Film in_author_unit(render::Film film, double unit) {
  if (unit == 1) return film;
  const auto factor = static_cast<float>(1 / unit);
  for (float& depth : film.depth) depth *= factor;
  return film;
}

}  // namespace orbc::driver
