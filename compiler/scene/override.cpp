// An override changes the document before it is read, so that all checks, hints and warnings of the reader apply to it too.
#include "compiler/scene/override.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "compiler/scene/document.h"
#include "compiler/scene/locator.h"
#include "compiler/scene/readers.h"

namespace orbc::scene {
namespace {

constexpr std::size_t kMaxPathSteps = 64;  // steps of a path; scenes nest five or six deep
constexpr std::string_view kBlanks = " \t\r\n";
constexpr const char* kFormat = "write KEY=VALUE, such as camera.fov=60deg or objects.ball.at.polar=[0.2,30deg]";

struct PathStep {
  std::string word;
  bool quoted = false;              // never a number
  SourceSpan span;
};

struct Override {
  std::vector<PathStep> path;
  Node value;
  bool removes = false;
};

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  return begin == std::string_view::npos ? std::string_view() : text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

void relocate(Node& node, const std::shared_ptr<const SourceText>& source) {
  node.span.source = source;
  for (Node& key : node.keys) relocate(key, source);
  for (Node& item : node.items) relocate(item, source);
}

// The end of the path: the first equal sign outside of quotes.
std::size_t end_of_path(std::string_view text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quote) quote = text[i] == quote ? '\0' : quote;
    else if (text[i] == '"' || text[i] == '\'') quote = text[i];
    else if (text[i] == '=') return i;
  }
  return std::string_view::npos;
}

Result<std::vector<PathStep>> read_path(const Locator& locator, std::size_t end) {
  std::vector<PathStep> path;
  const std::string_view text = locator.text().substr(0, end);
  for (std::size_t begin = 0; begin <= text.size();) {
    while (begin < text.size() && kBlanks.find(text[begin]) != std::string_view::npos) ++begin;
    PathStep step;
    step.quoted = begin < text.size() && (text[begin] == '"' || text[begin] == '\'');
    const std::size_t closed = step.quoted ? text.find(text[begin], begin + 1) : begin;
    const std::size_t dot = std::min(text.find('.', std::min(closed, text.size())), text.size());
    std::string_view word = trimmed(text.substr(begin, dot - begin));
    step.span = locator.scalar_at(begin, word);
    if (step.quoted && word.size() >= 2 && word.back() == word.front()) word = word.substr(1, word.size() - 2);
    step.word = word;
    if (step.word.empty()) return make_error("scene.bad-override", "a word is missing here in the path", kFormat, locator.at(begin));
    path.push_back(std::move(step));
    begin = dot + 1;
  }
  if (path.size() > kMaxPathSteps)
    return make_error("scene.too-deep", fmt::format("the path has more than {} steps", kMaxPathSteps), "no part of a scene nests so deep",
                      path[kMaxPathSteps].span);
  return path;
}

// Parses the value as YAML. Blanks replace the path, so that columns are those of the argument.
Result<Document> read_value(const std::shared_ptr<const SourceText>& source, std::size_t begin) {
  const std::string_view text = source->text;
  const auto starts_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  const auto columns = static_cast<std::size_t>(std::count_if(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin),
                                                              starts_character));
  const auto padded = std::make_shared<SourceText>(SourceText{source->name, std::string(columns, ' ')});
  padded->text += text.substr(begin);
  Result<Document> parsed = parse_document(padded);
  if (!parsed) {
    Diagnostics errors = std::move(parsed).error();
    for (Diagnostic& error : errors) error.span.source = source;
    return errors;
  }
  relocate(parsed->root, source);
  for (Diagnostic& fault : parsed->faults) fault.span.source = source;
  return parsed;
}

Result<Override> read_override(const std::shared_ptr<const SourceText>& source, Diagnostics& faults) {
  const Locator locator(source);
  if (auto bad = locator.first_bad_character()) return std::move(*bad);
  const std::string_view text = locator.text();
  const std::size_t equals = end_of_path(text);
  if (equals == std::string_view::npos)
    return make_error("scene.bad-override", "there is no equal sign between key and value", kFormat, locator.token_at(0));
  Override change;
  auto path = read_path(locator, equals);
  if (!path) return path.error();
  change.path = std::move(*path);
  const std::string_view value = trimmed(text.substr(equals + 1));
  change.removes = value.empty() || value == "null" || value == "~";
  if (change.removes) return change;
  if (value[0] == '#' || value[0] == '*') {
    change.value.kind = NodeKind::scalar;
    change.value.quoted = true;
    change.value.text = value;
    change.value.span = locator.scalar_at(static_cast<std::size_t>(value.data() - text.data()), value);
    return change;
  }
  auto document = read_value(source, equals + 1);
  if (!document) return document.error();
  faults.insert(faults.end(), document->faults.begin(), document->faults.end());
  change.value = std::move(document->root);
  return change;
}

// "7" → 7; 0 for words that are no item numbers.
std::size_t item_number(const PathStep& step) {
  const bool digits = !step.quoted && step.word.size() <= 6 && step.word[0] != '0' &&
                      step.word.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::stoul(step.word) : 0;
}

bool is_list(std::string_view key) { return key == "objects" || key == "lights" || key == "cuts" || key == "mirrors"; }

class OverrideApplier {
 public:
  OverrideApplier(Node& root, const Override& change) : change_(change), at_(&root) {}

