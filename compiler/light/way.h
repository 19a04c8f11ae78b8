#pragma once
#include "compiler/light/shade.h"

namespace orbc::light {

/// The straight path from a surface point to a point of the cover: to a sample of a lamp's image.
struct Way {
  trace::Direction start;      ///< unit, at the surface point
  double length = 0, arc = 0;  ///< of the path, and of its floor geodesic
  bool exists = false;
};

/// In: on S² the number of half turns beyond the nearest. None to a point's own antipode, which is seen from all sides at once.
[[nodiscard]] Way way_to(geometry::Space space, const geometry::Position& from, const geometry::Position& to, int sheet);

/// What a shadow ray brings along from a sample of a lamp's image: nothing, or the weight of the mirrors that turned it back.
[[nodiscard]] scene::Color arriving(const LightField& field, const LampImage& image, const HungLamp& lamp, std::size_t sample,
                                    const surface::LightPoint& point, const Way& way);

/// Light per unit of power that would come from a sample if nothing stood between, on a surface across the path; times its profile.
[[nodiscard]] double unhindered(const LightField& field, const LampImage& image, const HungLamp& lamp, std::size_t sample,
                                const surface::LightPoint& point, const Way& way);

/// How far a stand-in lies off its surface close to vertices, at most: they are vertices of the surface.
inline constexpr double kOnVertex = 1e-4;

/// Where a point of a stand-in lies on the surface that it stands for.
struct OnSurface {
  surface::LightPoint point;
  trace::Hit hit;  ///< the triangle; of nothing where no surface is near
};
/// A point of a stand-in that lies near a surface of the room, put onto that surface, with its normal: coarse stand-ins cut corners and
/// would lie in its shadow, and turn elsewhere. In: how far off it may be. Left as it is where nothing is so near.
[[nodiscard]] OnSurface on_surface(const LightField& field, const surface::LightPoint& point, double reach);

/// Whether a point lies under or in a closed thing, which nobody looks into: all ways from it end on the inside of triangles.
[[nodiscard]] bool covered(const LightField& field, const surface::LightPoint& point);

/// The ray that leaves a lit point.
[[nodiscard]] trace::Ray leaving(const LightField& field, const surface::LightPoint& point, const trace::Direction& direction);

}  // namespace orbc::light
