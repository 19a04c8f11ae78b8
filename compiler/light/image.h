#pragma once
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

/// The images of all lamps that paths of at most `bounces` mirrors can lead to.
/// Makes: orbifolds: every copy once, by normal forms, copies behind walls without mirrors left out, on S² also those seen past the
///        antipode; floor and ceiling
///        mirrors repeat them above and below. Other rooms: one image for every word of mirrors.
/// Not promised: that a path arrives. Which do, and with which weight, the mirrors themselves say (trace::follow).
[[nodiscard]] std::vector<LampImage> lamp_images(const std::vector<HungLamp>& lamps, const place::PlacedRoom& room, int bounces);

}  // namespace orbc::light
