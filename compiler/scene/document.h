#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/base/result.h"

namespace orbc::scene {

enum class NodeKind { nothing, scalar, list, map };

/// A value of a YAML document and the place where it stands. Plain scalars are not yet numbers or words: the reader decides.
struct Node {
  NodeKind kind = NodeKind::nothing;
  bool quoted = false;              ///< a scalar in quotes or a block: text, never a number
  std::string text;                 ///< scalar
  std::vector<Node> keys;           ///< map: scalars, all different
  std::vector<Node> items;          ///< list: the items; map: the values, items[i] belongs to keys[i]
  SourceSpan span;

  [[nodiscard]] const Node* find(std::string_view key) const;
};

struct Document {
  Node root;
  Diagnostics faults;               ///< what does not hinder reading on: keys given twice (the first one counts)
};

/// What no scene may exceed; nobody writes so much by hand, and it bounds time and memory of reading.
struct DocumentLimits {
  std::size_t bytes = 4u << 20;
  std::size_t values = 200'000;
  std::size_t depth = 64;
};

/// Reads one YAML 1.2 document without aliases, anchors and tags, whatever the bytes are: bounded time, memory and stack.
/// Diagnostics: scene.too-large, scene.not-utf8, scene.bad-character, scene.tab, scene.syntax, scene.alias, scene.tag, scene.too-deep,
///              scene.too-many-values, scene.many-documents, scene.empty; scene.duplicate-key and scene.bad-key as faults.
[[nodiscard]] Result<Document> parse_document(const std::shared_ptr<const SourceText>& source, const DocumentLimits& limits = {});

}  // namespace orbc::scene
