// The reader of case files.

#include "cases/case_reader.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rastercheck;
  const Result<cases::Case> c = cases::parse_case(fuzz::text_of(data, size), "input");
  if (c) {
    fuzz::expect_round_trip(*c);
  } else {
    fuzz::expect_one_line(c.error());
  }
  return 0;
}
