// What nobody writes but a program may be given: every case must end quickly, with a diagnostic or a scene.
#include <catch2/catch.hpp>
#include <cstdio>
#include <ctime>
#include <random>

#include "tests/unit/scene/corpus.h"

using namespace orbc;
using namespace orbc::scene;

namespace {

const std::string kHead = "orbc: 1\norbifold: \"*22222\"\n";

std::string repeated(const std::string& piece, std::size_t bytes) {
  std::string all;
  all.reserve(bytes + piece.size());
  while (all.size() < bytes) all += piece;
  return all;
}

// The first code, or "ok"; the printed text must be bounded too.
std::string verdict(const std::string& text) {
  const std::clock_t begin = std::clock();
  const auto read = read_scene(SourceText{"nasty.yaml", text});
  const std::size_t printed = read ? to_text(read->notes).size() : to_text(read.error()).size();
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;  // of this process: others may be busy
  CHECK(seconds < 20);              // measured: below 1 s, without sanitizers
  CHECK(printed < 200'000);
  if (read) return "ok";
  REQUIRE_FALSE(read.error().empty());
  return read.error()[0].code;
}

}  // namespace

TEST_CASE("big files are refused before they are parsed", "[scene]") {
  CHECK(verdict(std::string(100u << 20, 'x')) == "scene.too-large");
  CHECK(verdict(kHead + repeated("# comment\n", 5u << 20)) == "scene.too-large");
  CHECK(verdict(kHead + repeated("# comment\n", 4'000'000)) == "ok");
}

TEST_CASE("deep nesting ends at its bound, not at the stack's", "[scene]") {
  for (const char* piece : {"[", "{", "[{", "{a: ", "- ", "? ", "? - ", "[? ", "{? ", "a: [", "{[", "- ? ", "[[],", "!!map {", "&a [",
                            "'':[", "- - - [", "\n- ", "{\"a\":"}) {
    INFO(piece);
    CHECK(verdict(repeated(piece, 100'000)) != "ok");
    CHECK(verdict(kHead + "room: " + repeated(piece, 100'000)) != "ok");
  }
  CHECK(verdict(kHead + "room:\n " + repeated("[", 4'000'000)) == "scene.too-deep");
  std::string staircase;
  for (int depth = 0; depth < 2000; ++depth) staircase.append(static_cast<std::size_t>(depth), ' ').append("a:\n");
  CHECK(verdict(staircase) == "scene.too-deep");
}

TEST_CASE("many small things end at their bound", "[scene]") {
  CHECK(verdict(kHead + "objects: [" + repeated("1, ", 3'900'000) + "1]") == "scene.too-many-values");
  CHECK(verdict(kHead + "objects: [" + repeated(",", 3'900'000) + "]") != "ok");
  CHECK(verdict(kHead + repeated("- \n", 3'900'000)) != "ok");
  CHECK(verdict(repeated("a: 1\n", 4'000'000)) == "scene.too-many-values");
  CHECK(verdict(repeated(": ", 4'000'000)) != "ok");
  CHECK(verdict(repeated("---\n", 4'000'000)) != "ok");
  CHECK(verdict(repeated("...\n", 4'000'000)) != "ok");
  CHECK(verdict(repeated("%TAG ! a\n", 4'000'000)) != "ok");
  CHECK(verdict(repeated("%YAML 1.2\n", 4'000'000)) != "ok");
  CHECK(verdict(repeated("!a ", 4'000'000)) != "ok");
  CHECK(verdict(repeated("&a ", 4'000'000)) != "ok");
  CHECK(verdict(repeated("*a ", 4'000'000)) != "ok");
  CHECK(verdict(repeated("] ", 4'000'000)) != "ok");
  CHECK(verdict(repeated("\n", 4'000'000)) == "scene.empty");
  CHECK(verdict(repeated(" ", 4'000'000)) == "scene.empty");
  CHECK(verdict(repeated("\r", 4'000'000)) != "");
  CHECK(verdict(repeated("\t", 4'000'000)) != "ok");
  CHECK(verdict(repeated("\"", 4'000'000)) != "ok");
  CHECK(verdict(repeated("'", 4'000'000)) != "ok");
  CHECK(verdict(repeated("|\n", 4'000'000)) != "ok");
  CHECK(verdict(repeated("a\n", 4'000'000)) != "ok");
  CHECK(verdict(repeated("é", 4'000'000)) != "ok");
  CHECK(verdict(kHead + "room: {" + repeated("k: 1, ", 190'000) + "}") != "ok");
  std::string keys = kHead + "room: {";
  for (int i = 0; i < 90'000; ++i) keys.append("k").append(std::to_string(i)).append(": 1, ");
  CHECK(verdict(keys + "}") == "scene.unknown-key");
  std::string walls = kHead + "room: {walls: {";
  for (int i = 1; i < 90'000; ++i) walls.append(std::to_string(i)).append(": {}, ");
  CHECK(verdict(walls + "}}") == "scene.no-such-wall");
  std::string objects = kHead + "objects: [";
  for (int i = 1; i < 45'000; ++i) objects += "{sphere: {}}, ";
  CHECK(verdict(objects + "]") == "ok");
}

TEST_CASE("long words are bounded in time and in messages", "[scene]") {
  const std::string word(1'000'000, 'a');
  CHECK(verdict(kHead + word + ": 1\n") != "ok");
  CHECK(verdict(kHead + "? " + word + "\n: 1\n") == "scene.unknown-key");
  CHECK(verdict(kHead + "room: {floor: {color: " + word + "}}\n") == "scene.bad-color");
  CHECK(verdict(kHead + "camera: {look_at: " + word + "}\n") == "scene.unknown-object");
  CHECK(verdict(kHead + "camera: {fov: " + word + "}\n") == "scene.bad-angle");
  CHECK(verdict(kHead + "camera: {fov: " + std::string(1'000'000, '9') + "deg}\n") != "ok");
  CHECK(verdict(kHead + "room: {height: " + std::string(1'000'000, '9') + "}\n") == "scene.not-finite");
  CHECK(verdict(kHead + "room: {height: 0." + std::string(1'000'000, '0') + "1}\n") == "scene.out-of-range");
  CHECK(verdict(kHead + "objects: [{mesh: " + word + "}]\n") == "scene.unknown-format");
  CHECK(verdict(kHead + "objects: [{mesh: " + word + ".obj}]\n") == "ok");
  CHECK(verdict("orbc: 1\norbifold: \"*" + std::string(1'000'000, '2') + "\"\n") != "ok");
  CHECK(verdict("orbc: 1\norbifold: \"*(" + std::string(1'000'000, '2') + ")\"\n") != "ok");
  CHECK(verdict("orbc: " + std::string(1'000'000, '1') + "\norbifold: \"*22222\"\n") == "scene.wrong-version");
}

TEST_CASE("bytes that are no text are refused with their place", "[scene]") {
  CHECK(verdict(std::string(1000, '\0')) == "scene.bad-character");
  CHECK(verdict(kHead + std::string("room: {height: 1\0}", 18)) == "scene.bad-character");
  CHECK(verdict(kHead + "\x04") == "scene.bad-character");              // the end of a file to yaml-cpp
  CHECK(verdict("\xff\xfeo\0r\0b\0c\0") == "scene.not-utf8");           // UTF-16
  CHECK(verdict("\xef\xbb\xbf\xef\xbb\xbf" + kHead) == "scene.bad-character");
  CHECK(verdict("\xef\xbb\xbf") == "scene.empty");
  CHECK(verdict("") == "scene.empty");
  CHECK(verdict(kHead + "\xf4\x90\x80\x80") == "scene.not-utf8");       // beyond U+10FFFF
}

TEST_CASE("every prefix of a good scene is read or refused", "[scene]") {
  for (const std::string& file : corpus::files("good")) {
    const std::string bytes = corpus::bytes_of(file);
    INFO(file);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const auto read = read_scene(SourceText{"prefix.yaml", bytes.substr(0, length)});
      if (!read && (read.error().empty() || to_text(read.error()).empty())) FAIL("no reason at length " << length);
    }
  }
}

TEST_CASE("scenes with flipped, lost and doubled bytes are read or refused", "[scene]") {
  std::mt19937 random(20230915);
  const auto files = corpus::files("");
  const std::string pieces[] = {"{", "}", "[", "]", ": ", "- ",    "\n",   "\n  ", "\"", "'",  "#",  "*",  "&a ", "!",
                                "|", ">", "%", "?", ",",  "1e999", ".nan", "-",    "~",  "\t", "\r", "<<", "---", "é"};
  for (int round = 0; round < 6000; ++round) {
    std::string bytes = corpus::bytes_of(files[random() % files.size()]);
    for (unsigned edits = 1 + random() % 6; edits > 0 && !bytes.empty(); --edits) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 5) {
        case 0: bytes[at] = static_cast<char>(random() % 256); break;
        case 1: bytes.erase(at, 1 + random() % 20); break;
        case 2: bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 30)); break;
        case 3: bytes.insert(at, pieces[random() % std::size(pieces)]); break;
        default: bytes[at] ^= static_cast<char>(1 << random() % 8);
      }
    }
    const auto read = read_scene(SourceText{"flipped.yaml", bytes});
    if (!read && (read.error().empty() || to_text(read.error()).empty())) FAIL("no reason in round " << round);
  }
}
