#include "compiler/driver/fingerprint.h"

namespace orbc::driver {
namespace {

/// Values without gaps between their members.
template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace

std::uint64_t checksum(std::string_view bytes, std::uint64_t before) {
  for (const char c : bytes) before = (before ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return before;
}

std::uint64_t fingerprint(const place::Interior& interior) {
  std::uint64_t sum = checksum({});
  for (const place::PlacedMesh& part : interior.parts) {
    sum = checksum(part.name, sum);
    sum = checksum(bytes_of(part.floor), sum);
    sum = checksum(bytes_of(part.z), sum);
    sum = checksum(bytes_of(part.triangles), sum);
    sum = checksum(bytes_of(part.uv), sum);
    sum = checksum(bytes_of(part.color), sum);
    sum = checksum(bytes_of(part.style), sum);
  }
  for (const image::Image& texture : interior.textures) sum = checksum(bytes_of(texture.rgba), sum);
  return sum;
}

}  // namespace orbc::driver
