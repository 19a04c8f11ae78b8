// The only file that includes yaml-cpp. Its events build our own tree. So nodes have exact spans, aliases are never expanded, depth and
// number of values are bounded while parsing (yaml-cpp recurses one level per OnMapStart/OnSequenceStart, and our handler throws from
// there), and duplicate keys are found. Bytes that yaml-cpp treats specially (NUL, 0x04, other encodings) are rejected before it is called.
#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "compiler/scene/document.h"
#include "compiler/scene/locator.h"

namespace orbc::scene {
namespace {

struct Refusal {  // thrown by the handler through yaml-cpp, caught in parse_document
  Diagnostic diagnostic;
};

// Usually an orbifold without quotes.
Diagnostic alias(const Locator& locator, std::size_t offset) {
  return make_error("scene.alias", "in YAML a word that starts with * is a reference to an anchor, which scene files do not have",
                    "a notation is text, write it in quotes: orbifold: \"*22222\"", locator.token_at(offset));
}

class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const Locator& locator, const DocumentLimits& limits) : locator_(locator), limits_(limits) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1)
      refuse(mark, "scene.many-documents", "a second YAML document starts here",
             "a scene is one document: remove the line `---` or `...`, or put the second scene into its own file");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { put(Node{}, mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { throw Refusal{alias(locator_, static_cast<std::size_t>(mark.pos))}; }
  void OnAnchor(const YAML::Mark& mark, const std::string&) override {
    refuse(mark, "scene.alias", "anchors (&name) and references (*name) are not part of a scene file",
           "write the value out; `walls: {all: …}` shares settings between walls");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, const std::string& value) override {
    refuse_tag(mark, tag);
    if (!locator_.quote_is_closed(mark.pos))
      refuse(mark, "scene.syntax", "this quote is not closed", "end the text with the quote it starts with");
    Node node;
    node.kind = NodeKind::scalar;
    node.text = value;
    node.quoted = tag == "!";
    put(std::move(node), mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, YAML::EmitterStyle::value) override {
    open(NodeKind::list, mark, tag);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, YAML::EmitterStyle::value) override {
    open(NodeKind::map, mark, tag);
  }
  void OnMapEnd() override { close(); }

  // The innermost list or map that is still open.
  [[nodiscard]] std::optional<SourceSpan> innermost() const {
    return levels_.empty() ? std::nullopt : std::optional(levels_.back().node.span);
  }

  Document document;

 private:
  struct Level {
    Node node;
    bool value_next = false;        // of a map: the key is read
    Node key;
    std::map<std::string, SourceSpan> seen;
  };

  [[noreturn]] void refuse(const YAML::Mark& mark, const char* code, std::string message, std::string hint) const {
    throw Refusal{make_error(code, std::move(message), std::move(hint), locator_.token_at(mark.pos))};
  }
  void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!")
      refuse(mark, "scene.tag", "YAML tags (!name) are not part of a scene file", "remove the tag");
  }

  void count(const YAML::Mark& mark) {
    if (++values_ > limits_.values)
      refuse(mark, "scene.too-many-values", fmt::format("the scene has more than {} values", limits_.values),
             "put big data into mesh files");
  }

  void open(NodeKind kind, const YAML::Mark& mark, const std::string& tag) {
    refuse_tag(mark, tag);
    count(mark);
    if (levels_.size() >= limits_.depth)
      refuse(mark, "scene.too-deep", fmt::format("more than {} lists and maps inside each other", limits_.depth),
             "no part of a scene nests so deep: is a bracket missing?");
    Level level;
    level.node.kind = kind;
    level.node.span = locator_.at(mark.pos);
    levels_.push_back(std::move(level));
  }

  void close() {
    Node node = std::move(levels_.back().node);
    levels_.pop_back();
    attach(std::move(node));
  }

  void put(Node node, const YAML::Mark& mark) {
    count(mark);
    node.span = locator_.scalar_at(mark.pos, node.text);
    attach(std::move(node));
  }

  void attach(Node node) {
    if (levels_.empty()) {
      document.root = std::move(node);
      return;
    }
    Level& level = levels_.back();
    if (level.node.kind == NodeKind::list) level.node.items.push_back(std::move(node));
    else if (!level.value_next) {
      level.key = std::move(node);
      level.value_next = true;
    } else {
      level.value_next = false;
      add_entry(level, std::move(node));
    }
  }

  void add_entry(Level& level, Node value) {
    if (level.key.kind != NodeKind::scalar) {
      document.faults.push_back(make_error("scene.bad-key", "a key must be a word or a number", "write `key: value`", level.key.span));
      return;
    }
    if (value.kind == NodeKind::null) value.span = level.key.span;  // yaml-cpp marks the next token, which may be lines below
    const auto [first, fresh] = level.seen.emplace(level.key.text, level.key.span);
    if (!fresh) {
      document.faults.push_back(make_error("scene.duplicate-key",
                                           fmt::format("`{}` is given twice here, first in line {}", level.key.text, first->second.line),
                                           "keep one of the two", level.key.span));
      return;
    }
    level.node.keys.push_back(std::move(level.key));
    level.node.items.push_back(std::move(value));
  }

  const Locator& locator_;
  DocumentLimits limits_;
  std::vector<Level> levels_;
  std::size_t values_ = 0;
  int documents_ = 0;
};

// Hints for yaml-cpp's messages.
std::string hint_for(const std::string& message) {
  static const std::map<std::string, std::string> hints = {
      {YAML::ErrorMsg::MAP_VALUE, "only one `key: value` may stand on a line outside { }; text that contains `: ` must stand in quotes"},
      {YAML::ErrorMsg::MAP_KEY, "only one `key: value` may stand on a line outside { }; text that contains `? ` must stand in quotes"},
      {YAML::ErrorMsg::END_OF_MAP, "do all keys of this block start in the same column, and does each have its colon?"},
      {YAML::ErrorMsg::END_OF_SEQ, "do all `-` of this list start in the same column?"},
      {YAML::ErrorMsg::FLOW_END, "there is a ] or } without the [ or { before it"},
      {YAML::ErrorMsg::EOF_IN_SCALAR, "a quote is not closed"},
      {YAML::ErrorMsg::DOC_IN_SCALAR, "a quote is not closed"},
      {YAML::ErrorMsg::BLOCK_ENTRY, "a list starts on its own line, below its key"},
      {YAML::ErrorMsg::UNKNOWN_TOKEN, "text that starts with one of @ ` % must stand in quotes"},
  };
  const auto found = hints.find(message);
  return found == hints.end() ? std::string() : found->second;
}

// The first tab among the blanks that start the line of `offset` or the line before it.
std::optional<std::size_t> tab_in_indentation(std::string_view text, std::size_t offset) {
  std::size_t end = std::min(offset, text.size());
  for (int lines = 0; lines < 2; ++lines) {
    const std::size_t begin = end == 0 ? 0 : text.rfind('\n', end - 1) + 1;
    const std::size_t blank = text.find_first_not_of(' ', begin);
    if (blank != std::string_view::npos && text[blank] == '\t') return blank;
    if (begin == 0) break;
    end = begin - 1;
  }
  return std::nullopt;
}

// Whether a quoted text ends before `offset`, in its line.
bool follows_quote(std::string_view text, std::size_t offset) {
  const std::size_t last = offset == 0 ? std::string_view::npos : text.find_last_not_of(' ', std::min(offset, text.size()) - 1);
  return last != std::string_view::npos && (text[last] == '"' || text[last] == '\'');
}

// The diagnostic points to the open bracket, not to the place where the parser stops.
Diagnostic unclosed(const YAML::ParserException& exception, const Locator& locator, const std::optional<SourceSpan>& opened) {
  const bool map = exception.msg == YAML::ErrorMsg::END_OF_MAP_FLOW;
  const SourceSpan noticed = locator.at(static_cast<std::size_t>(exception.mark.pos));
  return make_error(
      "scene.syntax", fmt::format("this {} is not closed, or a comma is missing; noticed in line {}", map ? "{" : "[", noticed.line),
      fmt::format("write the missing {} or comma; a # starts a comment, so colours like \"#ffeedd\" need quotes", map ? "}" : "]"),
      opened ? *opened : noticed);
}

Diagnostic translate(const YAML::ParserException& exception, const Locator& locator, const std::optional<SourceSpan>& opened) {
  const std::size_t offset = exception.mark.is_null() ? 0 : static_cast<std::size_t>(exception.mark.pos);
  if (exception.msg == YAML::ErrorMsg::UNKNOWN_ANCHOR || exception.msg == YAML::ErrorMsg::ALIAS_NOT_FOUND ||
      exception.msg == YAML::ErrorMsg::CHAR_IN_ALIAS)
    return alias(locator, offset > 0 && locator.text().substr(offset - 1, 1) == "*" && locator.text().substr(offset, 1) != "*" ? offset - 1
                                                                                                                               : offset);
  if (const auto tab = tab_in_indentation(locator.text(), offset))
    return make_error("scene.tab", "a tab stands in the indentation", "YAML indents with spaces: use two spaces for each level",
                      locator.at(*tab));
  if (exception.msg == YAML::ErrorMsg::END_OF_MAP_FLOW || exception.msg == YAML::ErrorMsg::END_OF_SEQ_FLOW)
    return unclosed(exception, locator, opened);
  if (exception.msg == YAML::ErrorMsg::END_OF_MAP && follows_quote(locator.text(), offset))
    return make_error("scene.syntax", "text goes on behind the closing quote", "put the whole text into one pair of quotes",
                      locator.at(offset));
  return make_error("scene.syntax", "this is not YAML: " + exception.msg, hint_for(exception.msg), locator.at(offset));
}

}  // namespace

const Node* Node::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i].text == key) return &items[i];
  return nullptr;
}

Result<Document> parse_document(const std::shared_ptr<const SourceText>& source, const DocumentLimits& limits) {
  if (source->text.size() > limits.bytes)
    return make_error("scene.too-large",
                      fmt::format("the file has {} bytes, more than a scene may have ({})", source->text.size(), limits.bytes),
                      "put big data into mesh files", {source, 0, 0, 0});
  const Locator locator(source);
  if (auto bad = locator.first_bad_character()) return std::move(*bad);
  TreeBuilder builder(locator, limits);
  try {
    std::istringstream stream(source->text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const Refusal& refusal) {
    return refusal.diagnostic;
  } catch (const YAML::ParserException& exception) {
    return translate(exception, locator, builder.innermost());
  } catch (const YAML::Exception& exception) {
    return make_error("scene.syntax", "this is not YAML: " + exception.msg, "", {source, 0, 0, 0});
  }
  if (builder.document.root.kind == NodeKind::null)
    return make_error("scene.empty", "the scene is empty", "the smallest scene is the two lines `orbc: 1` and `orbifold: \"*22222\"`",
                      {source, 0, 0, 0});
  return std::move(builder.document);
}

}  // namespace orbc::scene
