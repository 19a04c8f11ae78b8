// Each notation has a function that reads it or returns nothing. No text is a symbol of two notations, so their order does not matter.
// Orders are copied, in parentheses where they have several digits; the reader of Conway's symbols checks them.
#include "compiler/notation/translate.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "compiler/base/diagnostic.h"

namespace orbc::notation {
namespace {

using Words = std::vector<std::string>;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// An order for Conway's notation: "7", "(10)", "∞".
std::string order(const std::string& word) {
  if (word == "inf") return "∞";
  const std::size_t first = std::min(word.find_first_not_of('0'), word.size() - 1);
  const std::string number = word.substr(first);
  return number.size() == 1 ? number : "(" + number + ")";
}

std::string mirrored(const Words& orders) {
  std::string symbol = "*";
  for (const std::string& word : orders) symbol += order(word);
  return symbol;
}

/// *2pq, the smaller of p and q first.
std::string right_triangle(std::string p, std::string q) {
  const auto larger = [](const std::string& a, const std::string& b) {
    if (a == "inf" || b == "inf") return a == "inf" && b != "inf";
    return a.size() != b.size() ? a.size() > b.size() : a > b;
  };
  if (larger(p, q)) std::swap(p, q);
  return "*2" + order(p) + order(q);
}

/// The words of "7, 3" or "7 3": digits, "inf", fractions; an empty list for anything else.
std::optional<Words> list_of(std::string_view text) {
  Words words;
  bool open = true;  // the next word may begin
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == ' ' || c == '\t') {
      open = true;
      ++at;
      continue;
    }
    if (c == ',') {
      const std::size_t next = text.find_first_not_of(" \t", at + 1);
      if (words.empty() || next == std::string_view::npos || text[next] == ',') return std::nullopt;
      open = true;
      ++at;
      continue;
    }
    if (!open) return std::nullopt;
    std::size_t end = at;
    while (end < text.size() && text[end] != ' ' && text[end] != '\t' && text[end] != ',') ++end;
    std::string word(text.substr(at, end - at));
    if (word == "infinity" || word == "infty" || word == "oo" || word == "Inf" || word == "INF") word = "inf";
    const bool number = std::all_of(word.begin(), word.end(), [](char d) { return is_digit(d) || d == '/'; }) && is_digit(word.front());
    if (!number && word != "inf") return std::nullopt;
    words.push_back(std::move(word));
    at = end;
    open = false;
  }
  return words;
}

bool has_fraction(const Words& words) {
  return std::any_of(words.begin(), words.end(), [](const std::string& w) { return w.find('/') != std::string::npos; });
}

// ---- wallpaper groups and friezes ----------------------------------------------------------------------------------------------

const std::map<std::string, std::string, std::less<>>& wallpaper_groups() {
  static const std::map<std::string, std::string, std::less<>> groups = {
      {"p1", "o"},     {"p2", "2222"},   {"p211", "2222"}, {"pm", "**"},     {"p1m1", "**"},   {"pm11", "**"},
      {"pg", "xx"},    {"p1g1", "xx"},   {"cm", "*x"},     {"c1m1", "*x"},   {"pmm", "*2222"}, {"pmg", "22*"},
      {"p2mg", "22*"}, {"pgg", "22x"},   {"p2gg", "22x"},  {"cmm", "2*22"},  {"c2mm", "2*22"}, {"p4", "442"},
      {"p4m", "*442"}, {"p4mm", "*442"}, {"p4g", "4*2"},   {"p4gm", "4*2"},  {"p3", "333"},    {"p3m1", "*333"},
      {"p31m", "3*3"}, {"p6", "632"},    {"p6m", "*632"},  {"p6mm", "*632"}, {"p11m", "∞*"},   {"p11g", "∞x"},
  };
  return groups;
}

std::optional<Translation> wallpaper(std::string_view text) {
  if (text == "p2mm") return Translation{"", "names two groups", "the wallpaper group p2mm (pmm) is *2222, the frieze group p2mm is *22∞"};
  const auto found = wallpaper_groups().find(text);
  if (found == wallpaper_groups().end()) return std::nullopt;
  return Translation{found->second, "", ""};
}

// ---- point groups --------------------------------------------------------------------------------------------------------------

