#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/base/result.h"

namespace orbc::scene {

enum class NodeKind { null, scalar, list, map };

/// A value of a YAML document with its span. Plain scalars are text here; the reader decides whether they are numbers.
struct Node {
  NodeKind kind = NodeKind::null;
  bool quoted = false;              ///< scalar: quoted or a block, so never a number
  std::string text;                 ///< scalar
  std::vector<Node> keys;           ///< map: different scalars
  std::vector<Node> items;          ///< list: its items; map: the values, where items[i] belongs to keys[i]
  SourceSpan span;

  /// The value of a key, or nullptr.
  [[nodiscard]] const Node* find(std::string_view key) const;
};

struct Document {
  Node root;
  Diagnostics faults;               ///< errors that do not stop the reader, such as duplicate keys (the first one counts)
};

/// Limits of a scene file, far above what anybody writes by hand. They bound time and memory of reading.
struct DocumentLimits {
  std::size_t bytes = 4u << 20;
  std::size_t values = 200'000;
  std::size_t depth = 64;
};

/// Parses one YAML 1.2 document without aliases, anchors and tags, in bounded time, memory and stack for any bytes.
/// Diagnostics: scene.too-large, scene.not-utf8, scene.bad-character, scene.tab, scene.syntax, scene.alias, scene.tag, scene.too-deep,
///              scene.too-many-values, scene.many-documents, scene.empty; scene.duplicate-key and scene.bad-key as faults.
[[nodiscard]] Result<Document> parse_document(const std::shared_ptr<const SourceText>& source, const DocumentLimits& limits = {});

}  // namespace orbc::scene
