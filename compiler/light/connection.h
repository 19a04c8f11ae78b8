#pragma once
#include "compiler/light/lighting.h"

namespace orbc::light {

/// The geodesic from a surface point to a point of the universal cover, such as a sample of a lamp image.
struct Connection {
  trace::Direction direction;  ///< unit, at the surface point
  double length = 0;
  double arc = 0;      ///< length of its floor geodesic
  bool valid = false;  ///< false: the points coincide, or the geodesic is not unique (the antipode on S²)
};
/// Connects two points. In: on S², the half turns of the geodesic beyond the shortest one.
[[nodiscard]] Connection connect(geometry::Space space, const geometry::Position& from, const geometry::Position& to, int sheet);

/// The throughput of the mirrors on the path from a point to a sample of a lamp image; black where the path is blocked.
/// In: the connection of `point` and image.samples[sample].
[[nodiscard]] scene::Color shadow_transmittance(const LightingContext& lighting, const LampImage& image, std::size_t sample,
                                                const surface::ShadingPoint& point, const Connection& connection);

/// Whether the geodesic of a connection reaches its end over at most `bounces` mirrors, past all objects farther than `clearance` from the
/// point. Levels of detail lie beside the surface that they stand for, and would hide their own points.
[[nodiscard]] bool is_unobstructed(const LightingContext& lighting, const surface::ShadingPoint& point, const Connection& connection,
                                   int bounces, double clearance = 0);

/// The irradiance per unit of power on a surface across the connection if nothing blocked it: falloff times angular intensity.
[[nodiscard]] double unoccluded_irradiance(const LightingContext& lighting, const LampImage& image, std::size_t sample,
                                           const surface::ShadingPoint& point, const Connection& connection);

/// Meshes of coarser levels of detail keep vertices of the surface they stand for. There they lie off it by at most this length.
inline constexpr double kVertexTolerance = 1e-4;

/// A point of a coarser level of detail, moved onto the surface it stands for.
struct SurfaceProjection {
  surface::ShadingPoint point;
  trace::Hit hit;  ///< the triangle of that surface; HitKind::none if no surface was near
};
/// Projects a point onto the nearest surface of the room along its geometric normal, to either side. Coarser levels cut corners of the
/// surface and would lie in its shadow, with other normals.
/// In:    the greatest distance allowed.
/// Makes: the point unchanged where no surface with a similar normal (within 45°) is so near.
[[nodiscard]] SurfaceProjection project_to_surface(const LightingContext& lighting, const surface::ShadingPoint& point,
                                                   double max_distance);

/// Whether a point lies inside or under a closed body, where nobody looks: all of a few rays from it end on the inside of triangles.
[[nodiscard]] bool is_enclosed(const LightingContext& lighting, const surface::ShadingPoint& point);

/// The ray that leaves a surface point in a direction.
[[nodiscard]] trace::Ray spawn_ray(const LightingContext& lighting, const surface::ShadingPoint& point, const trace::Direction& direction);

}  // namespace orbc::light
