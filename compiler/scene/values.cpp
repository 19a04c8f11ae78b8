// Scalars follow the core schema of YAML 1.2 (§ 10.3), not YAML 1.1: `on`, `yes`, `0x10`, `1:30` and `1_000` are words.
#include "compiler/scene/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace orbc::scene {
namespace {

constexpr std::size_t kMaxQuotedBytes = 40;  // of an author's word in a message

std::string shortened(std::string_view text) {
  if (text.size() <= kMaxQuotedBytes) return std::string(text);
  std::size_t end = kMaxQuotedBytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return std::string(text.substr(0, end)) + "…";
}

std::string described(const Node& node) {
  switch (node.kind) {
    case NodeKind::null: return "nothing";
    case NodeKind::list: return "a list";
    case NodeKind::map: return "a map";
    case NodeKind::scalar: break;
  }
  if (node.text.find('\n') != std::string::npos) return "a text of several lines";
  const std::string shown = fmt::format("\"{}\"", shortened(node.text));
  return node.quoted ? "the text " + shown : number_of(node) ? shortened(node.text) : shown;
}

std::string keys_of(const std::vector<std::string>& known) {
  return fmt::format("{} {}", known.size() == 1 ? "its only key is" : "its keys are", listed(known, "and"));
}

bool is_truth_value(std::string_view text) {
  return text == "true" || text == "True" || text == "TRUE" || text == "false" || text == "False" || text == "FALSE";
}

// Decimal integers and floats as in JSON, but also "+1", ".5" and "5.".
std::optional<double> parse_number(std::string_view text) {
  const std::string_view unsigned_text = !text.empty() && (text[0] == '+' || text[0] == '-') ? text.substr(1) : text;
  const double sign = !text.empty() && text[0] == '-' ? -1 : 1;
  if (unsigned_text == ".inf" || unsigned_text == ".Inf" || unsigned_text == ".INF") return sign * std::numeric_limits<double>::infinity();
  if (text == ".nan" || text == ".NaN" || text == ".NAN") return std::numeric_limits<double>::quiet_NaN();
  if (unsigned_text.empty() || unsigned_text.find_first_not_of("0123456789.eE+-") != std::string_view::npos) return std::nullopt;
  const bool digit_first = unsigned_text[0] >= '0' && unsigned_text[0] <= '9';
  if (!digit_first && !(unsigned_text[0] == '.' && unsigned_text.size() > 1 && unsigned_text[1] >= '0' && unsigned_text[1] <= '9'))
    return std::nullopt;
#ifdef __EMSCRIPTEN__  // its libc++ has no from_chars for doubles; its strtod rounds alike and knows one locale
  const std::string terminated(unsigned_text);
  char* end = nullptr;
  const double value = std::strtod(terminated.c_str(), &end);
  if (end != terminated.c_str() + terminated.size()) return std::nullopt;
#else
  double value = 0;
  const auto [end, error] = std::from_chars(unsigned_text.data(), unsigned_text.data() + unsigned_text.size(), value);
  if (end != unsigned_text.data() + unsigned_text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {  // too small counts as 0, too large as infinite
    const std::size_t e = unsigned_text.find_first_of("eE");
    const bool tiny = e != std::string_view::npos ? unsigned_text[e + 1] == '-' : unsigned_text[0] == '.' || unsigned_text[0] == '0';
    return tiny ? 0.0 : sign * std::numeric_limits<double>::infinity();
  }
#endif
  return sign * value;
}

}  // namespace

std::optional<double> number_of(const Node& node) {
  if (node.kind != NodeKind::scalar || node.quoted) return std::nullopt;
  return parse_number(node.text);
}

std::string listed(const std::vector<std::string>& words, std::string_view last) {
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i)
    all += i == 0 ? words[i] : i + 1 == words.size() ? fmt::format(" {} {}", last, words[i]) : fmt::format(", {}", words[i]);
  return all;
}

bool contains(const Range& range, double value) {
  return (range.open_min ? value > range.min : value >= range.min) && (range.open_max ? value < range.max : value <= range.max);
}

std::string to_string(const Range& range) {
  if (!range.open_min && !range.open_max) return fmt::format("from {} to {}", range.min, range.max);
  return fmt::format("{} {} and {} {}", range.open_min ? "greater than" : "at least", range.min, range.open_max ? "less than" : "at most",
                     range.max);
}

// ---- Reader ---------------------------------------------------------------------------------------------------------------

void Reader::error(std::string code, const SourceSpan& span, std::string message, std::string hint) {
  diagnostics.push_back(make_error(std::move(code), std::move(message), std::move(hint), span));
}

