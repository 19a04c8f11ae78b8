// glTF 2.0 (Khronos specification 2.0.1) by tinygltf: nodes, triangle primitives, base colour. tinygltf parses; every index, offset and
// count of the model is checked here before a byte is read, since tinygltf leaves that to its callers. It touches the disk only
// through the callbacks below, which read nothing outside the folder of the file. Pictures are not decoded while it parses: it would hand
// over unchecked ranges of buffers.
#include "compiler/mesh/gltf.h"

#include <fmt/core.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>

#include "compiler/base/elementary.h"
#include "compiler/files/files.h"
#include "compiler/image/image.h"
#include "compiler/image_io/decode.h"
#include "compiler/mesh/sieve.h"
#include "compiler/mesh/weld.h"

namespace orbc::mesh {
namespace {

using geometry::Vector3;

/// What the callbacks know and take down.
struct Files {
  const std::string& name;
  const std::string& folder;
  std::uint64_t budget = 0;
  Diagnostics refused;
  std::map<int, std::string> pictures;  ///< encoded, of images that are not in a buffer
};

std::optional<std::string> path_of(Files& files, std::string_view reference) {
  while (reference.substr(0, 2) == "./") reference.remove_prefix(2);
  auto path = files::referred_path(reference, files.name, files.folder);
  const auto wrong = path ? files::check_file(*path, files.budget) : path.error();
  if (wrong.empty()) return *path;
  for (const auto& known : files.refused) {
    if (known.message == wrong.front().message) return {};
  }
  files.refused.push_back(wrong.front());
  return {};
}

tinygltf::FsCallbacks callbacks(Files& files) {
  tinygltf::FsCallbacks fs{};
  fs.user_data = &files;
  fs.FileExists = [](const std::string& path, void* data) { return path_of(*static_cast<Files*>(data), path).has_value(); };
  fs.ExpandFilePath = [](const std::string& path, void*) { return path; };
  fs.ReadWholeFile = [](std::vector<unsigned char>* out, std::string* error, const std::string& path, void* data) {
    auto& own = *static_cast<Files*>(data);
    const auto full = path_of(own, path);
    auto bytes = full ? files::read_file(*full, own.budget) : Result<std::string>(Diagnostics{});
    if (!bytes) return *error = "refused", false;
    own.budget -= bytes->size();
    out->assign(bytes->begin(), bytes->end());
    return true;
  };
  fs.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; };
  return fs;
}

bool keep_picture(tinygltf::Image* image, const int index, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
                  void* data) {
  // In a buffer: the range is not checked yet, so not touched; it is found again through image->bufferView.
  if (image->bufferView < 0 && size > 0)
    static_cast<Files*>(data)->pictures[index].assign(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  return true;
}

/// An affine map: columns of the linear part, and the translation.
struct Affine {
  Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, t{0, 0, 0};
  Vector3 linear(const Vector3& p) const { return p.x * x + p.y * y + p.z * z; }
  Vector3 operator()(const Vector3& p) const { return linear(p) + t; }
  Affine operator*(const Affine& b) const { return {linear(b.x), linear(b.y), linear(b.z), (*this)(b.t)}; }
  double determinant() const { return dot(x, cross(y, z)); }
};

Affine local_of(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    const auto& m = node.matrix;
    return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  }
  Affine local;
  if (node.rotation.size() == 4) {
    double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
    const double norm = std::sqrt(x * x + y * y + z * z + w * w);
    if (norm > 0) {
      x /= norm, y /= norm, z /= norm, w /= norm;
      local.x = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
      local.y = {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
      local.z = {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
    }
  }
  if (node.scale.size() == 3) local.x = node.scale[0] * local.x, local.y = node.scale[1] * local.y, local.z = node.scale[2] * local.z;
  if (node.translation.size() == 3) local.t = {node.translation[0], node.translation[1], node.translation[2]};
  return local;
}

/// Thrown inside this file only: ends the reading with a diagnostic.
struct Wrong {
  Diagnostic diagnostic;
};

class Reader {
 public:
  Reader(const tinygltf::Model& model, const Files& files, const LoadOptions& options) : model_(model), files_(files), options_(options) {}

  Loaded read() {
    check_extensions();
    walk();
    if (mesh_.triangles.empty()) fail("mesh.no-triangles", "there is no triangle in its scene");
    if (!has_uv_) mesh_.uv.clear();
    if (mesh_.looks.size() < 2) mesh_.material.clear();
    leave_out_unused(mesh_);
    if (!model_.skins.empty()) {
      loaded_.warnings.push_back(make_warning("mesh.ignored", files_.name + ": is posed by a skeleton; it is shown as it is stored"));
    }
    return std::move(loaded_);
  }

 private:
  [[noreturn]] void fail(const std::string& code, const std::string& what, const std::string& hint = {}) const {
    throw Wrong{make_error(code, fmt::format("{}: {}", files_.name, what), hint)};
  }

  void check_extensions() const {
    static const std::set<std::string> known = {
        "KHR_materials_unlit",        "KHR_mesh_quantization", "KHR_texture_transform",           "KHR_lights_punctual",
        "KHR_materials_specular",     "KHR_materials_ior",     "KHR_materials_clearcoat",         "KHR_materials_sheen",
        "KHR_materials_transmission", "KHR_materials_volume",  "KHR_materials_emissive_strength", "KHR_materials_variants"};
    for (const auto& extension : model_.extensionsRequired) {
      if (!known.count(extension)) fail("mesh.unsupported", "needs the glTF extension " + extension, "export it without compression");
    }
  }

  // ---- numbers ----------------------------------------------------------------------------------------------------------------

  /// The bytes of a buffer view from an offset on, at least `needed` of them.
  const unsigned char* range(int view, std::uint64_t offset, std::uint64_t needed, const std::string& what) const {
    if (view < 0 || static_cast<std::size_t>(view) >= model_.bufferViews.size())
      fail("mesh.bad-gltf", what + " uses a buffer view that is not there");
    const auto& v = model_.bufferViews[static_cast<std::size_t>(view)];
    if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= model_.buffers.size())
      fail("mesh.bad-gltf", what + " uses a buffer that is not there");
    const auto& data = model_.buffers[static_cast<std::size_t>(v.buffer)].data;
    const bool view_fits = v.byteOffset <= data.size() && v.byteLength <= data.size() - v.byteOffset;
    if (!view_fits || offset > v.byteLength || needed > v.byteLength - offset) {
      fail("mesh.bad-gltf", what + " reaches beyond the end of its buffer", "the file was cut off, or its exporter is broken");
    }
    return data.data() + v.byteOffset + offset;
  }

  static double component(const unsigned char* at, int type, bool normalized) {
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
  static std::uint64_t size_of(int type) {
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

  /// All numbers of an accessor, `width` for each element.
  std::vector<double> numbers(int index, int type, std::uint64_t width, const std::string& what) const {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size())
      fail("mesh.bad-gltf", what + " uses an accessor that is not there");
    const auto& a = model_.accessors[static_cast<std::size_t>(index)];
    const auto size = size_of(a.componentType);
    if (a.type != type || size == 0) fail("mesh.bad-gltf", what + " is of the wrong type");
    if (a.count > 3 * options_.max_triangles) throw Wrong{too_many(files_.name, "vertices", a.count, 3 * options_.max_triangles)};
    if (a.count == 0) return {};
    const std::uint64_t element = size * width;
    std::vector<double> values;
    if (a.bufferView >= 0) {
      std::uint64_t stride = element;
      if (static_cast<std::size_t>(a.bufferView) < model_.bufferViews.size() &&
          model_.bufferViews[static_cast<std::size_t>(a.bufferView)].byteStride != 0) {
        stride = model_.bufferViews[static_cast<std::size_t>(a.bufferView)].byteStride;
        if (stride > 65536) fail("mesh.bad-gltf", what + " has an absurd stride");
      }
      const auto* bytes = range(a.bufferView, a.byteOffset, stride * (a.count - 1) + element, what);
      values.resize(a.count * width);
      for (std::uint64_t i = 0; i < a.count; ++i) {
        for (std::uint64_t k = 0; k < width; ++k)
          values[i * width + k] = component(bytes + i * stride + k * size, a.componentType, a.normalized);
      }
    } else {
      values.resize(a.count * width);
    }
    if (a.sparse.isSparse) apply_sparse(a, width, values, what);
    return values;
  }
  void apply_sparse(const tinygltf::Accessor& a, std::uint64_t width, std::vector<double>& values, const std::string& what) const {
    const auto& s = a.sparse;
    if (s.count < 0 || static_cast<std::uint64_t>(s.count) > a.count || s.indices.byteOffset < 0 || s.values.byteOffset < 0) {
      fail("mesh.bad-gltf", what + " has a sparse part that is larger than itself");
    }
    const auto count = static_cast<std::uint64_t>(s.count), index_size = size_of(s.indices.componentType), size = size_of(a.componentType);
    if (index_size == 0) fail("mesh.bad-gltf", what + " has sparse indices of the wrong type");
    const auto* indices = range(s.indices.bufferView, static_cast<std::uint64_t>(s.indices.byteOffset), count * index_size, what);
    const auto* bytes = range(s.values.bufferView, static_cast<std::uint64_t>(s.values.byteOffset), count * size * width, what);
    for (std::uint64_t i = 0; i < count; ++i) {
      const double at = component(indices + i * index_size, s.indices.componentType, false);
      if (!(at >= 0 && at < static_cast<double>(a.count))) fail("mesh.bad-index", what + " has a sparse index out of range");
      for (std::uint64_t k = 0; k < width; ++k) {
        values[static_cast<std::uint64_t>(at) * width + k] = component(bytes + (i * width + k) * size, a.componentType, a.normalized);
      }
    }
  }

  // ---- the scene ----------------------------------------------------------------------------------------------------------------

  void walk() {
    std::vector<std::pair<int, Affine>> open;
    const auto count = model_.nodes.size();
    std::vector<char> seen(count, 0);
    if (!model_.scenes.empty()) {
      const auto scene =
          model_.defaultScene >= 0 && static_cast<std::size_t>(model_.defaultScene) < model_.scenes.size() ? model_.defaultScene : 0;
      for (const int root : model_.scenes[static_cast<std::size_t>(scene)].nodes) open.push_back({root, {}});
    } else {
      std::vector<char> is_child(count, 0);
      for (const auto& node : model_.nodes) {
        for (const int child : node.children) {
          if (child >= 0 && static_cast<std::size_t>(child) < count) is_child[static_cast<std::size_t>(child)] = 1;
        }
      }
      for (std::size_t i = 0; i < count; ++i) {
        if (!is_child[i]) open.push_back({static_cast<int>(i), {}});
      }
    }
    std::reverse(open.begin(), open.end());
    while (!open.empty()) {
      const auto [index, parent] = open.back();
      open.pop_back();
      if (index < 0 || static_cast<std::size_t>(index) >= count) fail("mesh.bad-gltf", fmt::format("node {} is not there", index));
      if (seen[static_cast<std::size_t>(index)]) fail("mesh.bad-gltf", fmt::format("node {} hangs in the tree more than once", index));
      seen[static_cast<std::size_t>(index)] = 1;
      const auto& node = model_.nodes[static_cast<std::size_t>(index)];
      const Affine scene_from_node = parent * local_of(node);
      if (node.mesh >= 0) {
        if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size())
          fail("mesh.bad-gltf", fmt::format("mesh {} is not there", node.mesh));
        const auto& primitives = model_.meshes[static_cast<std::size_t>(node.mesh)].primitives;
        for (std::size_t p = 0; p < primitives.size(); ++p)
          add(primitives[p], scene_from_node, fmt::format("mesh {}, primitive {}", node.mesh, p));
      }
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) open.push_back({*child, scene_from_node});
      if (open.size() > 4 * count + 16) fail("mesh.bad-gltf", "its nodes are no tree");
    }
  }

  void add(const tinygltf::Primitive& primitive, const Affine& map, const std::string& what) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN) return;
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return;  // allowed by the specification: drawn by an extension
    const auto xyz = numbers(position->second, TINYGLTF_TYPE_VEC3, 3, what + ": POSITION");
    const auto count = xyz.size() / 3;
    const auto base = mesh_.positions.size();
    if (base + count > 3 * options_.max_triangles) throw Wrong{too_many(files_.name, "vertices", base + count, 3 * options_.max_triangles)};
    for (std::size_t i = 0; i < count; ++i) {
      const auto p = map({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
      if (!(std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate && std::abs(p.z) <= kLargestCoordinate)) {
        throw Wrong{not_finite(files_.name, fmt::format("{}, vertex {}", what, i))};
      }
      mesh_.positions.push_back(p);
    }
    const auto look = look_of(primitive.material);
    add_uv(primitive, count, what);
    std::vector<double> indices;
    if (primitive.indices >= 0) indices = numbers(primitive.indices, TINYGLTF_TYPE_SCALAR, 1, what + ": indices");
    const std::size_t corners = primitive.indices >= 0 ? indices.size() : count;
    const auto vertex = [&](std::size_t c) {
      if (primitive.indices < 0) return static_cast<std::uint32_t>(base + c);
      if (!(indices[c] >= 0 && indices[c] < static_cast<double>(count))) {
        fail("mesh.bad-index", fmt::format("{} uses vertex {:g}, but there are only {}", what, indices[c], count));
      }
      return static_cast<std::uint32_t>(base + static_cast<std::size_t>(indices[c]));
    };
    const bool flip = map.determinant() < 0;
    const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    for (std::size_t c = 0; c + 2 < corners; c += step) {
      Triangle t{vertex(mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : c), vertex(c + 1), vertex(c + 2)};
      const bool odd = mode == TINYGLTF_MODE_TRIANGLE_STRIP && c % 2 == 1;
      if (odd != flip) std::swap(t[1], t[2]);
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      mesh_.triangles.push_back(t);
      mesh_.material.push_back(look);
      if (mesh_.triangles.size() > options_.max_triangles)
        throw Wrong{too_many(files_.name, "triangles or more", mesh_.triangles.size(), options_.max_triangles)};
    }
  }

  // ---- looks --------------------------------------------------------------------------------------------------------------------

  const tinygltf::TextureInfo* texture_info(int material) const {
    if (material < 0 || static_cast<std::size_t>(material) >= model_.materials.size()) return nullptr;
    const auto& info = model_.materials[static_cast<std::size_t>(material)].pbrMetallicRoughness.baseColorTexture;
    return info.index >= 0 ? &info : nullptr;
  }

  static double number(const tinygltf::Value& value, double otherwise) { return value.IsNumber() ? value.GetNumberAsDouble() : otherwise; }

  void add_uv(const tinygltf::Primitive& primitive, std::size_t count, const std::string& what) {
    const auto* info = texture_info(primitive.material);
    int set = info ? info->texCoord : 0;
    double offset[2] = {0, 0}, scale[2] = {1, 1}, turn = 0;
    if (info) {
      const auto found = info->extensions.find("KHR_texture_transform");
      if (found != info->extensions.end() && found->second.IsObject()) {
        const auto& transform = found->second;
        for (int k = 0; k < 2; ++k) {
          if (transform.Get("offset").IsArray()) offset[k] = number(transform.Get("offset").Get(k), 0);
          if (transform.Get("scale").IsArray()) scale[k] = number(transform.Get("scale").Get(k), 1);
        }
        turn = number(transform.Get("rotation"), 0);
        set = static_cast<int>(number(transform.Get("texCoord"), set));
      }
    }
    const auto found = primitive.attributes.find(fmt::format("TEXCOORD_{}", set));
    const auto base = mesh_.uv.size();
    mesh_.uv.resize(base + count, {0, 0});
    if (found == primitive.attributes.end()) return;
    const auto uv = numbers(found->second, TINYGLTF_TYPE_VEC2, 2, what + ": TEXCOORD");
    if (uv.size() != 2 * count) fail("mesh.bad-gltf", what + " has more or fewer texture coordinates than vertices");
    has_uv_ = true;
    const double c = math::cos(turn), s = math::sin(turn);
    for (std::size_t i = 0; i < count; ++i) {
      // KHR_texture_transform: translation · rotation · scale; v points down, so the rotation is written as below.
      const double u = scale[0] * uv[2 * i], v = scale[1] * uv[2 * i + 1];
      const double x = offset[0] + c * u + s * v, y = offset[1] - s * u + c * v;
      if (!(std::abs(x) <= 1e6 && std::abs(y) <= 1e6)) throw Wrong{not_finite(files_.name, what + ": TEXCOORD")};
      mesh_.uv[base + i] = {static_cast<float>(x), static_cast<float>(y)};
    }
  }

  std::uint8_t look_of(int material) {
    const auto known = looks_.find(material);
    if (known != looks_.end()) return known->second;
    Mesh::Look look;
    if (material >= 0) {
      if (static_cast<std::size_t>(material) >= model_.materials.size())
        fail("mesh.bad-gltf", fmt::format("material {} is not there", material));
      const auto& pbr = model_.materials[static_cast<std::size_t>(material)].pbrMetallicRoughness;
      look.color = {1, 1, 1};
      for (std::size_t k = 0; k < 3 && k < pbr.baseColorFactor.size(); ++k) {
        const double value = pbr.baseColorFactor[k];
        look.color[k] = value >= 0 && value <= 1 ? value : 1;
      }
      if (const auto* info = texture_info(material)) look.texture = texture_of(info->index);
      // Alpha is that of the texture times that of the factor.
      const auto& own = model_.materials[static_cast<std::size_t>(material)];
      const double factor = pbr.baseColorFactor.size() == 4 ? pbr.baseColorFactor[3] : 1;
      if (own.alphaMode == "MASK" && look.texture >= 0) look.cutoff = factor > 0 ? std::max(0.0, own.alphaCutoff / factor) : 2;
    }
    if (mesh_.looks.size() >= 256) {
      if (looks_.size() == 256) {
        loaded_.warnings.push_back(
            make_warning("mesh.too-many-looks", files_.name + ": more than 256 materials; the others look like the last one"));
      }
      return looks_[material] = 255;
    }
    mesh_.looks.push_back(look);
    return looks_[material] = static_cast<std::uint8_t>(mesh_.looks.size() - 1);
  }

  int texture_of(int texture) {
    if (static_cast<std::size_t>(texture) >= model_.textures.size()) fail("mesh.bad-gltf", fmt::format("texture {} is not there", texture));
    const int image = model_.textures[static_cast<std::size_t>(texture)].source;
    const auto known = images_.find(image);
    if (known != images_.end()) return known->second;
    auto picture = picture_of(image);
    if (!picture) {
      const auto& reason = picture.error().front();
      loaded_.warnings.push_back(
          make_warning("mesh.bad-texture", fmt::format("{}: a texture is left out: {}", files_.name, reason.message), reason.hint));
      return images_[image] = -1;
    }
    mesh_.textures.push_back(*std::move(picture));
    return images_[image] = static_cast<int>(mesh_.textures.size()) - 1;
  }

  Result<image::Image> picture_of(int index) const {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.images.size()) {
      return make_error("mesh.bad-texture", fmt::format("image {} is not there, or of a kind that is not read", index));
    }
    auto limits = options_.images;
    for (const auto& texture : mesh_.textures) limits.max_bytes -= std::min<std::uint64_t>(limits.max_bytes, texture.rgba.size());
    const auto& image = model_.images[static_cast<std::size_t>(index)];
    const auto what = fmt::format("image {}", index);
    if (image.bufferView >= 0) {
      if (static_cast<std::size_t>(image.bufferView) >= model_.bufferViews.size())
        fail("mesh.bad-gltf", what + " uses a buffer view that is not there");
      const auto size = model_.bufferViews[static_cast<std::size_t>(image.bufferView)].byteLength;
      const auto* bytes = range(image.bufferView, 0, size, what);
      return image_io::decode_image({reinterpret_cast<const char*>(bytes), size}, what, limits);
    }
    const auto found = files_.pictures.find(index);
    if (found != files_.pictures.end()) return image_io::decode_image(found->second, what, limits);
    if (!files_.refused.empty()) return files_.refused.front();
    return make_error("mesh.bad-texture", what + " is empty");
  }

