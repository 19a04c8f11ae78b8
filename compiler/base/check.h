#pragma once
#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace orbc {

/// Prints the failed comparison and its place, then aborts. For errors of orbc itself, never for errors of the user.
template <class A, class B>
[[noreturn]] void check_failed(const char* expression, const A& left, const B& right, const char* file, int line) {
  const std::string text = fmt::format("orbc: internal error at {}:{}: {} (left {}, right {})\n", file, line, expression, left, right);
  std::fputs(text.c_str(), stderr);  // fmt::print would throw where standard error is closed
  std::abort();
}

}  // namespace orbc

/// ORBC_CHECK(a, <, b) aborts with both operands unless `a < b`.
#define ORBC_CHECK(a, op, b)                                                                 \
  do {                                                                                       \
    const auto& orbc_left = (a);                                                             \
    const auto& orbc_right = (b);                                                            \
    if (!(orbc_left op orbc_right))                                                          \
      ::orbc::check_failed(#a " " #op " " #b, orbc_left, orbc_right, __FILE__, __LINE__);    \
  } while (false)