void Reader::warning(std::string code, const SourceSpan& span, std::string message, std::string hint) {
  diagnostics.push_back(make_warning(std::move(code), std::move(message), std::move(hint), span));
}

void Reader::wrong_type(const Node& node, std::string_view what, std::string_view wanted, std::string hint) {
  if (hint.empty() && node.kind == NodeKind::null) hint = "give it a value or remove the line";
  error("scene.wrong-type", node.span, fmt::format("{} must be {}, but is {}", what, wanted, described(node)), std::move(hint));
}

void Reader::unknown_value(const Node& node, std::string_view what, const std::vector<std::string>& known) {
  if (node.kind != NodeKind::scalar) return wrong_type(node, what, listed(known));
  const std::string nearest = nearest_word(node.text, known);
  error("scene.unknown-value", node.span, fmt::format("{} must be {}, but is {}", what, listed(known), described(node)),
        nearest.empty() ? "" : fmt::format("did you mean `{}`?", nearest));
}

double Reader::number(const Node& node, std::string_view what, double fallback, const Range& range) {
  const std::optional<double> value = number_of(node);
  if (!value) {
    const bool text = node.kind == NodeKind::scalar && node.quoted && parse_number(node.text);
    wrong_type(node, what, "a number " + to_string(range), text ? "remove the quotes" : "");
    return fallback;
  }
  if (!std::isfinite(*value)) {
    error("scene.not-finite", node.span,
          fmt::format("{} must be a finite number, but is {}", what, node.text.size() > 40 ? "too large" : node.text),
          "allowed is a number " + to_string(range));
    return fallback;
  }
  if (!contains(range, *value)) {
    error("scene.out-of-range", node.span, fmt::format("{} must be {}, but is {}", what, to_string(range), *value));
    return fallback;
  }
  return *value;
}

int Reader::integer(const Node& node, std::string_view what, int fallback, int min, int max) {
  const Range range{static_cast<double>(min), static_cast<double>(max)};
  const double value = number(node, what, fallback, range);
  if (value != std::floor(value)) {
    wrong_type(node, what, "a whole number " + to_string(range));
    return fallback;
  }
  return static_cast<int>(value);
}

bool Reader::boolean(const Node& node, std::string_view what, bool fallback) {
  if (node.kind == NodeKind::scalar && !node.quoted && is_truth_value(node.text)) return node.text[0] == 't' || node.text[0] == 'T';
  wrong_type(node, what, "true or false");
  return fallback;
}

std::optional<std::string> Reader::text(const Node& node, std::string_view what) {
  const bool text = node.kind == NodeKind::scalar && (node.quoted || !(number_of(node) || is_truth_value(node.text)));
  if (text && !node.text.empty()) return node.text;
  if (text) error("scene.wrong-type", node.span, fmt::format("{} must not be empty", what));
  else wrong_type(node, what, "text", node.kind == NodeKind::scalar ? "write it in quotes" : "");
  return std::nullopt;
}

Color Reader::color(const Node& node, std::string_view what, const Color& fallback) {
  if (node.kind == NodeKind::list) {
    const auto rgb = numbers<3>(node, what, {0.5, 0.5, 0.5}, kUnit, "three numbers from 0 to 1: red, green, blue");
    return from_srgb(rgb[0], rgb[1], rgb[2]);
  }
  static constexpr const char* kWanted = "a colour: a CSS name, \"#rgb\", \"#rrggbb\" or [red, green, blue] from 0 to 1";
  if (node.kind == NodeKind::null) {
    wrong_type(node, what, kWanted, "in YAML a # starts a comment: write \"#ffeedd\" in quotes");
    return fallback;
  }
  const bool text = node.kind == NodeKind::scalar && (node.quoted || !(number_of(node) || is_truth_value(node.text)));
  if (!text) {
    wrong_type(node, what, kWanted);
    return fallback;
  }
  if (const auto parsed = parse_color(node.text)) return *parsed;
  const std::string nearest = !node.text.empty() && node.text[0] == '#' ? "" : nearest_word(node.text, color_names());
  error("scene.bad-color", node.span, fmt::format("{} must be {}, but is {}", what, kWanted, described(node)),
        nearest.empty() ? "" : fmt::format("did you mean `{}`?", nearest));
  return fallback;
}

