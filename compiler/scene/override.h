#pragma once
#include <memory>
#include <vector>

#include "compiler/base/diagnostic.h"

namespace orbc::scene {

struct Document;

/// Changes of a scene. Each text is PATH=VALUE, such as `camera.fov=60deg`; its name is the name in messages, such as `<--set 1>`.
///
/// PATH leads from the scene to a value: keys, numbers of list items (from 1), and names of objects, joined by dots. Words with dots or
/// equal signs in them stand in quotes. VALUE is YAML. An empty value, `null` or `~` removes the key, so that its default holds. A value
/// that starts with `#` or `*`, which in YAML starts a comment or a reference, is text: a colour or a notation.
using Overrides = std::vector<SourceText>;

/// The texts of overrides, as objects that spans can refer to.
using OverrideSources = std::vector<std::shared_ptr<const SourceText>>;
[[nodiscard]] OverrideSources sources_of(const Overrides& overrides);

/// Applies overrides to a parsed scene, one after the other. Missing maps along a path are created. The number after a list's last item
/// appends an item. The reader then reads the values as if they stood in the file. Makes:       diagnostics about the overrides themselves,
/// placed in their texts. Diagnostics: scene.bad-override, scene.no-such-item, scene.not-a-map, scene.too-deep, those of `parse_document`;
/// scene.no-effect.
[[nodiscard]] Diagnostics apply_overrides(const OverrideSources& overrides, Document& document);

}  // namespace orbc::scene
