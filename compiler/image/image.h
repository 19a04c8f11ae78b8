#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace orbc::image {

/// A picture of 8 bits a channel: sRGB-encoded red, green and blue, and alpha; width × height × 4 bytes, rows from top to bottom.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// A picture of 16 bits a channel, for places where 8 bits would show bands: sRGB-encoded red, green and blue; width × height × 3 values,
/// rows from top to bottom.
struct Image16 {
  int width = 0, height = 0;
  std::vector<std::uint16_t> rgb;
};

/// A picture of named channels of floating-point numbers, as OpenEXR has them; width × height values each, rows from top to bottom.
struct FloatImage {
  int width = 0, height = 0;
  std::map<std::string, std::vector<float>> channels;
};

}  // namespace orbc::image
