#pragma once
#include <string_view>

#include "exporters/text.h"

namespace orbc::gltf {

/// Writes JSON as it goes; knows only where a comma belongs. The caller closes what it opens.
class Json {
 public:
  explicit Json(exporters::Pen& pen) : pen_(pen) {}

  Json& object() { return open('{'); }
  Json& array() { return open('['); }
  Json& end_object() { return close('}'); }
  Json& end_array() { return close(']'); }
  Json& key(std::string_view name) {
    separate();
    text(name);
    pen_ << ':';
    first_ = true;
    return *this;
  }
  Json& string(std::string_view value) {
    separate();
    text(value);
    return *this;
  }
  Json& boolean(bool value) {
    separate();
    pen_ << (value ? "true" : "false");
    return *this;
  }
  template <class T>
  Json& number(T value) {
    separate();
    pen_ << value;
    return *this;
  }
  template <class Range>
  Json& numbers(const Range& values) {
    array();
    for (const auto& value : values) number(value);
    return end_array();
  }

 private:
  Json& open(char bracket) {
    separate();
    pen_ << bracket;
    first_ = true;
    return *this;
  }
  Json& close(char bracket) {
    pen_ << bracket;
    first_ = false;
    return *this;
  }
  void separate() {
    if (!first_) pen_ << ',';
    first_ = false;
  }
  void text(std::string_view value);

  exporters::Pen& pen_;
  bool first_ = true;
};

}  // namespace orbc::gltf
