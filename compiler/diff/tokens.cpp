#include "compiler/diff/tokens.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace orbc::diff {
namespace {

// By hand: <cctype> asks the locale.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_part_of_word(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

}  // namespace

Token Tokens::take(TokenKind kind, std::size_t length) {
  Token token;
  token.kind = kind, token.at = at_, token.text = text_.substr(at_, length);
  at_ += token.text.size();
  return token;
}

// [+-] digits [. digits] [e [+-] digits]; a point may stand first or last.
bool Tokens::number(Token& token) {
  std::size_t i = at_;
  const auto digits = [&] {
    const std::size_t from = i;
    while (i < text_.size() && is_digit(text_[i])) ++i;
    return i - from;
  };
  const auto is_at = [&](std::size_t where, char c) { return where < text_.size() && text_[where] == c; };
  if (is_at(i, '+') || is_at(i, '-')) ++i;
  std::size_t count = digits();
  bool whole = true;
  if (is_at(i, '.')) {
    ++i;
    count += digits();
    whole = false;
  }
  if (count == 0) return false;
  if (is_at(i, 'e') || is_at(i, 'E')) {
    const std::size_t before = i++;
    if (is_at(i, '+') || is_at(i, '-')) ++i;
    if (digits() == 0) i = before;
    else whole = false;
  }
  token = take(TokenKind::number, i - at_);
  token.whole = whole;
  std::string_view plain = token.text;
  if (plain.front() == '+') plain.remove_prefix(1);  // which from_chars does not take
  const auto read = std::from_chars(plain.data(), plain.data() + plain.size(), token.value);
  if (read.ec == std::errc::result_out_of_range) token.value = plain.find('-') == 0 ? -HUGE_VAL : HUGE_VAL;
  return true;
}

bool Tokens::comment(Token& token) {
  const std::string_view rest = text_.substr(at_);
  if (rest.substr(0, 2) == "//") {
    token = take(TokenKind::comment, std::min(rest.find('\n'), rest.size()));
    return true;
  }
  if (rest.substr(0, 2) != "/*") return false;
  const std::size_t end = rest.find("*/", 2);
  token = take(TokenKind::comment, end == std::string_view::npos ? rest.size() : end + 2);
  constexpr std::string_view kFile = "/* orbc-file ", kEncoded = " base64\n";
  const std::size_t name_end = token.text.find(kEncoded);
  if (token.text.substr(0, kFile.size()) == kFile && name_end < 4096 && end != std::string_view::npos) {
    token.kind = TokenKind::file;
    token.bytes = token.text.substr(name_end + kEncoded.size(), token.text.size() - 2 - name_end - kEncoded.size());
    token.text = token.text.substr(kFile.size(), name_end - kFile.size());
  }
  return true;
}

Token Tokens::next() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  if (at_ >= text_.size()) return take(TokenKind::end, 0);
  const char c = text_[at_];
  Token token;
  const auto run = [&](std::size_t from, auto belongs) {
    std::size_t i = at_ + from;
    while (i < text_.size() && belongs(text_[i])) ++i;
    return i - at_;
  };
  if (grammar_ == Grammar::svg) {
    if (c == '#' && at_ + 1 < text_.size() && is_hex(text_[at_ + 1])) return take(TokenKind::word, run(1, is_hex));
    if (is_letter(c)) return take(TokenKind::word, run(0, is_letter));
  } else {
    if (c == '/' && comment(token)) return token;
    if (c == '"') {
      const std::size_t length = run(1, [](char in) { return in != '"' && in != '\n'; });
      token = take(TokenKind::text, length);
      token.text.remove_prefix(1);
      if (at_ < text_.size() && text_[at_] == '"') ++at_;
      return token;
    }
    if (is_letter(c) || c == '_') return take(TokenKind::word, run(0, is_part_of_word));
  }
  if (number(token)) return token;
  return take(TokenKind::sign, 1);
}

std::string line_and_column(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
  return fmt::format("{}:{}", std::count(before.begin(), before.end(), '\n') + 1, before.size() - start + 1);
}

}  // namespace orbc::diff
