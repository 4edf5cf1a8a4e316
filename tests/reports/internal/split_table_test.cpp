#include "reports/internal/split_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace rastercheck::reports::split_table_test {
namespace {

using records::ErrorSplit;
using records::Stage;
using ::testing::HasSubstr;
using ::testing::Not;

// Kills: bars that begin at zero, and so do not show that they add up.
TEST(SplitTable, EachBarBeginsWhereTheLastEnded) {
  ErrorSplit split;
  split.parts = {{Stage::snap, {2, 2}}, {Stage::set_up, {-1, -1}}, {Stage::rounding, {0, 0}}};
  split.total = {1, 1};
  const std::string table = split_table(split);
  // From 0 to 2, on 200 units.
  EXPECT_THAT(table, HasSubstr("<rect class=\"above\" x=\"0.0\" y=\"2\" width=\"200.0\""));
  EXPECT_THAT(table, HasSubstr("<rect class=\"below\" x=\"100.0\" y=\"2\" width=\"100.0\""));
  EXPECT_THAT(table, HasSubstr("<rect class=\"total\" x=\"0.0\" y=\"2\" width=\"100.0\""));
  EXPECT_THAT(table, HasSubstr("<tr class=\"largest\"><th scope=\"row\">snap</th>"
                               "<td class=\"number\">+2</td>"));
  EXPECT_THAT(table, HasSubstr("<tr><th scope=\"row\">set-up</th><td class=\"number\">-1</td>"));
  EXPECT_THAT(table, HasSubstr("<th scope=\"row\">rounding</th><td class=\"number\">0</td>"
                               "<td></td>"));
  EXPECT_THAT(table, HasSubstr("<tr class=\"total\"><th scope=\"row\">total</th>"
                               "<td class=\"number\">+1</td>"));
}

// An error of 0, and an error that no double bounds.
TEST(SplitTable, DrawsWithinItsBox) {
  ErrorSplit none;
  none.parts = {{Stage::rounding, {0, 0}}};
  EXPECT_THAT(split_table(none), Not(HasSubstr("largest")));
  ErrorSplit endless = none;
  endless.parts[0].error = {1, std::numeric_limits<double>::infinity()};
  endless.total = endless.parts[0].error;
  EXPECT_THAT(split_table(endless), Not(HasSubstr("x=\"inf\"")));
  EXPECT_THAT(split_table(endless), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace rastercheck::reports::split_table_test
