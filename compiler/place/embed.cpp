// Paper, "Object Embedding and Movement": an object's horizontal coordinates become coordinates of the stereographic or Poincaré disk.
// Lengths at the disk's origin count double, hence (x + iy)/2.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "compiler/geometry/predicates.h"
#include "compiler/mesh/analyse.h"
#include "compiler/mesh/refine.h"
#include "compiler/place/locate.h"
#include "compiler/place/embed.h"

namespace orbc::place {
namespace {

using geometry::Containment;
using geometry::Point;
using geometry::Space;
using geometry::Vector3;

Point embedded(Space space, scene::Embedding embedding, const Vector3& p) {
  if (embedding == scene::Embedding::exponential) return geometry::point_from_log(space, {p.x, p.y});
  return geometry::point_from_disk(space, (space == Space::euclidean ? 1.0 : 0.5) * std::complex<double>(p.x, p.y));
}

// Whether the embedding is defined and injective on the disk up to p.
bool in_chart(Space space, scene::Embedding embedding, const Vector3& p) {
  const double r = math::hypot(p.x, p.y);
  if (!(r < 1e15) || !(std::fabs(p.z) < 1e15)) return false;
  if (embedding == scene::Embedding::exponential)
    return r < (space == Space::spherical ? std::numbers::pi : space == Space::hyperbolic ? 30 : 1e15);
  return space != Space::hyperbolic || r < 2 * (1 - 1e-9);
}

// The intrinsic length of the interval [low, high] of the axis.
double embedded_length(Space space, scene::Embedding embedding, double low, double high) {
  if (embedding == scene::Embedding::exponential || space == Space::euclidean) return high - low;
  return 2 * (geometry::atan_k(space, high / 2) - geometry::atan_k(space, low / 2));
}

// Rotates p so that the axis `up` becomes z.
Vector3 z_up(const Vector3& p, scene::Axis up) {
  switch (up) {
    case scene::Axis::plus_x:
      return {-p.z, p.y, p.x};
    case scene::Axis::minus_x:
      return {p.z, p.y, -p.x};
    case scene::Axis::plus_y:
      return {p.x, -p.z, p.y};
    case scene::Axis::minus_y:
      return {p.x, p.z, -p.y};
    case scene::Axis::minus_z:
      return {p.x, -p.y, -p.z};
    default:
      return p;
  }
}

// Cosine and sine of a rotation in a plane; exact for quarter turns, so that a box stays a box.
struct PlaneRotation {
  double c = 1, s = 0;
};

PlaneRotation plane_rotation(const Angle& angle) {
  const double quarters = angle.radians / (std::numbers::pi / 2), whole = std::round(quarters);
  if (std::fabs(quarters - whole) > 1e-15 * std::fmax(1, std::fabs(quarters))) return {math::cos(angle.radians), math::sin(angle.radians)};
  constexpr double kCos[] = {1, 0, -1, 0}, kSin[] = {0, 1, 0, -1};
  const auto k = static_cast<std::size_t>(std::fmod(std::fmod(whole, 4) + 4, 4));
  return {kCos[k], kSin[k]};
}

/// The linear map of a mesh before it is centred: `up`, then `scale`, then `rotate`.
class Pose {
 public:
  explicit Pose(const scene::Object& object)
      : up_(object.up),
        scale_(object.scale),
        about_{plane_rotation(object.rotate[0]), plane_rotation(object.rotate[1]), plane_rotation(object.rotate[2])} {}

