// libFuzzer: any bytes are a mesh or a diagnostic. The first byte chooses the format, so that one corpus serves all.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "compiler/image_io/decode.h"
#include "compiler/mesh/analyse.h"
#include "compiler/mesh_io/load.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orbc::mesh_io;
  if (size < 1) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  LoadOptions options;
  options.max_triangles = 100'000;
  options.images.max_bytes = 1 << 20;
  if (data[0] % 7 == 6) {
    const auto image = orbc::image_io::decode_image(bytes, "fuzz", options.images);
    if (image && image->rgba.size() != std::size_t{4} * static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height))
      std::abort();
    return 0;
  }
  const auto loaded = load_mesh_bytes(bytes, static_cast<Format>(data[0] % 7), "fuzz", "", options);
  if (!loaded) {
    if (loaded.error().empty() || loaded.error().front().code.rfind("mesh.", 0) != 0) std::abort();
    return 0;
  }
  const auto& mesh = loaded->mesh;
  for (const auto& t : mesh.triangles) {
    for (const auto v : t) {
      if (v >= mesh.positions.size()) std::abort();
    }
  }
  for (const auto& p : mesh.positions) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) std::abort();
  }
  if (!mesh.uv.empty() && mesh.uv.size() != mesh.positions.size()) std::abort();
  if (!mesh.triangle_material.empty() && mesh.triangle_material.size() != mesh.triangles.size()) std::abort();
  (void)orbc::mesh::analyse(mesh);
  return 0;
}
