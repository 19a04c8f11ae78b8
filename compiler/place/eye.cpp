#include "compiler/place/eye.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "compiler/geometry/predicates.h"
#include "compiler/place/locate.h"
#include "compiler/place/placed.h"
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

// ---- where the eye stands ---------------------------------------------------------------------------------------------------

// The side of X, or, where it lies exactly on the line, the side of a point moved an infinitesimal way, the same way for all lines: of two
// triangles that share an edge exactly one holds it (simulation of simplicity, Edelsbrunner and Mücke 1990).
Side side_of_moved(const Ambient& p, const Ambient& q, const Ambient& x) {
  Side side = geometry::side_of(p, q, x);
  if (side == Side::on) side = geometry::side_of(p, q, {0, 1, 0});
  if (side == Side::on) side = geometry::side_of(p, q, {0, 0, 1});
  if (side == Side::on) side = geometry::side_of(p, q, {1, 0, 0});
  return side;
}

double determinant(const Ambient& a, const Ambient& b, const Ambient& c) {
  return a.w * (b.x * c.y - b.y * c.x) - a.x * (b.w * c.y - b.y * c.w) + a.y * (b.w * c.x - b.x * c.w);
}

// Whether the vertical line through the eye meets an odd number of triangles above it, and an odd number below. Frames are open where they
// touch walls, floor and ceiling: there the nearest faces tell, which turn away from an eye that is inside.
bool is_inside(const PlacedMesh& mesh, const Position& eye) {
  bool above = false, below = false;
  struct Face {
    double z;
    bool up;
  };
  std::optional<Face> ceiling, floor;
  for (const mesh::Triangle& t : mesh.triangles) {
    const Point &p = mesh.floor[t[0]], &q = mesh.floor[t[1]], &r = mesh.floor[t[2]], &x = eye.floor;
    const Side side = side_of_moved(p, q, x);
    if (side == Side::on || side_of_moved(q, r, x) != side || side_of_moved(r, p, x) != side) continue;
    // On S² the cone of the triangle and its opposite both pass the test; the eye's is the one with positive weights.
    const double a = determinant(q, r, x), b = determinant(r, p, x), c = determinant(p, q, x), sum = a + b + c,
                 whole = determinant(p, q, r);
    if (!(sum * whole > 0)) continue;
    const double z = (a * mesh.z[t[0]] + b * mesh.z[t[1]] + c * mesh.z[t[2]]) / sum;
    (z >= eye.z ? above : below) ^= true;
    if (z >= eye.z && (!ceiling || z < ceiling->z)) ceiling = Face{z, whole > 0};
    if (z < eye.z && (!floor || z > floor->z)) floor = Face{z, whole > 0};
  }
  if (mesh.kind == PartKind::frame) return (ceiling || floor) && (!ceiling || ceiling->up) && (!floor || !floor->up);
  return above && below;
}

Diagnostics wrong_place(const PlacedRoom& placed, const Position& eye, const SourceSpan& span) {
  if (geometry::contains(placed.room.outline, eye.floor) == Containment::on_border)
    return {make_error("place.eye-in-wall", fmt::format("the eye stands exactly in wall {}", overhang(placed.room, eye.floor).wall + 1),
                       "move it into the room", span)};
  if (!(eye.z > 0) || !(eye.z < placed.height))
    return {make_error("place.eye-outside-room", fmt::format("the eye is not between floor and ceiling: its height is {}", to_text(eye.z)),
                       fmt::format("the room is {} high", to_text(placed.height)), span)};
  if (const PlacedMesh* around = object_around(placed, eye))
    return {
        make_error("place.eye-inside-object", fmt::format("the eye stands inside {}", around->name), "move the eye or the object", span)};
  return {};
}

// ---- where it looks ---------------------------------------------------------------------------------------------------------

