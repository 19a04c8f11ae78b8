#pragma once
#include <cstdint>
#include <vector>

#include "compiler/light/lamp.h"

namespace orbc::light {

/// A mirror image of a lamp in the universal cover. The geodesic from a point of the room to the image is the unfolded path of light.
struct LampImage {
  int lamp = 0;                             ///< index of the lamp
  int bounces = 0;                          ///< mirrors on the path
  int sheet = 0;                            ///< S²: half turns of the path beyond the shortest geodesic
  std::vector<std::int16_t> walls;          ///< the mirrors of the path in order, without floor and ceiling; empty unless `path_specific`
  bool path_specific = false;               ///< only the path over exactly these mirrors counts: in rooms that are no orbifolds
  std::vector<geometry::Position> samples;  ///< images of the lamp's samples
  std::vector<trace::Direction> axes;       ///< images of the lamp's axes
  std::vector<HotSpot> hot_spots;           ///< images of the lamp's hot spots
  double max_throughput = 1;                ///< upper bound of the largest channel of a path's throughput
  double multiplicity = 1;                  ///< faint images: how many this one stands for
};

struct ImageOptions {
  int bounces = 2;  ///< most mirrors on a path
  double exposure = 1;
  double faint_below = 0;  ///< white = 1: images that add less at every point of the room are faint; 0: none are
};
inline constexpr std::size_t kMaxImages = 20'000;              ///< images that are not faint, 8 kB each
inline constexpr std::size_t kMaxFaintImages = 1024;           ///< of more than these, some stand for many
inline constexpr std::uint64_t kMaxVisitedImages = 4'000'000;  ///< images that are considered, which takes about a second

/// The images of all lamps.
struct LampImages {
  std::vector<LampImage> images;
  std::vector<LampImage> faint;  ///< reduced to their centres: each adds next to nothing, but there may be many
  double faint_below = 0;        ///< white = 1: what separates the two, at most that of the options
};

/// Finds the images of all lamps over paths of at most `bounces` mirrors.
/// Makes:        in orbifolds every copy of the room once (by normal forms), without copies behind walls that have no mirror; on S² also
///               the images seen past the antipode. Mirrors on floor and ceiling repeat the images vertically. In other rooms one image
///               for every word of mirrors. None is left out. In dim rooms images are faint in proportion to the light of all. Of many
///               faint images kMaxFaintImages are drawn in the order of their words, with probabilities in proportion to their upper
///               bounds, and count for as many as the inverse of that (systematic sampling: Madow, Annals of Math. Statistics 20, 1949).
/// Diagnostics:  light.too-many-images; the hint names the largest number of mirrors that is possible.
/// Not promised: that light arrives over a path. trace::follow decides that, and with which throughput.
[[nodiscard]] Result<LampImages> lamp_images(const std::vector<PlacedLamp>& lamps, const place::Interior& interior,
                                             const ImageOptions& options = {});

/// Upper bound of the radiance that an image adds to a white surface, white = 1.
/// In: the path's throughput, its length, and the length of its floor geodesic (`arc`).
[[nodiscard]] double max_contribution(geometry::Space space, const PlacedLamp& lamp, double throughput, double exposure, double length,
                                      double arc);

}  // namespace orbc::light
