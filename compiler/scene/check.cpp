#include "compiler/scene/check.h"

#include <fmt/format.h>

#include <cmath>

#include "compiler/scene/defaults.h"
#include "compiler/scene/values.h"

namespace orbc::scene {
namespace {

// No point of a room lies farther from the centre; hyperbolic functions of larger lengths overflow or lose all digits in double.
constexpr double kMaxDistanceHyperbolic = 100;
constexpr double kMaxDistanceSpherical = 3.141592653589793;

class Checker {
 public:
  explicit Checker(const Scene& scene) : scene_(scene), curvature_(curvature_sign(scene.orbifold)) {}

  Diagnostics run() {
    check_walls();
    for (const Object& object : scene_.objects) check_object(object);
    for (const Lamp& lamp : scene_.lamps) {
      check_place(lamp.place);
      if (lamp.to) check_place(*lamp.to);
    }
    check_camera();
    return std::move(diagnostics_);
  }

 private:
  void error(const char* code, std::string message, std::string hint, const SourceSpan& span) {
    diagnostics_.push_back(make_error(code, std::move(message), std::move(hint), span));
  }

  void check_walls() {
    const int walls = wall_count(scene_.orbifold);
    if (static_cast<int>(scene_.room.walls.size()) != walls)
      error("scene.wall-count", fmt::format("the room has {} walls, but {} are furnished", walls, scene_.room.walls.size()), "",
            scene_.room.span);
  }

  void check_object(const Object& object) {
    if (const auto* beam = std::get_if<BarSpec>(&object.shape)) {
      check_place(beam->from);
      check_place(beam->to);
    } else {
      check_place(object.place);
    }
  }

  void check_distance(double distance, const SourceSpan& span) {
    const double farthest = curvature_ < 0 ? kMaxDistanceHyperbolic : kMaxDistanceSpherical;
    if (curvature_ != 0 && distance > farthest)
      error("scene.outside-space", fmt::format("the distance {} is too large: lengths are measured in curvature radii here", distance),
            fmt::format("at most {} in this space; `orbc info` prints how large the room is", curvature_ < 0 ? "100" : "π"), span);
  }

  void check_place(const Place& place) {
    if (const auto* disk = std::get_if<AtDisk>(&place.floor); disk && curvature_ < 0 && std::norm(disk->z) >= 1)
      error("scene.outside-space", "this point lies outside the hyperbolic plane: its disk has radius 1", "x² + y² must be less than 1",
            place.span);
    if (const auto* polar = std::get_if<AtPolar>(&place.floor)) check_distance(polar->r, place.span);
    if (const auto* xy = std::get_if<AtXy>(&place.floor))
      for (const double along : {xy->x, xy->y}) check_distance(std::abs(along), place.span);
    if (const auto* toward = std::get_if<AtToward>(&place.floor)) check_distance(toward->distance, place.span);
    if (const auto* walls = std::get_if<AtWalls>(&place.floor))
      for (const double distance : walls->distances) check_distance(distance, place.span);
  }

  void check_camera() {
    const Camera& camera = scene_.camera;
    check_place(camera.place);
    if (const auto* object = std::get_if<LookAtObject>(&camera.look_at.value)) check_named("look_at", object->name, camera.look_at.span);
    if (camera.lens) check_lens(camera.lens->focus);
    if (const auto* target = std::get_if<Place>(&camera.look_at.value)) {
      check_place(*target);
      const bool both_centre = std::holds_alternative<AtCentre>(target->floor) && std::holds_alternative<AtCentre>(camera.place.floor);
      const double eye_z = camera.place.z.value_or(scene_.room.height / 2);
      if (both_centre && target->z.value_or(eye_z) == eye_z)
        error("scene.looks-at-itself", "the camera stands in the point it looks at",
              "move it with `at`, or give a direction: look_at: {azimuth: 0deg, elevation: 0deg}",
              camera.look_at.span.source ? camera.look_at.span : camera.span);
    }
    const double ratio = static_cast<double>(camera.size[0]) / camera.size[1];
    if (camera.projection == Projection::panorama && std::abs(ratio - 2) > 0.02)
      diagnostics_.push_back(make_warning(
          "scene.stretched", fmt::format("a panorama shows 360° × 180°; {}×{} pixels stretch it", camera.size[0], camera.size[1]),
          fmt::format("make it twice as wide as high: size: [{0}, {1}], or --size {0}x{1}", 2 * camera.size[1], camera.size[1]),
          camera.size_span));
    if (camera.projection == Projection::stereo && std::abs(ratio - 1) > 0.01)
      diagnostics_.push_back(make_warning(
          "scene.stretched",
          fmt::format("two panoramas of 360° × 180°, one above the other, are a square; {}×{} pixels stretch them", camera.size[0],
                      camera.size[1]),
          fmt::format("make it as wide as high: size: [{0}, {0}], or --size {0}x{0}", std::max(camera.size[0], camera.size[1])),
          camera.size_span));
  }

  void check_lens(const Located<std::variant<double, LookAtObject, Place>>& focus) {
    if (const auto* object = std::get_if<LookAtObject>(&focus.value)) check_named("focus", object->name, focus.span);
    if (const auto* place = std::get_if<Place>(&focus.value)) check_place(*place);
    const auto* distance = std::get_if<double>(&focus.value);
    const double farthest = curvature_ == 0 ? kMaxLength : curvature_ < 0 ? kMaxFocusDistanceHyperbolic : kMaxFocusDistanceSpherical;
    if (distance && *distance > farthest)
      error("scene.outside-space", fmt::format("the focus distance {} is too large for this space", *distance),
            fmt::format("at most {} curvature radii, beyond which no lens can focus here", farthest), focus.span);
  }

  void check_named(const char* key, const std::string& name, const SourceSpan& span) {
    std::vector<std::string> known;
    for (const Object& object : scene_.objects) {
      if (object.name == name) return;
      known.push_back(object.name);
    }
    const std::string nearest = nearest_word(name, known);
    std::string hint = !nearest.empty() ? fmt::format("did you mean `{}`?", nearest)
                       : !known.empty()
                           ? "objects have the name of `name`, of their mesh file or of their kind; here is " + known.front()
                           : "this scene has no objects; a place is {polar: [r, 30deg]}, a direction {azimuth: 30deg, elevation: 0deg}";
    error("scene.unknown-object", fmt::format("`{}` names no object of this scene: \"{}\"", key, name.substr(0, 200)), std::move(hint),
          span);
  }

  const Scene& scene_;
  int curvature_;
  Diagnostics diagnostics_;
};

}  // namespace

int curvature_sign(const notation::Orbifold& orbifold) {
  if (orbifold.strip) return 0;
  Rational chi = 1 - Rational(static_cast<int>(orbifold.corners.size()), 2);
  for (const Rational& k : orbifold.corners) chi += 1 / (2 * k);
  return chi > 0 ? 1 : chi < 0 ? -1 : 0;
}

Diagnostics check(const Scene& scene) { return Checker(scene).run(); }

}  // namespace orbc::scene
