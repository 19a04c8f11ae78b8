// Triangle primitives of glTF (specification 2.0.1, section 3.7.2). Points and lines are passed over.
#include "compiler/mesh_io/gltf_primitives.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "compiler/base/elementary.h"
#include "compiler/mesh_io/errors.h"

namespace orbc::mesh_io {
namespace {

using geometry::Vector3;
using mesh::Mesh;
using mesh::Triangle;

/// A primitive on its way into the mesh.
struct PrimitiveTask {
  const tinygltf::Primitive& primitive;
  const MeshInstance& instance;
  std::string what;       ///< what messages call it
  std::size_t base = 0;   ///< its first vertex in the mesh
  std::size_t count = 0;  ///< of its vertices
};

bool is_within(double value, double bound) { return std::abs(value) <= bound; }

/// The positions in the axes of the mesh, its morph targets added with their weights (specification, 3.7.2.2).
std::vector<Vector3> morphed_positions(const GltfSource& source, const PrimitiveTask& task) {
  const auto read = [&](int accessor) {
    const auto xyz = numbers_of_accessor(source, accessor, {TINYGLTF_TYPE_VEC3, 3}, task.what + ": POSITION");
    std::vector<Vector3> points;
    for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) points.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
    return points;
  };
  auto points = read(task.primitive.attributes.at("POSITION"));
  const auto& targets = task.primitive.targets;
  for (std::size_t k = 0; k < targets.size() && k < task.instance.morph_weights.size(); ++k) {
    const double weight = task.instance.morph_weights[k];
    const auto found = targets[k].find("POSITION");
    if (weight == 0 || !(std::abs(weight) <= kMaxCoordinate) || found == targets[k].end()) continue;
    const auto offsets = read(found->second);
    if (offsets.size() != points.size()) source.fail("mesh.bad-gltf", task.what + " has a morph target of another size");
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = points[i] + weight * offsets[i];
  }
  return points;
}

/// Moves vertices by the joints that they hang on. False when the primitive does not say which these are.
bool apply_skin(const GltfSource& source, const PrimitiveTask& task, std::vector<Vector3>& points) {
  const auto& maps = task.instance.scene_from_bind;
  std::vector<Vector3> posed(points.size());
  std::vector<double> total(points.size(), 0);
  for (int set = 0;; ++set) {
    const auto joints = task.primitive.attributes.find(fmt::format("JOINTS_{}", set)),
               weights = task.primitive.attributes.find(fmt::format("WEIGHTS_{}", set));
    if (joints == task.primitive.attributes.end() || weights == task.primitive.attributes.end()) break;
    const auto j = numbers_of_accessor(source, joints->second, {TINYGLTF_TYPE_VEC4, 4}, task.what + ": JOINTS");
    const auto w = numbers_of_accessor(source, weights->second, {TINYGLTF_TYPE_VEC4, 4}, task.what + ": WEIGHTS");
    if (j.size() != 4 * points.size() || w.size() != j.size())
      source.fail("mesh.bad-gltf", task.what + " has more or fewer joints than vertices");
    for (std::size_t k = 0; k < j.size(); ++k) {
      if (!(w[k] > 0)) continue;
      if (!(j[k] >= 0 && j[k] < static_cast<double>(maps.size())))
        source.fail("mesh.bad-index", task.what + " uses a joint that is not there");
      posed[k / 4] = posed[k / 4] + w[k] * maps[static_cast<std::size_t>(j[k])](points[k / 4]);
      total[k / 4] += w[k];
    }
  }
  if (std::any_of(total.begin(), total.end(), [](double sum) { return !(sum > 0); })) return false;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = (1 / total[i]) * posed[i];
  return true;
}

void add_positions(const GltfSource& source, PrimitiveTask& task, Mesh& mesh) {
  auto points = morphed_positions(source, task);
  task.base = mesh.positions.size();
  task.count = points.size();
  const auto max_vertices = 3 * source.context.options.max_triangles;
  if (task.base + task.count > max_vertices)
    throw GltfError{too_many(source.context.name, "vertices", task.base + task.count, max_vertices)};
  const bool is_posed = !task.instance.scene_from_bind.empty() && apply_skin(source, task, points);
  for (std::size_t i = 0; i < task.count; ++i) {
    const auto p = is_posed ? points[i] : task.instance.scene_from_mesh(points[i]);
    if (!is_within(p.x, kMaxCoordinate) || !is_within(p.y, kMaxCoordinate) || !is_within(p.z, kMaxCoordinate))
      throw GltfError{not_finite(source.context.name, fmt::format("{}, vertex {}", task.what, i))};
    mesh.positions.push_back(p);
  }
}

/// Adds the colours of the vertices, linear in glTF (COLOR_0). Makes: whether the primitive has any; without them its vertices get white.
bool add_colors(const GltfSource& source, const PrimitiveTask& task, Mesh& mesh) {
  mesh.colors.resize(task.base + task.count, {1, 1, 1});
  const auto found = task.primitive.attributes.find("COLOR_0");
  if (found == task.primitive.attributes.end()) return false;
  const auto& accessor = entry(source, source.model.accessors, found->second, task.what + ": COLOR_0");
  const bool has_alpha = accessor.type == TINYGLTF_TYPE_VEC4;
  const std::size_t width = has_alpha ? 4 : 3;
  const auto colors =
      numbers_of_accessor(source, found->second, {has_alpha ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3, width}, task.what + ": COLOR_0");
  if (colors.size() != width * task.count) source.fail("mesh.bad-gltf", task.what + " has more or fewer colours than vertices");
  for (std::size_t i = 0; i < task.count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double channel = colors[width * i + k];
      mesh.colors[task.base + i][k] = channel >= 0 ? static_cast<float>(std::min(channel, 1.0)) : 0.0f;
    }
  }
  return true;
}

