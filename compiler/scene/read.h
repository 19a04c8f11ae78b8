#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/scene/document.h"
#include "compiler/scene/override.h"
#include "compiler/scene/scene.h"

namespace orbc::scene {

/// A scene, and warnings and notes to its author.
struct ReadResult {
  Scene scene;
  Diagnostics notes;  ///< in the order of the file
};

/// Reads the text of a scene file, in bounded time, memory and stack for any text. All errors of a file are reported together, in the order
/// of the file, at most 100. A YAML error is reported alone, because the text after it cannot be parsed. In:          the text and its name
/// for messages; `folder`, to which paths of meshes and textures are relative; `overrides`, which are
///              checked like the text, with diagnostics placed in the overrides.
/// Makes:       a scene with all defaults: one entry per wall of the notation, and one name per object.
/// Diagnostics: scene.* (schema/diagnostics.md), and notation.* placed at the notation.
/// Not promised: that files exist, or that objects lie inside the room.
[[nodiscard]] Result<ReadResult> read_scene(const std::shared_ptr<const SourceText>& source, const std::string& folder = {},
                                            const Overrides& overrides = {});
[[nodiscard]] Result<ReadResult> read_scene(const SourceText& source, const std::string& folder = {}, const Overrides& overrides = {});

/// The text of a scene, and the folder to which paths in it are relative.
struct SceneText {
  std::shared_ptr<const SourceText> source;
  std::string folder;
};

/// The document of a scene with overrides applied, as the reader would read it.
/// Diagnostics: those of `parse_document` and `apply_overrides`.
[[nodiscard]] Result<Document> document_of(const SceneText& text, const Overrides& overrides);

/// The text of a scene file. The folder of the file is the scene's folder; for a pipe it is the current folder. Stops at the size limit of
/// scenes, so that /dev/zero ends.
/// Diagnostics: scene.cannot-read, scene.too-large.
[[nodiscard]] Result<SceneText> open_scene(const std::string& path);

/// Opens and reads a scene file.
/// Diagnostics: those of `open_scene` and `read_scene`.
[[nodiscard]] Result<ReadResult> load_scene(const std::string& path, const Overrides& overrides = {});

}  // namespace orbc::scene
