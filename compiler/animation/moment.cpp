#include "compiler/animation/moment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "compiler/animation/interpolate.h"
#include "compiler/animation/path.h"
#include "compiler/geometry/chart.h"
#include "compiler/room/realise.h"
#include "compiler/scene/print_document.h"
#include "compiler/scene/values.h"

namespace orbc::animation {
namespace {

using scene::Track;

constexpr std::string_view kCorners = "orbifold.corners.";

bool moves_corner(const Track& track) { return track.path.compare(0, kCorners.size(), kCorners) == 0; }

/// Values by their paths, in the order in which they are set.
using Settings = std::vector<std::pair<std::string, std::string>>;

void append(Settings& to, const Settings& more) { to.insert(to.end(), more.begin(), more.end()); }

/// Settings as overrides; their name in messages says which moment it is.
scene::Overrides overrides_of(const Settings& settings, double t) {
  scene::Overrides overrides;
  for (const auto& [path, value] : settings) overrides.push_back({fmt::format("<animation at t = {:.6g}>", t), path + "=" + value});
  return overrides;
}

/// The index of the corner that `orbifold.corners.3` names (2), among `count` corners; nothing when there is none.
std::optional<std::size_t> corner_index(const std::string& path, std::size_t count) {
  const std::string digits = path.substr(kCorners.size());
  for (std::size_t i = 0; i < count; ++i)
    if (digits == std::to_string(i + 1)) return i;
  return std::nullopt;
}

/// The notation of a room with corners of real orders: *23(6.5).
std::string notation_of(const std::vector<double>& orders) {
  std::string text = "*";
  for (const double order : orders) {
    const std::string digits = fmt::format("{}", order);
    text += digits.size() == 1 ? digits : "(" + digits + ")";
  }
  return text;
}

/// The orbifold whose corners are those of the moment.
Result<Settings> corner_settings(const scene::Animation& animation, double t, const notation::Orbifold& orbifold) {
  std::vector<double> orders;
  for (const Rational& order : orbifold.corners) orders.push_back(static_cast<double>(order));
  for (const Track& track : animation.tracks) {
    if (!moves_corner(track)) continue;
    const auto corner = corner_index(track.path, orders.size());
    if (!corner)
      return make_error("animation.no-such-corner", fmt::format("`{}` is no corner of this room", track.path),
                        fmt::format("corners are orbifold.corners.1 to orbifold.corners.{}", orders.size()), track.path_span);
    const auto* keyframes = std::get_if<scene::Keyframes>(&track.motion);
    const auto value = keyframes ? value_at(*keyframes, t) : Result<scene::Node>(scene::Node{});
    if (!value) return value.error();
    const auto order = scene::number_of(*value);
    if (!order || !(*order > 1) || !(*order <= 1e6))
      return make_error("animation.bad-corner", "the order of a corner is a number greater than 1", "orbifold.corners.3: {from: 6, to: 7}",
                        track.span);
    orders[*corner] = *order;
  }
  Settings settings = {{"orbifold", notation_of(orders)}};
  if (std::any_of(orders.begin(), orders.end(), [](double order) { return order != std::floor(order); }))
    settings.emplace_back("allow_non_orbifold", "true");
  return settings;
}

/// Something that moves through the room.
struct Mover {
  std::string key;  ///< of its place in the scene: `camera.at`
  Path path;
  double s = 0;            ///< arc length on the path at the moment
  bool backwards = false;  ///< whether s falls with time
};

std::string place_text(const Path& path, const PathPoint& at) {
  const std::complex<double> z = geometry::disk_from_point(path.space, at.at);
  return path.has_height ? fmt::format("{{disk: [{}, {}], z: {}}}", z.real(), z.imag(), at.z)
                         : fmt::format("{{disk: [{}, {}]}}", z.real(), z.imag());
}

/// The azimuth, in degrees in the frame of the place, of the point that lies `lead` ahead on the path.
/// Formula: the argument of the log map at the place; its axes are those of the translated frame (place::Camera).
double azimuth_ahead(const Mover& mover, double lead) {
  const geometry::Point here = point_at(mover.path, mover.s).at,
                        there = point_at(mover.path, mover.s + (mover.backwards ? -lead : lead)).at;
  const std::complex<double> step =
      geometry::log_from_point(mover.path.space, geometry::inverse(geometry::translation_to(mover.path.space, here)) * there);
  return math::atan2(step.imag(), step.real()) * 180 / std::numbers::pi;
}

/// `camera.at` for `camera.look_at`; `objects.statue.at` for `objects.statue.turn`.
std::string place_beside(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot) + ".at";
}

Result<std::vector<Mover>> movers_of(const scene::Animation& animation, double t, const room::Room& room) {
  std::vector<Mover> movers;
  for (const Track& track : animation.tracks) {
    if (const auto* walk = std::get_if<scene::WallWalk>(&track.motion)) {
      auto path = wall_path(room, *walk, track.span);
      if (!path) return path.error();
      const double s = t * walk->laps * path->length;
      movers.push_back({track.path, std::move(*path), s, walk->laps < 0});
    } else if (const auto* spline = std::get_if<scene::PlacePath>(&track.motion)) {
      auto path = place_path(room, *spline);
      if (!path) return path.error();
      const double s = t * path->length;
      movers.push_back({track.path, std::move(*path), s});
    }
  }
  return movers;
}

/// The directions of what looks or turns to where it goes.
Result<Settings> direction_settings(const scene::Animation& animation, const std::vector<Mover>& movers) {
  Settings settings;
  for (const Track& track : animation.tracks) {
    const auto* ahead = std::get_if<scene::Ahead>(&track.motion);
    if (!ahead) continue;
    const std::string place = place_beside(track.path);
    const auto mover = std::find_if(movers.begin(), movers.end(), [&](const Mover& m) { return m.key == place; });
    if (mover == movers.end())
      return make_error(
          "animation.nothing-ahead", fmt::format("`{}` is to follow its motion, but `{}` does not move along a path", track.path, place),
          fmt::format("add {}: {{walk: walls, distance: 0.15}} or a path of places", place.empty() ? "camera.at" : place), track.span);
    const double azimuth = azimuth_ahead(*mover, ahead->lead) + ahead->offset.radians * 180 / std::numbers::pi;
    const std::string key = track.path.substr(track.path.rfind('.') + 1);
    if (key == "look_at")
      settings.emplace_back(
          track.path, fmt::format("{{azimuth: {}deg, elevation: {}deg}}", azimuth, ahead->elevation.radians * 180 / std::numbers::pi));
    else settings.emplace_back(track.path, fmt::format("{}deg", azimuth));
  }
  return settings;
}

}  // namespace