Result<Position> centre_of(const PlacedRoom& placed, const std::string& name, const SourceSpan& span) {
  std::vector<std::string> known;
  for (const PlacedMesh& part : placed.parts) {
    if (part.kind != PartKind::object) continue;
    known.push_back(part.name);
    if (part.name != name) continue;
    // The bounding box in the log chart about the mean of the vertices.
    Ambient sum{0, 0, 0};
    for (const Point& p : part.floor) sum = sum + p;
    const geometry::Isometry room_from_box =
        geometry::translation_to(placed.room.space, geometry::normalised_point(placed.room.space, sum));
    const geometry::Isometry box_from_room = geometry::inverse(room_from_box);
    Vector3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (std::size_t i = 0; i < part.floor.size(); ++i) {
      const std::complex<double> p = geometry::log_from_point(placed.room.space, box_from_room * part.floor[i]);
      low = {std::fmin(low.x, p.real()), std::fmin(low.y, p.imag()), std::fmin(low.z, part.z[i])};
      high = {std::fmax(high.x, p.real()), std::fmax(high.y, p.imag()), std::fmax(high.z, part.z[i])};
    }
    const Vector3 middle = 0.5 * (low + high);
    return Position{room_from_box * geometry::point_from_log(placed.room.space, {middle.x, middle.y}), middle.z};
  }
  const std::string nearest = nearest_word(name, known);
  return make_error("place.no-such-object", fmt::format("there is no object `{}` to look at", name),
                    nearest.empty() ? "" : fmt::format("did you mean `{}`?", nearest), span);
}

Vector3 towards(const geometry::Isometry& room_from_eye, double eye_z, const Position& target) {
  const std::complex<double> p = geometry::log_from_point(room_from_eye.space, geometry::inverse(room_from_eye) * target.floor);
  return {p.real(), p.imag(), target.z - eye_z};
}

// Sets the camera's axes; looking straight up or down keeps the azimuth 0 for what is right. A picture all around stays upright, with its
// horizon level, whatever it looks at: tilted, every vertical beam would be a wave.
void look_along(Eye& eye, Vector3 direction, double azimuth_if_vertical) {
  if (eye.projection != scene::Projection::perspective) {
    direction.z = 0;
    if (math::hypot(direction.x, direction.y) < 1e-12) direction = {math::cos(azimuth_if_vertical), math::sin(azimuth_if_vertical), 0};
  }
  eye.forward = geometry::normalised(direction);
  const double flat = math::hypot(eye.forward.x, eye.forward.y);
  if (flat > 1e-12) {
    eye.right = {eye.forward.y / flat, -eye.forward.x / flat, 0};
  } else {
    eye.forward = {0, 0, direction.z > 0 ? 1.0 : -1.0};
    eye.right = {math::sin(azimuth_if_vertical), -math::cos(azimuth_if_vertical), 0};
  }
  eye.up = geometry::cross(eye.right, eye.forward);
}

// The default: the centre of the room, or, from there, the middle of the longest wall.
Vector3 default_direction(const PlacedRoom& placed, const Eye& eye) {
  const Vector3 to_centre = towards(eye.room_from_eye, eye.z, {Point{}, eye.z});
  if (geometry::length(to_centre) > 1e-9 || placed.room.walls.empty()) return to_centre;
  std::size_t longest = 0;
  for (std::size_t i = 1; i < placed.room.walls.size(); ++i)
    if (placed.room.walls[i].length > placed.room.walls[longest].length * (1 + 1e-9)) longest = i;
  return towards(eye.room_from_eye, eye.z,
                 {room::point_on_wall(placed.room, static_cast<int>(longest), placed.room.walls[longest].length / 2), eye.z});
}

