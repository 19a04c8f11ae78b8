#pragma once
#include <cstdint>
#include <vector>

#include "compiler/light/lamp.h"

namespace orbc::light {

/// A mirror image of a lamp in the universal cover: where a path of light from the room would go to if no mirror turned it back.
struct LampImage {
  int lamp = 0;
  int bounces = 0;                          ///< mirrors on the way
  int sheet = 0;                            ///< S²: how many half turns the path makes beyond the nearest
  std::vector<std::int16_t> walls;          ///< the mirrors in order, without floor and ceiling; kept only where `exact`
  bool exact = false;                       ///< only the path over these very mirrors is this image's: rooms that are no orbifolds
  std::vector<geometry::Position> samples;  ///< of the lamp's samples
  std::vector<trace::Direction> axes;
  std::vector<Foot> feet;              ///< of the lamp's feet
  double weight = 1;                        ///< upper bound of the largest channel of a path's weight
};

struct ImageOptions {
  int bounces = 2;                          ///< mirrors on a path
  double exposure = 1;
  double cut = 0;                           ///< of white: images that add less anywhere in the room are left out; 0: none are
};
inline constexpr std::size_t kMostImages = 20'000;            ///< that are kept; about 2 kB each
inline constexpr std::uint64_t kMostConsidered = 4'000'000;   ///< that are looked at: about a second

/// The images of all lamps that paths of at most `bounces` mirrors can lead to.
/// Makes:       orbifolds: every copy once, by normal forms, copies behind walls without mirrors left out, on S² also those seen past the
///              antipode; floor and ceiling mirrors repeat them above and below. Other rooms: one image for every word of mirrors.
/// Diagnostics: light.too-many-images; the hint names the number of mirrors that fits.
/// Not promised: that a path arrives. Which do, and with which weight, the mirrors themselves say (trace::follow).
[[nodiscard]] Result<std::vector<LampImage>> lamp_images(const std::vector<HungLamp>& lamps, const place::PlacedRoom& room,
                                                         const ImageOptions& options = {});

/// The most that an image of that weight can add to a white surface so far away, white = 1.
[[nodiscard]] double at_most(geometry::Space space, const HungLamp& lamp, double weight, double exposure, double length, double arc);

}  // namespace orbc::light
