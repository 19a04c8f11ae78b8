#pragma once
#include <utility>
#include <variant>

#include "compiler/base/check.h"
#include "compiler/base/diagnostic.h"

namespace orbc {

/// A value, or the diagnostics that say why there is none. Shaped like std::expected<T, Diagnostics>.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Diagnostics errors) : state_(std::in_place_index<1>, std::move(errors)) {}
  Result(Diagnostic error) : state_(std::in_place_index<1>, Diagnostics{std::move(error)}) {}

  [[nodiscard]] bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  [[nodiscard]] T& value() & { return check(), std::get<0>(state_); }
  [[nodiscard]] const T& value() const& { return check(), std::get<0>(state_); }
  [[nodiscard]] T&& value() && { return check(), std::get<0>(std::move(state_)); }
  [[nodiscard]] T& operator*() & { return value(); }
  [[nodiscard]] const T& operator*() const& { return value(); }
  [[nodiscard]] T&& operator*() && { return std::move(*this).value(); }
  [[nodiscard]] T* operator->() { return &value(); }
  [[nodiscard]] const T* operator->() const { return &value(); }
  [[nodiscard]] const Diagnostics& error() const& { return std::get<1>(state_); }
  [[nodiscard]] Diagnostics&& error() && { return std::get<1>(std::move(state_)); }

 private:
  void check() const {
    if (!has_value()) check_failed("Result::value() of a failure", to_text(std::get<1>(state_)), "", __FILE__, __LINE__);
  }
  std::variant<T, Diagnostics> state_;
};

}  // namespace orbc
