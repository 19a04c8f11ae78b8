#pragma once
#include <map>
#include <string>
#include <vector>

#include "compiler/scene/read.h"
#include "compiler/scene/scene.h"
#include "compiler/scene/values.h"

namespace orbc::scene {

/// What the notation alone says of the room; 0 walls = nothing is known, because the notation itself is wrong (then nothing is said of
/// numbers).
struct RoomFacts {
  int walls = 0;
  int corners = 0;
  notation::Orbifold orbifold;      ///< `**` and `*22∞` have end walls and a `length`
  bool flat = false;                ///< E²: has a `scale`
  bool rectangle = false;           ///< `*2222`: has an `aspect`
};
[[nodiscard]] RoomFacts facts_of(const notation::Orbifold& orbifold);

// The parts of a scene, each read from its node. All report to the reader and return what could be read.

[[nodiscard]] Place read_place(Reader& reader, const Node& node, const std::string& what, const RoomFacts& facts);

/// The keys of a material, for the maps that take them beside their own.
[[nodiscard]] const std::vector<std::string>& material_keys();
/// True when one of them is given.
[[nodiscard]] bool has_material_key(const Fields& fields);
/// A preset, a colour, or a map of material keys.
[[nodiscard]] Material read_material(Reader& reader, const Node& node, const std::string& what, const Material& base);
/// The material keys of a map that has other keys too; `material: …` among them stands for all the others.
[[nodiscard]] Material read_material_keys(const Fields& fields, const Material& base);
[[nodiscard]] std::optional<Material> preset_material(std::string_view name);
[[nodiscard]] const std::vector<std::string>& preset_names();

[[nodiscard]] RoomSpec read_room(Reader& reader, const Node& node, const RoomFacts& facts);
[[nodiscard]] std::vector<Object> read_objects(Reader& reader, const Node& node, const RoomFacts& facts);
/// The names that objects of a list have, whatever else is wrong with them.
[[nodiscard]] std::vector<std::string> object_names(const Node& node);
[[nodiscard]] std::vector<Lamp> read_lamps(Reader& reader, const Node& node, const RoomFacts& facts);
[[nodiscard]] Camera read_camera(Reader& reader, const Node& node, const RoomFacts& facts);
[[nodiscard]] BakeSpec read_bake(Reader& reader, const Node& node, Integrator integrator);
/// Divides all light of a scene (lamps, ambient, what glows) by the white point that it names, so that this looks white in both roads and
/// every output.
void balance_white(const Fields& fields, Scene& scene);
[[nodiscard]] CoverSpec read_cover(Reader& reader, const Node& node, CoverSpec cover);

/// The number of a wall from a key of `walls`, checked against the room; 0 when it is none.
[[nodiscard]] int read_wall_number(Reader& reader, const Node& key, const RoomFacts& facts);

}  // namespace orbc::scene
