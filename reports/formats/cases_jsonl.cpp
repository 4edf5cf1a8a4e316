// cases.jsonl: the result of each case, one object per line (records/case_record_json.h), for tools
// such as jq, pandas and DuckDB. Only runs that kept these results have it.

#include <nlohmann/json.hpp>
#include <string>

#include "cases/json.h"
#include "records/case_record_json.h"
#include "reports/format.h"

namespace rastercheck::reports::cases_jsonl_format {
namespace {

using nlohmann::json;

std::string write(const records::Run& run) {
  std::string text;
  if (!run.cases) return text;
  for (const auto& one : *run.cases) {
    json line;
    write_value(line, one);
    text += cases::json_line(line) + "\n";
  }
  return text;
}

const FormatRegistration kRegistration({.name = "cases",
                                        .file_name = "cases.jsonl",
                                        .write = &write,
                                        .is_on_request = true,
                                        .needs_cases = true});

}  // namespace
}  // namespace rastercheck::reports::cases_jsonl_format
