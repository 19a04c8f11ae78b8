#include "compiler/driver/by_object.h"

#include <map>
#include <utility>

namespace orbc::driver {
namespace {

using Key = std::pair<place::PartKind, std::string>;   // an author may call an object "floor"

Key key_of(const place::PlacedMesh& part) { return {part.kind, part.name}; }

}  // namespace

ByObject part_by_object(const place::Interior& room, std::vector<bend::Model>& models, std::vector<std::uint32_t>& model_of_copy) {
  ByObject by;
  std::map<Key, std::uint32_t> number;
  for (const place::PlacedMesh& part : room.parts)
    if (number.try_emplace(key_of(part), static_cast<std::uint32_t>(by.names.size())).second) by.names.push_back(part.name);
  const std::size_t copies = model_of_copy.size(), whole = models.size();
  std::vector<bend::Model> parted;
  std::vector<std::uint32_t> model_of_entry;
  for (std::uint32_t object = 0; object < by.names.size(); ++object) {
    const auto first = static_cast<std::uint32_t>(parted.size());
    parted.resize(parted.size() + whole);
    for (std::size_t m = 0; m < whole; ++m)
      for (const bend::Model::Part& part : models[m].parts)
        if (number.at(key_of(*part.mesh)) == object) parted[first + m].parts.push_back(part);
    for (std::uint32_t c = 0; c < copies; ++c) {
      const std::uint32_t model = first + model_of_copy[c];
      if (object > 0 && parted[model].parts.empty()) continue;
      by.copy_of_entry.push_back(c);
      by.object_of_entry.push_back(object);
      model_of_entry.push_back(model);
    }
  }
  models = std::move(parted);
  model_of_copy = std::move(model_of_entry);
  return by;
}

}  // namespace orbc::driver