  const tinygltf::Model& model_;
  const Files& files_;
  const LoadOptions& options_;
  Loaded loaded_;
  Mesh& mesh_ = loaded_.mesh;
  std::map<int, std::uint8_t> looks_;
  std::map<int, int> images_;
  bool has_uv_ = false;
};

std::string first_line(std::string text) {
  std::string shown;
  for (const char c : text.substr(0, 300)) {
    if (c == '\n') break;
    shown += c >= 32 && c < 127 ? c : '?';
  }
  return shown.empty() ? "it is not glTF" : shown;
}

}  // namespace

Result<Loaded> read_gltf(std::string_view bytes, bool binary, const std::string& name, const std::string& folder,
                         const LoadOptions& options) {
  if (auto wrong = scan_gltf(bytes, binary, name, options); !wrong.empty()) return wrong;
  Files files{name, folder, options.max_file_bytes, {}, {}};
  try {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(&keep_picture, &files);
    loader.SetFsCallbacks(callbacks(files));
    tinygltf::Model model;
    std::string error, warning;
    const auto size = static_cast<unsigned int>(bytes.size());
    const bool done =
        binary ? loader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()), size, "")
               : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "");
    if (!done) {
      if (!files.refused.empty()) return files.refused;
      return make_error("mesh.bad-gltf", fmt::format("{}: {}", name, first_line(error)), "check it with the Khronos glTF validator");
    }
    return Reader(model, files, options).read();
  } catch (const Wrong& wrong) {
    return wrong.diagnostic;
  } catch (const std::exception& thrown) {
    return make_error("mesh.bad-gltf", fmt::format("{}: {}", name, first_line(thrown.what())), "check it with the Khronos glTF validator");
  }
}

}  // namespace orbc::mesh