Result<Vector3> direction_of(const scene::Camera& camera, const PlacedRoom& placed, const Eye& eye) {
  const auto& look_at = camera.look_at;
  if (const auto* direction = std::get_if<scene::LookDirection>(&look_at.value)) {
    const double a = direction->azimuth.radians, e = direction->elevation.radians;
    return Vector3{math::cos(e) * math::cos(a), math::cos(e) * math::sin(a), math::sin(e)};
  }
  Position target{Point{}, eye.z};
  if (const auto* object = std::get_if<scene::LookAtObject>(&look_at.value)) {
    if (object->name.empty()) return default_direction(placed, eye);
    Result<Position> centre = centre_of(placed, object->name, look_at.span);
    if (!centre) return std::move(centre).error();
    target = *centre;
  } else {
    const auto& place = std::get<scene::Place>(look_at.value);
    if (std::holds_alternative<scene::AtCentre>(place.floor) && !place.z && !look_at.span.source) return default_direction(placed, eye);
    Result<Position> there = locate(place, placed.room, placed.height, eye.z);
    if (!there) return located(std::move(there).error(), look_at.span);
    target = *there;
  }
  const Vector3 direction = towards(eye.room_from_eye, eye.z, target);
  if (!(geometry::length(direction) > 1e-12))
    return make_error("place.looks-at-itself", "the camera looks at the point where it stands", "move it, or give another `look_at`",
                      look_at.span);
  return direction;
}

// ---- its lens ---------------------------------------------------------------------------------------------------------------

/// Clockwise as seen from behind: what was right tips down.
void roll(Eye& eye, double radians) {
  if (eye.projection != Projection::perspective || radians == 0) return;
  const Vector3 right = eye.right, up = eye.up;
  eye.right = math::cos(radians) * right - math::sin(radians) * up;
  eye.up = math::sin(radians) * right + math::cos(radians) * up;
}

Result<double> focus_distance(const scene::Lens& lens, const PlacedRoom& placed, const Eye& eye) {
  const auto& focus = lens.focus;
  if (const auto* distance = std::get_if<double>(&focus.value)) return *distance;
  Position target;
  if (const auto* object = std::get_if<scene::LookAtObject>(&focus.value)) {
    Result<Position> centre = centre_of(placed, object->name, focus.span);
    if (!centre) return std::move(centre).error();
    target = *centre;
  } else {
    Result<Position> there = locate(std::get<scene::Place>(focus.value), placed.room, placed.height, eye.z);
    if (!there) return located(std::move(there).error(), focus.span);
    target = *there;
  }
  return geometry::length(towards(eye.room_from_eye, eye.z, target));
}

/// What the lens reaches into, if anything.
std::string in_the_way_of(const PlacedRoom& placed, const Eye& eye, double radius) {
  const Position middle{eye.room_from_eye * Point{}, eye.z};
  const Overhang nearest = overhang(placed.room, middle.floor);
  if (-nearest.distance <= radius) return fmt::format("wall {}", nearest.wall + 1);
  if (eye.z <= radius) return "the floor";
  if (placed.height - eye.z <= radius) return "the ceiling";
  constexpr int kAround = 16;
  for (int i = 0; i < kAround; ++i) {
    const double a = 2 * kPi * i / kAround;
    const Vector3 p = radius * (math::cos(a) * eye.right + math::sin(a) * eye.up);
    const Position rim{eye.room_from_eye * geometry::point_from_log(eye.room_from_eye.space, {p.x, p.y}), eye.z + p.z};
    if (const PlacedMesh* around = object_around(placed, rim)) return around->name;
  }
  return "";
}

Result<EyeLens> make_lens(const scene::Lens& lens, const PlacedRoom& placed, const Eye& eye) {
  if (const std::string what = in_the_way_of(placed, eye, lens.radius); !what.empty())
    return make_error("place.lens-too-large", fmt::format("the lens, {} in radius, reaches into {}", to_text(lens.radius), what),
                      "give it a smaller `radius`, or move the camera", lens.radius_span);
  Result<double> distance = focus_distance(lens, placed, eye);
  if (!distance) return std::move(distance).error();
  const geometry::Space space = placed.room.space;
  const double farthest = space == geometry::Space::spherical    ? scene::kFarthestFocusSpherical
                          : space == geometry::Space::hyperbolic ? scene::kFarthestFocusHyperbolic
                                                                 : 1e15;
  if (!(*distance > 0) || !(*distance <= farthest))
    return make_error("place.lens-focus", fmt::format("the lens cannot focus on what is {} from the eye", to_text(*distance)),
                      *distance > 0 ? fmt::format("at most {} curvature radii", farthest) : "focus on what lies before the eye",
                      lens.focus.span);
  return EyeLens{lens.radius, *distance};
}

}  // namespace

