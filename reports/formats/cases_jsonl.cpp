// cases.jsonl: what each case gave, an object a line (records/case_record_json.h), for tools that
// read such files: `jq`, pandas, DuckDB. Of runs that kept it.

#include <nlohmann/json.hpp>
#include <string>

#include "records/case_record_json.h"
#include "reports/format.h"

namespace rastercheck::reports::cases_jsonl_format {
namespace {

using nlohmann::json;

std::string write(const records::Run& run) {
  std::string text;
  if (!run.cases) return text;
  for (const auto& [key, record] : *run.cases) {
    text += records::case_record_to_json(key, record)
                .dump(-1, ' ', false, json::error_handler_t::replace) +
            "\n";
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
