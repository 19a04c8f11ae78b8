// What the program knows of itself: its diagnostics and the schema of its scenes.
#include "compiler/cli/explain.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "compiler/cli/commands.h"
#include "compiler/cli/embedded.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"

namespace orbc::cli {
namespace {

constexpr std::size_t kColumns = 100;              // of explanations

// "| `code` | cause | cure |" → its three cells; a \| belongs to the text.
std::vector<std::string> cells(std::string_view line) {
  std::vector<std::string> found;
  std::string cell;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '|' && line[i - 1] != '\\') {
      const std::size_t begin = cell.find_first_not_of(' ');
      found.push_back(begin == std::string::npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') - begin + 1));
      cell.clear();
    } else {
      if (line[i] == '|') cell.pop_back();
      cell += line[i];
    }
  }
  return found;
}

// Words of `text` in lines of at most kColumns columns; lines after the first begin with `indent` blanks.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string out;
  std::size_t column = indent;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (column > indent && column + 1 + end - begin > kColumns) out += "\n" + std::string(indent, ' '), column = indent;
    else if (column > indent) out += ' ', ++column;
    out += text.substr(begin, end - begin);
    column += end - begin;
    begin = end + 1;
  }
  return out;
}

std::string explanation(const Explained& row) {
  const std::string cause = fmt::format("{}\n  cause: {}\n", row.code, wrapped(row.cause, 9));
  return row.cure.empty() ? cause : fmt::format("{}  cure:  {}\n", cause, wrapped(row.cure, 9));
}

std::string list_of(const std::vector<Explained>& rows) {
  std::string text;
  for (const Explained& row : rows) {
    std::string line = fmt::format("{:<34} {}", row.code, row.cause);
    if (line.size() > kColumns) line = line.substr(0, line.find_last_of(' ', kColumns - 4)) + " …";
    text += line + "\n";
  }
  return text;
}

}  // namespace

std::vector<Explained> read_explained(std::string_view table) {
  std::vector<Explained> rows;
  for (std::size_t begin = 0; begin < table.size();) {
    const std::size_t end = std::min(table.find('\n', begin), table.size());
    const std::string_view line = table.substr(begin, end - begin);
    begin = end + 1;
    if (line.substr(0, 3) != "| `") continue;
    const std::vector<std::string> row = cells(line);
    if (row.size() == 3 && row[0].size() > 2) rows.push_back({row[0].substr(1, row[0].size() - 2), row[1], row[2]});
  }
  return rows;
}

const std::vector<Explained>& explained() {
  static const std::vector<Explained> rows = read_explained(diagnostics_table());
  return rows;
}

int explain(const ExplainArguments& a, const Common& common) {
  std::vector<Explained> rows;
  std::vector<std::string> known;
  for (const Explained& row : explained()) {
    known.push_back(row.code);
    if (a.code.empty() || row.code == a.code || row.code.rfind(a.code + ".", 0) == 0) rows.push_back(row);
  }
  if (rows.empty()) {
    const std::string nearest = nearest_word(a.code, known);
    throw UsageError(fmt::format("there is no diagnostic {}; {}", a.code,
                                 nearest.empty() ? "orbc explain lists all of them" : fmt::format("did you mean {}?", nearest)));
  }
  if (common.json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Explained& row : rows) list.push_back({{"code", row.code}, {"cause", row.cause}, {"cure", row.cure}});
    write_standard_output(list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    return kDone;
  }
  write_standard_output(rows.size() == 1 ? explanation(rows.front()) : list_of(rows));
  return kDone;
}

int schema(const Common&) {
  write_standard_output(scene_schema());
  return kDone;
}

std::string schema_line() {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::filesystem::path prefix = program.parent_path().parent_path();
  std::string where = "orbc-scene.schema.json";  // beside the scene: `orbc schema > orbc-scene.schema.json` puts it there
  for (const std::filesystem::path& folder : {prefix / "share/orbc", prefix.parent_path() / "schema"})
    if (const auto file = folder / "orbc-scene.schema.json"; std::filesystem::exists(file, ignored)) {
      where = file.string();
      break;
    }
  // The line ends at a blank for editors; as the address of a file it has none.
  static const std::string kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+~";
  if (where.find_first_not_of(kPlain) != std::string::npos) {
    std::string address = "file://";
    for (const char c : where)
      address += kPlain.find(c) != std::string::npos ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    where = address;
  }
  return fmt::format("# yaml-language-server: $schema={}\n", where);
}

}  // namespace orbc::cli