Result<scene::Overrides> overrides_at(const scene::Animation& animation, double t, const ReadScene& read) {
  Settings settings = {{"animation", ""}};
  bool corners = false, moving = false;
  for (const Track& track : animation.tracks) {
    const auto* keyframes = std::get_if<scene::Keyframes>(&track.motion);
    corners = corners || moves_corner(track);
    moving = moving || !keyframes;
    if (!keyframes || moves_corner(track)) continue;
    const auto value = value_at(*keyframes, t);
    if (!value) return value.error();
    settings.emplace_back(track.path, scene::flow_text(*value));
  }
  if (corners) {
    const auto still = read(overrides_of(settings, t));
    if (!still) return still.error();
    const auto more = corner_settings(animation, t, still->scene.orbifold);
    if (!more) return more.error();
    append(settings, *more);
  }
  if (!moving) return overrides_of(settings, t);
  const auto still = read(overrides_of(settings, t));
  if (!still) return still.error();
  const auto room = room::realise(still->scene.orbifold, still->scene.room.shape, still->scene.allow_non_orbifold);
  if (!room) return located(room.error(), animation.span);
  const auto movers = movers_of(animation, t, *room);
  if (!movers) return movers.error();
  for (const Mover& mover : *movers) settings.emplace_back(mover.key, place_text(mover.path, point_at(mover.path, mover.s)));
  const auto directions = direction_settings(animation, *movers);
  if (!directions) return directions.error();
  append(settings, *directions);
  return overrides_of(settings, t);
}

Result<scene::Overrides> overrides_of_frame(const scene::Animation& animation, int frame, const ReadScene& read) {
  auto overrides = overrides_at(animation, static_cast<double>(frame) / animation.frames, read);
  if (!overrides || animation.fixed_noise) return overrides;
  const auto still = read(*overrides);
  if (!still) return still.error();
  if (still->scene.integrator == scene::Integrator::path)
    overrides->push_back({overrides->front().name, fmt::format("bake.seed={}", (still->scene.bake.seed + frame) % 1'000'000'001)});
  return overrides;
}

}  // namespace orbc::animation
