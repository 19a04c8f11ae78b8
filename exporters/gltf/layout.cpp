// The binary chunk is written once, front to back, through a block that stays in the cache: no zeroing, no second copy of 100 MB.
#include "exporters/gltf/layout.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "compiler/base/check.h"

namespace orbc::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian; so is the memory this is copied from");

constexpr std::size_t kBlock = 4096;  // vertices or indices converted at a time: 48 KiB, stays in L1/L2

std::array<float, 3> gltf_from_eye(const std::array<float, 3>& p) { return {p[0], p[2], -p[1]}; }

void measure(const driver::Product& product, Part& part) {
  part.low.fill(std::numeric_limits<float>::infinity());
  part.high.fill(-std::numeric_limits<float>::infinity());
  float poison = 0;  // NaN as soon as one coordinate is not finite
  for (std::size_t i = part.first_vertex; i < part.first_vertex + part.vertex_count; ++i) {
    const std::array<float, 3> p = gltf_from_eye(product.positions[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      part.low[k] = std::min(part.low[k], p[k]);
      part.high[k] = std::max(part.high[k], p[k]);
      poison += p[k] * 0.0f;
    }
    poison += (product.uv[i][0] + product.uv[i][1]) * 0.0f;
  }
  ORBC_CHECK(poison, ==, 0.0f);
}

/// Runs of copies that have something to draw and whose arrays follow one another.
std::vector<Part> make_parts(const driver::Product& product, bool part_per_copy) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < product.copies.size(); ++i) {
    const driver::ProductCopy& copy = product.copies[i];
    if (copy.vertex_count == 0 || copy.index_count == 0) continue;
    ORBC_CHECK(copy.first_vertex + copy.vertex_count, <=, product.positions.size());
    ORBC_CHECK(copy.first_index + copy.index_count, <=, product.indices.size());
    ORBC_CHECK(copy.index_count % 3, ==, 0u);
    const bool glows = !product.native || copy.shading != native_lights::Shading::lit;
    if (!part_per_copy && !parts.empty() && parts.back().glows == glows && parts.back().object == copy.object) {
      Part& last = parts.back();
      if (last.first_vertex + last.vertex_count == copy.first_vertex && last.first_index + last.index_count == copy.first_index) {
        last.copy_count = i + 1 - last.first_copy;
        last.vertex_count += copy.vertex_count;
        last.index_count += copy.index_count;
        continue;
      }
    }
    Part part;
    part.first_copy = i, part.copy_count = 1;
    part.glows = glows;
    part.object = copy.object;
    part.first_vertex = copy.first_vertex, part.vertex_count = copy.vertex_count;
    part.first_index = copy.first_index, part.index_count = copy.index_count;
    parts.push_back(part);
  }
  return parts;
}

std::size_t aligned(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

std::array<std::uint16_t, 4> quantised(const scene::Color& tint) {
  const auto channel = [](double v) { return static_cast<std::uint16_t>(std::lround(std::clamp(v, 0.0, 1.0) * 65535)); };
  return {channel(tint.r), channel(tint.g), channel(tint.b), 65535};
}

template <class T>
void append(std::string& out, const T* values, std::size_t count) {
  out.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

void append_vectors(const std::vector<std::array<float, 3>>& vectors, const Part& part, std::string& out) {
  std::array<float, 3> block[kBlock];
  for (std::size_t done = 0; done < part.vertex_count; done += kBlock) {
    const std::size_t n = std::min(kBlock, part.vertex_count - done);
    for (std::size_t i = 0; i < n; ++i) block[i] = gltf_from_eye(vectors[part.first_vertex + done + i]);
    append(out, block, n);
  }
}

template <class Index>
void append_indices(const driver::Product& product, const Part& part, std::string& out) {
  Index block[kBlock];
  for (std::size_t done = 0; done < part.index_count; done += kBlock) {
    const std::size_t n = std::min(kBlock, part.index_count - done);
    const std::uint32_t* source = product.indices.data() + part.first_index + done;
    std::size_t largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t index = source[i] - part.first_vertex;  // wraps below first_vertex, and is caught too
      largest = std::max(largest, index);
      block[i] = static_cast<Index>(index);
    }
    ORBC_CHECK(largest, <, part.vertex_count);
    append(out, block, n);
  }
  out.append(aligned(part.index_count * sizeof(Index)) - part.index_count * sizeof(Index), '\0');
}

}  // namespace

Layout make_layout(const driver::Product& product, bool part_per_copy, std::size_t atlas_bytes) {
  Layout layout;
  layout.parts = make_parts(product, part_per_copy);
  layout.has_uv = !product.atlas.rgba.empty();
  layout.has_color = !part_per_copy;
  layout.has_normals = !product.normals.empty();
  std::size_t vertices = 0;
  for (Part& part : layout.parts) {
    measure(product, part);
    part.index_bytes = part.vertex_count <= 65535 ? 2 : 4;
    part.position_at = part.normal_at = 12 * vertices;
    part.uv_at = 8 * vertices;
    part.color_at = 8 * vertices;
    vertices += part.vertex_count;
    part.index_at = layout.index_bytes;
    layout.index_bytes += aligned(part.index_count * static_cast<std::size_t>(part.index_bytes));
  }
  std::size_t at = layout.position_bytes = 12 * vertices;
  layout.normal_at = at;
  at += layout.normal_bytes = layout.has_normals ? 12 * vertices : 0;
  layout.uv_at = at;
  at += layout.uv_bytes = layout.has_uv ? 8 * vertices : 0;
  layout.color_at = at;
  at += layout.color_bytes = layout.has_color ? 8 * vertices : 0;
  layout.index_at = at;
  at += layout.index_bytes;
  layout.atlas_at = at;
  layout.atlas_bytes = atlas_bytes;
  layout.total_bytes = at + aligned(atlas_bytes);
  return layout;
}

void append_geometry(const driver::Product& product, const Layout& layout, std::string& out) {
  for (const Part& part : layout.parts) append_vectors(product.positions, part, out);
  if (layout.has_normals)
    for (const Part& part : layout.parts) append_vectors(product.normals, part, out);
  if (layout.has_uv)
    for (const Part& part : layout.parts) append(out, product.uv.data() + part.first_vertex, part.vertex_count);
  if (layout.has_color) {
    for (const Part& part : layout.parts) {
      for (std::size_t c = part.first_copy; c < part.first_copy + part.copy_count; ++c) {
        const driver::ProductCopy& copy = product.copies[c];
        if (copy.vertex_count == 0 || copy.index_count == 0) continue;
        std::array<std::uint16_t, 4> block[kBlock];
        std::fill(block, block + std::min(kBlock, copy.vertex_count), quantised(part.glows ? copy.weight : scene::Color{1, 1, 1}));
        for (std::size_t done = 0; done < copy.vertex_count; done += kBlock) append(out, block, std::min(kBlock, copy.vertex_count - done));
      }
    }
  }
  for (const Part& part : layout.parts) {
    if (part.index_bytes == 2) append_indices<std::uint16_t>(product, part, out);
    else append_indices<std::uint32_t>(product, part, out);
  }
}

}  // namespace orbc::gltf
