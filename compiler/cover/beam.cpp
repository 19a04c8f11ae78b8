// Beams are propagated bounce by bounce, so that all counts of the bounces before are known when a cover becomes too large.
//
// In one copy, all rays of a beam enter through one wall, and each leaves through one other, because the room is convex. They all come from
// one pole: the eye, or past its antipode the antipode. From a pole outside of the room, the corners from the far end of the entry wall
// round to its near end divide the interval of bearings. Each corner is clamped to what is left of the interval, so that the pieces fill it
// whatever rounding does to the corners. From a pole inside (in the first room; on S² in the copy in which the rays meet again) the whole
// boundary is visible, and each ray leaves where it points. Past that pole all directions are reversed.
#include "compiler/cover/beam.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "compiler/base/elementary.h"
#include "compiler/cover/beam_hits.h"
#include "compiler/cover/boundary.h"
#include "compiler/cover/projected_size.h"
#include "compiler/cover/storeys.h"
#include "compiler/notation/euler.h"
#include "compiler/room/room.h"

namespace orbc::cover {
namespace {

using geometry::Ambient;
using geometry::Isometry;
using geometry::Space;

struct Beam {
  Isometry cover_from_room;
  Wedge wedge;
  int entry = -1;  // the wall through which the rays enter
  int sheet = 0;
  std::vector<std::uint16_t> crossings;  // as in BeamHit
  Word word;
  std::vector<HeightBound> height_bounds;
};

/// The part of a beam that leaves a copy through one edge of its boundary.
struct Exit {
  int edge = 0;
  Wedge wedge;
  int sheet = 0;
};

Bearing bearing_of(const Ambient& point, int sheet) {
  const double scale = (sheet % 2 == 1 ? -1 : 1) / math::hypot(point.x, point.y);
  return {point.x * scale, point.y * scale};
}

HeightBound at_height(HeightBound bound, double z, bool above) {
  bound.z = z;
  bound.above = above;
  return bound;
}

/// Propagates beams and records what they hit. Invariant: `beams_` are the beams of one number of bounces, `hits_` those of all bounces up
/// to it, and `all_found_` says whether none was left out for its weight.
class BeamUnfolder {
 public:
  BeamUnfolder(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec)
      : room_(room),
        spec_(spec),
        boundary_(make_boundary(room, spec.max_bounces)),
        reflections_(reflections_of(room, spec.max_bounces)),
        eye_z_(eye.z),
        eye_from_cover_(inverse(eye.room_from_eye)),
        size_(room, eye) {
    for (const auto& [storey, weight] : storeys_within(room, spec.max_bounces)) {
      lowest_ = std::min(lowest_, storey.number * room.height);
      highest_ = std::max(highest_, (storey.number + 1) * room.height);
    }
  }

  Result<std::vector<Copy>> run(const BeamOptions& options) {
    Copy room;
    room.cover_from_room = geometry::identity(room_.polygon.space);
    if (spec_.max_bounces > 0) start();
    std::uint64_t total = 1;
    for (int bounces = 1; !beams_.empty(); ++bounces) {
      total += beams_.size();
      if (total > options.max_beams) {
        return make_error("cover.too-much", fmt::format("max_bounces: {} makes more than {} beams", spec_.max_bounces, options.max_beams),
                          fmt::format("max_bounces: {} fits", bounces - 1));
      }
      report(options.progress, "following beams", total, 0, "beams");
      const std::vector<Beam> beams = std::move(beams_);
      beams_.clear();
      for (const Beam& beam : beams) enter_copy(beam, bounces);
    }
    std::vector<Copy> copies{room};
    for (Copy& copy : copies_of(std::move(hits_), reflections_, boundary_.throughputs, all_found_)) copies.push_back(std::move(copy));
    return copies;
  }

 private:
  void start() {
    Beam root;
    root.cover_from_room = geometry::identity(room_.polygon.space);
    root.crossings.assign(boundary_.throughputs.size(), 0);
    const auto bearings = bearings_of_points(eye_from_cover_, 0);
    for (std::size_t i = 0; i < boundary_.edges.size(); ++i)
      propagate(root, {static_cast<int>(i), {bearings[i], bearings[(i + 1) % bearings.size()]}, 0});
  }

