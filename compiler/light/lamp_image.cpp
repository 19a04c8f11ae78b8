// The unfolding of light: a path from a surface point over mirrors to the lamp is a geodesic to the lamp's image. Walls without mirrors are
// no letters of words, for the reason given at cover::visit_copies. Most images hardly matter by themselves: in H² their number grows like
// e^L with the length L of the path, and the light of each falls like e^-L. So copies are visited one by one, twice: first to find out how
// bright the room is, then to keep the images that are visible somewhere in it whole, and of the faint others, which are evaluated as a
// sum, no more than that needs.
#include "compiler/light/lamp_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "compiler/base/elementary.h"
#include "compiler/cover/enumerate.h"
#include "compiler/light/falloff.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/growth.h"
#include "compiler/room/room.h"

namespace orbc::light {
namespace {

using geometry::Isometry;
using geometry::Position;
using geometry::Space;

constexpr double kFaintShare = 4;  // images are faint below this, times ImageOptions::faint_below, of the light of all

/// An image of the floor: a product of reflections in walls.
struct HorizontalImage {
  Isometry cover_from_room;
  int bounces = 0, sheet = 0;
  std::vector<std::int16_t> walls;
  bool path_specific = false;
};
/// An image of the height: z ↦ sign·z + shift, a product of reflections in floor and ceiling.
struct VerticalImage {
  double sign = 1, shift = 0;
  int bounces = 0;
};

/// The surfaces that have mirrors.
struct MirroredSurfaces {
  std::vector<bool> walls;
  bool floor = false, ceiling = false;
  double max_throughput = 0;  ///< largest channel of any mirror
};

MirroredSurfaces mirrored_surfaces(const place::Interior& interior) {
  MirroredSurfaces mirrors;
  mirrors.walls.assign(interior.polygon.walls.size(), false);
  for (const place::PlacedMirror& m : interior.mirrors) {
    if (m.wall >= 0) mirrors.walls[static_cast<std::size_t>(m.wall)] = true;
    else (m.wall == -1 ? mirrors.floor : mirrors.ceiling) = true;
    mirrors.max_throughput = std::max({mirrors.max_throughput, m.throughput.r, m.throughput.g, m.throughput.b});
  }
  return mirrors;
}

/// Called with every image; false stops the enumeration.
using Visitor = std::function<bool(const HorizontalImage&)>;

// Orbifolds: every element of the group once.
void visit_group(const place::Interior& interior, const MirroredSurfaces& mirrors, int bounces, const Visitor& visit) {
  std::vector<int> wall;
  for (std::size_t i = 0; i < interior.polygon.walls.size(); ++i)
    if (interior.polygon.walls[i].reflects) wall.push_back(static_cast<int>(i));
  std::vector<Isometry> reflections;
  bool all_mirrors = true;
  for (const int w : wall) {
    reflections.push_back(room::reflection_in_wall(interior.polygon, w));
    all_mirrors = all_mirrors && mirrors.walls[static_cast<std::size_t>(w)];
  }
  const bool closed = interior.polygon.space == Space::spherical && all_mirrors;  // geodesics go on round the sphere
  const int half_turn = closed ? notation::longest_length(interior.polygon.orbifold).value() : 0;
  const cover::Automaton automaton(interior.polygon.orbifold, std::max(1, bounces));
  cover::enumerate(automaton, reflections, bounces, [&](const cover::Element& element, const Isometry& cover_from_room) {
    const int length = static_cast<int>(element.word.size());
    if (length > 0 && !mirrors.walls[static_cast<std::size_t>(wall[element.word.back()])]) return cover::Visit::prune;
    if (!visit({cover_from_room, length, 0, {}, false})) return cover::Visit::stop;
    for (int sheet = 1; closed && sheet * half_turn <= bounces; ++sheet) {
      const int more = sheet % 2 == 0 ? sheet * half_turn + length : (sheet + 1) * half_turn - length;
      if (more <= bounces && !visit({cover_from_room, more, sheet, {}, false})) return cover::Visit::stop;
    }
    return cover::Visit::descend;
  });
}

// Other rooms: every word of mirrors without the same letter twice in a row, from `at` on. Makes: false when `visit` has stopped.
bool visit_words(const place::Interior& interior, const MirroredSurfaces& mirrors, int bounces, const HorizontalImage& at,
                 const Visitor& visit) {
  if (!visit(at)) return false;
  if (at.bounces == bounces) return true;
  for (std::size_t w = 0; w < mirrors.walls.size(); ++w) {
    if (!mirrors.walls[w] || (!at.walls.empty() && at.walls.back() == static_cast<std::int16_t>(w))) continue;
    HorizontalImage next = at;
    next.cover_from_room = geometry::renormalised(next.cover_from_room * room::reflection_in_wall(interior.polygon, static_cast<int>(w)));
    next.walls.push_back(static_cast<std::int16_t>(w));
    ++next.bounces;
    if (!visit_words(interior, mirrors, bounces, next, visit)) return false;
  }
  return true;
}

std::vector<VerticalImage> vertical_images(const MirroredSurfaces& mirrors, double height, int bounces) {
  std::vector<VerticalImage> images{{}};
  for (const bool floor_first : {true, false}) {
    VerticalImage at;
    bool floor = floor_first;
    for (int k = 1; k <= bounces && (floor ? mirrors.floor : mirrors.ceiling); ++k) {
      // The k-th mirror lies in the cover where the k−1 mirrors before it have put it: its reflection is conjugated, which multiplies from
      // the right.
      const double shift = floor ? 0 : 2 * height;
      at = {-at.sign, at.sign * shift + at.shift, k};
      images.push_back(at);
      floor = !floor;
    }
  }
  return images;
}

trace::Direction image_of(const Isometry& map, const VerticalImage& vertical, const trace::Direction& d) {
  const double k = geometry::curvature(map.space),
               h = std::sqrt(std::max(0.0, d.floor.x * d.floor.x + d.floor.y * d.floor.y + k * d.floor.w * d.floor.w));
  if (h < 1e-12) return {{0, 0, 0}, vertical.sign * d.z};
  const geometry::Tangent t = map * geometry::Tangent(d.floor.w / h, d.floor.x / h, d.floor.y / h);
  return {h * t, vertical.sign * d.z};
}

Position image_of(const HorizontalImage& horizontal, const VerticalImage& vertical, const Position& p) {
  return {horizontal.cover_from_room * p.floor, vertical.sign * p.z + vertical.shift};
}

/// A room with all that the images of its lamps depend on.
struct ImageContext {
  const std::vector<PlacedLamp>& lamps;
  const place::Interior& interior;
  const ImageOptions& options;
  MirroredSurfaces mirrors;
};

double max_throughput(const ImageContext& context, const HorizontalImage& horizontal, const VerticalImage& vertical) {
  return math::pow(context.mirrors.max_throughput, horizontal.bounces + vertical.bounces);
}

/// The upper bound of what an image adds to any point of the room, white = 1. Infinite on S², where light rises again with distance and
/// images are few.
double most_in_room(const ImageContext& context, const PlacedLamp& lamp, const HorizontalImage& horizontal, const VerticalImage& vertical) {
  const Space space = context.interior.polygon.space;
  if (space == Space::spherical) return std::numeric_limits<double>::infinity();
  const Position centre = image_of(horizontal, vertical, lamp.centre);
  const double arc = std::max(0.0, geometry::distance(space, {}, centre.floor) - context.interior.polygon.circumradius);
  const double rise = std::max({0.0, -centre.z, centre.z - context.interior.height});
  return max_contribution(space, lamp, max_throughput(context, horizontal, vertical), context.options.exposure, math::hypot(arc, rise),
                          arc);
}

/// What an image adds in the middle of the room at normal incidence, white = 1: a measure of how bright the room is.
double at_middle_of_room(const ImageContext& context, const PlacedLamp& lamp, const HorizontalImage& horizontal,
                         const VerticalImage& vertical) {
  const Space space = context.interior.polygon.space;
  const Position centre = image_of(horizontal, vertical, lamp.centre);
  const double arc = geometry::distance(space, {}, centre.floor), height = context.interior.height;
  const double length = std::max(math::hypot(arc, centre.z - height / 2), height / 2);
  return max_contribution(space, lamp, max_throughput(context, horizontal, vertical), context.options.exposure, length, arc);
}

LampImage lamp_image(const ImageContext& context, int l, const HorizontalImage& horizontal, const VerticalImage& vertical) {
  const PlacedLamp& lamp = context.lamps[static_cast<std::size_t>(l)];
  LampImage image;
  image.lamp = l;
  image.bounces = horizontal.bounces + vertical.bounces;
  image.sheet = horizontal.sheet;
  image.walls = horizontal.walls;
  image.path_specific = horizontal.path_specific;
  image.max_throughput = max_throughput(context, horizontal, vertical);
  for (const Position& p : lamp.samples) image.samples.push_back(image_of(horizontal, vertical, p));
  for (const trace::Direction& axis : lamp.axes) image.axes.push_back(image_of(horizontal.cover_from_room, vertical, axis));
  image.hot_spots = lamp.hot_spots;
  for (HotSpot& spot : image.hot_spots) spot.at = image_of(horizontal, vertical, spot.at);
  return image;
}

/// Called with every image of every lamp; false stops the enumeration.
using ImageVisitor = std::function<bool(std::size_t lamp, const HorizontalImage&, const VerticalImage&)>;

void visit_images(const ImageContext& context, int bounces, const ImageVisitor& visit_image) {
  const std::vector<VerticalImage> verticals = vertical_images(context.mirrors, context.interior.height, bounces);
  const auto visit = [&](const HorizontalImage& horizontal) {
    for (std::size_t l = 0; l < context.lamps.size(); ++l)
      for (const VerticalImage& vertical : verticals)
        if (horizontal.bounces + vertical.bounces <= bounces && !visit_image(l, horizontal, vertical)) return false;
    return true;
  };
  if (notation::is_orbifold(context.interior.polygon.orbifold)) visit_group(context.interior, context.mirrors, bounces, visit);
  else visit_words(context.interior, context.mirrors, bounces, {geometry::identity(context.interior.polygon.space), 0, 0, {}, true}, visit);
}

/// What is known of the images before any is kept.
struct ImageSurvey {
  double faint_below = 0;     ///< as in LampImages
  std::vector<float> bounds;  ///< of the faint images, in their order
};

/// Nothing when there are too many images.
std::optional<ImageSurvey> survey_images(const ImageContext& context, int bounces) {
  const double most = context.options.faint_below;
  std::uint64_t visited = 0;
  double all = 0;
  std::vector<float> bounds;
  visit_images(context, bounces, [&](std::size_t l, const HorizontalImage& horizontal, const VerticalImage& vertical) {
    if (++visited > kMaxVisitedImages) return false;
    all += at_middle_of_room(context, context.lamps[l], horizontal, vertical);
    if (most > 0) bounds.push_back(static_cast<float>(most_in_room(context, context.lamps[l], horizontal, vertical)));
    return true;
  });
  if (visited > kMaxVisitedImages) return std::nullopt;
  ImageSurvey survey{std::min(most, kFaintShare * most * all), std::move(bounds)};
  const auto is_faint = [&](float bound) { return static_cast<double>(bound) < survey.faint_below; };
  if (visited - static_cast<std::uint64_t>(std::count_if(survey.bounds.begin(), survey.bounds.end(), is_faint)) > kMaxImages)
    return std::nullopt;
  survey.bounds.erase(std::remove_if(survey.bounds.begin(), survey.bounds.end(), [&](float b) { return !is_faint(b); }),
                      survey.bounds.end());
  return survey;
}

/// The factor c for which the probabilities min(1, c·bound) have the sum `count`. In: more bounds than that.
double probability_factor(const std::vector<float>& bounds, double count) {
  double sum = 0;
  for (const float b : bounds) sum += static_cast<double>(b);
  double factor = sum > 0 ? count / sum : 0;
  for (int i = 0; i < 20; ++i) {  // bounds are so even that a few rounds suffice
    double certain = 0, rest = 0;
    for (const float b : bounds) factor* static_cast<double>(b) >= 1 ? certain += 1 : rest += static_cast<double>(b);
    if (rest <= 0) break;
    factor = std::max(0.0, count - certain) / rest;
  }
  return factor;
}

/// The images over at most `bounces` mirrors; nothing when they are too many.
std::optional<LampImages> images_up_to(const ImageContext& context, int bounces) {
  const auto survey = survey_images(context, bounces);
  if (!survey) return std::nullopt;
  LampImages all{{}, {}, survey->faint_below};
  const bool draws = survey->bounds.size() > kMaxFaintImages;
  const double factor = draws ? probability_factor(survey->bounds, static_cast<double>(kMaxFaintImages)) : 0;
  double drawn = 0.5;
  visit_images(context, bounces, [&](std::size_t l, const HorizontalImage& horizontal, const VerticalImage& vertical) {
    const double bound = static_cast<double>(static_cast<float>(most_in_room(context, context.lamps[l], horizontal, vertical)));
    if (!(bound < survey->faint_below)) {
      all.images.push_back(lamp_image(context, static_cast<int>(l), horizontal, vertical));
      return true;
    }
    const double probability = draws ? std::min(1.0, factor * bound) : 1, before = std::floor(drawn);
    drawn += probability;
    if (std::floor(drawn) <= before) return true;
    LampImage image = lamp_image(context, static_cast<int>(l), horizontal, vertical);
    image.samples.resize(1);
    image.axes.resize(std::min<std::size_t>(image.axes.size(), 1));
    image.hot_spots.clear();
    image.multiplicity = 1 / probability;
    all.faint.push_back(std::move(image));
    return true;
  });
  return all;
}

}  // namespace

double max_contribution(Space space, const PlacedLamp& lamp, double throughput, double exposure, double length, double arc) {
  return max_channel(lamp.power) / std::numbers::pi * exposure * throughput * lamp.peak_intensity *
         falloff(lamp.falloff, space, std::max(length - lamp.extent, lamp.radius), arc, lamp.radius);
}

Result<LampImages> lamp_images(const std::vector<PlacedLamp>& lamps, const place::Interior& interior, const ImageOptions& options) {
  const ImageContext context{lamps, interior, options, mirrored_surfaces(interior)};
  if (auto images = images_up_to(context, options.bounces)) return std::move(*images);
  int fits = -1;
  while (fits + 1 < options.bounces && images_up_to(context, fits + 1)) ++fits;
  return make_error(
      "light.too-many-images",
      fmt::format(
          "over {} mirrors {} lamp{} of this scene {} too many images: more than {} would add light, or {} would have to be looked at",
          options.bounces, lamps.size(), lamps.size() == 1 ? "" : "s", lamps.size() == 1 ? "has" : "have", kMaxImages, kMaxVisitedImages),
      fits >= 0 ? fmt::format("`bake: {{mirrors: {}}}` has few enough", fits) : "use fewer lamps");
}

}  // namespace orbc::light
