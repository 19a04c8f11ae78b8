#pragma once
// The kernel of log_map_simd.cpp for one point, without vector instructions: the same operations in the same order, hence the same bits.
// For processors and browsers without vector instructions.
#include <cmath>
#include <cstdint>
#include <cstring>

namespace orbc::bend {

inline float asinh_plain(float rho, float w) {
  const float e = rho + w;
  const bool direct = e < 2.82842712f;
  std::int32_t bits = 0;
  std::memcpy(&bits, &e, 4);
  bits -= 0x3f3504f3;
  const float k = direct ? 0 : static_cast<float>(bits >> 23);
  const std::int32_t m_bits = (bits & 0x007fffff) + 0x3f3504f3;
  float m = 0;
  std::memcpy(&m, &m_bits, 4);
  const float s = (direct ? rho : m - 1) / ((direct ? w : m) + 1), y = s * s;
  const float series =
      ((((0.29407531f * y + 0.141076148f) * y + 0.2273283f) * y + 0.285432875f) * y + 0.400005579f) * y + 0.666666627f;
  return k * 0.693359375f + ((s + s) + (s * y * series + k * -2.12194440e-4f));
}

inline float atan2_plain(float rho, float w) {
  const float aw = std::fabs(w), small = rho < aw ? rho : aw, big = rho > aw ? rho : aw;
  const bool beyond = small > big * 0.414213562f;
  const float t = (beyond ? small - big : small) / (beyond ? small + big : big), y = t * t;
  const float series = (((-0.0645171851f * y + 0.107436687f) * y - 0.142639503f) * y + 0.199995399f) * y - 0.333333313f;
  float angle = t * y * series + t;
  angle = angle + (beyond ? 0.785398163f : 0.0f);
  if (rho > aw) angle = (1.57079637f - angle) + -4.37113883e-8f;
  return w < 0 ? (3.14159274f - angle) + -8.74227766e-8f : angle;
}

/// Kernel. In: the matrix row by row; `base`, the distance at which the sheet begins, negative where the image lies in the opposite
/// direction.
inline void bend_one(int curvature, const double* m, float base, double w, double x, double y, float z, float* out) {
  const auto row = [&](int i) { return static_cast<float>(m[i] * w + (m[i + 1] * x + m[i + 2] * y)); };
  const float u = row(3), v = row(6), rho2 = u * u + v * v, rho = std::sqrt(rho2);
  float factor = 1;
  if (curvature != 0 && !(rho2 < 1e-30f))
    factor = (curvature < 0 ? asinh_plain(rho, std::sqrt(1 + rho2)) : base + atan2_plain(rho, row(0))) / rho;
  out[0] = u * factor;
  out[1] = v * factor;
  out[2] = z;
}

}  // namespace orbc::bend
