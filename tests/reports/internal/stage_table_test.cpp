#include "reports/internal/stage_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rastercheck::reports::stage_table_test {
namespace {

using records::AttributeKind;
using records::LawSummary;
using records::Stage;
using records::Stratum;
using ::testing::HasSubstr;

TEST(StageTable, SharesAreOfSizeTimesNumber) {
  LawSummary row;
  row.stages = {{AttributeKind::smooth, {}, Stage::set_up, 10, {{0.25, 0.25}}},
                {AttributeKind::smooth, {}, Stage::rounding, 30, {{0.25, 0.25}}},
                {AttributeKind::smooth, Stratum::sliver, Stage::set_up, 5, {{0.5, 0.5}}}};
  const std::string table = stage_table(row);
  EXPECT_THAT(table, HasSubstr("<td>smooth</td><td>all</td>"));
  // The shares are 2.5 and 7.5 of 10.
  EXPECT_THAT(table, HasSubstr("<rect class=\"stage-3\" x=\"0.00\" width=\"25.00\""));
  EXPECT_THAT(table, HasSubstr("<rect class=\"stage-7\" x=\"25.00\" width=\"75.00\""));
  EXPECT_THAT(table, HasSubstr("data-name=\"set-up\">0.25</td>"));
  EXPECT_THAT(table, HasSubstr("data-name=\"rounding\"><strong>0.25</strong></td>"));
  EXPECT_THAT(table, HasSubstr("<td>sliver</td>"));
  EXPECT_THAT(table, HasSubstr("<rect class=\"stage-3\" x=\"0.00\" width=\"100.00\""));
  EXPECT_THAT(table, HasSubstr("<td class=\"number none\" data-name=\"rounding\">–</td>"));
}

TEST(StageTable, SaysNothingOfWhatWasNotSplit) { EXPECT_EQ(stage_table({}), ""); }

TEST(StageTable, OfUnknownSizesThereIsNoBar) {
  LawSummary row;
  row.stages = {{AttributeKind::depth, {}, Stage::snap, 10, {}}};
  EXPECT_THAT(stage_table(row), HasSubstr("aria-hidden=\"true\"></svg>"));
  EXPECT_THAT(stage_table(row), HasSubstr("data-name=\"snap\">–</td>"));
}

}  // namespace
}  // namespace rastercheck::reports::stage_table_test
