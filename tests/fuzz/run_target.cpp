// The reader of run.json, and the reports that `rastercheck report` makes from what was read.

#include <string>

#include "reports/format.h"
#include "reports/run_reader.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

void check_run(const records::Run& run) {
  const std::string text = reports::find_format("json")->write(run);
  const Result<records::Run> again = reports::parse_run(text, "again");
  expect(again.has_value(), "a run that was written can be read");
  expect(*again == run, "a run that was written is read as the same");
  expect(reports::find_format("json")->write(*again) == text,
         "a run that was read again is written as the same");
  for (const reports::Format& format : reports::formats()) {
    if (format.needs_cases && !run.cases) continue;
    expect(!format.write(run).empty(), "every report can be made of a run");
  }
  for (const records::Counterexample& one : run.counterexamples) {
    const std::string file = records::file_of(one);
    expect(file.starts_with("counterexamples/") && file.rfind('/') == file.find('/'),
           "a counterexample's file is in their folder");
    expect(fuzz::is_one_line(file), "a counterexample's file has a name of one line");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Result<records::Run> run = reports::parse_run(fuzz::text_of(data, size), "input");
  if (run) {
    check_run(*run);
  } else {
    fuzz::expect_one_line(run.error());
  }
  return 0;
}