  [[nodiscard]] bool is_scaled() const { return scale_ != std::array<double, 3>{1, 1, 1}; }
  [[nodiscard]] bool is_mirrored() const { return scale_[0] * scale_[1] * scale_[2] < 0; }
  [[nodiscard]] Vector3 operator()(const Vector3& own) const {
    Vector3 p = z_up(own, up_);
    p = {scale_[0] * p.x, scale_[1] * p.y, scale_[2] * p.z};
    const auto& [x, y, z] = about_;
    p = {p.x, x.c * p.y - x.s * p.z, x.s * p.y + x.c * p.z};
    p = {y.c * p.x + y.s * p.z, p.y, y.c * p.z - y.s * p.x};
    return {z.c * p.x - z.s * p.y, z.s * p.x + z.c * p.y, p.z};
  }
  /// The inverse of `rotate`; solid patterns rotate with the object.
  [[nodiscard]] Vector3 unrotated(Vector3 p) const {
    const auto& [x, y, z] = about_;
    p = {z.c * p.x + z.s * p.y, z.c * p.y - z.s * p.x, p.z};
    p = {y.c * p.x - y.s * p.z, p.y, y.c * p.z + y.s * p.x};
    return {p.x, x.c * p.y + x.s * p.z, x.c * p.z - x.s * p.y};
  }

