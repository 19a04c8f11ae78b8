#include "compiler/bake/patch_places.h"

namespace orbc::bake {

std::vector<std::size_t> first_vertices(const std::vector<TexelPatch>& patches) {
  std::vector<std::size_t> first(patches.size() + 1, 0);
  for (std::size_t i = 0; i < patches.size(); ++i) first[i + 1] = first[i] + (patches[i].second < 0 ? 3 : 4);
  return first;
}

void place_patch(std::vector<std::array<float, 2>>& uv, const TexelPatch& patch, std::size_t v, const TexelRect& rect,
                 const PackedRects& packed) {
  const auto place = [&](double x, double y) {
    return std::array<float, 2>{static_cast<float>(x / packed.width), static_cast<float>(y / packed.height)};
  };
  const double x0 = rect.x + 0.5, y0 = rect.y + 0.5, x1 = rect.x + rect.width - 0.5, y1 = rect.y + rect.height - 0.5;
  uv[v] = place(x0, y0);
  uv[v + 1] = place(x1, y0);
  uv[v + 2] = place(x0, y1);
  if (patch.second >= 0) uv[v + 3] = place(x1, y1);
}

std::vector<std::array<float, 2>> rescale_uv(std::vector<std::array<float, 2>> uv, double u, double v) {
  for (auto& at : uv) at = {static_cast<float>(u * static_cast<double>(at[0])), static_cast<float>(v * static_cast<double>(at[1]))};
  return uv;
}

}  // namespace orbc::bake
