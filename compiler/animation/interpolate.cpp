#include "compiler/animation/interpolate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "compiler/image/srgb.h"
#include "compiler/scene/color.h"
#include "compiler/scene/print_document.h"
#include "compiler/scene/values.h"

namespace orbc::animation {
namespace {

using scene::Node;
using scene::NodeKind;

/// A number and its unit: "deg", "rad" or none.
struct Measure {
  double value = 0;
  std::string unit;
};

std::optional<Measure> measure_of(const Node& node) {
  if (node.kind != NodeKind::scalar || node.quoted) return std::nullopt;
  if (const auto number = scene::number_of(node)) return Measure{*number, ""};
  for (const char* unit : {"deg", "rad"}) {
    const std::string& text = node.text;
    if (text.size() <= 3 || text.compare(text.size() - 3, 3, unit) != 0) continue;
    Node digits = node;
    digits.text = text.substr(0, text.find_last_not_of(' ', text.size() - 4) + 1);
    if (const auto number = scene::number_of(digits)) return Measure{*number, unit};
  }
  return std::nullopt;
}

Node scalar(std::string text, const Node& like, bool quoted = false) {
  Node node;
  node.kind = NodeKind::scalar;
  node.text = std::move(text);
  node.quoted = quoted;
  node.span = like.span;
  return node;
}

/// The shortest text that reads back as the same number.
std::string to_text(double value) { return fmt::format("{}", value); }

Node color_node(const scene::Color& color, const Node& like) {
  Node node;
  node.kind = NodeKind::list;
  node.span = like.span;
  for (const double channel : {color.r, color.g, color.b})
    node.items.push_back(scalar(to_text(std::clamp(image::encode_srgb(channel), 0.0, 1.0)), like));
  return node;
}

std::optional<scene::Color> color_of(const Node& node) {
  return node.kind == NodeKind::scalar ? scene::parse_color(node.text) : std::nullopt;
}

Result<Node> mix(const Node& a, const Node& b, double s);

Result<Node> mix_items(const Node& a, const Node& b, double s) {
  Node mixed = a;
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    const Node* other = a.kind == NodeKind::list ? &b.items[i] : b.find(a.keys[i].text);
    auto item = mix(a.items[i], *other, s);
    if (!item) return item;
    mixed.items[i] = std::move(*item);
  }
  return mixed;
}

bool same_shape(const Node& a, const Node& b) {
  if (a.kind != b.kind || a.items.size() != b.items.size()) return false;
  return a.kind == NodeKind::list || (a.kind == NodeKind::map && std::all_of(a.keys.begin(), a.keys.end(),
                                                                             [&](const Node& key) { return b.find(key.text) != nullptr; }));
}

/// The value between a (s = 0) and b (s = 1).
Result<Node> mix(const Node& a, const Node& b, double s) {
  const auto x = measure_of(a), y = measure_of(b);
  // A plain number may stand for an angle, in degrees; a unit on one side alone decides for both, unless it would change the meaning.
  if (x && y && (x->unit == y->unit || (x->unit != "rad" && y->unit != "rad")))
    return scalar(to_text(x->value + s * (y->value - x->value)) + (x->unit.empty() ? y->unit : x->unit), b);
  if (const auto p = color_of(a), q = color_of(b); p && q) return color_node((1 - s) * *p + s * *q, b);
  if (same_shape(a, b)) return mix_items(a, b, s);
  if (a.kind == NodeKind::scalar && b.kind == NodeKind::scalar && a.text == b.text) return b;
  return make_error(
      "animation.no-interpolation",
      fmt::format("there is nothing between `{}` and `{}`", scene::flow_text(a).substr(0, 40), scene::flow_text(b).substr(0, 40)),
      "numbers, angles, colours, lists and maps of the same shape run; `interpolate: step` jumps between any two values", b.span);
}

/// The share of the change that is done at the share s of the time between two keyframes.
double eased(double s, bool smooth) { return smooth ? s * s * (3 - 2 * s) : s; }

}  // namespace

Result<Node> value_at(const scene::Keyframes& keyframes, double t) {
  const auto& keys = keyframes.keys;
  const auto after = std::find_if(keys.begin(), keys.end(), [&](const scene::Keyframe& key) { return key.t > t; });
  if (after == keys.begin()) return keys.front().value;
  if (after == keys.end()) return keys.back().value;
  const scene::Keyframe& before = *(after - 1);
  if (keyframes.interpolation == scene::Interpolation::step) return before.value;
  return mix(before.value, after->value,
             eased((t - before.t) / (after->t - before.t), keyframes.interpolation == scene::Interpolation::smooth));
}

}  // namespace orbc::animation
