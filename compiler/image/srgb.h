#pragma once
#include <cstdint>

namespace orbc::image {

// The transfer function of sRGB (IEC 61966-2-1), channel by channel, both ways. Linear values are relative to white = 1.

/// In: an encoded value; 0…1 is black to white. Makes: linear light; nothing is clamped.
[[nodiscard]] double decode_srgb(double encoded);
/// Makes: the encoded value, 0…1; linear light outside [0, 1] is clamped.
[[nodiscard]] double encode_srgb(double linear);

/// The nearest code of 8 bits: round(255·encode_srgb(linear)).
[[nodiscard]] std::uint8_t encode_srgb8(double linear);
/// The nearest code of 16 bits: round(65535·encode_srgb(linear)).
[[nodiscard]] std::uint16_t encode_srgb16(double linear);
/// Linear light of a code of 8 bits, from a table.
[[nodiscard]] double decode_srgb8(std::uint8_t code);
/// Linear light of a code of 16 bits.
[[nodiscard]] double decode_srgb16(std::uint16_t code);

}  // namespace orbc::image
