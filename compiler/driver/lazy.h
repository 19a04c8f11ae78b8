#pragma once
#include <mutex>
#include <optional>

namespace orbc::driver {

/// A value that is made when it is first needed, and never again.
/// Invariant: one thread makes the value while others wait; afterwards it does not change. A `make` that throws leaves it unmade.
/// Not promised: calls of `get` from tasks of the executor with which `make` works; they may wait for themselves.
template <class T>
class Lazy {
 public:
  template <class Make>
  [[nodiscard]] const T& get(const Make& make) const {
    const std::lock_guard lock(mutex_);
    if (!value_) value_.emplace(make());
    return *value_;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::optional<T> value_;
};

}  // namespace orbc::driver
