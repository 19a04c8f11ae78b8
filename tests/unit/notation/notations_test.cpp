// Notations as people write them: each form has one right answer, read with a note or refused with a hint.
#include <catch2/catch.hpp>
#include <random>

#include "compiler/notation/classify.h"
#include "compiler/notation/parse.h"
#include "compiler/notation/print.h"

namespace orbc::notation {
namespace {

struct Form {
  const char* text;
  const char* answer;  // of those read: the orbifold; of those refused: a part of message or hint
};

void check_read(const std::string& text, const std::string& orbifold, bool noted) {
  CAPTURE(text);
  const Result<Parsed> parsed = parse_with_notes(text);
  if (!parsed) FAIL_CHECK(to_text(parsed.error()));
  if (!parsed) return;
  CHECK(to_text(parsed->orbifold) == orbifold);
  CHECK(parsed->notes.empty() != noted);
  if (!noted || parsed->notes.empty()) return;
  CHECK(parsed->notes.back().code == "notation.read-as");
  CHECK(parsed->notes.back().severity == Severity::note);
  CHECK(parsed->notes.back().message.find(orbifold) != std::string::npos);
}

void check_refused(const std::string& text, const std::string& answer, const std::string& code) {
  CAPTURE(text);
  const Result<Parsed> parsed = parse_with_notes(text);
  if (parsed) FAIL_CHECK("read as " + to_text(parsed->orbifold));
  if (parsed) return;
  const Diagnostic& error = parsed.error().front();
  CHECK(error.code == code);
  INFO(to_text(error));
  CHECK((error.message + "\n" + error.hint).find(answer) != std::string::npos);
  CHECK(error.span.column >= 1);
}

TEST_CASE("each of the 17 wallpaper groups has its answer", "[notation]") {
  for (const auto& [text, orbifold] : {Form{"p6m", "*632"},
                                       {"p6mm", "*632"},
                                       {"p4m", "*442"},
                                       {"p4mm", "*442"},
                                       {"p3m1", "*333"},
                                       {"pmm", "*2222"},
                                       {"pm", "**"},
                                       {"p1m1", "**"}})
    check_read(text, orbifold, true);
  for (const auto& [text, answer] : {Form{"p1", "p1 is written o: o (the wallpaper group p1) is not kaleidoscopic"},
                                     {"p2", "2222"},
                                     {"p2", "with mirrors it is *2222"},
                                     {"pg", "xx"},
                                     {"cm", "*x (the wallpaper group cm)"},
                                     {"pmg", "22*"},
                                     {"pgg", "22x"},
                                     {"cmm", "2*22"},
                                     {"c2mm", "2*22"},
                                     {"p4", "with mirrors it is *442"},
                                     {"p4g", "4*2 (the wallpaper group p4g)"},
                                     {"p4gm", "4*2"},
                                     {"p3", "with mirrors it is *333"},
                                     {"p31m", "3*3"},
                                     {"p6", "with mirrors it is *632"},
                                     {"p4g", "turns and glide reflections are not drawn yet"}})
    check_refused(text, answer, "notation.not-kaleidoscopic");
  check_refused("p2mm", "the wallpaper group p2mm (pmm) is *2222, the frieze group p2mm is *22∞", "notation.no-room");
}

TEST_CASE("point groups by Schoenflies", "[notation]") {
  for (const auto& [text, orbifold] : {Form{"Ih", "*532"},
                                       {"I_h", "*532"},
                                       {"Iₕ", "*532"},
                                       {"ih", "*532"},
                                       {"Oh", "*432"},
                                       {"Td", "*332"},
                                       {"D3h", "*223"},
                                       {"D_{3h}", "*223"},
                                       {"D₃ₕ", "*223"},
                                       {"d12h", "*22(12)"},
                                       {"D1h", "*22"},
                                       {"D2h", "*222"},
                                       {"C3v", "*33"},
                                       {"C₂ᵥ", "*22"},
                                       {"C1v", "*"},
                                       {"C10v", "*(10)(10)"},
                                       {"Cs", "*"},
                                       {"C1h", "*"},
                                       {"S1", "*"}})
    check_read(text, orbifold, true);
  for (const auto& [text, answer] : {Form{"I", "532 (the chiral icosahedral group)"},
                                     {"I", "with mirrors it is *532"},
                                     {"T", "with mirrors it is *332"},
                                     {"D5", "225 (the dihedral group D5)"},
                                     {"D5", "with mirrors it is *225"},
                                     {"C7", "with mirrors it is *77"},
                                     {"S10", "5x (the spherical group S10)"},
                                     {"S2", "central inversion"},
                                     {"Ci", "central inversion"},
                                     {"Th", "3*2 (the pyritohedral group)"},
                                     {"D4d", "2*4 (the spherical group D4d)"},
                                     {"C5h", "5* (the spherical group C5h)"}})
    check_refused(text, answer, "notation.not-kaleidoscopic");
  check_refused("O", "Schoenflies' O is 432, with mirrors Oh, *432", "notation.no-room");
  check_refused("D∞h", "*22(60)", "notation.no-room");
  check_refused("C∞v", "*(60)(60)", "notation.no-room");
  check_refused("D99999999h", "too many digits", "notation.order-out-of-range");
}

TEST_CASE("point groups by Hermann and Mauguin", "[notation]") {
  for (const auto& [text, orbifold] :
       {Form{"m-3m", "*432"},  {"m3m", "*432"},   {"m3\u0305m", "*432"}, {"m -3 m", "*432"}, {"-43m", "*332"},
        {"4/mmm", "*224"},     {"6/mmm", "*226"}, {"5mm", "*55"},        {"6mm", "*66"},     {"4mm", "*44"},
        {"3m", "*33"},         {"mm2", "*22"},    {"mmm", "*222"},       {"m", "*"},         {"-2", "*"},
        {"-6m2", "*223"},      {"-62m", "*223"},  {"m-3-5", "*532"},     {"-53m", "*532"},   {"2/m2/m2/m", "*222"},
        {"10/mmm", "*22(10)"}, {"-14m2", "*227"}})
    check_read(text, orbifold, true);
  for (const auto& [text, answer] : {Form{"-1", "central inversion"},
                                     {"2/m", "2*"},
                                     {"-3", "3x"},
                                     {"-4", "2x"},
                                     {"-6", "3*"},
                                     {"-42m", "2*2"},
                                     {"-3m", "2*3"},
                                     {"m-3", "3*2"},
                                     {"6/m", "6*"}})
    check_refused(text, answer, "notation.not-kaleidoscopic");
}

TEST_CASE("Schläfli's, Coxeter's and Wythoff's symbols, and triangle groups", "[notation]") {
  for (const auto& [text, orbifold] :
       {Form{"{7,3}", "*237"}, {"{3,7}", "*237"},     {"{3, 5}", "*235"},    {"{4 4}", "*244"},      {"{12,3}", "*23(12)"},
        {"{5}", "*55"},        {"{∞}", "**"},         {"{∞,2}", "*22∞"},     {"{5/2,5}", "*235"},    {"｛7，3｝", "*237"},
        {"[7,3]", "*237"},     {"[3,5]", "*235"},     {"[ 4 , 4 ]", "*244"}, {"[5]", "*55"},         {"[]", "*"},
        {"[∞]", "**"},         {"[inf]", "**"},       {"[2,∞]", "*22∞"},     {"[∞]×[∞]", "*2222"},   {"[∞,2,∞]", "*2222"},
        {"[∞]x[]", "*22∞"},    {"[(3,4,5)]", "*345"}, {"[3[3]]", "*333"},    {"(2,3,7)", "*237"},    {"(2 3 7)", "*237"},
        {"(4, 4, 3)", "*443"}, {"Δ(2,3,7)", "*237"},  {"∆(2,3,7)", "*237"},  {"△(2, 3, 7)", "*237"}, {"Delta(2,3,7)", "*237"},
        {"(2,2,∞)", "*22∞"},   {"3 | 2 7", "*327"},   {"2 3 | 7", "*237"},   {"H3", "*532"},         {"I2(7)", "*77"}})
    check_read(text, orbifold, true);
  for (const auto& [text, answer] : {Form{"D(2,3,7)", "with mirrors it is *237"},
                                     {"(0;2,3,7)", "with mirrors it is *237"},
                                     {"[3,7]+", "with mirrors it is *237"},
                                     {"[3+,4]", "3*2"},
                                     {"[4,4+]", "4*2"},
                                     {"| 2 3 7", "with mirrors it is *237"}})
    check_refused(text, answer, "notation.not-kaleidoscopic");
  for (const auto& [text, answer] : {Form{"{3,3,3}", "three dimensions or more"},
                                     {"[3,3,3]", "three dimensions or more"},
                                     {"t{7,3}", "the mirrors of {7,3} are *237"},
                                     {"{7/2,3}", "more than once"},
                                     {"{}", "{7,3} for a tiling"},
                                     {"{7,x}", "{7,3} for a tiling"},
                                     {"[7;3]", "[3,7] for a triangle"},
                                     {"[7,3", "[3,7] for a triangle"},
                                     {"(2,3,7,9)", "*2379"},
                                     {"(2,3)", "*23"},
                                     {"2 | 3", "3 | 2 7"}})
    check_refused(text, answer, "notation.no-room");
  check_refused("{∞,3}", "*23(60)", "notation.not-closed");
  check_refused("{0,3}", "*203", "notation.order-out-of-range");
  check_refused("p6n", "p6m (*632)", "notation.unexpected-character");
}

TEST_CASE("Conway's symbols as keyboards, shells and TeX have them", "[notation]") {
  for (const auto& [text, orbifold] : {Form{"*(4,4,2)", "*442"},
                                       {"*(2, 3, 10)", "*23(10)"},
                                       {"*4.4.2", "*442"},
                                       {"*2.3.10", "*23(10)"},
                                       {"*4·4·2", "*442"},
                                       {"*2.(10).3", "*2(10)3"},
                                       {"*2^5", "*22222"},
                                       {"*2⁵", "*22222"},
                                       {"*23^2", "*233"},
                                       {"*2^{10}", "*2222222222"},
                                       {"*(10)^3", "*(10)(10)(10)"},
                                       {"*(2,3)^2", "*2323"},
                                       {"*2³3", "*2223"},
                                       {"*2^3, 3", "*2223"},
                                       {"＊２２２", "*222"},
                                       {"＊２（１０）３", "*2(10)3"},
                                       {"\\*22", "*22"},
                                       {"'*237'", "*237"},
                                       {"\"*237\"", "*237"},
                                       {"“*237”", "*237"},
                                       {"$*237$", "*237"},
                                       {"$\\ast 237$", "*237"},
                                       {"\\star237", "*237"},
                                       {"⋆237", "*237"},
                                       {"★237", "*237"},
                                       {"*∞∞", "**"},
                                       {"*∞ ∞", "**"},
                                       {"*oooo", "**"},
                                       {"*inf inf", "**"},
                                       {"*(∞)(∞)", "**"},
                                       {"\\*\\*", "**"},
                                       {"*22inf", "*22∞"},
                                       {"*22oo", "*22∞"},
                                       {"*2,2,infinity", "*22∞"},
                                       {"*22\\infty", "*22∞"},
                                       {"*22(inf)", "*22∞"},
                                       {"*2∞2", "*22∞"},
                                       {"*∞22", "*22∞"},
                                       {"*(2,2,∞)", "*22∞"}})
    check_read(text, orbifold, true);
  for (const char* text : {"*237", "∗237", "*22∞", "**", "*2 3 10", "*", "*2 2 ∞"}) check_read(text, to_text(parse(text).value()), false);
  CHECK(parse("*22∞").value().strip);
  CHECK(parse("*22∞").value() != parse("**").value());
  CHECK(parse("*22∞").value() != parse("*22").value());
}

TEST_CASE("what could mean two things is refused with both", "[notation]") {
  check_refused("*4.4", "*(2.5)44; two corners are written *22", "notation.unexpected-character");
  check_refused("*2^53", "*2^{10}, *2^5 3", "notation.unexpected-character");
  check_refused("*^2", "*2^5 is *22222", "notation.unexpected-character");
  check_refused("*2^3^2", "*2^5 is *22222", "notation.unexpected-character");
  check_refused("*2^{3", "*2^5 is *22222", "notation.unexpected-character");
  check_refused("*2^0", "repeated 0 times", "notation.order-out-of-range");
  check_refused("*2^{999999999999}", "256", "notation.too-many-corners");
  check_refused("*(2,3)^{200}", "256", "notation.too-many-corners");
  check_refused("*22\\foo", "'\\'", "notation.unexpected-character");
}

TEST_CASE("rooms with cusps are kaleidoscopic, but not closed; the hint comes close", "[notation]") {
  for (const char* text : {"*23∞", "*∞∞∞", "*2∞∞", "*222∞", "*∞(10)3"}) {
    CAPTURE(text);
    const Result<Orbifold> read = parse(text);
    REQUIRE_FALSE(read);
    const Diagnostic& error = read.error().front();
    CHECK(error.code == "notation.not-closed");
    const std::string hint = error.hint.substr(error.hint.find('*'));
    CHECK(parse(hint));
  }
  for (const char* text : {"*∞", "*2∞", "*∞7"}) check_refused(text, "*22∞", "notation.bad-orbifold");
}

TEST_CASE("random text of all these alphabets never breaks the reader", "[notation]") {
  std::mt19937 random(14);
  const std::string alphabet[] = {"*", "2", "3",  "7",   "10", "(", ")",  "[", "]", "{",  "}",  ",",      ".", " ", "^", "⁵",   "|",
                                  "+", "-", "/",  "m",   "p",  "c", "g",  "h", "d", "v",  "s",  "D",      "C", "S", "I", "O",   "T",
                                  "Δ", "∞", "oo", "inf", "x",  "o", "\\", "'", "$", "＊", "２", "\u0305", "ₕ", "₃", ";", "\xFF"};
  std::size_t read = 0;
  for (int trial = 0; trial < 60000; ++trial) {
    const char* starts[] = {"", "*", "{", "[", "(", "p", "D", "-"};
    std::string text = starts[trial % 8];
    for (std::size_t i = random() % 9; i > 0; --i) text += alphabet[random() % std::size(alphabet)];
    CAPTURE(text);
    const Result<Parsed> parsed = parse_with_notes(text, {{}, trial % 3 == 0});
    if (!parsed) {
      CHECK_FALSE(to_text(parsed.error()).empty());
      continue;
    }
    ++read;
    CHECK(classify(parsed->orbifold).has_value());
    const Result<Orbifold> back = parse(to_text(parsed->orbifold), {{}, true});
    REQUIRE(back.has_value());
    CHECK(*back == parsed->orbifold);
  }
  CHECK(read > 1000);
}

}  // namespace
}  // namespace orbc::notation