  /// The bearings of the boundary's points, seen from the eye on a sheet.
  [[nodiscard]] std::vector<Bearing> bearings_of_points(const Isometry& eye_from_copy, int sheet) const {
    std::vector<Bearing> bearings;
    bearings.reserve(boundary_.points.size());
    for (const geometry::Point& point : boundary_.points) bearings.push_back(bearing_of(eye_from_copy * point, sheet));
    return bearings;
  }

  /// Bit i: wall i faces rays that come from a pole (in room coordinates).
  [[nodiscard]] std::uint64_t walls_facing(const Ambient& pole) const {
    std::uint64_t walls = 0;
    for (std::size_t i = 0; i < room_.polygon.walls.size() && i < 64; ++i)
      if (value_at(room_.polygon.walls[i].line, pole) < 0) walls |= wall_bit(static_cast<int>(i));
    return walls;
  }
  [[nodiscard]] bool is_inside(const Ambient& pole) const {
    return std::all_of(room_.polygon.walls.begin(), room_.polygon.walls.end(),
                       [&](const room::Wall& wall) { return value_at(wall.line, pole) > 0; });
  }

  /// Records the copy that a beam enters and propagates the beam through it.
  void enter_copy(const Beam& beam, int bounces) {
    const bool further = bounces < spec_.max_bounces;
    const Isometry eye_from_copy = eye_from_cover_ * beam.cover_from_room;
    const Ambient eye = inverse(eye_from_copy) * geometry::Point();
    const Ambient pole = beam.sheet % 2 == 0 ? eye : -1.0 * eye, next_pole = -1.0 * pole;
    record(beam, bounces, beam.sheet, walls_facing(pole) | wall_bit(beam.entry));
    if (room_.polygon.space == Space::spherical && is_inside(next_pole)) {
      // All rays meet in this copy, which is therefore seen a second time, on the next sheet.
      record(beam, bounces, beam.sheet + 1, 0);
      if (further) split_from_inside(beam, eye_from_copy);
    } else if (further) {
      split_from_outside(beam, eye_from_copy);
    }
  }

  void record(const Beam& beam, int bounces, int sheet, std::uint64_t eye_facing_walls) {
    hits_.push_back({beam.word, bounces, sheet, beam.crossings, beam.wedge, beam.cover_from_room, eye_facing_walls, beam.height_bounds});
  }

  void split_from_inside(const Beam& beam, const Isometry& eye_from_copy) {
    const int sheet = beam.sheet + 1;
    const auto bearings = bearings_of_points(eye_from_copy, sheet);
    const bool clockwise = eye_from_copy.reversing != (sheet % 2 == 1);
    for (std::size_t i = 0; i < boundary_.edges.size(); ++i) {
      if (boundary_.edges[i].apertures.empty()) continue;
      const Bearing &a = bearings[i], &b = bearings[(i + 1) % bearings.size()];
      if (const auto wedge = intersection(beam.wedge, clockwise ? Wedge{b, a} : Wedge{a, b}))
        propagate(beam, {static_cast<int>(i), *wedge, sheet});
    }
  }

  void split_from_outside(const Beam& beam, const Isometry& eye_from_copy) {
    const int n = static_cast<int>(boundary_.edges.size());
    const auto entry = static_cast<std::size_t>(beam.entry);
    const int after = boundary_.first_edge[entry] + boundary_.edge_count[entry], chain = n - boundary_.edge_count[entry];
    if (chain <= 0) return;
    const bool clockwise = eye_from_copy.reversing != (beam.sheet % 2 == 1);
    Bearing last = beam.wedge.from;
    for (int k = 0; k < chain && last != beam.wedge.to; ++k) {
      // The edges of the chain, counter-clockwise round the eye.
      const int edge = (after + (clockwise ? chain - 1 - k : k)) % n;
      Bearing end = beam.wedge.to;
      if (k + 1 < chain) {
        const int point = clockwise ? edge : (edge + 1) % n;
        end = bearing_of(eye_from_copy * boundary_.points[static_cast<std::size_t>(point)], beam.sheet);
        end = clamped(end, {last, beam.wedge.to});
      }
      if (last != end) propagate(beam, {edge, {last, end}, beam.sheet});
      last = end;
    }
  }