const std::map<std::string, std::string, std::less<>>& fixed_point_groups() {
  static const std::map<std::string, std::string, std::less<>> groups = {
      // Schoenflies
      {"Ih", "*532"},
      {"Oh", "*432"},
      {"Td", "*332"},
      {"Th", "3*2"},
      {"I", "532"},
      {"T", "332"},
      {"Cs", "*"},
      {"Ci", "x"},
      // Hermann and Mauguin, with older and full symbols; those of digits alone are Conway's, too, and name the same groups
      {"m", "*"},
      {"mm2", "*22"},
      {"2mm", "*22"},
      {"m2m", "*22"},
      {"mm", "*22"},
      {"mmm", "*222"},
      {"2/m2/m2/m", "*222"},
      {"m-3", "3*2"},
      {"m3", "3*2"},
      {"2/m-3", "3*2"},
      {"m-3m", "*432"},
      {"m3m", "*432"},
      {"4/m-32/m", "*432"},
      {"-43m", "*332"},
      {"m-3-5", "*532"},
      {"m-5-3", "*532"},
      {"-5-32/m", "*532"},
      {"2/m-3-5", "*532"},
      {"-53m", "*532"},
      {"53m", "*532"},
      // finite Coxeter groups
      {"A1", "*"},
      {"A2", "*33"},
      {"B2", "*44"},
      {"G2", "*66"},
      {"H2", "*55"},
      {"A3", "*332"},
      {"B3", "*432"},
      {"H3", "*532"},
  };
  return groups;
}

/// The text without blanks, underscores and braces: "D_{3h}" is D3h, "m -3 m" is m-3m.
std::string joined(std::string_view text) {
  std::string all;
  for (const char c : text)
    if (c != ' ' && c != '_' && c != '{' && c != '}') all += c;
  return all;
}

/// Cn, Cnv, Cnh, Dn, Dnd, Dnh, S2n.
std::optional<Translation> schoenflies_family(const std::string& text) {
  const char family = static_cast<char>(text[0] & ~0x20);
  if (text.size() < 2 || (family != 'C' && family != 'D' && family != 'S')) return std::nullopt;
  std::size_t end = 1;
  while (end < text.size() && is_digit(text[end])) ++end;
  const bool endless = text.compare(1, 3, "inf") == 0;
  if (endless) end = 4;
  if (end == 1 || text.size() > end + 1) return std::nullopt;
  const char kind = end == text.size() ? ' ' : static_cast<char>(text[end] | 0x20);
  if (endless && std::string_view(" vhd").find(kind) != std::string_view::npos)
    return Translation{"", "turns by every angle: it has no room", "a large order comes close: *(60)(60) is C60v, *22(60) is D60h"};
  const std::string word = text.substr(1, end - 1), n = order(word);
  if (family == 'C' && kind == ' ') return Translation{n + n, "", ""};
  if (family == 'C' && kind == 'v') return Translation{"*" + n + n, "", ""};
  if (family == 'C' && kind == 'h') return Translation{n == "1" ? "*" : n + "*", "", ""};
  if (family == 'D' && kind == ' ') return Translation{"22" + n, "", ""};
  if (family == 'D' && kind == 'h') return Translation{"*22" + n, "", ""};
  if (family == 'D' && kind == 'd') return Translation{n == "1" ? "2*" : "2*" + n, "", ""};
  if (family == 'S' && kind == ' ' && word.size() < 8) {
    const int turns = std::stoi(word);
    if (turns >= 2 && turns % 2 == 0) return Translation{turns == 2 ? "x" : order(std::to_string(turns / 2)) + "x", "", ""};
    if (turns >= 1) return Translation{turns == 1 ? "*" : order(word) + "*", "", ""};
  }
  return std::nullopt;
}

/// nm, nmm, n/m, n/mmm, -n, -nm, -n2m, -nm2 for every n.
std::optional<Translation> hermann_mauguin_family(const std::string& text) {
  const bool inverted = text[0] == '-';
  std::size_t end = inverted ? 1 : 0;
  const std::size_t begin = end;
  while (end < text.size() && is_digit(text[end])) ++end;
  if (end == begin || end - begin > 7) return std::nullopt;
  std::string digits = text.substr(begin, end - begin), rest = text.substr(end);
  if (inverted && digits.size() > 1 && digits.back() == '2' && (rest == "m" || rest == "/m")) {  // -62m is -6 2 m
    digits.pop_back();
    rest.insert(0, 1, '2');
  }
  const int n = std::stoi(digits);
  const auto is_any = [&](std::initializer_list<const char*> words) { return std::find(words.begin(), words.end(), rest) != words.end(); };
  const auto said = [](int k) { return order(std::to_string(k)); };
  if (n < 1) return std::nullopt;
  if (!inverted) {
    if (is_any({"m", "mm", "m1", "1m"})) return Translation{"*" + said(n) + said(n), "", ""};
    if (rest == "/m") return Translation{n == 1 ? "*" : said(n) + "*", "", ""};
    if (is_any({"/mmm", "/mm", "/m2/m2/m"})) return Translation{"*22" + said(n), "", ""};
    return std::nullopt;
  }
  if (rest.empty()) {
    if (n == 1) return Translation{"x", "", ""};
    if (n % 2 == 1) return Translation{said(n) + "x", "", ""};
    if (n % 4 == 0) return Translation{said(n / 2) + "x", "", ""};
    return Translation{n == 2 ? "*" : said(n / 2) + "*", "", ""};
  }
  if (n % 2 == 1 && is_any({"m", "2/m", "m1", "1m", "2/m1", "12/m"})) return Translation{n == 1 ? "2*" : "2*" + said(n), "", ""};
  if (n % 2 == 0 && is_any({"2m", "m2"})) return Translation{(n % 4 == 0 ? "2*" : "*22") + said(n / 2), "", ""};
  return std::nullopt;
}

