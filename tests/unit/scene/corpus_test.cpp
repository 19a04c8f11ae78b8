// tests/scenes: good scenes are read, bad ones refused with exactly the codes and places that their first line promises.
// The folders of bad say who can refuse: syntax (no document at all), schema (the JSON Schema too), semantic (the reader alone);
// scripts/check_schema.py holds the schema to the same verdicts.
#include "tests/unit/scene/corpus.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>

using namespace orbc;
using namespace orbc::scene;

namespace {

std::string promise(const std::string& bytes) {
  const std::string mark = "# expect: ";
  if (bytes.compare(0, mark.size(), mark) != 0) return {};
  return bytes.substr(mark.size(), bytes.find('\n') - mark.size());
}

std::string summary_of_all(const Diagnostics& diagnostics) {
  Diagnostics errors = diagnostics;
  for (Diagnostic& d : errors) d.severity = Severity::error;
  return corpus::summary(errors);
}

}  // namespace

TEST_CASE("every bad scene is refused with the codes and places it promises", "[scene]") {
  const auto files = corpus::files("bad");
  CHECK(files.size() >= 60);
  for (const std::string& file : files) {
    INFO(file);
    const auto read = load_scene(file);
    REQUIRE_FALSE(read);
    CHECK(corpus::summary(read.error()) == promise(corpus::bytes_of(file)));
    for (const Diagnostic& diagnostic : read.error()) {
      CHECK(diagnostic.span.source != nullptr);
      CHECK_FALSE(diagnostic.message.empty());
      CHECK_FALSE(to_text(diagnostic).empty());
    }
  }
}

TEST_CASE("every good scene is read, with the warnings it promises", "[scene]") {
  const auto files = corpus::files("good");
  CHECK(files.size() >= 12);
  for (const std::string& file : files) {
    const auto read = load_scene(file);
    if (!read) FAIL(to_text(read.error()));
    INFO(file << "\n" << to_text(read->notes));
    CHECK(summary_of_all(read->notes) == promise(corpus::bytes_of(file)));
  }
}

TEST_CASE("every code of this room that the corpus shows stands in schema/diagnostics.md", "[scene]") {
  const std::string table = corpus::bytes_of(std::string(ORBC_SOURCE_DIR) + "/schema/diagnostics.md");
  for (const std::string& file : corpus::files("")) {
    const auto read = load_scene(file);
    for (const Diagnostic& diagnostic : read ? read->notes : read.error()) {
      if (diagnostic.code.compare(0, 6, "scene.") != 0) continue;
      INFO(file << " " << diagnostic.code);
      CHECK(table.find("| `" + diagnostic.code + "` |") != std::string::npos);
    }
  }
}

// For scripts/check_schema.py: the reader's verdict on every scene of a folder, one line each.
TEST_CASE("print verdicts", "[.verdict]") {
  const char* folder = std::getenv("ORBC_VERDICT_FOLDER");
  REQUIRE(folder != nullptr);
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) {
    const auto read = load_scene(file);
    std::cout << "verdict\t" << std::filesystem::path(file).filename().string() << "\t" << (read ? "ok" : corpus::summary(read.error()))
              << "\n";
  }
}
