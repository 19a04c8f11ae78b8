// The tree of nodes of a glTF scene (specification 2.0.1, section 3.5).
#include "compiler/mesh_io/gltf_nodes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace orbc::mesh_io {
namespace {

AffineMap parent_from_node(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    const auto& m = node.matrix;
    return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  }
  AffineMap map;
  if (node.rotation.size() == 4) {
    double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
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
  }
  if (node.scale.size() == 3) {
    map.x = node.scale[0] * map.x;
    map.y = node.scale[1] * map.y;
    map.z = node.scale[2] * map.z;
  }
  if (node.translation.size() == 3) map.t = {node.translation[0], node.translation[1], node.translation[2]};
  return map;
}

std::vector<int> root_nodes(const tinygltf::Model& model) {
  if (!model.scenes.empty()) {
    const bool has_default = model.defaultScene >= 0 && static_cast<std::size_t>(model.defaultScene) < model.scenes.size();
    return model.scenes[has_default ? static_cast<std::size_t>(model.defaultScene) : 0].nodes;
  }
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

}  // namespace

std::vector<MeshInstance> mesh_instances(const GltfSource& source) {
  const auto& model = source.model;
  std::vector<MeshInstance> instances;
  std::vector<std::pair<int, AffineMap>> open;  // nodes to be visited, and where their parents are
  for (const int root : root_nodes(model)) open.push_back({root, {}});
  std::reverse(open.begin(), open.end());
  std::vector<char> visited(model.nodes.size(), 0);
  while (!open.empty()) {
    const auto [index, scene_from_parent] = open.back();
    open.pop_back();
    const auto& node = entry(source, model.nodes, index, fmt::format("node {}", index));
    if (visited[static_cast<std::size_t>(index)])
      source.fail("mesh.bad-gltf", fmt::format("node {} hangs in the tree more than once", index));
    visited[static_cast<std::size_t>(index)] = 1;
    const AffineMap scene_from_node = scene_from_parent * parent_from_node(node);
    if (node.mesh >= 0) instances.push_back({index, node.mesh, scene_from_node});
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) open.push_back({*child, scene_from_node});
    if (open.size() > 4 * model.nodes.size() + 16) source.fail("mesh.bad-gltf", "its nodes are no tree");
  }
  return instances;
}

}  // namespace orbc::mesh_io