  Diagnostics run() {
    for (step_ = 0; step_ < change_.path.size() && found_.empty() && at_; ++step_) {
      if (at_->kind == NodeKind::null) make_container();
      if (at_->kind == NodeKind::map) through_map();
      else if (at_->kind == NodeKind::list) through_list();
      else refuse_scalar();
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] const PathStep& step() const { return change_.path[step_]; }
  [[nodiscard]] bool last() const { return step_ + 1 == change_.path.size(); }
  [[nodiscard]] std::string parent() const { return step_ == 0 ? "the scene" : fmt::format("`{}`", change_.path[step_ - 1].word); }

  void error(const char* code, std::string message, std::string hint) {
    found_.push_back(make_error(code, std::move(message), std::move(hint), step().span));
  }

  void nothing_to_remove(const std::vector<std::string>& known) {
    const std::string nearest = nearest_word(step().word, known);
    found_.push_back(make_warning("scene.no-effect", fmt::format("{} has no `{}` that could be removed", parent(), step().word),
                                  nearest.empty() ? "" : fmt::format("did you mean `{}`?", nearest), step().span));
  }

  // Creates a map or list for a key without a value. It keeps the span of the value around it, since errors there are not this override's.
  void make_container() {
    at_->kind = step_ > 0 && is_list(change_.path[step_ - 1].word) && item_number(step()) > 0 ? NodeKind::list : NodeKind::map;
  }

  void through_map() {
    const auto key = std::find_if(at_->keys.begin(), at_->keys.end(), [&](const Node& k) { return k.text == step().word; });
    const auto index = key - at_->keys.begin();
    if (key == at_->keys.end()) {
      if (change_.removes) {
        std::vector<std::string> known;
        for (const Node& other : at_->keys) known.push_back(other.text);
        return nothing_to_remove(known);
      }
      Node fresh;
      fresh.kind = NodeKind::scalar;
      fresh.text = step().word;
      fresh.span = step().span;
      Node value;
      value.span = at_->span;
      at_->keys.push_back(std::move(fresh));
      at_->items.push_back(std::move(value));
    } else if (last() && change_.removes) {
      at_->keys.erase(key);
      at_->items.erase(at_->items.begin() + index);
      return;
    } else if (last()) {
      key->span = step().span;
    }
    enter(static_cast<std::size_t>(index));
  }

  void through_list() {
    std::vector<std::string> names;
    if (step_ == 1 && change_.path[0].word == "objects") names = object_names(*at_);
    std::size_t number = item_number(step());
    if (number == 0) number = static_cast<std::size_t>(std::find(names.begin(), names.end(), step().word) - names.begin()) + 1;
    const std::size_t count = at_->items.size();
    const bool named = item_number(step()) == 0;
    if (number > count + 1 || (number > count && (named || change_.removes))) return refuse_item(names, count);
    if (number > count) {
      at_->items.emplace_back();
      at_->items.back().span = step().span;
    } else if (last() && change_.removes) {
      at_->items.erase(at_->items.begin() + static_cast<std::ptrdiff_t>(number) - 1);
      return;
    }
    enter(number - 1);
  }

  void refuse_item(const std::vector<std::string>& names, std::size_t count) {
    const std::string nearest = nearest_word(step().word, names);
    std::string hint = !nearest.empty() ? fmt::format("did you mean `{}`?", nearest)
                       : names.empty()  ? "items have numbers, counted from 1"
                                        : fmt::format("items have numbers, counted from 1, and names: here {}", listed(names, "and"));
    if (item_number(step()) > 0) {
      hint = count == 0 ? "it is empty" : count == 1 ? "it has one item" : fmt::format("it has the items 1 to {}", count);
      if (!change_.removes) hint += fmt::format("; {} would append one", count + 1);
    }
    error("scene.no-such-item", fmt::format("{} has no item `{}`", parent(), step().word), std::move(hint));
  }

  void refuse_scalar() {
    error("scene.not-a-map", fmt::format("{} is `{}` here, which has no keys", parent(), at_->text.substr(0, 40)),
          step_ == 0 ? "" : fmt::format("say all of it: {}={{{}: …}}", path_text(step_), step().word));
  }

  [[nodiscard]] std::string path_text(std::size_t steps) const {
    std::string text;
    for (std::size_t i = 0; i < steps; ++i) text += (i == 0 ? "" : ".") + change_.path[i].word;
    return text;
  }

  void enter(std::size_t index) {
    at_ = &at_->items[index];
    if (last()) *at_ = change_.value;
  }

  const Override& change_;
  Node* at_;
  std::size_t step_ = 0;
  Diagnostics found_;
};

}  // namespace

OverrideSources sources_of(const Overrides& overrides) {
  OverrideSources sources;
  for (const SourceText& text : overrides) sources.push_back(std::make_shared<const SourceText>(text));
  return sources;
}

Diagnostics apply_overrides(const OverrideSources& overrides, Document& document) {
  Diagnostics found;
  for (const auto& source : overrides) {
    const Result<Override> change = read_override(source, found);
    if (!change) found.insert(found.end(), change.error().begin(), change.error().end());
    if (!change || document.root.kind != NodeKind::map) continue;  // the reader refuses a scene that is no map
    const Diagnostics more = OverrideApplier(document.root, *change).run();
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

}  // namespace orbc::scene
