#pragma once
#include <array>
#include <vector>

#include "compiler/light/shade.h"
#include "compiler/surface/frame.h"

namespace orbc::light {

/// Where the brightest spots lie: below and above lamps, and beside them on plain walls. For every lamp, to be filled into HungLamp::feet.
[[nodiscard]] std::vector<Foot> feet_of(const HungLamp& lamp, const place::PlacedRoom& room);

/// How to ask for the light that comes to a matte point from all other surfaces: directions more often towards the bright spots around
/// lamps and their images in the mirrors, else by the cosine. Where light comes from is not decided by it, only where one looks: the mean
/// of weight × radiance is ∫ radiance·cosθ dω/π whatever the spots are.
/// Source: Veach, Robust Monte Carlo Methods (1997), §9.2, the one-sample mixture.
struct Guide {
  static constexpr int kMost = 24;
  struct Lobe {
    geometry::Vector3 axis;
    double cosine = 1;   ///< of half its opening
    double share = 0;    ///< of all directions
    double density = 0;  ///< share / its solid angle
  };
  std::array<Lobe, kMost> lobes;
  int count = 0;
  double by_cosine = 1;  ///< share of directions by the cosine alone
  surface::Frame frame;
  geometry::Vector3 normal, across, other;  ///< orthonormal, in the frame
  geometry::Vector3 flat;                   ///< the surface's true normal: no direction goes below it
};
[[nodiscard]] Guide guide_at(const LightField& field, const surface::LightPoint& point);

struct Chosen {
  trace::Direction direction;  ///< unit
  double weight = 0;           ///< cosθ/(π·density); 0: nothing comes from there
};
/// In: numbers in [0, 1).
[[nodiscard]] Chosen choose(const Guide& guide, const std::array<double, 3>& u);

}  // namespace orbc::light
