#include "compiler/base/diagnostic.h"

#include <catch2/catch.hpp>

namespace orbc {
namespace {

SourceSpan span_in(std::string text, std::size_t line, std::size_t column, std::size_t length = 1) {
  return {std::make_shared<SourceText>(SourceText{"kitchen.yaml", std::move(text)}), line, column, length};
}

std::string shown(std::string text, std::size_t line, std::size_t column, std::size_t length = 1) {
  return to_text(make_error("a.b", "wrong", "", span_in(std::move(text), line, column, length)));
}

TEST_CASE("an error shows its place, its line, a caret and a hint", "[base]") {
  const std::string text = "orbc: 1\nroom:\n  orbifold: \"*23\"\n";
  CHECK(to_text(make_error("notation.bad-orbifold", "*23 closes in no space", "*22 or *33", span_in(text, 3, 13, 5))) ==
        "kitchen.yaml:3:13: error[notation.bad-orbifold] *23 closes in no space\n"
        "   3 |   orbifold: \"*23\"\n"
        "     |             ^^^^^\n"
        "  hint: *22 or *33\n");
}

TEST_CASE("a diagnostic without a place is one line", "[base]") {
  CHECK(to_text(make_warning("a.b", "careful")) == "warning[a.b] careful\n");
  CHECK(to_text(make_note("a.b", "by the way", "do this")) == "note[a.b] by the way\n  hint: do this\n");
}

TEST_CASE("line 0 means the whole file", "[base]") { CHECK(shown("x\n", 0, 0) == "kitchen.yaml: error[a.b] wrong\n"); }

TEST_CASE("columns count characters, not bytes", "[base]") {
  CHECK(shown("größe: müll", 1, 8, 4) == "kitchen.yaml:1:8: error[a.b] wrong\n   1 | größe: müll\n     |        ^^^^\n");
  CHECK(shown("\xF0\x9F\x98\x80 x", 1, 3) == "kitchen.yaml:1:3: error[a.b] wrong\n   1 | \xF0\x9F\x98\x80 x\n     |   ^\n");
}

TEST_CASE("a tab is one column wide, so the caret stays below its character", "[base]") {
  CHECK(shown("\ta:\tb", 1, 5) == "kitchen.yaml:1:5: error[a.b] wrong\n   1 |  a: b\n     |     ^\n");
}

TEST_CASE("control bytes and bytes that are not UTF-8 are shown by number", "[base]") {
  CHECK(shown("a\x1B[31mb", 1, 2) == "kitchen.yaml:1:2: error[a.b] wrong\n   1 | a\\x1B[31mb\n     |  ^^^^\n");
  CHECK(shown("\xFFx", 1, 2) == "kitchen.yaml:1:2: error[a.b] wrong\n   1 | \\xFFx\n     |     ^\n");
  // A cut sequence, an overlong slash, a surrogate, a code point above U+10FFFF, a C1 control: none reaches the terminal.
  for (const std::string bad : {"\xC3", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xC2\x9B"}) {
    const std::string text = shown(bad, 1, 1);
    INFO(text);
    CHECK(text.find(bad) == std::string::npos);
    CHECK(text.find("\\x") != std::string::npos);
  }
}

TEST_CASE("messages that quote a file do not smuggle control bytes either", "[base]") {
  const std::string text = to_text(make_error("a.b", "unknown key \"\x1B[2J\xFF\"", "did you mean \"\x07\"?"));
  CHECK(text == "error[a.b] unknown key \"\\x1B[2J\\xFF\"\n  hint: did you mean \"\\x07\"?\n");
}

TEST_CASE("a long line is cut around the caret", "[base]") {
  const std::string text = shown(std::string(5000, 'x') + "HERE" + std::string(5000, 'y'), 1, 5001, 4);
  INFO(text);
  CHECK(text.size() < 500);
  CHECK(text.find("…") != std::string::npos);
  const std::size_t line = text.find('|') + 2, next = text.find('|', line) + 2;
  const std::size_t caret = text.find("^^^^", next) - next;
  const std::string quoted = text.substr(line);
  // The cut mark is one character of three bytes.
  CHECK(quoted.substr(caret + 2, 4) == "HERE");
}

TEST_CASE("places outside the text do no harm", "[base]") {
  CHECK(shown("abc", 1, 4) == "kitchen.yaml:1:4: error[a.b] wrong\n   1 | abc\n     |    ^\n");
  CHECK(shown("abc", 1, 400) == "kitchen.yaml:1:400: error[a.b] wrong\n   1 | abc\n     |    ^\n");
  CHECK(shown("abc", 7, 1) == "kitchen.yaml:7:1: error[a.b] wrong\n   7 | \n     | ^\n");
  CHECK(shown("", 1, 1) == "kitchen.yaml:1:1: error[a.b] wrong\n   1 | \n     | ^\n");
  CHECK(shown("abc", 1, 2, 1000) == "kitchen.yaml:1:2: error[a.b] wrong\n   1 | abc\n     |  ^^\n");
  CHECK(shown("abc", 1, 0) == "kitchen.yaml:1:0: error[a.b] wrong\n   1 | abc\n     | ^\n");
  CHECK(shown("abc", 1, 2, 0) == "kitchen.yaml:1:2: error[a.b] wrong\n   1 | abc\n     |  ^\n");
}

TEST_CASE("a carriage return before the line's end is not part of it", "[base]") {
  CHECK(shown("abc\r\ndef\r\n", 2, 1) == "kitchen.yaml:2:1: error[a.b] wrong\n   2 | def\n     | ^\n");
}

TEST_CASE("located fills in only missing places", "[base]") {
  const SourceSpan here = span_in("x", 1, 1);
  const Diagnostics some = located({make_error("a.b", "one"), make_error("a.c", "two", "", span_in("y", 2, 2))}, here);
  CHECK(some[0].span.source == here.source);
  CHECK(some[1].span.line == 2);
}

TEST_CASE("has_error ignores notes and warnings", "[base]") {
  CHECK_FALSE(has_error({make_note("a.b", ""), make_warning("a.b", "")}));
  CHECK(has_error({make_note("a.b", ""), make_error("a.b", "")}));
  CHECK_FALSE(has_error({}));
}

TEST_CASE("the nearest word is near and known", "[base]") {
  const std::vector<std::string> keys = {"orbifold", "room", "objects", "lights", "camera", "cover", "height"};
  CHECK(nearest_word("orbifld", keys) == "orbifold");
  CHECK(nearest_word("cmaera", keys) == "camera");
  CHECK(nearest_word("heigth", keys) == "height");
  CHECK(nearest_word("rom", keys) == "room");
  CHECK(nearest_word("object", keys) == "objects");
  CHECK(nearest_word("banana", keys).empty());
  CHECK(nearest_word("x", keys).empty());
  CHECK(nearest_word("", keys).empty());
  CHECK(nearest_word("room", keys) == "room");
  CHECK(nearest_word("at", {"to"}).empty());
  CHECK(nearest_word(std::string(100000, 'x'), keys).empty());
  CHECK(nearest_word("ab", {}).empty());
}

}  // namespace
}  // namespace orbc
