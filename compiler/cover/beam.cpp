// Beams go out bounce by bounce, so that a cover that is too large is known with all counts of the bounces before.
//
// In one copy all rays of a beam come in through one wall and, the room being convex, each leaves through one other. Seen from a pole
// outside of the room (the eye; past it, what lies half turns away) the corners from the far end of that wall round to its near end divide
// the interval: clamped to the interval and kept in order they do so whatever rounding did to them, so the pieces always fill it. Seen from
// a pole inside (the first room; on S² the copy in which the rays meet again) the whole border is seen, and each ray leaves where it
// points. Past that pole directions are those of the far side: reversed.
#include "compiler/cover/beam.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "compiler/base/elementary.h"
#include "compiler/cover/automaton.h"
#include "compiler/cover/rim.h"
#include "compiler/cover/size.h"
#include "compiler/cover/storeys.h"
#include "compiler/room/room.h"

namespace orbc::cover {
namespace {

using geometry::Ambient;
using geometry::Isometry;
using geometry::Space;

constexpr double kSameWay = 1e-12;  // radians

struct Beam {
  Isometry cover_from_room;
  Wedge wedge;
  int entry = -1;                       // the wall by which the rays come in
  int sheet = 0;
  std::vector<std::uint16_t> crossings; // per loss of the rim
  Word word;                            // letters of the normal form (orbifolds) or walls passed
  std::vector<Sill> sills;              // those that bound the rays up and down
};

/// A copy as one beam sees it.
struct Seen {
  Word word;
  int bounces = 0, sheet = 0;
  std::vector<std::uint16_t> crossings;
  Wedge wedge;
  Isometry cover_from_room;             // rooms that are no orbifolds
  std::uint64_t nearer_walls = 0;
  std::vector<Sill> sills;
};

bool is_orbifold(const place::PlacedRoom& room) {
  return std::all_of(room.room.orbifold.corners.begin(), room.room.orbifold.corners.end(), is_integer);
}
std::uint64_t bit(int wall) { return wall >= 0 && wall < 64 ? std::uint64_t{1} << wall : 0; }

Bearing bearing_of(const Ambient& seen, int sheet) {
  const double scale = (sheet % 2 == 1 ? -1 : 1) / math::hypot(seen.x, seen.y);
  return {seen.x * scale, seen.y * scale};
}

/// Bearings that lie on a border of the wedge, but for rounding, become that border.
Bearing snapped(const Bearing& b, const Wedge& wedge) {
  if (std::fabs(turn(wedge.from, b)) < kSameWay && ahead(wedge.from, b)) return wedge.from;
  if (std::fabs(turn(wedge.to, b)) < kSameWay && ahead(wedge.to, b)) return wedge.to;
  return b;
}
bool holds(const Wedge& wedge, const Bearing& b) {
  return same(b, wedge.from) || same(b, wedge.to) || (turn(wedge.from, b) >= 0 && turn(b, wedge.to) >= 0);
}

/// What two wedges share. Their borders are told apart by more than rounding, or equal.
std::optional<Wedge> common(const Wedge& a, const Wedge& b) {
  const Bearing from = snapped(b.from, a), to = snapped(b.to, a);
  if (same(from, a.to) || same(to, a.from)) return std::nullopt;
  Wedge both = a;
  if (holds(a, from)) both.from = from;
  else if (!holds(b, a.from)) return std::nullopt;
  if (holds(a, to)) both.to = to;
  if (turn(both.from, both.to) <= 0) return std::nullopt;
  return both;
}

class Unfolder {
 public:
  Unfolder(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec, const Rim& rim)
      : room_(room),
        spec_(spec),
        rim_(rim),
        eye_z_(eye.z),
        eye_from_cover_(inverse(eye.room_from_eye)),
        size_(room, eye) {
    for (const WeightedStorey& on : storeys_of(room, spec.max_bounces)) {
      lowest_ = std::min(lowest_, on.storey.number * room.height);
      highest_ = std::max(highest_, (on.storey.number + 1) * room.height);
    }
    const int walls = static_cast<int>(room.room.walls.size());
    for (int wall = 0; wall < walls; ++wall) mirrors_.push_back(room::reflection_in_wall(room.room, wall));
    letter_.assign(static_cast<std::size_t>(walls), -1);
    if (!is_orbifold(room)) return;
    automaton_.emplace(room.room.orbifold, std::max(1, spec.max_bounces));
    for (int wall = 0; wall < walls; ++wall) {
      if (!room.room.walls[static_cast<std::size_t>(wall)].reflects) continue;
      letter_[static_cast<std::size_t>(wall)] = static_cast<int>(wall_.size());
      wall_.push_back(wall);
    }
  }

