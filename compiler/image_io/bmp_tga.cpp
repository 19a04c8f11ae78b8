// BMP and TGA by stb_image, as Debian keeps it.
#include "compiler/image_io/bmp_tga.h"

#include <cstdint>
#include <memory>

#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace orbc::image_io {

bool is_bmp_or_tga(std::string_view bytes, const std::string& name) {
  constexpr std::string_view kFooter = "TRUEVISION-XFILE.";
  if (bytes.substr(0, 2) == "BM") return true;
  if (bytes.size() > 44 && bytes.substr(bytes.size() - 18, kFooter.size()) == kFooter) return true;
  const std::string ending = name.size() < 4 ? "" : name.substr(name.size() - 4);
  return ending == ".tga" || ending == ".TGA" || ending == ".Tga";
}

Result<image::Image> decode_bmp_or_tga(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());  // files are read up to 1 GiB
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels) || width < 0 || height < 0)
    return bad_image(name, "the BMP or TGA picture is damaged");
  if (auto wrong = check_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), name, limits); !wrong.empty())
    return wrong;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(stbi_load_from_memory(data, size, &width, &height, &channels, 4),
                                                                    &stbi_image_free);
  if (!pixels) return bad_image(name, "the BMP or TGA picture is damaged");
  const std::size_t count = std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return image::Image{width, height, std::vector<std::uint8_t>(pixels.get(), pixels.get() + count)};
}

}  // namespace orbc::image_io
