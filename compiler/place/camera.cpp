#include "compiler/place/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "compiler/geometry/predicates.h"
#include "compiler/place/locate.h"
#include "compiler/place/interior.h"
#include "compiler/scene/check.h"

namespace orbc::place {
namespace {

using geometry::Ambient;
using geometry::Containment;
using geometry::Point;
using geometry::Position;
using geometry::Side;
using geometry::Vector3;
using scene::Projection;

constexpr double kPi = std::numbers::pi;

// ---- position of the eye ---------------------------------------------------------------------------------------------------

// The side of X. If X lies exactly on the line, the side of X moved by the same infinitesimal amount for all lines, so that of two
// triangles that share an edge exactly one contains X (simulation of simplicity, Edelsbrunner and Mücke 1990).
Side perturbed_side_of(const Ambient& p, const Ambient& q, const Ambient& x) {
  Side side = geometry::side_of(p, q, x);
  if (side == Side::on) side = geometry::side_of(p, q, {0, 1, 0});
  if (side == Side::on) side = geometry::side_of(p, q, {0, 0, 1});
  if (side == Side::on) side = geometry::side_of(p, q, {1, 0, 0});
  return side;
}

double determinant(const Ambient& a, const Ambient& b, const Ambient& c) {
  return a.w * (b.x * c.y - b.y * c.x) - a.x * (b.w * c.y - b.y * c.w) + a.y * (b.w * c.x - b.x * c.w);
}

// Whether the vertical line through the position meets an odd number of triangles above it, and an odd number below. Frames are open where
// they touch walls, floor and ceiling; there the nearest faces decide, whose front sides are turned away from a position inside.
bool is_inside(const PlacedMesh& mesh, const Position& at) {
  bool above = false, below = false;
  struct Face {
    double z;
    bool up;
  };
  std::optional<Face> ceiling, floor;
  for (const mesh::Triangle& t : mesh.triangles) {
    const Point &p = mesh.floor[t[0]], &q = mesh.floor[t[1]], &r = mesh.floor[t[2]], &x = at.floor;
    const Side side = perturbed_side_of(p, q, x);
    if (side == Side::on || perturbed_side_of(q, r, x) != side || perturbed_side_of(r, p, x) != side) continue;
    // On S² the cone of the triangle and the opposite cone both pass the test; weights are positive in the triangle's own cone.
    const double a = determinant(q, r, x), b = determinant(r, p, x), c = determinant(p, q, x), sum = a + b + c,
                 whole = determinant(p, q, r);
    if (!(sum * whole > 0)) continue;
    const double z = (a * mesh.z[t[0]] + b * mesh.z[t[1]] + c * mesh.z[t[2]]) / sum;
    (z >= at.z ? above : below) ^= true;
    if (z >= at.z && (!ceiling || z < ceiling->z)) ceiling = Face{z, whole > 0};
    if (z < at.z && (!floor || z > floor->z)) floor = Face{z, whole > 0};
  }
  if (mesh.kind == PartKind::frame) return (ceiling || floor) && (!ceiling || ceiling->up) && (!floor || !floor->up);
  return above && below;
}

Diagnostics placement_error(const Interior& interior, const Position& at, const SourceSpan& span) {
  if (geometry::contains(interior.polygon.outline, at.floor) == Containment::on_border)
    return {make_error("place.eye-in-wall", fmt::format("the eye stands exactly in wall {}", overhang(interior.polygon, at.floor).wall + 1),
                       "move it into the room", span)};
  if (!(at.z > 0) || !(at.z < interior.height))
    return {make_error("place.eye-outside-room", fmt::format("the eye is not between floor and ceiling: its height is {}", to_text(at.z)),
                       fmt::format("the room is {} high", to_text(interior.height)), span)};
  if (const PlacedMesh* around = enclosing_object(interior, at))
    return {
        make_error("place.eye-inside-object", fmt::format("the eye stands inside {}", around->name), "move the eye or the object", span)};
  return {};
}

// ---- direction of view ---------------------------------------------------------------------------------------------------------

Result<Position> centre_of(const Interior& interior, const std::string& name, const SourceSpan& span) {
  std::vector<std::string> known;
  for (const PlacedMesh& part : interior.parts) {
    if (part.kind != PartKind::object) continue;
    known.push_back(part.name);
    if (part.name != name) continue;
    // The bounding box in the log chart about the mean of the vertices.
    Ambient sum{0, 0, 0};
    for (const Point& p : part.floor) sum = sum + p;
    const geometry::Isometry room_from_box =
        geometry::translation_to(interior.polygon.space, geometry::normalised_point(interior.polygon.space, sum));
    const geometry::Isometry box_from_room = geometry::inverse(room_from_box);
    Vector3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (std::size_t i = 0; i < part.floor.size(); ++i) {
      const std::complex<double> p = geometry::log_from_point(interior.polygon.space, box_from_room * part.floor[i]);
      low = {std::fmin(low.x, p.real()), std::fmin(low.y, p.imag()), std::fmin(low.z, part.z[i])};
      high = {std::fmax(high.x, p.real()), std::fmax(high.y, p.imag()), std::fmax(high.z, part.z[i])};
    }
    const Vector3 middle = 0.5 * (low + high);
    return Position{room_from_box * geometry::point_from_log(interior.polygon.space, {middle.x, middle.y}), middle.z};
  }
  const std::string nearest = nearest_word(name, known);
  return make_error("place.no-such-object", fmt::format("there is no object `{}` to look at", name),
                    nearest.empty() ? "" : fmt::format("did you mean `{}`?", nearest), span);
}

Vector3 log_vector_to(const geometry::Isometry& room_from_eye, double eye_z, const Position& target) {
  const std::complex<double> p = geometry::log_from_point(room_from_eye.space, geometry::inverse(room_from_eye) * target.floor);
  return {p.real(), p.imag(), target.z - eye_z};
}

// Sets the camera's axes. A vertical direction takes its azimuth from `azimuth_if_vertical`. Panoramas and cylinders keep their horizon
// level: in a tilted one, every vertical line would be a wave.
void aim_along(Camera& camera, Vector3 direction, double azimuth_if_vertical) {
  if (camera.projection != scene::Projection::perspective) {
    direction.z = 0;
    if (math::hypot(direction.x, direction.y) < 1e-12) direction = {math::cos(azimuth_if_vertical), math::sin(azimuth_if_vertical), 0};
  }
  camera.forward = geometry::normalised(direction);
  const double flat = math::hypot(camera.forward.x, camera.forward.y);
  if (flat > 1e-12) {
    camera.right = {camera.forward.y / flat, -camera.forward.x / flat, 0};
  } else {
    camera.forward = {0, 0, direction.z > 0 ? 1.0 : -1.0};
    camera.right = {math::sin(azimuth_if_vertical), -math::cos(azimuth_if_vertical), 0};
  }
  camera.up = geometry::cross(camera.right, camera.forward);
}

// The default target: the centre of the room; from there, the middle of the longest wall.
Vector3 default_direction(const Interior& interior, const Camera& camera) {
  const Vector3 to_centre = log_vector_to(camera.room_from_eye, camera.z, {Point{}, camera.z});
  if (geometry::length(to_centre) > 1e-9 || interior.polygon.walls.empty()) return to_centre;
  std::size_t longest = 0;
  for (std::size_t i = 1; i < interior.polygon.walls.size(); ++i)
    if (interior.polygon.walls[i].length > interior.polygon.walls[longest].length * (1 + 1e-9)) longest = i;
  return log_vector_to(camera.room_from_eye, camera.z,
                 {room::point_on_wall(interior.polygon, static_cast<int>(longest), interior.polygon.walls[longest].length / 2), camera.z});
}

Result<Vector3> direction_of(const scene::Camera& spec, const Interior& interior, const Camera& camera) {
  const auto& look_at = spec.look_at;
  if (const auto* direction = std::get_if<scene::LookDirection>(&look_at.value)) {
    const double a = direction->azimuth.radians, e = direction->elevation.radians;
    return Vector3{math::cos(e) * math::cos(a), math::cos(e) * math::sin(a), math::sin(e)};
  }
  Position target{Point{}, camera.z};
  if (const auto* object = std::get_if<scene::LookAtObject>(&look_at.value)) {
    if (object->name.empty()) return default_direction(interior, camera);
    Result<Position> centre = centre_of(interior, object->name, look_at.span);
    if (!centre) return std::move(centre).error();
    target = *centre;
  } else {
    const auto& place = std::get<scene::Place>(look_at.value);
    if (std::holds_alternative<scene::AtCentre>(place.floor) && !place.z && !look_at.span.source)
      return default_direction(interior, camera);
    Result<Position> there = locate(place, interior.polygon, interior.height, camera.z);
    if (!there) return located(std::move(there).error(), look_at.span);
    target = *there;
  }
  const Vector3 direction = log_vector_to(camera.room_from_eye, camera.z, target);
  if (!(geometry::length(direction) > 1e-12))
    return make_error("place.looks-at-itself", "the camera looks at the point where it stands", "move it, or give another `look_at`",
                      look_at.span);
  return direction;
}

// ---- lens ---------------------------------------------------------------------------------------------------------------

/// Rolls the camera clockwise as seen from behind: `right` turns downwards.
void roll(Camera& camera, double radians) {
  if (camera.projection != Projection::perspective || radians == 0) return;
  const Vector3 right = camera.right, up = camera.up;
  camera.right = math::cos(radians) * right - math::sin(radians) * up;
  camera.up = math::sin(radians) * right + math::cos(radians) * up;
}

Result<double> focus_distance(const scene::Lens& lens, const Interior& interior, const Camera& camera) {
  const auto& focus = lens.focus;
  if (const auto* distance = std::get_if<double>(&focus.value)) return *distance;
  Position target;
  if (const auto* object = std::get_if<scene::LookAtObject>(&focus.value)) {
    Result<Position> centre = centre_of(interior, object->name, focus.span);
    if (!centre) return std::move(centre).error();
    target = *centre;
  } else {
    Result<Position> there = locate(std::get<scene::Place>(focus.value), interior.polygon, interior.height, camera.z);
    if (!there) return located(std::move(there).error(), focus.span);
    target = *there;
  }
  return geometry::length(log_vector_to(camera.room_from_eye, camera.z, target));
}

/// The name of what the lens touches, or "".
std::string lens_obstacle(const Interior& interior, const Camera& camera, double radius) {
  const Position middle{camera.room_from_eye * Point{}, camera.z};
  const Overhang nearest = overhang(interior.polygon, middle.floor);
  if (-nearest.distance <= radius) return fmt::format("wall {}", nearest.wall + 1);
  if (camera.z <= radius) return "the floor";
  if (interior.height - camera.z <= radius) return "the ceiling";
  constexpr int kRimPoints = 16;
  for (int i = 0; i < kRimPoints; ++i) {
    const double a = 2 * kPi * i / kRimPoints;
    const Vector3 p = radius * (math::cos(a) * camera.right + math::sin(a) * camera.up);
    const Position rim{camera.room_from_eye * geometry::point_from_log(camera.room_from_eye.space, {p.x, p.y}), camera.z + p.z};
    if (const PlacedMesh* around = enclosing_object(interior, rim)) return around->name;
  }
  return "";
}

Result<ThinLens> make_lens(const scene::Lens& lens, const Interior& interior, const Camera& camera) {
  if (const std::string what = lens_obstacle(interior, camera, lens.radius); !what.empty())
    return make_error("place.lens-too-large", fmt::format("the lens, {} in radius, reaches into {}", to_text(lens.radius), what),
                      "give it a smaller `radius`, or move the camera", lens.radius_span);
  Result<double> distance = focus_distance(lens, interior, camera);
  if (!distance) return std::move(distance).error();
  const geometry::Space space = interior.polygon.space;
  const double farthest = space == geometry::Space::spherical    ? scene::kMaxFocusDistanceSpherical
                          : space == geometry::Space::hyperbolic ? scene::kMaxFocusDistanceHyperbolic
                                                                 : 1e15;
  if (!(*distance > 0) || !(*distance <= farthest))
    return make_error("place.lens-focus", fmt::format("the lens cannot focus on what is {} from the eye", to_text(*distance)),
                      *distance > 0 ? fmt::format("at most {} curvature radii", farthest) : "focus on what lies before the eye",
                      lens.focus.span);
  return ThinLens{lens.radius, *distance};
}

// ---- stereo -------------------------------------------------------------------------------------------------------------

/// The triangles of a part below or above a disk about a point of the floor, and possibly more.
PlacedMesh near_part(const geometry::Space space, const PlacedMesh& part, const Point& centre, double radius) {
  constexpr double kSlack = 1e-6;
  PlacedMesh near;
  near.kind = part.kind;
  near.name = part.name;
  near.floor = part.floor;
  near.z = part.z;
  for (const mesh::Triangle& t : part.triangles) {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::fmax(longest, geometry::distance(space, part.floor[t[i]], part.floor[t[(i + 1) % 3]]));
    // No point of a triangle is farther from a corner than its longest edge.
    if (geometry::distance(space, centre, part.floor[t[0]]) <= radius + longest + kSlack) near.triangles.push_back(t);
  }
  return near;
}

/// What an eye of the stereo panorama would stand in, or "".
std::string stereo_obstacle(const Interior& interior, const Camera& camera) {
  const double radius = camera.eye_separation / 2;
  const geometry::Space space = interior.polygon.space;
  const Point middle = camera.room_from_eye * Point{};
  if (!interior.polygon.walls.empty())
    if (const Overhang nearest = overhang(interior.polygon, middle); -nearest.distance <= radius)
      return fmt::format("wall {}", nearest.wall + 1);
  std::vector<Position> eyes;
  for (int x = 0; x < camera.width; ++x) {
    const Vector3 p = eye_offset(camera, x + 0.5, 0);
    eyes.push_back({camera.room_from_eye * geometry::point_from_log(space, {p.x, p.y}), camera.z});
    const Vector3 q = -1.0 * p;
    eyes.push_back({camera.room_from_eye * geometry::point_from_log(space, {q.x, q.y}), camera.z});
  }
  for (const PlacedMesh& part : interior.parts) {
    if (part.kind != PartKind::object && part.kind != PartKind::frame) continue;
    const PlacedMesh near = near_part(space, part, middle, radius);
    if (near.triangles.empty()) continue;
    for (const Position& eye : eyes)
      if (is_inside(near, eye)) return part.name;
  }
  return "";
}

Diagnostics stereo_error(const scene::Camera& spec, const Interior& interior, const Camera& camera) {
  const std::string what = stereo_obstacle(interior, camera);
  if (what.empty()) return {};
  return {
      make_error("place.stereo-eye",
                 fmt::format("an eye of the stereo panorama, half of `eye_separation` beside the camera's place, would stand in {}", what),
                 "give the camera a smaller `eye_separation`, or move it", spec.eye_separation ? spec.eye_separation_span : spec.span)};
}

bool is_upper(const Camera& camera, double y) { return y < camera.height / 2.0; }

}  // namespace

Vector3 eye_offset(const Camera& camera, double x, double y) {
  if (camera.projection != Projection::stereo) return {0, 0, 0};
  const double azimuth = kPi * (2 * x / camera.width - 1), to_the_right = (is_upper(camera, y) ? -0.5 : 0.5) * camera.eye_separation;
  return to_the_right * (math::cos(azimuth) * camera.right - math::sin(azimuth) * camera.forward);
}

Vector3 direction_through(const Camera& camera, double x, double y) {
  const double u = 2 * x / camera.width - 1, v = 1 - 2 * y / camera.height, aspect = static_cast<double>(camera.height) / camera.width;
  if (camera.projection == Projection::perspective) {
    const double t = math::tan(camera.fov.radians / 2);
    return geometry::normalised(camera.forward + (u * t) * camera.right + (v * aspect * t) * camera.up);
  }
  if (camera.projection == Projection::panorama || camera.projection == Projection::stereo) {
    const double rows = camera.height / 2.0;
    const double a = kPi * u,
                 e = kPi / 2 * (camera.projection == Projection::panorama ? v : 1 - 2 * (is_upper(camera, y) ? y : y - rows) / rows);
    return (math::cos(e) * math::cos(a)) * camera.forward + (math::cos(e) * math::sin(a)) * camera.right + math::sin(e) * camera.up;
  }
  const double a = camera.fov.radians / 2 * u, height = v * aspect * camera.fov.radians / 2;
  return geometry::normalised(math::cos(a) * camera.forward + math::sin(a) * camera.right + height * camera.up);
}

std::optional<std::array<double, 2>> pixel_of(const Camera& camera, const Vector3& direction) {
  const double f = dot(direction, camera.forward), r = dot(direction, camera.right), u = dot(direction, camera.up);
  const double w = camera.width, h = camera.height;
  if (camera.projection == Projection::perspective) {
    if (!(f > 0)) return std::nullopt;
    const double t = math::tan(camera.fov.radians / 2) * f;
    return std::array<double, 2>{w / 2 * (1 + r / t), h / 2 - w / 2 * u / t};
  }
  const double azimuth = math::atan2(r, f), flat = math::hypot(r, f);
  if (camera.projection == Projection::panorama)
    return std::array<double, 2>{w * (azimuth / (2 * kPi) + 0.5), h * (0.5 - math::atan2(u, flat) / kPi)};
  if (camera.projection == Projection::stereo)
    return std::array<double, 2>{w * (azimuth / (2 * kPi) + 0.5), h / 2 * (0.5 - math::atan2(u, flat) / kPi)};
  if (!(flat > 0)) return std::nullopt;
  return std::array<double, 2>{w * (azimuth / camera.fov.radians + 0.5), h / 2 - w * (u / flat) / camera.fov.radians};
}

double pixels_per_radian(const Camera& camera) {
  if (camera.projection == Projection::perspective) return camera.width / 2.0 / math::tan(camera.fov.radians / 2);
  return camera.width / (camera.projection == Projection::cylinder ? camera.fov.radians : 2 * kPi);
}

const PlacedMesh* enclosing_object(const Interior& interior, const Position& at) {
  for (const PlacedMesh& part : interior.parts)
    if ((part.kind == PartKind::object || part.kind == PartKind::frame) && is_inside(part, at)) return &part;
  return nullptr;
}

Result<Camera> make_camera(const scene::Scene& scene, const Interior& interior) {
  const scene::Camera& spec = scene.camera;
  const SourceSpan& span = spec.place.span.source ? spec.place.span : spec.span;
  Result<Position> at = locate(spec.place, interior.polygon, interior.height, interior.height / 2);
  if (!at) {
    Diagnostics errors = located(std::move(at).error(), span);
    for (Diagnostic& error : errors)
      if (error.code == "place.outside-room") error.code = "place.eye-outside-room";
    return errors;
  }
  Diagnostics wrong = placement_error(interior, *at, span);
  if (has_error(wrong)) return wrong;
  Camera camera;
  camera.room_from_eye = geometry::translation_to(interior.polygon.space, at->floor);
  camera.z = at->z;
  camera.projection = spec.projection;
  camera.fov = spec.fov;
  camera.width = spec.size[0];
  camera.height = spec.size[1];
  Result<Vector3> direction = direction_of(spec, interior, camera);
  if (!direction) return std::move(direction).error();
  const auto* angles = std::get_if<scene::LookDirection>(&spec.look_at.value);
  aim_along(camera, *direction, angles ? angles->azimuth.radians : 0);
  roll(camera, spec.roll.radians);
  if (spec.lens && camera.projection == Projection::perspective) {
    Result<ThinLens> lens = make_lens(*spec.lens, interior, camera);
    if (!lens) return std::move(lens).error();
    camera.lens = *lens;
  }
  if (camera.projection == Projection::stereo) {
    camera.eye_separation = spec.eye_separation.value_or(scene::kEyeSeparation * interior.height);
    if (Diagnostics errors = stereo_error(spec, interior, camera); !errors.empty()) return errors;
  }
  return camera;
}

}  // namespace orbc::place
