#include "compiler/driver/draw_list.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <utility>

#include "compiler/native_lights/split.h"

namespace orbc::driver {
namespace {

using native_lights::Shading;

/// A model for each combination of levels.
std::vector<bend::Model> models_of(const Job& job, const lod::LodSelection& selection, const Appearance& appearance) {
  const std::vector<place::PlacedMesh>& meshes = job.scene.surfaces(job.run)->meshes;
  const lod::InteriorWithLods& lods = job.scene.lods(job.run);
  std::vector<bend::Model> models;
  for (const std::vector<std::uint16_t>& levels : selection.levels_of_model) {
    models.emplace_back();
    for (std::size_t p = 0; p < levels.size(); ++p) {
      const std::uint32_t part = lods.part_of_level[p][levels[p]];
      models.back().parts.push_back({&meshes[part], &appearance.uv[part], false});
    }
  }
  return models;
}

/// Gives copies with texels of their own a model of their own, with other places in the atlas.
DrawList with_copy_uv(const Job& job, const std::vector<bake::CopyUv>& all, DrawList list) {
  const std::vector<place::PlacedMesh>& meshes = job.scene.surfaces(job.run)->meshes;
  for (std::size_t i = 0; i < all.size();) {
    const std::size_t copy = all[i].copy;
    bend::Model model = list.models[list.model_of_copy[copy]];
    for (; i < all.size() && all[i].copy == copy; ++i)
      for (bend::Model::Part& part : model.parts)
        if (part.mesh == &meshes[all[i].part]) part.uv = &all[i].uv;
    list.model_of_copy[copy] = static_cast<std::uint32_t>(list.models.size());
    list.models.push_back(std::move(model));
  }
  return list;
}

DrawList with_impostors(const Job& job, const Detail& detail, const Appearance& appearance, DrawList list) {
  const place::Interior& interior = job.scene.interior();
  const cutoff::CullTest is_culled = cull_test(job, detail);
  const bool unsplit = is_culled && cutoff::can_skip_splitting(interior, std::max(job.cover.min_pixels, detail.cull_px));
  const std::size_t mirrors = interior.mirrors.size(), depth_count = appearance.panels.size() - (is_culled ? mirrors : 0);
  cutoff::Impostors impostors;
  for (std::size_t i = 0; i < appearance.panels.size(); ++i) {
    const bool by_depth = i < depth_count;
    (by_depth ? impostors.depth : impostors.size).push_back({&appearance.panels[i], &appearance.panel_uv[i], !by_depth && unsplit});
  }
  cutoff::ModelsWithImpostors made = cutoff::attach_impostors(cutoff::Endings(interior, job.cover, is_culled), list.copies, impostors,
                                                              std::move(list.models), std::move(list.model_of_copy));
  list.models = std::move(made.models);
  list.model_of_copy = std::move(made.model_of_copy);
  list.impostors = made.attached;
  return list;
}

}  // namespace

DrawList draw_list(const Job& job, std::vector<cover::Copy> copies, const Detail& detail, const Appearance& appearance) {
  DrawList list;
  list.copies = std::move(copies);
  list.models = models_of(job, detail.selection, appearance);
  list.model_of_copy = detail.selection.model_of_copy;
  list.level_of_copy = detail.stats.level_of_copy;
  list.shading.assign(list.copies.size(), Shading::lit);
  return with_impostors(job, detail, appearance, with_copy_uv(job, appearance.copy_uv, std::move(list)));
}

DrawList split_emissive_copies(const place::Interior& interior, DrawList list) {
  const std::size_t copies = list.copies.size();
  std::array<std::vector<bend::Model>, 3> by_shading;
  for (std::vector<bend::Model>& models : by_shading) models.resize(list.models.size());
  for (std::size_t m = 0; m < list.models.size(); ++m)
    for (const bend::Model::Part& part : list.models[m].parts)
      by_shading[static_cast<std::size_t>(native_lights::shading_of(interior, *part.mesh))][m].parts.push_back(part);
  list.models = std::move(by_shading[0]);
  for (const Shading shading : {Shading::emissive, Shading::lamp_body}) {
    std::vector<bend::Model>& models = by_shading[static_cast<std::size_t>(shading)];
    const auto first = static_cast<std::uint32_t>(list.models.size());
    for (std::size_t c = 0; c < copies; ++c) {
      const std::uint32_t model = list.model_of_copy[c];
      if (models[model].parts.empty()) continue;
      list.copies.push_back(list.copies[c]);
      list.shading.push_back(shading);
      list.level_of_copy.push_back(list.level_of_copy[c]);
      list.model_of_copy.push_back(first + model);
    }
    std::move(models.begin(), models.end(), std::back_inserter(list.models));
  }
  return list;
}

DrawList split_by_object(const place::Interior& interior, const std::vector<place::PlacedMesh>& panels, DrawList list) {
  using Key = std::pair<place::PartKind, std::string>;  // an author may name an object "floor"
  const auto key_of = [](const place::PlacedMesh& part) { return Key{part.kind, part.name}; };
  DrawList split;
  std::map<Key, std::uint32_t> number;
  for (const auto* parts : {&interior.parts, &panels})
    for (const place::PlacedMesh& part : *parts)
      if (number.try_emplace(key_of(part), static_cast<std::uint32_t>(split.objects.size())).second) split.objects.push_back(part.name);
  const std::size_t models = list.models.size();
  for (std::uint32_t object = 0; object < split.objects.size(); ++object) {
    const auto first = static_cast<std::uint32_t>(split.models.size());
    split.models.resize(split.models.size() + models);
    for (std::size_t m = 0; m < models; ++m)
      for (const bend::Model::Part& part : list.models[m].parts)
        if (number.at(key_of(*part.mesh)) == object) split.models[first + m].parts.push_back(part);
    for (std::uint32_t c = 0; c < list.copies.size(); ++c) {
      const std::uint32_t model = first + list.model_of_copy[c];
      if (object > 0 && split.models[model].parts.empty()) continue;  // the entries of the first object are all copies
      split.copies.push_back(list.copies[c]);
      split.model_of_copy.push_back(model);
      split.level_of_copy.push_back(list.level_of_copy[c]);
      split.shading.push_back(list.shading[c]);
      split.object_of_copy.push_back(object);
      split.original_of_copy.push_back(c);
    }
  }
  split.impostors = list.impostors;
  return split;
}

}  // namespace orbc::driver
