#include "compiler/light/leg.h"

#include <algorithm>
#include <cmath>

namespace orbc::light {
namespace {

using scene::Color;

constexpr int kMostObjects = 16;    // mirror and glass objects on a leg

// Share of light that a boundary of relative index `eta` (to / from) reflects, and the cosine of the refracted ray; 1 at total reflection.
double fresnel(double cosine, double eta, double& refracted) {
  const double sine2 = (1 - cosine * cosine) / (eta * eta);
  if (sine2 >= 1) return 1;
  refracted = std::sqrt(1 - sine2);
  const double parallel = (eta * cosine - refracted) / (eta * cosine + refracted);
  const double across = (cosine - eta * refracted) / (cosine + eta * refracted);
  return (parallel * parallel + across * across) / 2;
}

double cosine_at(const trace::TraceScene& scene, const trace::SurfacePoint& point) {
  return std::clamp(-trace::inner(scene.room->room.space, point.arriving, point.normal), 0.0, 1.0);
}

trace::Ray through_glass(Leg& leg, trace::SurfacePoint point, const scene::Material& material) {
  const Refraction glass = refracted(leg.field.scene, point, material.index);
  if (leg.random.next() < glass.reflectance) return trace::leave(leg.field.scene, point, mirrored(leg.field.scene, point));
  if (point.outside) leg.weight = leg.weight * surface_color(leg.room, point);
  point.normal = -point.normal;
  return trace::leave(leg.field.scene, point, glass.direction);
}

}  // namespace

Color surface_color(const place::PlacedRoom& room, const trace::SurfacePoint& point) {
  SurfaceKey key;
  key.look = point.look, key.color = point.color;
  key.uv[0] = point.uv[0], key.uv[1] = point.uv[1];
  if (point.part >= 0) set_solid(room, room.parts[static_cast<std::size_t>(point.part)], point.at, point.pattern_position, key);
  return surface_albedo(room, key);
}

trace::Direction mirrored(const trace::TraceScene& scene, const trace::SurfacePoint& point) {
  return point.arriving + (2 * cosine_at(scene, point)) * point.normal;
}

Refraction refracted(const trace::TraceScene& scene, const trace::SurfacePoint& point, double index) {
  const double eta = point.outside ? index : 1 / index, cosine = cosine_at(scene, point);
  double onward = 0;
  Refraction result;
  result.reflectance = fresnel(cosine, eta, onward);
  result.direction = (1 / eta) * point.arriving + (cosine / eta - onward) * point.normal;
  return result;
}

trace::FollowOptions Leg::follow_options() const {
  trace::FollowOptions follow;
  follow.max_bounces = field.options.leg_bounces;
  follow.min_weight = field.options.leg_min_weight;
  return follow;
}

bool Leg::arrive(const trace::Ray& ray) { return arrive(trace::follow(field.scene, ray, follow_options())); }

bool Leg::arrive(trace::Path path) {
  for (int objects = 0; objects <= kMostObjects; ++objects) {
    sum = sum + weight * path.glow;
    if (path.cut_off || path.hit.target == trace::Target::nothing) {
      sum = sum + weight * field.options.background;
      return false;
    }
    weight = weight * path.weight;
    hit = path.hit;
    point = trace::surface_at(field.scene, path.last, hit);
    const scene::Material* material = point.look >= 0 ? &room.looks[static_cast<std::size_t>(point.look)].material : nullptr;
    if (!material) return true;
    if (material->kind == scene::MaterialKind::emissive) {
      sum = sum + material->emission * (weight * surface_color(room, point));
      return false;
    }
    const bool mirror = material->kind == scene::MaterialKind::mirror;
    if (!mirror && material->kind != scene::MaterialKind::glass) return true;
    if (mirror) weight = weight * surface_color(room, point);
    const trace::Ray ray = mirror ? trace::leave(field.scene, point, mirrored(field.scene, point)) : through_glass(*this, point, *material);
    trace::FollowOptions follow = follow_options();
    follow.bounces = path.bounces;
    path = trace::follow(field.scene, ray, follow);
  }
  return false;
}

}  // namespace orbc::light
