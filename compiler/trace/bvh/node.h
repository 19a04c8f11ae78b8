#pragma once
#include <cstdint>

namespace orbc::trace {

/// A node with eight children, boxes in (ξ, η, z), as a structure of arrays. bounds[axis][0] are the lower and bounds[axis][1] the upper
/// planes, rounded outwards. child is the index of a node, or kBlockFlag | index of a block; unused children have an empty box.
struct alignas(32) Node8 {
  float bounds[3][2][8];
  std::uint32_t child[8];
};
static_assert(sizeof(Node8) == 224);

inline constexpr std::uint32_t kBlockFlag = 0x80000000u;
/// An empty box has the lower planes kEmptyBound and the upper planes −kEmptyBound. It is finite, so that 0·kEmptyBound is no NaN.
inline constexpr float kEmptyBound = 1e30f;

/// A leaf of eight triangles in chart coordinates, as a structure of arrays: per corner the gnomonic coordinates, z/w and 1/w (w of the
/// chart). Unused lanes lie far outside of the chart and have triangle = kNoTriangle.
struct alignas(32) Block8 {
  float x[3][8], y[3][8];
  float z_by_w[3][8], by_w[3][8];
  float size[8];  ///< largest difference of two corners, in the chart or in z
  std::uint32_t triangle[8];
};
static_assert(sizeof(Block8) == 448);

inline constexpr std::uint32_t kNoTriangle = ~0u;
inline constexpr int kMaxTreeDepth = 72;  ///< the builder splits at the median when SAH would go deeper than half of this

}  // namespace orbc::trace
