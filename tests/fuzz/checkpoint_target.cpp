// The reader of unfinished.json, from which an interrupted run continues.

#include <string>

#include "properties/campaign/checkpoint.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

void check_checkpoint(const properties::Checkpoint& checkpoint) {
  const std::string text = properties::to_json(checkpoint);
  const auto again = properties::parse_checkpoint(text, "again");
  expect(again.has_value(), "a checkpoint that was written can be read");
  expect(*again == checkpoint, "a checkpoint that was written is read as the same");
  for (const records::Counterexample& one : checkpoint.findings.counterexamples) {
    expect(one.source.found.has_value(), "a counterexample says where it was found");
  }
  for (const properties::Task& task : properties::shrink_tasks(checkpoint.findings)) {
    expect(task.subject.has_value(), "what is left to shrink is there");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto checkpoint = properties::parse_checkpoint(fuzz::text_of(data, size), "input");
  if (checkpoint) {
    check_checkpoint(*checkpoint);
  } else {
    fuzz::expect_one_line(checkpoint.error());
  }
  return 0;
}