 private:
  scene::Axis up_;
  std::array<double, 3> scale_;
  std::array<PlaneRotation, 3> about_;
};

// The centroid of the posed mesh. Uneven scaling does not preserve the centroid of a surface, which is then computed anew.
Vector3 posed_centroid(const mesh::Mesh& mesh, const Pose& pose) {
  mesh::AnalyseOptions quickly;
  quickly.crossings = false;
  if (!pose.is_scaled()) return pose(mesh::analyse(mesh, quickly).centroid);
  mesh::Mesh posed;
  posed.triangles = mesh.triangles;
  for (const Vector3& own : mesh.positions) posed.positions.push_back(pose(own));
  return mesh::analyse(posed, quickly).centroid;
}

// ---- refining ---------------------------------------------------------------------------------------------------------------

bool is_too_long(Space space, scene::Embedding embedding, const Vector3& p, const Vector3& q, double tolerance) {
  const double r2 = std::fmax(p.x * p.x + p.y * p.y, q.x * q.x + q.y * q.y), dx = p.x - q.x, dy = p.y - q.y;
  // Near the axis the error is below |z|·l²/8 with |z| ≤ r/2 in the disk. A test with eight times that decides nearly all edges of a fine
  // mesh.
  if (r2 < 0.25 && 0.25 * r2 * (dx * dx + dy * dy) * (dx * dx + dy * dy) <= tolerance * tolerance) return false;
  const Point from = embedded(space, embedding, p), to = embedded(space, embedding, q);
  // Not at the middle alone: an edge through the axis has no error there, and an edge that is never split while its neighbours are makes
  // endless slivers.
  for (const double t : {0.25, 0.5, 0.75}) {
    const Point chord = geometry::normalised_point(space, (1 - t) * from + t * to);
    if (geometry::distance(space, chord, embedded(space, embedding, (1 - t) * p + t * q)) > tolerance) return true;
  }
  return false;
}

// ---- containment ------------------------------------------------------------------------------------------------------------

// Whether X is so far inside that the stored lines and the stored outline agree. A filter before the exact predicate.
bool is_clearly_inside(const room::Room& room, const Point& x) {
  for (const room::Wall& wall : room.walls) {
    const geometry::Line& l = wall.line;
    const double size = std::fabs(l.w * x.w) + std::fabs(l.x * x.x) + std::fabs(l.y * x.y);
    if (!(geometry::value_at(l, x) > 1e-9 * size)) return false;
  }
  return true;
}

/// An object that is to stand in a room.
struct Standing {
  const mesh::Mesh& flat;           ///< the normalised mesh
  const scene::Object& object;
  const room::Room& room;
  double height = 1;                ///< of the room
};

struct ScaledOverhang {
  Overhang wall{0, 0};
  double above_ceiling = 0;
  [[nodiscard]] bool inside() const { return wall.distance <= 0 && above_ceiling <= 0; }
};

// The overhang of an object at `at`, scaled by `factor` about the foot of its axis; measured at every `stride`-th vertex, for hints.
ScaledOverhang overhang_at_scale(const Standing& standing, const geometry::Position& at, double factor, std::size_t stride) {
  const auto& [flat, object, room, height] = standing;
  const geometry::Isometry room_from_object =
      geometry::translation_to(room.space, at.floor) * geometry::rotation(room.space, object.turn.radians);
  ScaledOverhang worst;
  for (std::size_t i = 0; i < flat.positions.size(); i += stride) {
    const Vector3 p = factor * flat.positions[i];
    if (!in_chart(room.space, object.embedding, p)) return {{0, 1e9}, 0};
    const Overhang over = overhang(room, room_from_object * embedded(room.space, object.embedding, p));
    if (over.distance > worst.wall.distance) worst.wall = over;
    worst.above_ceiling = std::fmax(worst.above_ceiling, at.z + p.z - height);
  }
  return worst;
}

std::string fitting_size_hint(const Standing& standing, const geometry::Position& at) {
  const mesh::Mesh& flat = standing.flat;
  const std::size_t stride = flat.positions.size() / 20000 + 1;
  const auto fits = [&](const geometry::Position& place, double factor) {
    return overhang_at_scale(standing, place, factor, stride).inside();
  };
  const auto largest = [&](const geometry::Position& place) {
    double low = 0, high = 1;
    for (int i = 0; i < 20; ++i) (fits(place, 0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    return low;
  };
  double low[2] = {0, 0}, high[2] = {0, 0};
  for (const Vector3& p : flat.positions) {
    low[0] = std::fmin(low[0], p.x);
    low[1] = std::fmin(low[1], p.y);
    high[0] = std::fmax(high[0], p.x);
    high[1] = std::fmax(high[1], p.y);
  }
  const int axis = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
  // A little less than the largest size that fits, in three digits.
  const auto size = [&](double factor) {
    const double true_size = embedded_length(standing.room.space, standing.object.embedding, factor * low[axis], factor * high[axis]),
                 digits = math::pow(10, 2 - std::floor(math::log10(true_size)));
    return std::floor(0.998 * true_size * digits) / digits;
  };
  const double here = largest(at);
  if (here > 0.2) return fmt::format("`size: {:.3g}` fits here", size(here));
  if (fits({}, 1)) return "it fits at the centre of the room";
  return fmt::format("`size: {:.3g}` fits at the centre of the room", size(largest({})));
}

std::optional<Diagnostic> check_inside(const PlacedMesh& mesh, const Standing& standing, const geometry::Position& at) {
  const auto& [flat, object, room, height] = standing;
  Overhang worst{0, 0};
  double above = 0;
  bool outside = false;
  for (std::size_t i = 0; i < mesh.floor.size(); ++i) {
    above = std::fmax(above, mesh.z[i] - height);
    if (is_clearly_inside(room, mesh.floor[i]) || geometry::contains(room.outline, mesh.floor[i]) != Containment::outside) continue;
    const Overhang over = overhang(room, mesh.floor[i]);
    if (!outside || over.distance > worst.distance) worst = over;
    outside = true;
  }
  if (!outside && above <= 0) return std::nullopt;
  const std::string where = outside && worst.distance >= above ? fmt::format("{} beyond wall {}", to_text(worst.distance), worst.wall + 1)
                                                               : fmt::format("{} above the ceiling", to_text(above));
  return make_error("place.object-outside-room", fmt::format("{} reaches {}", object.name.empty() ? "this object" : object.name, where),
                    fitting_size_hint(standing, at),
                    object.size_span.source    ? object.size_span
                    : object.place.span.source ? object.place.span
                                               : object.span);
}

// Steps 1 to 5 of place_object: the mesh in Euclidean coordinates, its lowest point at z = 0.
Result<mesh::Mesh> normalised_mesh(const mesh::Mesh& mesh, const scene::Object& object, const room::Room& room) {
  const Pose pose(object);
  mesh::Mesh flat;
  flat.uv = mesh.uv;
  flat.colors = mesh.colors;
  flat.triangles = mesh.triangles;
  flat.triangle_material = mesh.triangle_material;
  if (pose.is_mirrored()) flat = mesh::flip_orientation(std::move(flat));
  const Vector3 middle = posed_centroid(mesh, pose);
  Vector3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const Vector3& own : mesh.positions) {
    const Vector3 p = pose(own);
    flat.positions.push_back({p.x - middle.x, p.y - middle.y, p.z});
    const Vector3& q = flat.positions.back();
    low = {std::fmin(low.x, q.x), std::fmin(low.y, q.y), std::fmin(low.z, q.z)};
    high = {std::fmax(high.x, q.x), std::fmax(high.y, q.y), std::fmax(high.z, q.z)};
  }
  double factor = 1;
  if (object.size) {
    const bool along_x = high.x - low.x >= high.y - low.y;
    const double from = along_x ? low.x : low.y, to = along_x ? high.x : high.y;
    if (!(to - from > 1e-9 * (high.z - low.z)))
      return make_error("place.flat-object", fmt::format("{} has no horizontal extent that `size` could set", object.name),
                        "leave `size` out", object.size_span);
    if (room.space == Space::spherical && *object.size >= std::numbers::pi)
      return make_error("place.too-large",
                        fmt::format("{} cannot be {} long on a sphere of circumference 2π", object.name, to_text(*object.size)), "",
                        object.size_span);
    factor = scale_for_size(room.space, object.embedding, from, to, *object.size);
  }
  for (Vector3& p : flat.positions) {
    p = {factor * p.x, factor * p.y, factor * (p.z - low.z)};
    if (!in_chart(room.space, object.embedding, p))
      return make_error("place.too-large", fmt::format("{} is too large for this space", object.name.empty() ? "this object" : object.name),
                        "give it a `size`, its longest horizontal extent", object.size_span.source ? object.size_span : object.span);
  }
  return flat;
}

}  // namespace

double scale_for_size(Space space, scene::Embedding embedding, double low, double high, double size) {
  const double k = geometry::curvature(space);
  if (k == 0 || embedding == scene::Embedding::exponential) return size / (high - low);
  const double t = geometry::tan_k(space, size / 2), a = high / 2, b = low / 2, d = a - b;
  return 2 * t / (d + std::sqrt(std::fmax(0, d * d - 4 * k * a * b * t * t)));
}

Result<PlacedMesh> place_object(const mesh::Mesh& mesh, const scene::Object& object, const room::Room& room, double height,
                                const EmbedOptions& options) {
  Result<geometry::Position> at = locate(object.place, room, height, 0);
  if (!at) return located(std::move(at).error(), object.span);
  Result<mesh::Mesh> made = normalised_mesh(mesh, object, room);
  if (!made) return located(std::move(made).error(), object.span);
  if (room.space != Space::euclidean) {
    made = mesh::refine(
        *made, [&](const Vector3& p, const Vector3& q) { return is_too_long(room.space, object.embedding, p, q, options.tolerance); },
        options.max_triangles);
    if (!made) return located(std::move(made).error(), object.span);
  }
  mesh::Mesh& flat = *made;
  PlacedMesh placed;
  placed.name = object.name;
  placed.uv = std::move(flat.uv);
  placed.color = std::move(flat.colors);
  placed.triangles = std::move(flat.triangles);
  placed.style.assign(flat.triangle_material.begin(), flat.triangle_material.end());
  placed.style.resize(placed.triangles.size(), 0);
  const geometry::Isometry room_from_object =
      geometry::translation_to(room.space, at->floor) * geometry::rotation(room.space, object.turn.radians);
  for (const Vector3& p : flat.positions) {
    const Point x = room_from_object * embedded(room.space, object.embedding, p);
    placed.floor.push_back(is_clearly_inside(room, x) ? x : snap_into_room(room, x));
    // A body as high as the room touches the ceiling exactly, whatever the last bit of the sum is.
    const double z = at->z + p.z;
    placed.z.push_back(z > height && z < height * (1 + 1e-14) ? height : z);
  }
  if (auto error = check_inside(placed, {flat, object, room, height}, *at)) return located({*error}, object.span);
  const Pose pose(object);
  for (Vector3& p : flat.positions) p = pose.unrotated(p);
  placed.pattern_position = std::move(flat.positions);
  return placed;
}

}  // namespace orbc::place
