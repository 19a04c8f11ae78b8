#pragma once
#include <memory>
#include <vector>

#include "compiler/base/diagnostic.h"

namespace orbc::scene {

struct Document;

/// What is said instead of a scene, or beside it: each text is PATH=VALUE, such as `camera.fov=60deg`; the name is what messages call it,
/// such as `<--set 1>`.
///
/// PATH leads from the scene to a value: keys, numbers of list items (from 1), and names of objects, joined by dots. Words with dots or
/// equal signs in them stand in quotes. VALUE is YAML; nothing, `null` or `~` removes the key, so that its default holds. Text that starts
/// with `#` or `*`, which YAML takes as a comment and a reference, is a colour or a notation here.
using Overrides = std::vector<SourceText>;

/// The texts of `overrides` as spans refer to them.
using OverrideSources = std::vector<std::shared_ptr<const SourceText>>;
[[nodiscard]] OverrideSources sources_of(const Overrides& overrides);

/// Changes a parsed scene by overrides, one after the other. Maps on the way that are missing are made; the number after the last one
/// appends to a list. What the values mean is left to the reader, which finds them in the document as if they stood in the file.
/// Makes:       what is wrong with the overrides themselves, placed in their texts.
/// Diagnostics: scene.bad-override, scene.no-such-item, scene.not-a-map, scene.too-deep, those of `parse_document`; scene.no-effect.
[[nodiscard]] Diagnostics apply_overrides(const OverrideSources& overrides, Document& document);

}  // namespace orbc::scene