std::optional<Translation> point_group(std::string_view given) {
  std::string text = joined(given);
  if (text.empty()) return std::nullopt;
  if (text == "O")
    return Translation{"", "has two meanings", "Conway's o is the wallpaper group p1; Schoenflies' O is 432, with mirrors Oh, *432"};
  if (text == "Kh" || text == "K")
    return Translation{"", "turns by every angle: it has no room", "the largest of the regular solids' is *532"};
  const auto& groups = fixed_point_groups();
  auto found = groups.find(text);
  if (found == groups.end() && text.size() == 2 && text[0] >= 'a' && text[1] >= 'a') {  // "ih", "cs"
    text[0] = static_cast<char>(text[0] & ~0x20);
    found = groups.find(text);
  }
  if (found != groups.end()) return Translation{found->second, "", ""};
  if (text.compare(0, 3, "I2(") == 0 && text.back() == ')')
    if (const auto n = list_of(text.substr(3, text.size() - 4)); n && n->size() == 1)
      return Translation{mirrored({n->front(), n->front()}), "", ""};
  if (auto family = schoenflies_family(text)) return family;
  return hermann_mauguin_family(text);
}

// ---- Schläfli, Coxeter, triangle groups, Wythoff -------------------------------------------------------------------------------

std::optional<Translation> schlaefli(std::string_view text) {
  const std::size_t brace = text.find('{');
  if (brace == std::string_view::npos || text.back() != '}') return std::nullopt;
  const std::string_view prefix = text.substr(0, brace);
  if (prefix.find_first_not_of("trshac012, ") != std::string_view::npos) return std::nullopt;
  const auto words = list_of(text.substr(brace + 1, text.size() - brace - 2));
  const std::string wanted = "Schläfli's symbols are {7,3} for a tiling, {5} for a polygon";
  if (!words || words->empty()) return Translation{"", "is no symbol of Schläfli's", wanted};
  if (words->size() > 2)
    return Translation{"", "acts on a space of three dimensions or more", "rooms belong to tilings of surfaces: " + wanted};
  if (has_fraction(*words)) {
    static const std::array<Words, 4> kStars = {Words{"5/2", "5"}, Words{"5", "5/2"}, Words{"5/2", "3"}, Words{"3", "5/2"}};
    if (std::find(kStars.begin(), kStars.end(), *words) != kStars.end()) return Translation{"*235", "", ""};
    return Translation{"", "winds around its middle more than once", wanted};
  }
  const std::string symbol =
      words->size() == 1 ? mirrored({words->front(), words->front()}) : right_triangle(words->front(), words->back());
  if (prefix.empty()) return Translation{symbol, "", ""};
  return Translation{"", "is a tiling made from another", "the mirrors of " + std::string(text.substr(brace)) + " are " + symbol};
}

/// [p+,q] and [p,q+]: p*(q/2), if q is even.
std::optional<Translation> half_rotated(std::string p, const std::string& q) {
  p.pop_back();
  const auto words = list_of(p + "," + q);
  if (!words || words->size() != 2 || has_fraction(*words) || words->back() == "inf" || words->back().size() > 7) return std::nullopt;
  const int even = std::stoi(words->back());
  if (even < 2 || even % 2 != 0) return std::nullopt;
  return Translation{order(words->front()) + "*" + (even == 2 ? "" : order(std::to_string(even / 2))), "", ""};
}

