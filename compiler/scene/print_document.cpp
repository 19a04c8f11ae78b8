#include "compiler/scene/print_document.h"

#include "compiler/scene/values.h"

namespace orbc::scene {
namespace {

constexpr std::size_t kLineWidth = 110;  // characters

bool needs_quotes(const Node& node) {
  const std::string& text = node.text;
  return node.quoted || text.empty() || text.find_first_of("#*&!%@`\"',:[]{}|>?\n\t\\") != std::string::npos || text.front() == '-' ||
         text.front() == ' ' || text.back() == ' ';
}

std::string scalar_text(const Node& node) {
  if (scene::number_of(node) && !node.quoted) return node.text;
  if (!needs_quotes(node)) return node.text;
  std::string quoted = "\"";
  for (const char c : node.text) {
    if (c == '\n') quoted += "\\n";
    else if (c == '\t') quoted += "\\t";
    else if (c == '"' || c == '\\') quoted += std::string("\\") + c;
    else quoted += c;
  }
  return quoted + "\"";
}

void print_map(const Node& map, std::size_t indent, std::string& text) {
  const std::string blanks(indent, ' ');
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    const Node& value = map.items[i];
    const std::string key = blanks + scalar_text(map.keys[i]) + ":", line = flow_text(value);
    const bool nested = key.size() + line.size() > kLineWidth && !value.items.empty();
    text += key;
    if (!nested) {
      text += " " + line + "\n";
    } else if (value.kind == NodeKind::map) {
      text += "\n";
      print_map(value, indent + 2, text);
    } else {
      text += "\n";
      for (const Node& item : value.items) text += blanks + "  - " + flow_text(item) + "\n";
    }
  }
}

}  // namespace

std::string flow_text(const Node& value) {
  if (value.kind == NodeKind::null) return "null";
  if (value.kind == NodeKind::scalar) return scalar_text(value);
  std::string text = value.kind == NodeKind::list ? "[" : "{";
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    if (i > 0) text += ", ";
    if (value.kind == NodeKind::map) text += scalar_text(value.keys[i]) + ": ";
    text += flow_text(value.items[i]);
  }
  return text + (value.kind == NodeKind::list ? "]" : "}");
}

std::string block_text(const Node& map) {
  std::string text;
  print_map(map, 0, text);
  return text;
}

}  // namespace orbc::scene
