#include "reports/text_table.h"

#include <gtest/gtest.h>

namespace rastercheck::reports {
namespace {

TEST(TextTable, HasColumnsAsWideAsTheirWidestCell) {
  EXPECT_EQ(text_table({{"law", "of"}, {"a longer one", "cpu", "held"}}),
            "law           of\n"
            "a longer one  cpu  held\n");
  EXPECT_EQ(text_table({}), "");
}

// Kills: widths in bytes.
TEST(TextTable, CountsCharacters) {
  EXPECT_EQ(text_table({{"≤ 1", "x"}, {"abcd", "y"}}), "≤ 1   x\nabcd  y\n");
}

TEST(TextTable, EndsNoLineWithSpaces) {
  EXPECT_EQ(text_table({{"a", ""}, {"b", "c"}}), "a\nb  c\n");
}

}  // namespace
}  // namespace rastercheck::reports
