#pragma once
#include <cstddef>
#include <memory>
#include <string>

namespace orbc {

/// A text that diagnostics quote: the name of its file, as the user gave it, and its bytes.
struct SourceText {
  std::string name;
  std::string text;
};

/// A run of characters in a source text. Line and column count from 1 (columns in code points); line 0 means "the whole file".
struct SourceSpan {
  std::shared_ptr<const SourceText> source;
  std::size_t line = 0;
  std::size_t column = 0;
  std::size_t length = 1;
};

}  // namespace orbc
