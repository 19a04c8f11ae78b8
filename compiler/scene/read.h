#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/scene/override.h"
#include "compiler/scene/scene.h"

namespace orbc::scene {

/// A scene that can be built, and what its author may still want to know.
struct Read {
  Scene scene;
  Diagnostics notes;                ///< warnings and notes, in the order of the file
};

/// Reads a scene file's text. Never crashes, hangs or overflows the stack, whatever the text is; all mistakes of a file are reported at
/// once, in the order of the file (a YAML mistake alone, since nothing after it can be trusted; at most 100).
/// In:          the text with its name for messages; `folder` = what paths of meshes and textures are relative to;
///              `overrides` = what is said instead of the text: checked like it, and placed where it was said.
/// Makes:       a scene with every default filled in: as many walls as the notation has, one name per object.
/// Diagnostics: scene.* (schema/diagnostics.md), notation.* placed at the notation.
/// Not promised: that files exist, or that things stand inside the room: that takes geometry.
[[nodiscard]] Result<Read> read_scene(const std::shared_ptr<const SourceText>& source, const std::string& folder = {},
                                      const Overrides& overrides = {});
[[nodiscard]] Result<Read> read_scene(const SourceText& source, const std::string& folder = {}, const Overrides& overrides = {});

/// Reads a scene from a file; its folder is the scene's folder, of a pipe the current one. Reads no more than a scene may have, even from
/// /dev/zero.
/// Diagnostics: scene.cannot-read, and those of `read_scene`.
[[nodiscard]] Result<Read> load_scene(const std::string& path, const Overrides& overrides = {});

}  // namespace orbc::scene
