#include "compiler/diff/json.h"

#include <fmt/format.h>

namespace orbc::diff {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxText = std::size_t{256} << 20;
constexpr int kDeepest = 200;

std::string shown(const Json& value) {
  if (value.is_array()) return fmt::format("a list of {}", value.size());
  if (value.is_object()) return fmt::format("an object with {} keys", value.size());
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 60) + "…";
  return text;
}

class TreeComparison {
 public:
  TreeComparison(const TreeRules& rules, const Limits& limits, Finding& finding) : rules_(rules), limits_(limits), finding_(finding) {}

  void values(const Json& a, const Json& b) {
    if (!finding_.same_structure || (rules_.left_out && rules_.left_out(path_))) return;
    if (a.is_number() && b.is_number()) return numbers(a, b);
    if (a.type() != b.type()) return differ(a, b);
    if (a.is_object()) return objects(a, b);
    if (a.is_array()) return arrays(a, b);
    if (a.is_string()) {
      if (!same_name(a.get_ref<const std::string&>(), rules_.a, b.get_ref<const std::string&>(), rules_.b)) differ(a, b);
      return;
    }
    if (a != b) differ(a, b);
  }

 private:
  void differ(const Json& a, const Json& b) { finding_.differ_in_structure({path_, path_, shown(a) + " against " + shown(b)}); }

  void numbers(const Json& a, const Json& b) {
    if (a.is_number_integer() && b.is_number_integer()) {
      ++finding_.numbers;
      if (a != b) differ(a, b);
      return;
    }
    (void)take_numbers(a.get<double>(), b.get<double>(), limits_, finding_, [&] {
      return Difference{path_, path_, shown(a) + " against " + shown(b)};
    });
  }

  void objects(const Json& a, const Json& b) {
    const std::size_t length = path_.size();
    const auto without = [&](const Json& one, const Json& other, const char* which) {
      for (const auto& item : one.items()) {
        path_.resize(length);
        path_ += '.' + item.key();
        if (other.contains(item.key()) || (rules_.left_out && rules_.left_out(path_))) continue;
        finding_.differ_in_structure({path_, path_, fmt::format("only the {} file has this key", which)});
        break;
      }
      path_.resize(length);
    };
    without(a, b, "first");
    without(b, a, "second");
    for (const auto& item : a.items()) {
      if (!finding_.same_structure) return;
      const auto other = b.find(item.key());
      if (other == b.end()) continue;  // left out
      path_.resize(length);
      path_ += '.' + item.key();
      values(item.value(), *other);
    }
    path_.resize(length);
  }

  void arrays(const Json& a, const Json& b) {
    if (a.size() != b.size()) return differ(a, b);
    const std::size_t length = path_.size();
    for (std::size_t i = 0; i < a.size() && finding_.same_structure; ++i) {
      path_.resize(length);
      path_ += fmt::format("[{}]", i);
      values(a[i], b[i]);
    }
    path_.resize(length);
  }

  const TreeRules& rules_;
  const Limits& limits_;
  Finding& finding_;
  std::string path_ = "$";
};

}  // namespace

Result<Json> parse_json(std::string_view text, const std::string& name) {
  if (text.size() > kMaxText) return bad_file(name, fmt::format("more than {} MiB of JSON are not read", kMaxText >> 20));
  bool too_deep = false;
  try {
    Json tree = Json::parse(text.begin(), text.end(), [&](int depth, Json::parse_event_t, Json&) {
      if (depth <= kDeepest) return true;
      too_deep = true;
      throw std::length_error("too deep");
    });
    return tree;
  } catch (const Json::exception& error) {
    std::string why = error.what();  // "[json.exception.parse_error.101] parse error at line 1, column 2: …"
    if (const std::size_t end = why.find("] "); end != std::string::npos) why = why.substr(end + 2);
    return bad_file(name, why);
  } catch (const std::length_error&) {
    if (!too_deep) throw;
    return bad_file(name, fmt::format("more than {} lists and objects inside each other", kDeepest));
  }
}

void compare_trees(const Json& a, const Json& b, const TreeRules& rules, const Limits& limits, Finding& finding) {
  TreeComparison(rules, limits, finding).values(a, b);
}

Diagnostics compare_json(const Source& a, const Source& b, const Limits& limits, Finding& finding) {
  const auto left = parse_json(a.bytes, a.name), right = parse_json(b.bytes, b.name);
  if (!left) return left.error();
  if (!right) return right.error();
  compare_trees(*left, *right, {a, b, {}}, limits, finding);
  return {};
}

}  // namespace orbc::diff
