#include "compiler/notation/parse.h"

#include <catch2/catch.hpp>
#include <memory>
#include <random>

#include "compiler/notation/classify.h"
#include "compiler/notation/print.h"

namespace orbc::notation {
namespace {

const ParseOptions kReal{{}, true};

Orbifold corners(std::vector<Rational> list) { return {std::move(list), false}; }

// The first error of a text that must be refused.
Diagnostic refusal(const std::string& text, const ParseOptions& options = {}) {
  const Result<Orbifold> result = parse(text, options);
  CAPTURE(text);
  REQUIRE_FALSE(result.has_value());
  REQUIRE_FALSE(result.error().empty());
  return result.error().front();
}

std::string code(const std::string& text, const ParseOptions& options = {}) { return refusal(text, options).code; }

// "2+3": column and length of the caret.
std::string caret(const std::string& text) {
  const Diagnostic d = refusal(text);
  return std::to_string(d.span.column) + "+" + std::to_string(d.span.length);
}

TEST_CASE("each digit of compact text is a corner", "[notation]") {
  CHECK(parse("*22222").value() == corners({2, 2, 2, 2, 2}));
  CHECK(parse("*237").value() == corners({2, 3, 7}));
  CHECK(parse("*").value() == corners({}));
  CHECK(parse("*99").value() == corners({9, 9}));
  CHECK(parse("  *237\n").value() == corners({2, 3, 7}));
  CHECK(parse("* 237").value() == corners({2, 3, 7}));
}

TEST_CASE("parentheses and separators give larger orders", "[notation]") {
  CHECK(parse("*23(10)").value() == corners({2, 3, 10}));
  CHECK(parse("*23 (10)").value() == corners({2, 3, 10}));
  CHECK(parse("*( 10 )23").value() == corners({10, 2, 3}));
  CHECK(parse("*2 3 10").value() == corners({2, 3, 10}));
  CHECK(parse("* 2 3 10").value() == corners({2, 3, 10}));
  CHECK(parse("*2,3,(10)").value() == corners({2, 3, 10}));
  CHECK(parse("*2, 3 ,10").value() == corners({2, 3, 10}));
  CHECK(parse("*12,(10) 7").value() == corners({12, 10, 7}));
  CHECK(parse("*(010)(1000000)2").value() == corners({10, 1000000, 2}));
  CHECK(parse("*2 3 010").value() == corners({2, 3, 10}));
}

TEST_CASE("the mathematical star is a star", "[notation]") {
  CHECK(parse("∗237").value() == corners({2, 3, 7}));
  CHECK(parse("∗∗").value().strip);
}

TEST_CASE("two stars are the strip", "[notation]") {
  CHECK(parse("**").value().strip);
  CHECK(parse("* *").value().strip);
  CHECK(parse("**").value().corners.empty());
}

TEST_CASE("the author's corner order is kept", "[notation]") {
  CHECK(parse("*632").value() == corners({6, 3, 2}));
  CHECK(parse("*2354").value() == corners({2, 3, 5, 4}));
}

TEST_CASE("corners of order 1 are left out with a note", "[notation]") {
  const Parsed parsed = parse_with_notes("*121314").value();
  CHECK(parsed.notes.size() == 3);
  CHECK(parsed.notes[1].code == "notation.corner-of-order-one");
  CHECK(parsed.notes[1].severity == Severity::note);
  CHECK(parsed.notes[1].span.column == 4);
  CHECK(parse_with_notes("*237").value().notes.empty());
  CHECK(parse("*1").value() == corners({}));
  CHECK(parse("*11").value() == corners({}));
  CHECK(parse("*(1.0)22").value() == corners({2, 2}));
}

TEST_CASE("corners left out can leave a bad orbifold", "[notation]") { CHECK(code("*121") == "notation.bad-orbifold"); }

TEST_CASE("real corners are exact rationals where they are allowed", "[notation]") {
  CHECK(parse("*(3/2)(12)(12)", kReal).value() == corners({Rational(3, 2), 12, 12}));
  CHECK(parse("*(2.5)44", kReal).value() == corners({Rational(5, 2), 4, 4}));
  CHECK(parse("*5/2, 4, 4", kReal).value() == corners({Rational(5, 2), 4, 4}));
  CHECK(parse("*2.5 4 4", kReal).value() == corners({Rational(5, 2), 4, 4}));
  CHECK(parse("*( 7 )(2.50)(10/4)", kReal).value() == corners({7, Rational(5, 2), Rational(5, 2)}));
  CHECK(parse("*(3/2)(3/2)", kReal).value() == corners({Rational(3, 2), Rational(3, 2)}));
  // Fractions that are integers need no leave.
  CHECK(parse("*(6/2)(4.0)5").value() == corners({3, 4, 5}));
}

TEST_CASE("real corners need leave", "[notation]") {
  const Diagnostic d = refusal("*2(3/2)4");
  CHECK(d.code == "notation.non-orbifold-corner");
  CHECK(d.hint.find("allow_non_orbifold: true") != std::string::npos);
  CHECK(caret("*2(3/2)4") == "3+5");
  CHECK(code("*2 2.5 4") == "notation.non-orbifold-corner");
}

TEST_CASE("orders out of range are refused at their place", "[notation]") {
  for (const char* text : {"*0", "*20", "*(0)22", "*(-3)33", "*2 -3 4", "*(1000001)22", "*(99999999999999999999)22", "*(1/2)33", "*(3/0)33",
                           "*2 3 0", "*(0.999)33", "*(0.00000001)22", "*-3"}) {
    CAPTURE(text);
    CHECK(code(text, kReal) == "notation.order-out-of-range");
  }
  CHECK(caret("*230") == "4+1");
  CHECK(caret("*2(-3)3") == "3+4");
  CHECK(caret("*2 (1000001) 3") == "4+9");
  CHECK(refusal("*2310").hint == "write 10 as (10) or separate all corners: *2 3 10");
}

TEST_CASE("all wrong corners are told at once", "[notation]") {
  const Result<Orbifold> result = parse("*0(3/2)(2000000)2");
  REQUIRE_FALSE(result.has_value());
  CHECK(result.error().size() == 3);
}

TEST_CASE("too many corners are refused", "[notation]") {
  CHECK(parse("*" + std::string(256, '2')).value().corners.size() == 256);
  CHECK(code("*" + std::string(257, '2')) == "notation.too-many-corners");
  CHECK(code("*" + std::string(8192, '2')) == "notation.too-long");
  CHECK(code(std::string(100'000'000, '*')) == "notation.too-long");
}

TEST_CASE("bad orbifolds are refused with the reason", "[notation]") {
  for (const char* text : {"*2", "*7", "*(12)", "*23", "*32", "*(10)(11)"}) {
    CAPTURE(text);
    CHECK(code(text) == "notation.bad-orbifold");
  }
  CHECK(refusal("*23").message == "*23 closes in no space of constant curvature: two mirrors meet twice at the same angle");
  CHECK(refusal("*23").hint == "two mirror corners must have the same order: *22 or *33");
  CHECK(caret("*23") == "1+3");
  CHECK(caret("  *(10) ") == "3+5");
  CHECK(code("*(3/2)2", kReal) == "notation.bad-orbifold");
  CHECK(code("*(1.05)(10)(100)", kReal) == "notation.bad-orbifold");
}

TEST_CASE("text that is no notation is refused at its first wrong character", "[notation]") {
  const std::pair<const char*, const char*> cases[] = {
      {"*2a3", "3+1"},    {"a", "1+1"},      {"*2(", "4+1"},        {"*2()", "4+1"},   {"*2(3", "3+1"},    {"*2)3", "3+1"},
      {"*2((3))", "4+1"}, {"*2,,3", "4+1"},  {"*,2", "2+1"},        {",", "1+1"},      {"*2,3,", "6+1"},   {"*2.5", "3+1"},
      {"*3/2", "3+1"},    {"*(3/)2", "5+1"}, {"*(3.)2", "5+1"},     {"*(/2)2", "3+1"}, {"*(1e3)2", "4+1"}, {"*(2;3)", "4+1"},
      {"*2\xFF", "3+1"},  {"*2é", "3+1"},    {"*2\xE2\x88", "3+1"}, {"*(2 3)", "5+1"}, {"x*", "2+1"},      {"*2o", "3+1"},
      {"*(--3)2", "4+1"}, {"∗2?", "3+1"},    {"*2,*3", "4+1"},      {"*2𝟑3", "3+1"},
  };
  for (const auto& [text, place] : cases) {
    CAPTURE(text);
    CHECK(caret(text) == place);
    const std::string c = code(text);
    CHECK((c == "notation.unexpected-character" || c == "notation.unclosed-parenthesis"));
  }
  CHECK(code("*2(3") == "notation.unclosed-parenthesis");
  CHECK(code(std::string("*2\0003", 4)) == "notation.unexpected-character");
}

TEST_CASE("no text at all is refused", "[notation]") {
  for (const char* text : {"", " ", "\n\t "}) CHECK(code(text) == "notation.empty");
}

TEST_CASE("other orbifolds are refused by their names", "[notation]") {
  const std::pair<const char*, const char*> cases[] = {
      {"o", "o (the wallpaper group p1) is not kaleidoscopic: it has a wonder-ring (o)"},
      {"2222", "2222 (the wallpaper group p2) is not kaleidoscopic: it has gyration points of orders 2, 2, 2, 2"},
      {"*x", "*x (the wallpaper group cm) is not kaleidoscopic: it has a cross-cap (x)"},
      {"xx", "xx (the wallpaper group pg) is not kaleidoscopic: it has 2 cross-caps (x)"},
      {"22x", "22x (the wallpaper group pgg) is not kaleidoscopic: it has gyration points of orders 2, 2 and a cross-cap (x)"},
      {"22*", "22* (the wallpaper group pmg) is not kaleidoscopic: it has gyration points of orders 2, 2"},
      {"2*22", "2*22 (the wallpaper group cmm) is not kaleidoscopic: it has a gyration point of order 2"},
      {"3*3", "3*3 (the wallpaper group p31m) is not kaleidoscopic: it has a gyration point of order 3"},
      {"4*2", "4*2 (the wallpaper group p4g) is not kaleidoscopic: it has a gyration point of order 4"},
      {"333", "333 (the wallpaper group p3) is not kaleidoscopic: it has gyration points of orders 3, 3, 3"},
      {"442", "442 (the wallpaper group p4) is not kaleidoscopic: it has gyration points of orders 4, 4, 2"},
      {"632", "632 (the wallpaper group p6) is not kaleidoscopic: it has gyration points of orders 6, 3, 2"},
      {"532", "532 (the chiral icosahedral group) is not kaleidoscopic: it has gyration points of orders 5, 3, 2"},
      {"432", "432 (the chiral octahedral group) is not kaleidoscopic: it has gyration points of orders 4, 3, 2"},
      {"332", "332 (the chiral tetrahedral group) is not kaleidoscopic: it has gyration points of orders 3, 3, 2"},
      {"3*2", "3*2 (the pyritohedral group) is not kaleidoscopic: it has a gyration point of order 3"},
      {"2*7", "2*7 (the spherical group D7d) is not kaleidoscopic: it has a gyration point of order 2"},
      {"5*", "5* (the spherical group C5h) is not kaleidoscopic: it has a gyration point of order 5"},
      {"5x", "5x (the spherical group S10) is not kaleidoscopic: it has a gyration point of order 5 and a cross-cap (x)"},
      {"55", "55 (the cyclic group C5) is not kaleidoscopic: it has gyration points of orders 5, 5"},
      {"522", "522 (the dihedral group D5) is not kaleidoscopic: it has gyration points of orders 5, 2, 2"},
      {"x", "x (the group of the central inversion) is not kaleidoscopic: it has a cross-cap (x)"},
      {"237", "237 is not kaleidoscopic: it has gyration points of orders 2, 3, 7"},
      {"**2", "**2 is not kaleidoscopic: it has 2 mirror boundaries"},
      {"*2*3*4", "*2*3*4 is not kaleidoscopic: it has 3 mirror boundaries"},
      {"o2*3x", "o2*3x is not kaleidoscopic: it has a wonder-ring (o), a gyration point of order 2 and a cross-cap (x)"},
      {"(∞)∞", "(∞)∞ (the frieze group p1) is not kaleidoscopic: it has gyration points of orders ∞, ∞"},
      {"2*∞", "2*∞ (the frieze group p2mg) is not kaleidoscopic: it has a gyration point of order 2 and mirrors that meet at infinity"},
      {"○", "○ (the wallpaper group p1) is not kaleidoscopic: it has a wonder-ring (o)"},
      {"××", "×× (the wallpaper group pg) is not kaleidoscopic: it has 2 cross-caps (x)"},
  };
  for (const auto& [text, message] : cases) {
    const Diagnostic d = refusal(text);
    CHECK(d.code == "notation.not-kaleidoscopic");
    CHECK(d.message == message);
  }
  CHECK(refusal("237").hint == "with mirrors it is *237");
  CHECK(refusal("2*22").hint ==
        "a room is closed by mirrors alone, * followed by its corners; turns and glide reflections are not drawn yet");
  CHECK(caret("*23x") == "4+1");
  CHECK(caret("*23*4") == "4+1");
  CHECK(caret("22*") == "1+1");
  CHECK(code("(3/2)*3") == "notation.order-out-of-range");
}

TEST_CASE("carets point into the scene file", "[notation]") {
  const auto source = std::make_shared<SourceText>(SourceText{"kitchen.yaml", "orbc: 1\norbifold: \"*2a\"\nother: *2a\n"});
  CHECK(to_text(parse("*2a", {{source, 2, 11, 5}, false}).error()) ==
        "kitchen.yaml:2:14: error[notation.unexpected-character] 'a' does not belong into an orbifold notation\n"
        "   2 | orbifold: \"*2a\"\n"
        "     |              ^\n"
        "  hint: corners are digits, (10) or (3/2), as in *23(10) or *2 3 10\n");
  CHECK(parse("*2a", {{source, 3, 8, 3}, false}).error().front().span.column == 10);
  CHECK(parse("*2a", {{source, 0, 0, 1}, false}).error().front().span.line == 0);
  CHECK(parse("*2a", {{source, 99, 7, 1}, false}).error().front().span.column == 9);
}

TEST_CASE("what is printed reads back as the same orbifold", "[notation]") {
  std::mt19937 random(20231);
  const auto any = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  for (int trial = 0; trial < 2000; ++trial) {
    Orbifold o;
    const int count = any(0, 12);
    for (int i = 0; i < count; ++i) {
      const int kind = any(0, 9);
      if (kind < 9) o.corners.emplace_back(any(2, kind < 6 ? 9 : kind < 8 ? 120 : 1000000));
      else o.corners.push_back(Rational(any(13, 400)) / any(2, 12));
    }
    if (!classify(o)) continue;
    const std::string text = to_text(o);
    CAPTURE(text);
    const Result<Orbifold> back = parse(text, kReal);
    REQUIRE(back.has_value());
    CHECK(*back == o);
    // The same corners, written apart.
    std::string apart = "*";
    for (const Rational& corner : o.corners) apart += to_string(corner) + ", ";
    if (o.corners.size() > 1) CHECK(parse(apart.substr(0, apart.size() - 2), kReal).value() == o);
  }
  CHECK(to_text(parse("**").value()) == "**");
}

TEST_CASE("random text never breaks the reader", "[notation]") {
  std::mt19937 random(5);
  const std::string alphabet[] = {"*", "∗", "2", "3", "0", "1", "(", ")",    "/",        ".",
                                  ",", " ", "-", "x", "o", "∞", "a", "\xFF", "\xE2\x88", "\n"};
  std::size_t read = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string text = trial % 2 == 0 ? "*" : "";
    for (std::size_t i = random() % 12; i > 0; --i) text += alphabet[random() % std::size(alphabet)];
    const Result<Orbifold> result = parse(text, trial % 3 == 0 ? kReal : ParseOptions{});
    if (result) {
      ++read;
      CHECK(parse(to_text(*result), kReal).value() == *result);
    } else {
      CHECK_FALSE(to_text(result.error()).empty());
      CHECK(result.error().front().span.column >= 1);
    }
  }
  CHECK(read > 100);
}

}  // namespace
}  // namespace orbc::notation
