// The tree of nodes of a glTF scene (specification 2.0.1, section 3.5).
#include "compiler/mesh_io/gltf_nodes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace orbc::mesh_io {
namespace {

using geometry::Vector3;

/// In: a unit quaternion or near to one, w last; scale; translation.
AffineMap compose(double x, double y, double z, double w, const Vector3& scale, const Vector3& translation) {
  AffineMap map;
  const double norm = std::sqrt(x * x + y * y + z * z + w * w);
  if (norm > 0) {
    x /= norm;
    y /= norm;
    z /= norm;
    w /= norm;
    map.x = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
    map.y = {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
    map.z = {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
  }
  return {scale.x * map.x, scale.y * map.y, scale.z * map.z, translation};
}

AffineMap from_columns(const double* m) { return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}}; }

AffineMap parent_from_node(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return from_columns(node.matrix.data());
  const auto& r = node.rotation;
  const auto& s = node.scale;
  const auto& t = node.translation;
  const bool has_rotation = r.size() == 4;
  return compose(has_rotation ? r[0] : 0, has_rotation ? r[1] : 0, has_rotation ? r[2] : 0, has_rotation ? r[3] : 1,
                 s.size() == 3 ? Vector3{s[0], s[1], s[2]} : Vector3{1, 1, 1}, t.size() == 3 ? Vector3{t[0], t[1], t[2]} : Vector3{});
}

/// The nodes that are nobody's children.
std::vector<int> parentless_nodes(const tinygltf::Model& model) {
  const auto count = model.nodes.size();
  std::vector<char> is_child(count, 0);
  for (const auto& node : model.nodes) {
    for (const int child : node.children) {
      if (child >= 0 && static_cast<std::size_t>(child) < count) is_child[static_cast<std::size_t>(child)] = 1;
    }
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

std::vector<int> scene_roots(const tinygltf::Model& model) {
  if (model.scenes.empty()) return parentless_nodes(model);
  const bool has_default = model.defaultScene >= 0 && static_cast<std::size_t>(model.defaultScene) < model.scenes.size();
  return model.scenes[has_default ? static_cast<std::size_t>(model.defaultScene) : 0].nodes;
}

/// A node that a walk visits.
struct Visit {
  int node = 0;
  AffineMap scene_from_node;
  bool is_visible = true;
};

bool is_hidden(const tinygltf::Node& node) {
  const auto found = node.extensions.find("KHR_node_visibility");
  if (found == node.extensions.end() || !found->second.Has("visible")) return false;
  const auto& visible = found->second.Get("visible");
  return visible.IsBool() && !visible.Get<bool>();
}

/// All nodes under the roots, parents before children. Throws: GltfError where they are no tree.
std::vector<Visit> walk(const GltfSource& source, const std::vector<int>& roots) {
  const auto& nodes = source.model.nodes;
  std::vector<Visit> visits, open;  // open: what is still to be visited; scene_from_node is that of the parent
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) open.push_back({*root, {}, true});
  std::vector<char> visited(nodes.size(), 0);
  while (!open.empty()) {
    Visit visit = open.back();
    open.pop_back();
    const auto& node = entry(source, nodes, visit.node, fmt::format("node {}", visit.node));
    if (visited[static_cast<std::size_t>(visit.node)])
      source.fail("mesh.bad-gltf", fmt::format("node {} hangs in the tree more than once", visit.node));
    visited[static_cast<std::size_t>(visit.node)] = 1;
    visit.scene_from_node = visit.scene_from_node * parent_from_node(node);
    visit.is_visible = visit.is_visible && !is_hidden(node);
    visits.push_back(visit);
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      open.push_back({*child, visit.scene_from_node, visit.is_visible});
    if (open.size() > 4 * nodes.size() + 16) source.fail("mesh.bad-gltf", "its nodes are no tree");
  }
  return visits;
}

/// The maps of the joints of a skin: joint · inverse of where it was bound (specification, 3.7.3.1).
std::vector<AffineMap> joint_maps(const GltfSource& source, const tinygltf::Skin& skin, const std::vector<AffineMap>& scene_from_node) {
  std::vector<double> matrices;
  if (skin.inverseBindMatrices >= 0)
    matrices = numbers_of_accessor(source, skin.inverseBindMatrices, {TINYGLTF_TYPE_MAT4, 16}, "inverse bind matrices");
  std::vector<AffineMap> maps;
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    AffineMap map = entry(source, scene_from_node, skin.joints[j], fmt::format("joint {}", skin.joints[j]));
    if (16 * (j + 1) <= matrices.size()) map = map * from_columns(&matrices[16 * j]);
    maps.push_back(map);
  }
  return maps;
}

/// The copies of EXT_mesh_gpu_instancing, in the axes of the node; nothing for a node without it.
std::optional<std::vector<AffineMap>> instancing(const GltfSource& source, const tinygltf::Node& node) {
  const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
  if (found == node.extensions.end() || !found->second.Has("attributes")) return {};
  const auto& attributes = found->second.Get("attributes");
  const auto read = [&](const char* name, AccessorShape shape) {
    if (!attributes.Has(name) || !attributes.Get(name).IsNumber()) return std::vector<double>{};
    return numbers_of_accessor(source, attributes.Get(name).GetNumberAsInt(), shape, std::string("instancing: ") + name);
  };
  const auto t = read("TRANSLATION", {TINYGLTF_TYPE_VEC3, 3}), r = read("ROTATION", {TINYGLTF_TYPE_VEC4, 4}),
             s = read("SCALE", {TINYGLTF_TYPE_VEC3, 3});
  const std::size_t count = std::max({t.size() / 3, r.size() / 4, s.size() / 3});
  std::vector<AffineMap> maps;
  for (std::size_t i = 0; i < count; ++i) {
    const bool has_r = 4 * i + 3 < r.size(), has_s = 3 * i + 2 < s.size(), has_t = 3 * i + 2 < t.size();
    maps.push_back(compose(has_r ? r[4 * i] : 0, has_r ? r[4 * i + 1] : 0, has_r ? r[4 * i + 2] : 0, has_r ? r[4 * i + 3] : 1,
                           has_s ? Vector3{s[3 * i], s[3 * i + 1], s[3 * i + 2]} : Vector3{1, 1, 1},
                           has_t ? Vector3{t[3 * i], t[3 * i + 1], t[3 * i + 2]} : Vector3{}));
  }
  return maps;
}

}  // namespace

