#pragma once
#include <map>
#include <string>
#include <vector>

#include "compiler/scene/animation.h"
#include "compiler/scene/read.h"
#include "compiler/scene/scene.h"
#include "compiler/scene/values.h"

namespace orbc::scene {

/// Properties of the room that follow from the notation alone. If the notation is wrong, all numbers are 0, and the readers do not check
/// wall and corner numbers.
struct RoomFacts {
  int walls = 0;                    ///< number of walls; 0: unknown
  int corners = 0;                  ///< number of corners
  notation::Orbifold orbifold;      ///< `**` and `*22∞` have end walls and the key `length`
  bool flat = false;                ///< E², which has the key `scale`
  bool rectangle = false;           ///< `*2222`, which has the key `aspect`
};
/// The facts of an orbifold's room.
[[nodiscard]] RoomFacts room_facts(const notation::Orbifold& orbifold);

// One reader per part of a scene. All of them have the same contract:
// In:          `node`, the part's value in the document; `what`, its name in messages, such as "`at`".
// Makes:       the part. Values that are missing or wrong keep their defaults, so that reading goes on after errors.
// Diagnostics: scene.*, added to reader.diagnostics at the span of the wrong value.

/// Reads a place on the floor: `centre` or a map.
[[nodiscard]] Place read_place(Reader& reader, const Node& node, const std::string& what, const RoomFacts& facts);

/// All keys of a material, for maps that accept them beside their own keys.
[[nodiscard]] const std::vector<std::string>& material_keys();
/// Whether at least one of them is given.
[[nodiscard]] bool has_material_key(const Fields& fields);
/// Reads a material: a preset's name, a colour, or a map of material keys, which change `base`.
[[nodiscard]] Material read_material(Reader& reader, const Node& node, const std::string& what, const Material& base);
/// Reads the material keys of a map that has other keys too. The key `material` replaces all other material keys.
[[nodiscard]] Material read_material_keys(const Fields& fields, const Material& base);
/// The material of a preset ("marble"), or none.
[[nodiscard]] std::optional<Material> preset_material(std::string_view name);
/// The names of all presets, in alphabetical order.
[[nodiscard]] const std::vector<std::string>& preset_names();

/// Reads the room with all its defaults; one wall per wall of the notation.
[[nodiscard]] RoomSpec read_room(Reader& reader, const Node& node, const RoomFacts& facts);
/// Reads the list of objects and makes their names unique.
[[nodiscard]] std::vector<Object> read_objects(Reader& reader, const Node& node, const RoomFacts& facts);
/// The unique names of the objects of a list, whether or not the objects are valid.
[[nodiscard]] std::vector<std::string> object_names(const Node& node);
/// Reads the list `lights`.
[[nodiscard]] std::vector<Lamp> read_lamps(Reader& reader, const Node& node, const RoomFacts& facts);
/// Reads the camera; lens and roll belong to perspective cameras only.
[[nodiscard]] Camera read_camera(Reader& reader, const Node& node, const RoomFacts& facts);
/// Reads `bake`; some keys belong to `integrator: path` only.
[[nodiscard]] BakeSpec read_bake(Reader& reader, const Node& node, Integrator integrator);
/// Divides all light of the scene (lamps, ambient light, emissive surfaces) by the white point of the key `white`, so that light of this
/// colour is white in all products.
void balance_white(const Fields& fields, Scene& scene);
/// Reads `cover`; missing keys keep the values of `cover`.
[[nodiscard]] CoverSpec read_cover(Reader& reader, const Node& node, CoverSpec cover);

/// Reads `animation`. The paths and values are checked where they are applied (animation room).
[[nodiscard]] Animation read_animation(Reader& reader, const Node& node, const RoomFacts& facts);

/// Reads a wall's number (from 1) from a key of `walls`. Makes: 0 if it is no number.
[[nodiscard]] int read_wall_number(Reader& reader, const Node& key, const RoomFacts& facts);

}  // namespace orbc::scene
