#include "compiler/cli/result.h"

#include <system_error>

#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"

namespace orbc::cli {
namespace {

// Names of files need not be UTF-8.
std::string text_of(const nlohmann::ordered_json& json) { return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace); }

}  // namespace

nlohmann::ordered_json json_of(const Diagnostics& diagnostics) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Diagnostic& d : diagnostics) {
    static constexpr const char* kNames[] = {"note", "warning", "error"};
    nlohmann::ordered_json entry{{"severity", kNames[static_cast<int>(d.severity)]}, {"code", d.code}, {"message", d.message}};
    if (!d.hint.empty()) entry["hint"] = d.hint;
    if (d.span.source) entry["file"] = d.span.source->name;
    if (d.span.line) entry["line"] = d.span.line, entry["column"] = d.span.column, entry["length"] = d.span.length;
    list.push_back(std::move(entry));
  }
  return list;
}

std::string to_json(const Diagnostics& diagnostics) { return text_of(json_of(diagnostics)); }

void print_result(nlohmann::ordered_json result, const Diagnostics& diagnostics, const Common& common) {
  if (!common.json) return;
  result["diagnostics"] = json_of(diagnostics);
  write_standard_output(text_of(result) + "\n");
}

std::string failure_json(const std::string& code, const std::string& message) {
  return text_of({{"diagnostics", json_of({make_error(code, message)})}}) + "\n";
}

void print_failure(const std::string& code, const std::string& message) {
  try {
    write_standard_output(failure_json(code, message));
  } catch (const std::system_error&) {  // standard output may be what has failed
  }
}

void keep_standard_output_apart(const std::string& output, const Common& common) {
  if (output == "-" && common.json) throw UsageError("only one thing can go to standard output: the output itself or the result of --json");
}

}  // namespace orbc::cli