  /// Sends the part of a beam through all apertures of its edge.
  void propagate(const Beam& beam, const Exit& exit) {
    const Boundary::Edge& edge = boundary_.edges[static_cast<std::size_t>(exit.edge)];
    for (const Aperture& aperture : edge.apertures) {
      auto bounds = beam.height_bounds;
      if (edge.apertures.size() > 1 || !bounds.empty()) {
        const Isometry eye_from_copy = eye_from_cover_ * beam.cover_from_room;
        const HeightBound wall{eye_from_copy * room_.polygon.walls[static_cast<std::size_t>(edge.wall)].line, exit.sheet, 0, false};
        const HeightRange range{at_height(wall, std::max(aperture.from, lowest_), true),
                                at_height(wall, std::min(aperture.to, highest_), false)};
        if (is_blocked(room_.polygon.space, bounds, range, exit.wedge, eye_z_)) continue;
        if (aperture.from > lowest_) bounds = with_bound(std::move(bounds), range.low, eye_z_);
        if (aperture.to < highest_) bounds = with_bound(std::move(bounds), range.high, eye_z_);
      }
      if (auto next = reflected(beam, edge.wall, aperture.throughput_index)) {
        next->wedge = exit.wedge;
        next->sheet = exit.sheet;
        next->height_bounds = std::move(bounds);
        beams_.push_back(std::move(*next));
      }
    }
  }

  /// A beam behind a mirror, without its wedge and bounds; nothing when the copy there is left out.
  std::optional<Beam> reflected(const Beam& beam, int wall, int throughput_index) {
    Beam next;
    next.crossings = beam.crossings;
    ++next.crossings[static_cast<std::size_t>(throughput_index)];
    if (max_channel(weight_of(next.crossings, boundary_.throughputs)) < spec_.min_weight) {
      all_found_ = false;
      return std::nullopt;
    }
    if (reflections_.automaton) {
      next.word = multiply(*reflections_.automaton, beam.word, reflections_.letter_of_wall[static_cast<std::size_t>(wall)]);
      next.cover_from_room = isometry_of(reflections_, next.word);
    } else {
      next.word = beam.word;
      next.word.push_back(static_cast<std::uint8_t>(wall));
      next.cover_from_room = beam.cover_from_room * reflections_.in_wall[static_cast<std::size_t>(wall)];
      if (next.word.size() % 8 == 0) next.cover_from_room = geometry::renormalised(next.cover_from_room);
    }
    // All beams that enter a copy through one wall find it equally large, so it is left out of all of them or of none. What it hides stays
    // hidden by a panel in the mirrors of that wall (cutoff/impostor.h), and whole copies behind it need no wedge.
    if (spec_.min_pixels > 0 && is_culled(size_.of(next.cover_from_room), spec_)) return std::nullopt;
    next.entry = wall;
    return next;
  }

  const place::Interior& room_;
  const scene::CoverSpec& spec_;
  Boundary boundary_;
  Reflections reflections_;
  double eye_z_, lowest_ = 0, highest_ = 0;  // the heights that rays can have
  Isometry eye_from_cover_;
  ProjectedSize size_;
  std::vector<Beam> beams_;
  std::vector<BeamHit> hits_;
  bool all_found_ = true;
};

}  // namespace

Result<std::vector<Copy>> unfold_by_beams(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec,
                                          const BeamOptions& options) {
  return BeamUnfolder(room, eye, spec).run(options);
}

bool needs_beams(const place::Interior& room) {
  if (!notation::is_orbifold(room.polygon.orbifold)) return true;
  const place::PlacedMirror* first = nullptr;
  for (const place::PlacedMirror& mirror : room.mirrors) {
    if (mirror.wall < 0) continue;  // on floor or ceiling
    if (first && !(mirror.throughput == first->throughput)) return true;
    if (!first) first = &mirror;
  }
  return false;
}

}  // namespace orbc::cover