std::vector<MeshInstance> mesh_instances(const GltfSource& source) {
  const auto& model = source.model;
  const std::vector<Visit> visits = walk(source, scene_roots(model));
  std::vector<AffineMap> scene_from_node(model.nodes.size());  // joints may stand outside of the scene
  if (!model.skins.empty()) {
    for (const Visit& visit : walk(source, parentless_nodes(model)))
      scene_from_node[static_cast<std::size_t>(visit.node)] = visit.scene_from_node;
  }
  std::vector<MeshInstance> instances;
  for (const Visit& visit : visits) {
    const auto& node = model.nodes[static_cast<std::size_t>(visit.node)];
    if (node.mesh < 0 || !visit.is_visible) continue;
    MeshInstance instance{node.mesh, visit.scene_from_node, node.weights, {}};
    if (instance.morph_weights.empty())
      instance.morph_weights = entry(source, model.meshes, node.mesh, fmt::format("mesh {}", node.mesh)).weights;
    if (node.skin >= 0)
      instance.scene_from_bind =
          joint_maps(source, entry(source, model.skins, node.skin, fmt::format("skin {}", node.skin)), scene_from_node);
    const auto copies = instancing(source, node);
    if (!copies) instances.push_back(instance);
    if (!copies) continue;
    for (const AffineMap& node_from_copy : *copies) {
      MeshInstance copy = instance;
      copy.scene_from_mesh = visit.scene_from_node * node_from_copy;
      instances.push_back(std::move(copy));
    }
  }
  return instances;
}

}  // namespace orbc::mesh_io