/// Makes: whether the primitive has uv. Without them its vertices get (0, 0).
bool add_uv(const GltfSource& source, const PrimitiveTask& task, const UvTransform& transform, Mesh& mesh) {
  mesh.uv.resize(task.base + task.count, {0, 0});
  const auto found = task.primitive.attributes.find(fmt::format("TEXCOORD_{}", transform.set));
  if (found == task.primitive.attributes.end()) return false;
  const auto uv = numbers_of_accessor(source, found->second, {TINYGLTF_TYPE_VEC2, 2}, task.what + ": TEXCOORD");
  if (uv.size() != 2 * task.count) source.fail("mesh.bad-gltf", task.what + " has more or fewer texture coordinates than vertices");
  const double c = math::cos(transform.rotation), s = math::sin(transform.rotation);
  for (std::size_t i = 0; i < task.count; ++i) {
    // KHR_texture_transform: translation · rotation · scale; v points down, so the rotation is written as below.
    const double u = transform.scale[0] * uv[2 * i], v = transform.scale[1] * uv[2 * i + 1];
    const double x = transform.offset[0] + c * u + s * v, y = transform.offset[1] - s * u + c * v;
    if (!is_within(x, kMaxUv) || !is_within(y, kMaxUv)) throw GltfError{not_finite(source.context.name, task.what + ": TEXCOORD")};
    mesh.uv[task.base + i] = {static_cast<float>(x), static_cast<float>(y)};
  }
  return true;
}

/// The vertices of the mesh that the corners of the primitive are.
std::vector<std::uint32_t> corner_vertices(const GltfSource& source, const PrimitiveTask& task) {
  std::vector<std::uint32_t> corners;
  if (task.primitive.indices < 0) {
    for (std::size_t i = 0; i < task.count; ++i) corners.push_back(static_cast<std::uint32_t>(task.base + i));
    return corners;
  }
  for (const double index : numbers_of_accessor(source, task.primitive.indices, {TINYGLTF_TYPE_SCALAR, 1}, task.what + ": indices")) {
    if (!(index >= 0 && index < static_cast<double>(task.count)))
      source.fail("mesh.bad-index", fmt::format("{} uses vertex {:g}, but there are only {}", task.what, index, task.count));
    corners.push_back(static_cast<std::uint32_t>(task.base + static_cast<std::size_t>(index)));
  }
  return corners;
}

void add_triangles(const GltfSource& source, const PrimitiveTask& task, int mode, std::uint16_t material, Mesh& mesh) {
  const auto corners = corner_vertices(source, task);
  const auto max_triangles = source.context.options.max_triangles;
  const bool flip = task.instance.scene_from_bind.empty() && task.instance.scene_from_mesh.determinant() < 0;
  const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
  for (std::size_t c = 0; c + 2 < corners.size(); c += step) {
    Triangle t{corners[mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : c], corners[c + 1], corners[c + 2]};
    const bool odd = mode == TINYGLTF_MODE_TRIANGLE_STRIP && c % 2 == 1;
    if (odd != flip) std::swap(t[1], t[2]);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    mesh.triangles.push_back(t);
    mesh.triangle_material.push_back(material);
    if (mesh.triangles.size() > max_triangles)
      throw GltfError{too_many(source.context.name, "triangles or more", mesh.triangles.size(), max_triangles)};
  }
}

}  // namespace

Mesh assemble_mesh(const GltfSource& source, const std::vector<MeshInstance>& instances, GltfMaterials& materials) {
  Mesh mesh;
  bool has_uv = false, has_colors = false;
  for (const MeshInstance& instance : instances) {
    const auto& primitives = entry(source, source.model.meshes, instance.mesh, fmt::format("mesh {}", instance.mesh)).primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const int mode = primitives[p].mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitives[p].mode;
      if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN) continue;
      if (!primitives[p].attributes.count("POSITION")) continue;  // allowed by the specification: drawn by an extension
      PrimitiveTask task{primitives[p], instance, fmt::format("mesh {}, primitive {}", instance.mesh, p)};
      add_positions(source, task, mesh);
      const auto material = materials.index_of(primitives[p].material);
      has_uv = add_uv(source, task, materials.uv_transform(primitives[p].material), mesh) || has_uv;
      has_colors = add_colors(source, task, mesh) || has_colors;
      add_triangles(source, task, mode, material, mesh);
    }
  }
  if (!has_uv) mesh.uv.clear();
  if (!has_colors) mesh.colors.clear();
  return mesh;
}

}  // namespace orbc::mesh_io
