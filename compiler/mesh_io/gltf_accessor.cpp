// Numbers of a glTF file. tinygltf leaves it to its callers to check indices, offsets and counts: that is done here before a byte is read.
#include "compiler/mesh_io/gltf_accessor.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "compiler/mesh_io/errors.h"

namespace orbc::mesh_io {
namespace {

constexpr std::uint64_t kMaxStrideBytes = 65'536;

double component(const unsigned char* at, int type, bool normalized) {
  const auto get = [at](auto value) {
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return normalized ? std::max(get(std::int8_t{}) / 127, -1.0) : get(std::int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return get(std::uint8_t{}) / (normalized ? 255 : 1);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return normalized ? std::max(get(std::int16_t{}) / 32767, -1.0) : get(std::int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return get(std::uint16_t{}) / (normalized ? 65535 : 1);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return get(std::uint32_t{});
    default:
      return get(float{});
  }
}

/// Bytes of a component; 0 for a type that glTF has not.
std::uint64_t size_of_component(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

void read_dense(const GltfSource& source, const tinygltf::Accessor& a, std::uint64_t width, std::vector<double>& values,
                const std::string& what) {
  const auto size = size_of_component(a.componentType);
  const std::uint64_t element = size * width;
  std::uint64_t stride = element;
  const auto& views = source.model.bufferViews;
  if (static_cast<std::size_t>(a.bufferView) < views.size() && views[static_cast<std::size_t>(a.bufferView)].byteStride != 0) {
    stride = views[static_cast<std::size_t>(a.bufferView)].byteStride;
    if (stride > kMaxStrideBytes) source.fail("mesh.bad-gltf", what + " has an absurd stride");
  }
  const auto* bytes = bytes_of_view(source, a.bufferView, a.byteOffset, stride * (a.count - 1) + element, what);
  for (std::uint64_t i = 0; i < a.count; ++i) {
    for (std::uint64_t k = 0; k < width; ++k)
      values[i * width + k] = component(bytes + i * stride + k * size, a.componentType, a.normalized);
  }
}

void apply_sparse(const GltfSource& source, const tinygltf::Accessor& a, std::uint64_t width, std::vector<double>& values,
                  const std::string& what) {
  const auto& s = a.sparse;
  if (s.count < 0 || static_cast<std::uint64_t>(s.count) > a.count || s.indices.byteOffset < 0 || s.values.byteOffset < 0)
    source.fail("mesh.bad-gltf", what + " has a sparse part that is larger than itself");
  const auto count = static_cast<std::uint64_t>(s.count), index_size = size_of_component(s.indices.componentType),
             size = size_of_component(a.componentType);
  if (index_size == 0) source.fail("mesh.bad-gltf", what + " has sparse indices of the wrong type");
  const auto* indices =
      bytes_of_view(source, s.indices.bufferView, static_cast<std::uint64_t>(s.indices.byteOffset), count * index_size, what);
  const auto* bytes =
      bytes_of_view(source, s.values.bufferView, static_cast<std::uint64_t>(s.values.byteOffset), count * size * width, what);
  for (std::uint64_t i = 0; i < count; ++i) {
    const double at = component(indices + i * index_size, s.indices.componentType, false);
    if (!(at >= 0 && at < static_cast<double>(a.count))) source.fail("mesh.bad-index", what + " has a sparse index out of range");
    for (std::uint64_t k = 0; k < width; ++k)
      values[static_cast<std::uint64_t>(at) * width + k] = component(bytes + (i * width + k) * size, a.componentType, a.normalized);
  }
}

}  // namespace

void GltfSource::fail(const std::string& code, const std::string& what, const std::string& hint) const {
  throw GltfError{make_error(code, fmt::format("{}: {}", context.name, what), hint)};
}

const unsigned char* bytes_of_view(const GltfSource& source, int view, std::uint64_t offset, std::uint64_t needed,
                                   const std::string& what) {
  const auto& v = entry(source, source.model.bufferViews, view, what + ": its buffer view");
  const auto& data = entry(source, source.model.buffers, v.buffer, what + ": its buffer").data;
  const bool view_fits = v.byteOffset <= data.size() && v.byteLength <= data.size() - v.byteOffset;
  if (!view_fits || offset > v.byteLength || needed > v.byteLength - offset)
    source.fail("mesh.bad-gltf", what + " reaches beyond the end of its buffer", "the file was cut off, or its exporter is broken");
  return data.data() + v.byteOffset + offset;
}

std::vector<double> numbers_of_accessor(const GltfSource& source, int accessor, AccessorShape shape, const std::string& what) {
  const auto& a = entry(source, source.model.accessors, accessor, what + ": its accessor");
  if (a.type != shape.type || size_of_component(a.componentType) == 0) source.fail("mesh.bad-gltf", what + " is of the wrong type");
  const auto max_count = 3 * source.context.options.max_triangles;
  if (a.count > max_count) throw GltfError{too_many(source.context.name, "vertices", a.count, max_count)};
  if (a.count == 0) return {};
  std::vector<double> values(a.count * shape.width);
  if (a.bufferView >= 0) read_dense(source, a, shape.width, values, what);
  if (a.sparse.isSparse) apply_sparse(source, a, shape.width, values, what);
  return values;
}

}  // namespace orbc::mesh_io