Angle Reader::angle(const Node& node, std::string_view what, const Angle& fallback, const Range& degrees) {
  std::optional<double> value = number_of(node);
  bool radians = false;
  if (!value && node.kind == NodeKind::scalar) {
    const std::string_view text = node.text;
    const std::string_view unit = text.size() > 3 ? text.substr(text.size() - 3) : std::string_view();
    radians = unit == "rad";
    if (radians || unit == "deg") {
      std::string_view digits = text.substr(0, text.size() - 3);
      while (!digits.empty() && digits.back() == ' ') digits.remove_suffix(1);
      value = parse_number(digits);
    }
  }
  if (!value) {
    if (node.kind == NodeKind::scalar)
      error("scene.bad-angle", node.span, fmt::format("{} must be an angle, but is {}", what, described(node)),
            "write 30deg or 0.5rad; a plain number means degrees");
    else wrong_type(node, what, "an angle", "write 30deg or 0.5rad; a plain number means degrees");
    return fallback;
  }
  const Angle angle = radians ? Angle{*value} : Angle::from_degrees(*value);
  if (!std::isfinite(*value)) {
    error("scene.not-finite", node.span, fmt::format("{} must be a finite angle", what));
    return fallback;
  }
  if (!contains(degrees, radians ? angle.degrees() : *value)) {
    error("scene.angle-out-of-range", node.span,
          fmt::format("{} must be {} degrees, but is {}", what, to_string(degrees), described(node)));
    return fallback;
  }
  return angle;
}

bool Reader::list(const Node& node, std::string_view what, std::size_t count, std::string_view wanted) {
  if (node.kind != NodeKind::list) {
    wrong_type(node, what, wanted);
    return false;
  }
  if (node.items.size() == count) return true;
  error("scene.wrong-count", node.span, fmt::format("{} must be {}, but the list has {}", what, wanted, node.items.size()));
  return false;
}

// ---- Fields ---------------------------------------------------------------------------------------------------------------

Fields::Fields(Reader& reader, const Node& node, std::string what, std::vector<std::string> known)
    : reader_(reader), node_(node), what_(std::move(what)) {
  if (node.kind != NodeKind::map) {
    reader.wrong_type(node, what_, "a map of keys and values", node.kind == NodeKind::null ? "" : keys_of(known));
    return;
  }
  for (const Node& key : node.keys) {
    if (std::find(known.begin(), known.end(), key.text) != known.end()) continue;
    const std::string nearest = nearest_word(key.text, known);
    reader.error("scene.unknown-key", key.span, fmt::format("{} has no key `{}`", what_, shortened(key.text)),
                 nearest.empty() ? keys_of(known) : fmt::format("did you mean `{}`?", nearest));
  }
}

std::string Fields::quoted(std::string_view key) { return fmt::format("`{}`", key); }

SourceSpan Fields::key_span(std::string_view key) const {
  for (const Node& node : node_.keys)
    if (node.text == key) return node.span;
  return node_.span;
}

void Fields::require(std::string_view key, std::string hint) const {
  if (is_map() && !has(key))
    reader_.error("scene.missing-key", node_.span, fmt::format("{} needs the key `{}`", what_, key), std::move(hint));
}

std::string Fields::only_one_of(const std::vector<std::string>& keys) const {
  std::string first;
  for (const Node& key : node_.keys) {
    if (std::find(keys.begin(), keys.end(), key.text) == keys.end()) continue;
    if (first.empty()) first = key.text;
    else
      reader_.error("scene.conflict", key.span, fmt::format("{} has `{}` already, `{}` cannot stand beside it", what_, first, key.text),
                    "keep one of the two");
  }
  return first;
}

void Fields::no_effect(std::string_view key, std::string_view why) const {
  if (!has(key)) return;
  const SourceSpan span = key_span(key);
  const auto is_same = [&](const Diagnostic& d) {
    return d.code == "scene.no-effect" && d.span.line == span.line && d.span.column == span.column;
  };
  if (std::any_of(reader_.diagnostics.begin(), reader_.diagnostics.end(), is_same)) return;  // one warning per key is enough
  reader_.warning("scene.no-effect", span, fmt::format("`{}` changes nothing here: {}", key, why), "remove it");
}

double Fields::number(std::string_view key, double fallback, const Range& range) const {
  const Node* node = find(key);
  return node ? reader_.number(*node, quoted(key), fallback, range) : fallback;
}

int Fields::integer(std::string_view key, int fallback, int min, int max) const {
  const Node* node = find(key);
  return node ? reader_.integer(*node, quoted(key), fallback, min, max) : fallback;
}

bool Fields::boolean(std::string_view key, bool fallback) const {
  const Node* node = find(key);
  return node ? reader_.boolean(*node, quoted(key), fallback) : fallback;
}

Color Fields::color(std::string_view key, const Color& fallback) const {
  const Node* node = find(key);
  return node ? reader_.color(*node, quoted(key), fallback) : fallback;
}

Angle Fields::angle(std::string_view key, const Angle& fallback, const Range& degrees) const {
  const Node* node = find(key);
  return node ? reader_.angle(*node, quoted(key), fallback, degrees) : fallback;
}

}  // namespace orbc::scene
