#pragma once
#include <cstdint>

namespace orbc::trace {

/// Eight boxes, chart × chart × height, side by side: bounds[axis][0] the lower, [1] the upper planes, rounded outwards.
/// child: index of a node, or kBlock | index of a block; unused ones have an empty box.
struct alignas(32) Node8 {
  float bounds[3][2][8];
  std::uint32_t child[8];
};
static_assert(sizeof(Node8) == 224);

inline constexpr std::uint32_t kBlock = 0x80000000u;
inline constexpr float kNever = 1e30f;  ///< an empty box: lower planes here, upper planes at −kNever (finite: 0·kNever is no NaN)

/// Eight triangles side by side, as seen in the chart: per corner the gnomonic coordinates, z/w and 1/w (w of the chart).
/// Unused lanes lie far outside and have triangle = kNone.
struct alignas(32) Block8 {
  float x[3][8], y[3][8];
  float z_by_w[3][8], by_w[3][8];
  float size[8];                    ///< largest difference of two corners, in the chart or in z
  std::uint32_t triangle[8];
};
static_assert(sizeof(Block8) == 448);

inline constexpr std::uint32_t kNone = ~0u;
inline constexpr int kDeepest = 72;        ///< levels of a tree; the builder halves by count when SAH would go deeper than half of it

}  // namespace orbc::trace
