#include "records/stage_trace.h"

#include <gtest/gtest.h>

namespace rastercheck::records {
namespace {

TEST(StageTrace, IsFoundByItsNames) {
  const SampleTrace trace{
      {{"edges", {{"x0", 1}}, {{"a0", 2}, {"b0", 3}}}, {"weights", {}, {}}}, 0.5F, {}};
  ASSERT_NE(find_stage(trace, "edges"), nullptr);
  EXPECT_EQ(find_stage(trace, "weights"), &trace.stages[1]);
  EXPECT_EQ(find_stage(trace, "coverage"), nullptr);
  const NamedNumbers& numbers = find_stage(trace, "edges")->handed_on;
  EXPECT_EQ(find_number(numbers, "b0"), 3);
  EXPECT_EQ(find_number(numbers, "x0"), std::nullopt);
}

}  // namespace
}  // namespace rastercheck::records
