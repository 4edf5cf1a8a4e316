// The accuracy table as text.

#include "reports/accuracy_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rastercheck::reports::accuracy_table_test {
namespace {

using records::AccuracyRow;
using records::AttributeKind;
using records::Stratum;
using ::testing::HasSubstr;

AccuracyRow row_of(const char* backend, double worst) {
  AccuracyRow row;
  row.backend = backend;
  row.drawn_by = "it 1.0";
  row.asked = 200;
  row.drawn = 150;
  row.samples = 4'000'000;
  row.values = 75;
  row.not_judged = 25;
  row.figures = {{AttributeKind::smooth, Stratum::ordinary, 10, worst, 0.25}};
  return row;
}

// Kills: rows in the order of their names; a subject without values before those with some.
TEST(AccuracyTable, BeginsWithTheMostExact) {
  AccuracyRow none = row_of("none", 0);
  none.figures.clear();
  const std::string text =
      accuracy_text({none, row_of("far", 12345), row_of("near", 0.5)}, std::nullopt);
  const std::size_t near = text.find("\nnear ");
  const std::size_t far = text.find("\nfar ");
  EXPECT_LT(near, far);
  ASSERT_NE(text.find("\nnone "), std::string::npos);
  EXPECT_LT(far, text.find("\nnone "));
  EXPECT_THAT(text, HasSubstr("0.5 / 0.25"));
  EXPECT_THAT(text, HasSubstr("1.2e+04 / 0.25"));
}

TEST(AccuracyTable, HasSharesAndRates) {
  AccuracyRow row = row_of("it", 0.5);
  row.wrong_samples = 10;
  row.violated = 1;
  row.frame_time = 2.04;
  EXPECT_EQ(
      accuracy_markdown({row}),
      "| rasterizer | version | cases drawn | wrong samples in 10^6 | ordinary | near horizon | "
      "clipped | slivers | window-linear | depth | not numbers | values not judged | promise | "
      "frame time |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
      "| it | it 1.0 | 150 of 200 | 2.5 | 0.5 / 0.25 | – | – | – | – | – | 0 | 25% | broken | 2.0 "
      "|\n");
}

}  // namespace
}  // namespace rastercheck::reports::accuracy_table_test
