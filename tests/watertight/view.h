#pragma once
#include <random>
#include <string>
#include <vector>

#include "compiler/driver/compile.h"
#include "compiler/trace/follow.h"

namespace orbc::test {

/// A scene loaded once, to be looked at from many eyes.
driver::LoadedScene open_or_fail(const std::string& path);

/// Puts the eye anywhere in the room where it is not inside an object, looking anywhere; the head upright or tilted.
void move_eye(driver::LoadedScene& loaded, std::mt19937& random, int width, int height);

/// Which pixels' centres see a triangle of the product: counts triangles whose three signed volumes do not exclude the ray, so that a ray
/// through a shared edge is always counted by one of its two triangles, in exact agreement of their signs.
std::vector<bool> covered(const driver::Product& product);

/// What the pixels' centres see of it: linear colours, from the atlas (nearest texel) times the copy's weight; the background where
/// there is no triangle.
std::vector<scene::Color> picture(const driver::Product& product);

/// Of the pixels that see none, those where the mirrors themselves lead to something, at the pixel's centre and around it: holes.
struct Holes {
  int open = 0;    ///< pixels without a triangle
  int wrong = 0;   ///< of these, where the tracer sees something
  std::string first;
};
Holes holes(const driver::LoadedScene& loaded, const driver::Product& product, const trace::TraceScene& scene);

/// Vertices that lie within an edge of the same copy which belongs to one triangle only, but for edges on the borders of wedges.
struct Seams {
  int edges = 0, torn = 0;
  std::string first;
};
Seams seams(const driver::Product& product, const std::vector<cover::Copy>& copies);

}  // namespace orbc::test