  Result<std::vector<Copy>> run(const BeamOptions& options) {
    std::vector<Beam> beams, next;
    Beam root;
    root.cover_from_room = geometry::identity(room_.room.space);
    root.crossings.assign(rim_.losses.size(), 0);
    std::vector<std::uint64_t> per_bounces{1};
    if (spec_.max_bounces > 0) start(root, beams);
    std::uint64_t total = 1;
    for (int bounces = 1; !beams.empty(); ++bounces) {
      total += beams.size();
      if (total > options.max_beams) {
        return make_error("cover.too-much", fmt::format("max_bounces: {} makes more than {} beams", spec_.max_bounces, options.max_beams),
                          fmt::format("max_bounces: {} fits", bounces - 1));
      }
      report(options.progress, "following beams", total, 0, "beams");
      next.clear();
      for (Beam& beam : beams) follow(beam, bounces, bounces < spec_.max_bounces, next);
      std::swap(beams, next);
    }
    return merged(root);
  }

 private:
  void start(const Beam& root, std::vector<Beam>& out) {
    const auto bearings = bearings_of(eye_from_cover_, 0);
    for (std::size_t i = 0; i < rim_.edges.size(); ++i) {
      go_on(root, static_cast<int>(i), {bearings[i], bearings[(i + 1) % bearings.size()]}, 0, out);
    }
  }

  /// The borders of the wedges of the rim's points, as the eye sees them on a sheet.
  [[nodiscard]] std::vector<Bearing> bearings_of(const Isometry& eye_from_copy, int sheet) const {
    std::vector<Bearing> bearings;
    bearings.reserve(rim_.points.size());
    for (const geometry::Point& point : rim_.points) bearings.push_back(bearing_of(eye_from_copy * point, sheet));
    return bearings;
  }

  /// The eye's foot as the copy sees it, in room coordinates.
  [[nodiscard]] Ambient eye_in_copy(const Isometry& eye_from_copy) const { return inverse(eye_from_copy) * geometry::Point(); }

  /// Bit i: wall i faces the rays that come from `pole`.
  [[nodiscard]] std::uint64_t facing(const Ambient& pole) const {
    std::uint64_t walls = 0;
    for (std::size_t i = 0; i < room_.room.walls.size() && i < 64; ++i)
      walls |= value_at(room_.room.walls[i].line, pole) < 0 ? std::uint64_t{1} << i : 0;
    return walls;
  }
  [[nodiscard]] bool inside(const Ambient& pole) const {
    return std::all_of(room_.room.walls.begin(), room_.room.walls.end(),
                       [&](const room::Wall& wall) { return value_at(wall.line, pole) > 0; });
  }

  void follow(const Beam& beam, int bounces, bool further, std::vector<Beam>& out) {
    const Isometry eye_from_copy = eye_from_cover_ * beam.cover_from_room;
    const Ambient eye = eye_in_copy(eye_from_copy);
    const Ambient coming = beam.sheet % 2 == 0 ? eye : -1.0 * eye, meeting = -1.0 * coming;
    see(beam, bounces, beam.sheet, facing(coming) | bit(beam.entry));
    if (room_.room.space == Space::spherical && inside(meeting)) {
      // All rays meet here and go on on the other side.
      see(beam, bounces, beam.sheet + 1, 0);
      if (further) leave_from_inside(beam, eye_from_copy, out);
    } else if (further) {
      leave_from_outside(beam, eye_from_copy, out);
    }
  }

  void leave_from_inside(const Beam& beam, const Isometry& eye_from_copy, std::vector<Beam>& out) {
    const int sheet = beam.sheet + 1;
    const auto bearings = bearings_of(eye_from_copy, sheet);
    const bool clockwise = eye_from_copy.reversing != (sheet % 2 == 1);
    for (std::size_t i = 0; i < rim_.edges.size(); ++i) {
      if (rim_.edges[i].openings.empty()) continue;
      const Bearing &a = bearings[i], &b = bearings[(i + 1) % bearings.size()];
      if (const auto wedge = common(beam.wedge, clockwise ? Wedge{b, a} : Wedge{a, b}))
        go_on(beam, static_cast<int>(i), *wedge, sheet, out);
    }
  }