Vector3 direction_through(const Eye& eye, double x, double y) {
  const double u = 2 * x / eye.width - 1, v = 1 - 2 * y / eye.height, aspect = static_cast<double>(eye.height) / eye.width;
  if (eye.projection == Projection::perspective) {
    const double t = math::tan(eye.fov.radians / 2);
    return geometry::normalised(eye.forward + (u * t) * eye.right + (v * aspect * t) * eye.up);
  }
  if (eye.projection == Projection::panorama) {
    const double a = kPi * u, e = kPi / 2 * v;
    return (math::cos(e) * math::cos(a)) * eye.forward + (math::cos(e) * math::sin(a)) * eye.right + math::sin(e) * eye.up;
  }
  const double a = eye.fov.radians / 2 * u, height = v * aspect * eye.fov.radians / 2;
  return geometry::normalised(math::cos(a) * eye.forward + math::sin(a) * eye.right + height * eye.up);
}

std::optional<std::array<double, 2>> pixel_of(const Eye& eye, const Vector3& direction) {
  const double f = dot(direction, eye.forward), r = dot(direction, eye.right), u = dot(direction, eye.up);
  const double w = eye.width, h = eye.height;
  if (eye.projection == Projection::perspective) {
    if (!(f > 0)) return std::nullopt;
    const double t = math::tan(eye.fov.radians / 2) * f;
    return std::array<double, 2>{w / 2 * (1 + r / t), h / 2 - w / 2 * u / t};
  }
  const double azimuth = math::atan2(r, f), flat = math::hypot(r, f);
  if (eye.projection == Projection::panorama)
    return std::array<double, 2>{w * (azimuth / (2 * kPi) + 0.5), h * (0.5 - math::atan2(u, flat) / kPi)};
  if (!(flat > 0)) return std::nullopt;
  return std::array<double, 2>{w * (azimuth / eye.fov.radians + 0.5), h / 2 - w * (u / flat) / eye.fov.radians};
}

double pixels_per_radian(const Eye& eye) {
  if (eye.projection == Projection::perspective) return eye.width / 2.0 / math::tan(eye.fov.radians / 2);
  return eye.width / (eye.projection == Projection::panorama ? 2 * kPi : eye.fov.radians);
}

const PlacedMesh* object_around(const PlacedRoom& room, const Position& at) {
  for (const PlacedMesh& part : room.parts)
    if ((part.kind == PartKind::object || part.kind == PartKind::frame) && is_inside(part, at)) return &part;
  return nullptr;
}

Result<Eye> make_eye(const scene::Scene& scene, const PlacedRoom& placed) {
  const scene::Camera& camera = scene.camera;
  const SourceSpan& span = camera.place.span.source ? camera.place.span : camera.span;
  Result<Position> at = locate(camera.place, placed.room, placed.height, placed.height / 2);
  if (!at) {
    Diagnostics errors = located(std::move(at).error(), span);
    for (Diagnostic& error : errors)
      if (error.code == "place.outside-room") error.code = "place.eye-outside-room";
    return errors;
  }
  Diagnostics wrong = wrong_place(placed, *at, span);
  if (has_error(wrong)) return wrong;
  Eye eye;
  eye.room_from_eye = geometry::translation_to(placed.room.space, at->floor);
  eye.z = at->z;
  eye.projection = camera.projection;
  eye.fov = camera.fov;
  eye.width = camera.size[0], eye.height = camera.size[1];
  Result<Vector3> direction = direction_of(camera, placed, eye);
  if (!direction) return std::move(direction).error();
  const auto* angles = std::get_if<scene::LookDirection>(&camera.look_at.value);
  look_along(eye, *direction, angles ? angles->azimuth.radians : 0);
  roll(eye, camera.roll.radians);
  if (camera.lens && eye.projection == Projection::perspective) {
    Result<EyeLens> lens = make_lens(*camera.lens, placed, eye);
    if (!lens) return std::move(lens).error();
    eye.lens = *lens;
  }
  return eye;
}

}  // namespace orbc::place
