#include "compiler/light/leg.h"

namespace orbc::light {
namespace {

using scene::Color;

constexpr int kMostObjects = 16;  // mirror and glass objects on a leg

trace::Ray through_glass(Leg& leg, trace::SurfacePoint point, const scene::Material& material) {
  const surface::Refraction glass = surface::refracted(leg.field.scene, point, material.index);
  if (leg.random.next() < glass.reflectance) return trace::leave(leg.field.scene, point, surface::mirrored(leg.field.scene, point));
  if (point.outside) leg.weight = leg.weight * surface::surface_color(leg.room, point);
  point.normal = -point.normal;
  return trace::leave(leg.field.scene, point, glass.direction);
}

}  // namespace

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
      sum = sum + material->emission * (weight * surface::surface_color(room, point));
      return false;
    }
    const bool mirror = material->kind == scene::MaterialKind::mirror;
    if (!mirror && material->kind != scene::MaterialKind::glass) return true;
    if (mirror) weight = weight * surface::surface_color(room, point);
    const trace::Ray ray =
        mirror ? trace::leave(field.scene, point, surface::mirrored(field.scene, point)) : through_glass(*this, point, *material);
    trace::FollowOptions follow = follow_options();
    follow.bounces = path.bounces;
    path = trace::follow(field.scene, ray, follow);
  }
  return false;
}

}  // namespace orbc::light