  void leave_from_outside(const Beam& beam, const Isometry& eye_from_copy, std::vector<Beam>& out) {
    const int n = static_cast<int>(rim_.edges.size());
    const auto entry = static_cast<std::size_t>(beam.entry);
    const int after = rim_.first[entry] + rim_.count[entry], chain = n - rim_.count[entry];
    if (chain <= 0) return;
    const bool clockwise = eye_from_copy.reversing != (beam.sheet % 2 == 1);
    Bearing last = beam.wedge.from;
    for (int k = 0; k < chain && !same(last, beam.wedge.to); ++k) {
      // Counter-clockwise round the eye; the edge's far end is the chain's point k + 1.
      const int edge = (after + (clockwise ? chain - 1 - k : k)) % n;
      Bearing end = beam.wedge.to;
      if (k + 1 < chain) {
        const int point = clockwise ? edge : (edge + 1) % n;
        end = bearing_of(eye_from_copy * rim_.points[static_cast<std::size_t>(point)], beam.sheet);
        end = clamped(end, {last, beam.wedge.to});
      }
      if (!same(last, end)) go_on(beam, edge, {last, end}, beam.sheet, out);
      last = end;
    }
  }

  static Bearing clamped(const Bearing& b, const Wedge& wedge) {
    const Bearing near = snapped(b, wedge);
    if (same(near, wedge.from) || same(near, wedge.to)) return near;
    // A convex room fills less than half a turn: what is not left of the first border lies before it.
    if (turn(wedge.from, near) < 0) return wedge.from;
    return turn(near, wedge.to) < 0 ? wedge.to : near;
  }

  void go_on(const Beam& beam, int edge, const Wedge& wedge, int sheet, std::vector<Beam>& out) {
    const Rim::Edge& through = rim_.edges[static_cast<std::size_t>(edge)];
    for (const Opening& opening : through.openings) {
      std::vector<Sill> sills = beam.sills;
      if (through.openings.size() > 1 || !sills.empty()) {
        const Isometry eye_from_copy = eye_from_cover_ * beam.cover_from_room;
        const Sill wall{eye_from_copy * room_.room.walls[static_cast<std::size_t>(through.wall)].line, sheet, 0, false};
        const Sill low = at_height(wall, std::max(opening.from, lowest_), true),
                   high = at_height(wall, std::min(opening.to, highest_), false);
        if (nothing_passes(room_.room.space, sills, low, high, wedge, eye_z_)) continue;
        if (opening.from > lowest_) narrow(sills, low, eye_z_);
        if (opening.to < highest_) narrow(sills, high, eye_z_);
      }
      go_on(beam, through.wall, opening.loss, wedge, sheet, std::move(sills), out);
    }
  }

  static Sill at_height(Sill sill, double z, bool above) {
    sill.z = z;
    sill.above = above;
    return sill;
  }

  void go_on(const Beam& beam, int wall, int loss, const Wedge& wedge, int sheet, std::vector<Sill> sills, std::vector<Beam>& out) {
    Beam next;
    next.crossings = beam.crossings;
    ++next.crossings[static_cast<std::size_t>(loss)];
    if (largest(weight_of(next.crossings)) < spec_.min_weight) {
      cut_short_ = true;
      return;
    }
    next.cover_from_room = beam.cover_from_room * mirrors_[static_cast<std::size_t>(wall)];
    if (automaton_) {
      next.word = times(*automaton_, beam.word, letter_[static_cast<std::size_t>(wall)]);
      // The image of an element depends on nothing else, so that all its copies fit together bit by bit.
      next.cover_from_room = element_of(next.word);
    } else {
      next.word = beam.word;
      next.word.push_back(static_cast<std::uint8_t>(wall));
      if (next.word.size() % 8 == 0) next.cover_from_room = geometry::renormalised(next.cover_from_room);
    }
    // All beams that come into a copy through one wall see it alike: it is left out of all of them, or of none. So what it hides stays
    // hidden by a panel in that wall's mirrors (driver/tail.h), and whole copies behind it need no wedge.
    if (spec_.min_pixels > 0 && too_small(size_.of(next.cover_from_room), spec_)) return;
    next.wedge = wedge;
    next.sills = std::move(sills);
    next.entry = wall;
    next.sheet = sheet;
    out.push_back(std::move(next));
  }

  /// As `enumerate` multiplies.
  [[nodiscard]] Isometry element_of(const Word& word) const {
    Isometry product = geometry::identity(room_.room.space);
    for (std::size_t i = 0; i < word.size(); ++i) {
      product = product * mirrors_[static_cast<std::size_t>(wall_[word[i]])];
      if ((i + 1) % 8 == 0) product = geometry::renormalised(product);
    }
    return product;
  }

  /// By crossings, not along the way: equal whatever the order.
  [[nodiscard]] scene::Color weight_of(const std::vector<std::uint16_t>& crossings) const {
    scene::Color weight{1, 1, 1};
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      for (int n = 0; n < crossings[i]; ++n) weight = weight * rim_.losses[i];
    }
    return weight;
  }

