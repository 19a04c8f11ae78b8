#pragma once
#include <memory>
#include <vector>

#include "compiler/geometry/isometry.h"
#include "compiler/place/camera.h"
#include "compiler/trace/follow.h"

namespace orbc::render {

/// What the disk chart is multiplied by, so that it is true to length at its centre, where the metric is 2|dz|.
inline constexpr double kStraightScale = 2;
/// Where straight rays end on the sphere: distances in the scaled chart from its centre. The exports' chart ends there, too.
inline constexpr double kStraightHorizon = 200;

/// Straight rays instead of geodesics: how the universal cover looks when the disk chart times the height is taken for a room of its own.
/// The chart is scaled so that it is true to length at the room's centre: by 2 on the sphere and in the hyperbolic plane. The
/// camera stands at its place in the chart, and looks in the direction that its gaze has there; the chart is true to angles on the floor.
/// What a point of the cover shows does not depend on how rays reach it: the mirrors that it is seen through, their number and their
/// throughput, are those of the geodesic from the camera, as in the curved picture and in exports.
class StraightRays {
 public:
  /// In: a space that is not flat; `limits` for its max_bounces and min_weight. `scene` and its interior must outlive this.
  StraightRays(const trace::TraceScene& scene, const place::Camera& eye, const trace::FollowOptions& limits);

  /// Follows the straight line that leaves the eye as this ray does, in short geodesic pieces through the mirrors of the room.
  /// In:    a ray of the eye (`eye_ray`).
  /// Makes: a path whose last ray is the piece that hits, and whose length is that of the line in the scaled chart. A line that hits
  ///        nothing drawn is cut off with the throughput 1.
  /// Error: pieces are off the line by less than 0.2 pixels at the picture's centre.
  [[nodiscard]] trace::Path follow(const trace::Ray& ray) const;

 private:
  struct Walk;
  [[nodiscard]] double piece_length(const Walk& walk) const;
  [[nodiscard]] bool is_drawn(const geometry::Position& in_cover, trace::Path& path) const;

  const trace::TraceScene* scene_;
  std::unique_ptr<place::Interior> bare_room_;  ///< without objects and frames
  trace::TraceScene bare_;
  trace::FollowOptions limits_;
  geometry::Position eye_;
  double radians_per_pixel_;
  std::vector<geometry::Isometry> reflections_;  ///< in the walls
};

}  // namespace orbc::render
