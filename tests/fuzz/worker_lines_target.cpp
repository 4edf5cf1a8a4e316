// The lines that a campaign and its worker processes send each other: tasks and findings.

#include "properties/campaign/internal/findings_json.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

void check_findings(const properties::Findings& findings) {
  const std::string line = properties::findings_to_line(findings);
  expect(line.find('\n') == std::string::npos, "findings are one line");
  const Result<properties::Findings> again = properties::findings_from_line(line);
  expect(again.has_value(), "findings that were written can be read");
  expect(*again == findings, "findings that were written are read as the same");
  expect(properties::findings_to_line(again) == line,
         "findings that were read again are written as the same");
  // Does what a campaign does with the findings that it reads.
  properties::Findings merged = findings;
  properties::merge(merged, *again);
}

void check_error(const Error& error) {
  fuzz::expect_one_line(error);
  const std::string line = properties::findings_to_line(tl::unexpected(error));
  const Result<properties::Findings> again = properties::findings_from_line(line);
  expect(!again && to_string(again.error()) == to_string(error),
         "an error that was written is read as the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string line(fuzz::text_of(data, size));
  const Result<properties::Findings> findings = properties::findings_from_line(line);
  if (findings) {
    check_findings(*findings);
  } else {
    check_error(findings.error());
  }
  const std::optional<properties::Task> task = properties::task_from_line(line);
  if (task) {
    expect(properties::task_from_line(properties::task_to_line(*task)) == task,
           "a task that was written is read as the same");
  }
  return 0;
}