  void see(const Beam& beam, int bounces, int sheet, std::uint64_t nearer_walls) {
    seen_.push_back({beam.word, bounces, sheet, beam.crossings, beam.wedge, beam.cover_from_room, nearer_walls, beam.sills});
  }

  [[nodiscard]] Copy copy_of(const Seen& seen) const {
    Copy copy;
    copy.cover_from_room = seen.cover_from_room;
    copy.bounces = seen.bounces;
    copy.sheet = seen.sheet;
    copy.weight = weight_of(seen.crossings);
    copy.nearer_walls = seen.nearer_walls;
    copy.word = seen.word;
    if (!automaton_) return copy;
    for (std::uint8_t& letter : copy.word) letter = static_cast<std::uint8_t>(wall_[letter]);
    const std::uint64_t down = descents(*automaton_, seen.word);
    copy.nearer_walls = 0;
    for (std::size_t letter = 0; letter < wall_.size() && letter < 64; ++letter) {
      if (((down >> letter) & 1) != (seen.sheet % 2 == 1)) copy.nearer_walls |= bit(wall_[letter]);
    }
    return copy;
  }

  static auto place_of(const Seen& s) { return std::tie(s.bounces, s.sheet, s.word); }

  std::vector<Copy> merged(const Beam& root) {
    std::vector<Copy> copies;
    Copy first;
    first.cover_from_room = root.cover_from_room;
    copies.push_back(first);
    const auto before = [](const Seen& a, const Seen& b) {
      const double x = math::atan2(a.wedge.from.y, a.wedge.from.x), y = math::atan2(b.wedge.from.y, b.wedge.from.x);
      return std::tie(a.bounces, a.sheet, a.word, a.crossings, x) < std::tie(b.bounces, b.sheet, b.word, b.crossings, y);
    };
    std::sort(seen_.begin(), seen_.end(), before);
    for (std::size_t from = 0, to; from < seen_.size(); from = to) {
      for (to = from + 1; to < seen_.size() && place_of(seen_[from]) == place_of(seen_[to]);) ++to;
      const bool one_weight = seen_[from].crossings == seen_[to - 1].crossings;
      if (automaton_ && one_weight && !cut_short_) {
        // What is hidden of it lies behind plain walls.
        copies.push_back(copy_of(seen_[from]));
        continue;
      }
      for (std::size_t i = from; i < to;) {
        Copy copy = copy_of(seen_[i]);
        copy.wedge = seen_[i].wedge;
        copy.sills = seen_[i].sills;
        const std::size_t run = i;
        for (++i; i < to && continues(seen_[run], *copy.wedge, seen_[i]); ++i) copy.wedge->to = seen_[i].wedge.to;
        copies.push_back(std::move(copy));
      }
    }
    return copies;
  }

  /// Whether `next` is seen beside the wedge, as the same thing.
  static bool continues(const Seen& first, const Wedge& wedge, const Seen& next) {
    constexpr double kHalfTurn = 1e-6;
    if (!first.sills.empty() || !next.sills.empty()) return false;
    return first.crossings == next.crossings && first.nearer_walls == next.nearer_walls && same(wedge.to, next.wedge.from) &&
           turn(wedge.from, next.wedge.to) > kHalfTurn;
  }

  const place::PlacedRoom& room_;
  const scene::CoverSpec& spec_;
  const Rim& rim_;
  double eye_z_, lowest_ = 0, highest_ = 0;   // all heights that rays can have
  Isometry eye_from_cover_;
  CopySize size_;
  std::vector<Isometry> mirrors_;
  std::optional<Automaton> automaton_;  // orbifolds
  std::vector<int> letter_, wall_;      // wall ↔ letter of the automaton
  std::vector<Seen> seen_;
  bool cut_short_ = false;
};

}  // namespace

Result<std::vector<Copy>> unfold_by_beams(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec,
                                          const BeamOptions& options) {
  const Rim rim = make_rim(room, spec.max_bounces);
  return Unfolder(room, eye, spec, rim).run(options);
}

bool needs_beams(const place::PlacedRoom& room) {
  if (!is_orbifold(room)) return true;
  const place::PlacedMirror* first = nullptr;
  for (const place::PlacedMirror& mirror : room.mirrors) {
    if (mirror.wall < 0) continue;
    if (first && !(mirror.reflectance * mirror.tint == first->reflectance * first->tint)) return true;
    if (!first) first = &mirror;
  }
  return false;
}

}  // namespace orbc::cover
