#include "compiler/base/utf8.h"

#include <catch2/catch.hpp>

using namespace orbc;

TEST_CASE("every code point survives encoding and decoding, and surrogates are no characters", "[base]") {
  bool all_survive = true, surrogates_refused = true;
  for (char32_t code = 0; code <= 0x10FFFF; ++code) {
    const auto decoded = decode_utf8(encode_utf8(code));
    if (code >= 0xD800 && code < 0xE000) surrogates_refused = surrogates_refused && !decoded;
    else all_survive = all_survive && decoded && decoded->code == code && decoded->length == encode_utf8(code).size();
  }
  CHECK(all_survive);
  CHECK(surrogates_refused);
}

TEST_CASE("bytes that are no UTF-8 are no characters", "[base]") {
  // A lone tail, overlong forms, code points above U+10FFFF, truncated sequences.
  for (const char* bytes : {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80",
                            "\xE2\x88", "\xE2(\xA1"})
    CHECK_FALSE(decode_utf8(bytes).has_value());
  CHECK(decode_utf8("x\xE2\x88\x9E", 1)->code == 0x221E);
}
