#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/driver/product.h"
#include "compiler/mesh/asset_source.h"
#include "compiler/scene/scene.h"

namespace orbc::html {

/// A scene for the page: its text, and the files that it names, in the form of core/page_assets.h.
struct PageScene {
  std::string text;                                                      ///< YAML
  std::vector<std::pair<std::string, std::vector<std::uint8_t>>> files;  ///< by the name that the text gives them, in its order
};

/// Gathers the meshes and pictures that a scene names. In: the scene as it was read from `text`, and its room.
/// Diagnostics: those of place::furnish.
[[nodiscard]] Result<PageScene> page_scene(std::string text, const scene::Scene& scene, const room::Room& room,
                                           const mesh::AssetSource& assets);

/// Writes the designer's page: one file that asks for no other and for no network.
/// In:    the page as scripts/web builds it, with its places for a scene and for files (exporters/html/format.md).
/// Makes: the same bytes for the same input. Whatever names the scene has, they stay text: no `<` of theirs reaches HTML.
/// Error: none when the page has no such places.
[[nodiscard]] std::optional<driver::File> write_html(std::string_view page, const PageScene& scene);

}  // namespace orbc::html
