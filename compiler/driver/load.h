#pragma once
#include <memory>
#include <string>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/light/lighting.h"
#include "compiler/mesh/asset_source.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"
#include "compiler/scene/override.h"
#include "compiler/scene/read.h"
#include "compiler/scene/scene.h"

namespace orbc::driver {

/// A scene that has been read, realised and furnished, with its lamps and its eye: where both roads begin.
struct LoadedScene {
  scene::Scene scene;
  std::shared_ptr<const place::Interior> interior;  ///< shared by copies of this; never null
  std::shared_ptr<const light::LampSet> lamps;      ///< placed in the interior, with their mirror images; never null
  place::Camera eye;                                ///< the scene's camera
  Diagnostics notes;
  std::vector<std::string> files = {};              ///< all that were read: the scene ("-" is standard input), meshes, what they refer to
  double unit_of_length = 1;  ///< the author's, in that of this scene, which all lengths above have (unit_of_length.h)
};

/// The text of a scene. In: a path, or "-" for standard input.
[[nodiscard]] Result<scene::SceneText> open(const std::string& path);

/// read → realise → furnish → place lamps → eye. Flat rooms get a unit of length of their own.
/// In:          a path, or "-" for standard input; values that replace those of the scene; bytes that the program may take, which bound
///              meshes and pictures.
/// Diagnostics: those of the rooms it goes through, with places in the file.
[[nodiscard]] Result<LoadedScene> load(const std::string& path, const scene::Overrides& overrides = {},
                                       std::uint64_t max_memory = std::uint64_t{4} << 30);
/// The same for a text that has been opened.
[[nodiscard]] Result<LoadedScene> load(const scene::SceneText& text, const scene::Overrides& overrides = {},
                                       std::uint64_t max_memory = std::uint64_t{4} << 30);

/// The same for a scene that has been read, with its meshes and pictures from anywhere. Keeps the notes of reading.
[[nodiscard]] Result<LoadedScene> load(scene::ReadResult read, const mesh::AssetSource& assets);

/// The eye of a scene, in the author's unit, that differs from a loaded one in its camera alone.
/// Diagnostics: those of `place::make_camera`.
[[nodiscard]] Result<place::Camera> eye_of(const scene::Scene& scene, const LoadedScene& loaded);

}  // namespace orbc::driver