std::optional<Translation> coxeter(std::string_view text) {
  if (text.front() != '[') return std::nullopt;
  const std::string wanted = "Coxeter's groups are [3,7] for a triangle with a right angle, [5] for two mirrors";
  const Translation trouble{"", "is no group of Coxeter's that orbc reads", wanted};
  const std::string all = joined(text);
  if (all == "[inf]x[inf]" || all == "[inf,2,inf]") return Translation{"*2222", "", ""};
  if (all == "[inf]x[]" || all == "[]x[inf]") return Translation{"*22∞", "", ""};
  if (all == "[3[3]]" || all == "[3^[3]]") return Translation{"*333", "", ""};
  const bool rotations = text.back() == '+';
  const std::size_t end = text.size() - (rotations ? 2 : 1);
  if (text.size() < 2 || end >= text.size() || text[end] != ']') return trouble;
  std::string_view inside = text.substr(1, end - 1);
  const bool cyclic = inside.size() > 2 && inside.front() == '(' && inside.back() == ')';
  if (cyclic) inside = inside.substr(1, inside.size() - 2);
  if (const std::size_t plus = inside.find('+'); plus != std::string_view::npos && !rotations) {
    const std::size_t comma = inside.find(',');
    if (comma == std::string_view::npos) return trouble;
    const std::string p(inside.substr(0, comma)), q(inside.substr(comma + 1));
    const auto half = p.size() > 1 && p.back() == '+'   ? half_rotated(p, q)
                      : q.size() > 1 && q.back() == '+' ? half_rotated(q, p)
                                                        : std::nullopt;
    return half ? half : trouble;
  }
  const auto words = list_of(inside);
  if (!words || has_fraction(*words)) return trouble;
  if (words->size() > 2 && !(cyclic && words->size() == 3))
    return Translation{"", "acts on a space of three dimensions or more", "rooms belong to groups of surfaces: " + wanted};
  std::string symbol = words->empty()       ? "*"
                       : words->size() == 1 ? mirrored({words->front(), words->front()})
                       : words->size() == 3 ? mirrored(*words)
                                            : right_triangle(words->front(), words->back());
  if (rotations) symbol.erase(0, 1);
  if (symbol.empty()) return trouble;
  return Translation{symbol, "", ""};
}

std::optional<Translation> triangle_group(std::string_view text) {
  const std::size_t parenthesis = text.find('(');
  if (parenthesis == std::string_view::npos || text.back() != ')') return std::nullopt;
  const std::string name = joined(text.substr(0, parenthesis));
  if (!name.empty() && name != "Delta" && name != "D") return std::nullopt;
  std::string_view inside = text.substr(parenthesis + 1, text.size() - parenthesis - 2);
  bool rotations = name == "D";  // von Dyck's group, the even words of Δ
  if (name.empty() && inside.size() > 2 && inside[0] == '0' && inside[1] == ';') {  // Fuchs
    rotations = true;
    inside.remove_prefix(2);
  }
  const auto words = list_of(inside);
  if (!words || words->size() < (name.empty() && !rotations ? 2u : 1u)) return std::nullopt;
  if (words->size() != 3) {
    if (rotations && name.empty() && !has_fraction(*words)) return Translation{mirrored(*words).substr(1), "", ""};
    return Translation{"", "is no triangle group: it has three orders", "the room with these corners is " + mirrored(*words)};
  }
  if (has_fraction(*words))
    return Translation{"", "winds around its middle more than once", "orders of triangle groups are integers: (2,3,7)"};
  return Translation{mirrored(*words).substr(rotations ? 1 : 0), "", ""};
}

std::optional<Translation> wythoff(std::string_view text) {
  const std::size_t bar = text.find('|');
  if (bar == std::string_view::npos || text.find('|', bar + 1) != std::string_view::npos) return std::nullopt;
  std::string orders(text);
  orders[bar] = ' ';
  const auto words = list_of(orders);
  if (!words || words->size() != 3 || has_fraction(*words))
    return Translation{"", "is no symbol of Wythoff's that orbc reads", "Wythoff's symbols have three integers: 3 | 2 7"};
  const bool rotations = text.find_first_not_of(" \t") == bar;
  return Translation{mirrored(*words).substr(rotations ? 1 : 0), "", ""};
}

}  // namespace

std::optional<Translation> translate(std::string_view text) {
  if (text.empty()) return std::nullopt;
  for (const auto reader : {schlaefli, coxeter, triangle_group, wythoff, wallpaper, point_group})
    if (auto found = reader(text)) return found;
  return std::nullopt;
}

std::string nearest_group_name(std::string_view text) {
  // Groups with rooms come first.
  for (const bool mirrors : {true, false}) {
    std::vector<std::string> names;
    for (const auto* groups : {&wallpaper_groups(), &fixed_point_groups()})
      for (const auto& [name, symbol] : *groups)
        if (name.size() > 1 && (symbol[0] == '*') == mirrors) names.push_back(name);
    const std::string nearest = nearest_word(text, names);
    if (nearest.empty()) continue;
    const auto found = wallpaper_groups().find(nearest);
    return nearest + " (" + (found != wallpaper_groups().end() ? found->second : fixed_point_groups().at(nearest)) + ")";
  }
  return "";
}

}  // namespace orbc::notation
