// docs/files.md, row by row: its table says what this one says, and each cell holds for small files that are really read.
#include "tests/unit/mesh_io/formats_table.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

namespace {

using namespace orbc::mesh_io::test;

std::vector<Row> table() {
  return {
      positions(), polygons(),     points_and_lines(), texture_coordinates(), vertex_colors(), face_colors(), normals(),   pictures(),
      holes(),     transparency(), light_of_its_own(), metal_and_gloss(),     bumps(),         skeletons(),   instances(), compression(),
      text()};
}

/// The cells of the table's rows as the page has them, without its head.
std::vector<std::vector<std::string>> rows_of_page() {
  std::ifstream page(ORBC_SOURCE_DIR "/docs/files.md");
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) == 0) break;  // the table of bounds
    if (line.rfind("| ", 0) != 0 || line.rfind("| | OBJ", 0) == 0) continue;
    std::vector<std::string> cells;
    std::istringstream parts(line.substr(2));
    for (std::string cell; std::getline(parts, cell, '|');)
      cells.push_back(cell.substr(cell.find_first_not_of(' '), cell.find_last_not_of(' ') + 1 - cell.find_first_not_of(' ')));
    rows.push_back(std::move(cells));
  }
  return rows;
}

}  // namespace

TEST_CASE("the page on mesh files says of each format what is tested here", "[mesh_io]") {
  const auto page = rows_of_page();
  const auto tested = table();
  REQUIRE(page.size() == tested.size());
  for (std::size_t r = 0; r < page.size(); ++r) {
    std::vector<std::string> cells{tested[r].name};
    for (const Cell& cell : tested[r].cells) cells.push_back(cell.text);
    CHECK(page[r] == cells);
  }
}

TEST_CASE("each cell of the page on mesh files holds for small files", "[mesh_io]") {
  const char* const formats[] = {"OBJ", "PLY", "OFF", "STL", "glTF"};
  for (const Row& row : table()) {
    REQUIRE(row.cells.size() == 5);
    for (std::size_t c = 0; c < 5; ++c) {
      INFO(row.name << " of " << formats[c] << ": " << row.cells[c].text);
      if (row.cells[c].text == "—") CHECK_FALSE(row.cells[c].holds);
      else CHECK(row.cells[c].holds());
    }
  }
}
